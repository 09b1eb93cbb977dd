//! The part of a section where the field lies on one side of a level.

use super::section::{Section, Sides};

/// The bits of a point, which are equal for the shared edges of two triangles.
type PointBits = [u64; 2];
/// A point and its value.
type Corner = ([f64; 2], f64);

/// A region by its outline.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Region {
    /// Closed polygons, oriented like the section's quads; holes run in the opposite direction.
    pub loops: Vec<Vec<[f64; 2]>>,
}

impl Region {
    /// Returns the region where the field is at most `level`.
    pub fn at_most(section: &Section, level: f64) -> Self {
        Cells::of(section).at_most(level)
    }

    /// Returns the region where the field is at least `level`.
    pub fn at_least(section: &Section, level: f64) -> Self {
        Cells::of(section).at_least(level)
    }

    /// Returns the signed area, positive if the section's quads run counter-clockwise.
    pub fn area(&self) -> f64 {
        let cross = |[x1, y1]: [f64; 2], [x2, y2]: [f64; 2]| x1 * y2 - x2 * y1;
        let sides = self.loops.iter().flat_map(|polygon| {
            let next = polygon.iter().cycle().skip(1);
            polygon.iter().zip(next).map(|(a, b)| cross(*a, *b))
        });
        0.5 * sides.sum::<f64>()
    }

    /// Returns the region of a half section together with its mirror image in the vertical axis, without a
    /// seam.
    pub fn mirrored(&self) -> Self {
        Self { loops: self.loops.iter().flat_map(|polygon| mirrored(polygon)).collect() }
    }
}

/// Joins a polygon and its image into one polygon wherever it touches the axis.
fn mirrored(polygon: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let image = |chain: &[[f64; 2]]| -> Vec<[f64; 2]> {
        chain.iter().rev().map(|[x, y]| [-x, *y]).collect()
    };
    let Some(start) = polygon.iter().position(|[x, _]| *x == 0.0) else {
        return vec![polygon.to_vec(), image(polygon)];
    };
    let mut whole = Vec::new();
    let mut chain: Vec<[f64; 2]> = Vec::new();
    let round = polygon.iter().cycle().skip(start).take(polygon.len() + 1);
    for &point in round {
        chain.push(point);
        if point[0] == 0.0 {
            // Two successive points on the axis enclose nothing.
            if chain.len() > 2 {
                let back = image(&chain[1..chain.len() - 1]);
                chain.extend(back);
                whole.push(std::mem::take(&mut chain));
            }
            chain.clear();
            chain.push(point);
        }
    }
    whole
}

/// The quads with finite values, and the neighbour across each of their sides.
pub(crate) struct Cells {
    cells: Vec<[Corner; 4]>,
    beyond: Vec<[Option<u32>; 4]>,
}

impl Cells {
    pub fn of(section: &Section) -> Self {
        let quads: Vec<[u32; 4]> = section.finite_quads().collect();
        let sides = Sides::of(&quads, section.points.len());
        let beyond = |quad: &[u32; 4]| {
            let beyond = |k: usize| sides.find([quad[(k + 1) % 4], quad[k]]);
            [0, 1, 2, 3].map(|k| beyond(k).map(|(cell, _)| cell as u32))
        };
        let corners = |quad: &[u32; 4]| {
            quad.map(|point| (section.points[point as usize], section.values[point as usize]))
        };
        Self {
            cells: quads.iter().map(corners).collect(),
            beyond: quads.iter().map(beyond).collect(),
        }
    }

    /// Returns the region where the field is at most `level`.
    pub fn at_most(&self, level: f64) -> Region {
        self.clipped(level, 1.0)
    }

    /// Returns the region where the field is at least `level`.
    pub fn at_least(&self, level: f64) -> Region {
        self.clipped(-level, -1.0)
    }

    /// Returns the region where `sign` times the field is at most `level`.
    fn clipped(&self, level: f64, sign: f64) -> Region {
        let is_within =
            |cell: &[Corner; 4]| cell.iter().filter(|(_, value)| sign * value <= level).count();
        let within: Vec<usize> = self.cells.iter().map(is_within).collect();
        let (mut edges, mut polygon) = (Edges::default(), Vec::new());
        for ((cell, beyond), &n_within) in self.cells.iter().zip(&self.beyond).zip(&within) {
            if n_within == 4 {
                // A side between two whole quads is no edge.
                for k in 0..4 {
                    if beyond[k].is_none_or(|other| within[other as usize] < 4) {
                        edges.add_side(&cell[k].0, &cell[(k + 1) % 4].0);
                    }
                }
                continue;
            }
            let cell = cell.map(|(place, value)| (place, sign * value));
            let centre = centre(&cell);
            if n_within == 0 && centre.1 > level {
                continue;
            }
            for k in 0..4 {
                clip([cell[k], cell[(k + 1) % 4], centre], level, &mut polygon);
                edges.add_polygon(&polygon);
            }
        }
        Region { loops: edges.into_loops() }
    }
}

/// Returns the mean of the corners.
fn centre(cell: &[Corner; 4]) -> Corner {
    let mean = |of: &dyn Fn(&Corner) -> f64| cell.iter().map(of).sum::<f64>() / 4.0;
    ([mean(&|c| c.0[0]), mean(&|c| c.0[1])], mean(&|c| c.1))
}

/// Finds the part of a triangle with a linear field where that is at most `level`.
fn clip(triangle: [Corner; 3], level: f64, polygon: &mut Vec<[f64; 2]>) {
    polygon.clear();
    for k in 0..3 {
        let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
        if from.1 <= level {
            polygon.push(from.0);
        }
        if (from.1 <= level) != (to.1 <= level) {
            polygon.push(crossing(from, to, level));
        }
    }
}

/// Returns the point where the field passes the level, with the same bits from both ends.
fn crossing(a: Corner, b: Corner, level: f64) -> [f64; 2] {
    let (low, high) = if a.1 < b.1 { (a, b) } else { (b, a) };
    let t = (level - low.1) / (high.1 - low.1);
    [0, 1].map(|axis: usize| low.0[axis] + t * (high.0[axis] - low.0[axis]))
}

/// Directed edges, of which those that run in both directions cancel: the ends in their order, and whether the edge
/// runs against it.
#[derive(Default)]
struct Edges(Vec<(PointBits, PointBits, bool)>);

impl Edges {
    fn add_polygon(&mut self, polygon: &[[f64; 2]]) {
        let next = polygon.iter().cycle().skip(1);
        polygon.iter().zip(next).for_each(|(from, to)| self.add_side(from, to));
    }

    fn add_side(&mut self, from: &[f64; 2], to: &[f64; 2]) {
        // Adding 0 turns −0 into 0.
        let place = |point: &[f64; 2]| point.map(|x| (x + 0.0).to_bits());
        let (from, to) = (place(from), place(to));
        if from != to {
            self.0.push((from.min(to), from.max(to), from > to));
        }
    }

    /// Returns the edges that are left, in their order.
    fn remaining(mut self) -> Vec<(PointBits, PointBits)> {
        self.0.sort_unstable();
        let mut onward = Vec::new();
        for same in self.0.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let (low, high, _) = same[0];
            let n_against = same.iter().filter(|edge| edge.2).count();
            let n_along = same.len() - n_against;
            let edge = if n_along > n_against { (low, high) } else { (high, low) };
            onward.extend(std::iter::repeat_n(edge, n_along.abs_diff(n_against)));
        }
        onward.sort_unstable();
        onward
    }

    fn into_loops(self) -> Vec<Vec<[f64; 2]>> {
        let onward = self.remaining();
        let mut is_taken = vec![false; onward.len()];
        let mut loops = Vec::new();
        for first in 0..onward.len() {
            if is_taken[first] {
                continue;
            }
            let (start, mut place, mut polygon) = (onward[first].0, onward[first].0, Vec::new());
            // Of the edges that go on from a point, the last one is taken first.
            while let Some(next) = (0..onward.partition_point(|edge| edge.0 <= place))
                .rev()
                .take_while(|&k| onward[k].0 == place)
                .find(|&k| !is_taken[k])
            {
                polygon.push(place.map(f64::from_bits));
                is_taken[next] = true;
                place = onward[next].1;
                if place == start {
                    break;
                }
            }
            loops.push(polygon);
        }
        loops
    }
}
