//! The common refinement of both surfaces, in the order of the radius.

use std::f64::consts::PI;

use super::MovedInterface;
use super::segment::{Place, Segment};
use crate::evaluate::SurfaceFold;
use crate::interface::mean_length;

/// Gauss points of a piece: shares of the half length from its middle, and weights.
pub(super) const GAUSS: [[f64; 2]; 3] =
    [[-0.774_596_669_241_483_4, 5.0 / 9.0], [0.0, 8.0 / 9.0], [0.774_596_669_241_483_4, 5.0 / 9.0]];

/// A piece of the radius over which neither surface has a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece<'a> {
    /// Values of the lower and the upper surface.
    pub segments: [Segment<'a>; 2],
    /// Its ends, m.
    pub radii: [f64; 2],
    /// Sides and nodes that the ends move with; none of the axis and of a rigid sphere's equator.
    pub ends: [Option<(usize, u32)>; 2],
    /// Penalty per area, Pa/m.
    pub stiffness: f64,
}

/// A Gauss point of a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    /// m.
    pub radius: f64,
    /// 2πr dr, m².
    pub area: f64,
    /// y of the upper less that of the lower surface, m.
    pub gap: f64,
    /// Values of the lower and the upper surface.
    pub places: [Place; 2],
}

/// Walks along both surfaces. `U` tells the displacement of a node, m.
#[derive(Clone)]
pub(super) struct Pieces<'a, U> {
    interface: &'a MovedInterface,
    displacement: [U; 2],
    /// The segments in which the walk is; none if a surface turns over at the axis.
    segments: Option<[Segment<'a>; 2]>,
    is_over: bool,
    radius: f64,
    end: Option<(usize, u32)>,
    /// The side whose surface turns over where the walk has ended.
    turned: Option<usize>,
}

impl MovedInterface {
    /// The pieces for displacements (m) of the nodes of the lower and the upper body.
    pub(super) fn pieces<U: Fn(u32) -> [f64; 2]>(&self, displacement: [U; 2]) -> Pieces<'_, U> {
        let [lower, upper] = [0, 1].map(|side| self.segment(side, 0, &displacement[side]));
        let turned = [&lower, &upper].into_iter().position(Option::is_none);
        Pieces {
            interface: self,
            displacement,
            segments: lower.zip(upper).map(|(lower, upper)| [lower, upper]),
            is_over: turned.is_some(),
            radius: 0.0,
            end: None,
            turned,
        }
    }

    /// All Gauss points.
    pub(super) fn points<'a, U: Fn(u32) -> [f64; 2] + 'a>(
        &'a self,
        displacement: [U; 2],
    ) -> impl Iterator<Item = (Piece<'a>, Point)> + 'a {
        self.pieces(displacement).flat_map(|piece| GAUSS.map(|gauss| (piece, piece.point(gauss))))
    }

    /// A segment of a side, by the number of its inner node; `None` if it is turned over.
    pub(super) fn segment<U: Fn(u32) -> [f64; 2]>(
        &self,
        side: usize,
        index: usize,
        displacement: &U,
    ) -> Option<Segment<'_>> {
        let surface = &self.surfaces[side];
        let ends = [surface.nodes[index], surface.nodes[index + 1]].map(displacement);
        let (sign, gap) = if side == 0 { (-1.0, 0.0) } else { (1.0, self.gap) };
        Segment::new(surface, index, ends, sign, gap)
    }
}

impl<'a> Piece<'a> {
    /// Radius (m) and area seen along y (m²) at a share of the half length from the middle, −1 to 1.
    pub fn ring(&self, [offset, weight]: [f64; 2]) -> (f64, f64) {
        let [start, end] = self.radii;
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let radius = middle + offset * half;
        (radius, 2.0 * PI * radius * (weight * half))
    }

    /// The point there.
    pub fn point(&self, gauss: [f64; 2]) -> Point {
        let (radius, area) = self.ring(gauss);
        let places = self.segments.each_ref().map(|segment| segment.at(radius));
        Point { radius, area, gap: places[1].height - places[0].height, places }
    }

    /// The same if it is closed. Most points are open, and most of those by so much that it is known without
    /// their arcs.
    pub fn closed_point(&self, gauss: [f64; 2]) -> Option<Point> {
        let (radius, _) = self.ring(gauss);
        let [lower, upper] = self.segments.each_ref().map(|segment| segment.least_depth(radius));
        if lower + upper > 0.0 {
            return None;
        }
        Some(self.point(gauss)).filter(|point| point.gap < 0.0)
    }
}

impl<U: Fn(u32) -> [f64; 2]> Pieces<'_, U> {
    /// Where the walk has ended because a surface turns over, and whether it overlaps the other
    /// one further on: nodes beyond are compared with the other surface where they have come back to.
    pub fn turn(&self) -> Option<(SurfaceFold, bool)> {
        let side = self.turned?;
        let surface = &self.interface.surfaces[side];
        let at =
            |first: usize| SurfaceFold { side, node: surface.nodes[first], radius: self.radius };
        let Some(segments) = self.segments else { return Some((at(1), true)) };
        let first = segments[side].index + 2;
        let overlaps = (first..self.interface.n_nodes[side]).any(|k| {
            let [u_r, u_y] = self.displacement[side](surface.nodes[k]);
            let r = (surface.radii[k] + u_r).clamp(0.0, self.radius);
            let [lower, upper] = [0, 1].map(|s| match s == side {
                true if s == 0 => u_y - surface.depth(surface.radii[k]),
                true => u_y + self.interface.gap + surface.depth(surface.radii[k]),
                false => self.height_inside(s, &segments[s], r),
            });
            upper <= lower
        });
        Some((at(first), overlaps))
    }

    /// Height (m) of a side at a radius (m) up to the last segment in which the walk was.
    fn height_inside(&self, side: usize, last: &Segment<'_>, r: f64) -> f64 {
        if last.is_rigid() || r >= last.radii[0] {
            return last.at(r).height;
        }
        let (surface, displacement) = (&self.interface.surfaces[side], &self.displacement[side]);
        let is_beyond = |k: &usize| surface.radii[*k] + displacement(surface.nodes[*k])[0] > r;
        let outer = (1..last.index).find(is_beyond).unwrap_or(last.index);
        let segment = self.interface.segment(side, outer - 1, displacement);
        segment.as_ref().unwrap_or(last).at(r).height
    }
}

impl<'a, U: Fn(u32) -> [f64; 2]> Iterator for Pieces<'a, U> {
    type Item = Piece<'a>;

    fn next(&mut self) -> Option<Piece<'a>> {
        while !self.is_over {
            let segments = self.segments.as_ref()?;
            let side = usize::from(segments[1].radii[1] < segments[0].radii[1]);
            let ending = &segments[side];
            let radii = [self.radius, ending.radii[1]];
            let next = ending.index + 1;
            let end = (!ending.is_rigid()).then(|| (side, ending.nodes()[1]));
            let piece = (radii[1] > radii[0]).then(|| {
                let numbers = segments.each_ref().map(|segment| segment.index);
                let length = mean_length(&self.interface.surfaces, numbers);
                let stiffness = self.interface.stiffness / length;
                Piece { segments: *segments, radii, ends: [self.end, end], stiffness }
            });
            (self.radius, self.end) = (radii[1], end);
            self.step(side, next);
            if piece.is_some() {
                return piece;
            }
        }
        None
    }
}

impl<U: Fn(u32) -> [f64; 2]> Pieces<'_, U> {
    /// Takes a side to the segment of this number, or ends the walk.
    fn step(&mut self, side: usize, next: usize) {
        if next + 1 >= self.interface.n_nodes[side] {
            self.is_over = true;
            return;
        }
        match (&mut self.segments, self.interface.segment(side, next, &self.displacement[side])) {
            (Some(segments), Some(segment)) => segments[side] = segment,
            _ => {
                self.is_over = true;
                self.turned = Some(side);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use fem_mesh::{HalfDisc, Side};

    use super::*;
    use crate::surface::Surface;

    fn sphere(radius: f64, contact_element_size: f64, side: Side) -> Surface {
        let disc = HalfDisc { radius, contact_element_size, refined_radius: 0.3, growth: None };
        Surface::of_sphere(&disc.build().unwrap().on_side(side))
    }

    /// Of two spheres, and of one and a rigid sphere or a plane, pressed together by less and more and
    /// stretched: closed points are the same as by the arcs, and few others are asked for theirs. How many
    /// are is what a step of the contact costs.
    #[test]
    fn points_that_are_open_are_known_without_their_arcs() {
        let others =
            [sphere(1.0, 0.011, Side::Above), Surface::rigid_sphere(1.5).unwrap(), Surface::wall()];
        for upper in others {
            let lower = sphere(2.0, 0.01, Side::Below);
            let interface = MovedInterface::new(lower, upper, 1.0, 1e-4, 0.3).unwrap();
            let radii = interface.surfaces.each_ref().map(|surface| {
                let of = surface.nodes.iter().zip(&surface.radii);
                let mut radii =
                    vec![0.0; 1 + surface.nodes.iter().max().map_or(0, |&n| n as usize)];
                of.for_each(|(&node, &r)| radii[node as usize] = r);
                if surface.is_rigid() { vec![0.0; 2] } else { radii }
            });
            for pressed in [-1e-3, 1e-3, 4e-3, 1.5e-2] {
                // A surface gives way where it is pressed, by half as much on the axis.
                let moved = |side: usize| {
                    let (radii, sign) = (&radii[side], [1.0, -1.0][side]);
                    move |node: u32| {
                        let r = radii[node as usize];
                        [0.02 * r, sign * 0.5 * pressed * (1.0 - 0.5 * (-50.0 * r * r).exp())]
                    }
                };
                let (mut n, mut n_closed, mut n_asked) = (0, 0, 0);
                for piece in interface.pieces([moved(0), moved(1)]) {
                    for gauss in GAUSS {
                        let (point, found) = (piece.point(gauss), piece.closed_point(gauss));
                        let gap = |point: Point| point.gap.to_bits();
                        let is_closed = point.gap < 0.0;
                        assert_eq!(found.map(gap), is_closed.then(|| gap(point)));
                        let depth = piece.segments.map(|segment| segment.least_depth(point.radius));
                        n += 1;
                        n_closed += usize::from(is_closed);
                        n_asked += usize::from(depth[0] + depth[1] <= 0.0);
                    }
                }
                assert!(n > 60 && (n_closed > 3) == (pressed > 0.0), "{n} {n_closed}");
                assert!(
                    (n_closed..=n_closed + 2).contains(&n_asked),
                    "{n_closed} {n_asked} of {n}"
                );
            }
        }
    }
}
