//! The common refinement of both surfaces: intervals of the radius without a node of either, from the axis outward.

use std::f64::consts::PI;

use super::DeformedInterface;
use super::segment::{Segment, SurfacePoint};
use crate::interface::mean_length;
use crate::undeformed_forces::SurfaceFold;

/// Gauss points of an interval: offsets from its middle over the half length, and weights.
pub(super) const GAUSS: [[f64; 2]; 3] =
    [[-0.774_596_669_241_483_4, 5.0 / 9.0], [0.0, 8.0 / 9.0], [0.774_596_669_241_483_4, 5.0 / 9.0]];

/// An interval of the radius in which neither surface has a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interval<'a> {
    /// Segments of the lower and the upper surface.
    pub segments: [Segment<'a>; 2],
    /// Inner and outer end, m.
    pub radii: [f64; 2],
    /// Side and node with which each end moves; `None` on the axis and at the equator of a rigid sphere.
    pub ends: [Option<(usize, u32)>; 2],
    /// Penalty per area, Pa/m.
    pub stiffness: f64,
}

/// A Gauss point of an interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct GaussPoint {
    pub radius: f64,
    /// Area 2πr dr, m².
    pub area: f64,
    /// y of the upper less that of the lower surface, m.
    pub gap: f64,
    /// Points of the lower and the upper surface.
    pub surface_points: [SurfacePoint; 2],
}

/// Iterator over the intervals, along both surfaces. `U` maps a node to its displacement, m.
#[derive(Clone)]
pub(super) struct RefinementWalk<'a, U> {
    interface: &'a DeformedInterface,
    displacement: [U; 2],
    /// Current segments; none if a surface folds at the axis.
    segments: Option<[Segment<'a>; 2]>,
    is_over: bool,
    radius: f64,
    end: Option<(usize, u32)>,
    /// Side whose surface folds where the walk has ended.
    folded: Option<usize>,
}

impl DeformedInterface {
    /// Returns the intervals for displacements (m) of the nodes of the lower and the upper body.
    pub(super) fn intervals<U: Fn(u32) -> [f64; 2]>(
        &self,
        displacement: [U; 2],
    ) -> RefinementWalk<'_, U> {
        let [lower, upper] = [0, 1].map(|side| self.segment(side, 0, &displacement[side]));
        let folded = [&lower, &upper].into_iter().position(Option::is_none);
        RefinementWalk {
            interface: self,
            displacement,
            segments: lower.zip(upper).map(|(lower, upper)| [lower, upper]),
            is_over: folded.is_some(),
            radius: 0.0,
            end: None,
            folded,
        }
    }

    /// Returns all Gauss points with their intervals.
    pub(super) fn points<'a, U: Fn(u32) -> [f64; 2] + 'a>(
        &'a self,
        displacement: [U; 2],
    ) -> impl Iterator<Item = (Interval<'a>, GaussPoint)> + 'a {
        self.intervals(displacement)
            .flat_map(|interval| GAUSS.map(|gauss| (interval, interval.point(gauss))))
    }

    /// Returns a segment of a side by the number of its inner node; `None` if it is folded.
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

impl<'a> Interval<'a> {
    /// Returns radius (m) and projected area (m²) of a Gauss point.
    pub fn ring(&self, [offset, weight]: [f64; 2]) -> (f64, f64) {
        let [start, end] = self.radii;
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let radius = middle + offset * half;
        (radius, 2.0 * PI * radius * (weight * half))
    }

    /// Returns the Gauss point with its values of both surfaces.
    pub fn point(&self, gauss: [f64; 2]) -> GaussPoint {
        let (radius, area) = self.ring(gauss);
        let surface_points = self.segments.each_ref().map(|segment| segment.at(radius));
        GaussPoint {
            radius,
            area,
            gap: surface_points[1].height - surface_points[0].height,
            surface_points,
        }
    }

    /// Returns the Gauss point if it is closed. Most points are open by a large gap, which a lower bound shows
    /// without evaluating the arcs.
    pub fn closed_point(&self, gauss: [f64; 2]) -> Option<GaussPoint> {
        let (radius, _) = self.ring(gauss);
        let [lower, upper] = self.segments.each_ref().map(|segment| segment.least_depth(radius));
        if lower + upper > 0.0 {
            return None;
        }
        Some(self.point(gauss)).filter(|point| point.gap < 0.0)
    }
}

impl<U: Fn(u32) -> [f64; 2]> RefinementWalk<'_, U> {
    /// Returns the fold where the walk along the surface ended, and whether the nodes beyond it overlap the
    /// other surface.
    pub fn surface_fold(&self) -> Option<(SurfaceFold, bool)> {
        let side = self.folded?;
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

    /// Returns the height (m) of a side at a radius (m) up to the last segment of the walk.
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

impl<'a, U: Fn(u32) -> [f64; 2]> Iterator for RefinementWalk<'a, U> {
    type Item = Interval<'a>;

    fn next(&mut self) -> Option<Interval<'a>> {
        while !self.is_over {
            let segments = self.segments.as_ref()?;
            let side = usize::from(segments[1].radii[1] < segments[0].radii[1]);
            let ending = &segments[side];
            let radii = [self.radius, ending.radii[1]];
            let next = ending.index + 1;
            let end = (!ending.is_rigid()).then(|| (side, ending.nodes()[1]));
            let interval = (radii[1] > radii[0]).then(|| {
                let numbers = segments.each_ref().map(|segment| segment.index);
                let length = mean_length(&self.interface.surfaces, numbers);
                let stiffness = self.interface.stiffness / length;
                Interval { segments: *segments, radii, ends: [self.end, end], stiffness }
            });
            (self.radius, self.end) = (radii[1], end);
            self.step(side, next);
            if interval.is_some() {
                return interval;
            }
        }
        None
    }
}

impl<U: Fn(u32) -> [f64; 2]> RefinementWalk<'_, U> {
    /// Moves a side to the segment of this number, or ends the walk.
    fn step(&mut self, side: usize, next: usize) {
        if next + 1 >= self.interface.n_nodes[side] {
            self.is_over = true;
            return;
        }
        match (&mut self.segments, self.interface.segment(side, next, &self.displacement[side])) {
            (Some(segments), Some(segment)) => segments[side] = segment,
            _ => {
                self.is_over = true;
                self.folded = Some(side);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use fem_mesh::Side;

    use super::*;
    use crate::surface::Surface;
    use crate::test_support::sphere;

    fn surface(radius: f64, contact_element_size: f64, side: Side) -> Surface {
        Surface::of_sphere(&sphere(radius, contact_element_size, 0.3, side))
    }

    /// The lower bound of the depth finds the same closed points as the arcs do, and evaluates the arcs of few
    /// others, which decides the cost of the contact. A sphere is pressed on a sphere, a rigid sphere and a plane.
    #[test]
    fn open_points_are_found_without_evaluating_arcs() {
        let others = [
            surface(1.0, 0.011, Side::Above),
            Surface::rigid_sphere(1.5).unwrap(),
            Surface::wall(),
        ];
        for upper in others {
            let lower = surface(2.0, 0.01, Side::Below);
            let interface = DeformedInterface::new(lower, upper, 1.0, 1e-4, 0.3).unwrap();
            let radii = interface.surfaces.each_ref().map(|surface| {
                let of = surface.nodes.iter().zip(&surface.radii);
                let mut radii =
                    vec![0.0; 1 + surface.nodes.iter().max().map_or(0, |&n| n as usize)];
                of.for_each(|(&node, &r)| radii[node as usize] = r);
                if surface.is_rigid() { vec![0.0; 2] } else { radii }
            });
            for pressed in [-1e-3, 1e-3, 4e-3, 1.5e-2] {
                // A surface moves back where it is pressed, by half as much on the axis.
                let moved = |side: usize| {
                    let (radii, sign) = (&radii[side], [1.0, -1.0][side]);
                    move |node: u32| {
                        let r = radii[node as usize];
                        [0.02 * r, sign * 0.5 * pressed * (1.0 - 0.5 * (-50.0 * r * r).exp())]
                    }
                };
                let (mut n, mut n_closed, mut n_asked) = (0, 0, 0);
                for interval in interface.intervals([moved(0), moved(1)]) {
                    for gauss in GAUSS {
                        let (point, found) = (interval.point(gauss), interval.closed_point(gauss));
                        let gap = |point: GaussPoint| point.gap.to_bits();
                        let is_closed = point.gap < 0.0;
                        assert_eq!(found.map(gap), is_closed.then(|| gap(point)));
                        let depth =
                            interval.segments.map(|segment| segment.least_depth(point.radius));
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
