//! One body in section, and the sides of its quads.

use std::collections::{BTreeMap, BTreeSet};

/// Quads in the plane with a value at each of their points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    /// Horizontal and vertical coordinate of each point.
    pub points: Vec<[f64; 2]>,
    /// Value at each point; quads with a value that is not finite are left out.
    pub values: Vec<f64>,
    /// Point indices of each quad, all with the same orientation.
    pub quads: Vec<[u32; 4]>,
    /// Point indices along the outline.
    pub outline: Vec<u32>,
}

impl Section {
    /// Returns the section with its mirror image in the vertical axis; points on the axis belong to both
    /// halves. The outline begins or ends on the axis and continues in the mirror image.
    pub fn mirrored(&self) -> Self {
        let mut both = self.clone();
        let mut image: Vec<u32> = Vec::with_capacity(self.points.len());
        for ([x, y], value) in self.points.iter().zip(&self.values) {
            let is_on_axis = *x == 0.0;
            image.push(if is_on_axis { image.len() as u32 } else { both.points.len() as u32 });
            if !is_on_axis {
                both.points.push([-x, *y]);
                both.values.push(*value);
            }
        }
        let mirrored = |quad: &[u32; 4]| {
            let [a, b, c, d] = quad.map(|point| image[point as usize]);
            [d, c, b, a]
        };
        both.quads.extend(self.quads.iter().map(mirrored));
        let mut outline: Vec<u32> =
            self.outline.iter().rev().map(|point| image[*point as usize]).collect();
        let goes_on = outline.last().is_some_and(|last| Some(last) == self.outline.first());
        outline.extend(self.outline.iter().skip(usize::from(goes_on)));
        both.outline = outline;
        both
    }

    /// Returns the points of the outline.
    pub fn outline_points(&self) -> impl Iterator<Item = [f64; 2]> + Clone + '_ {
        self.outline.iter().map(|point| self.points[*point as usize])
    }

    /// Returns the section without the quads outside a rectangle (horizontal range, vertical range). Points and outline
    /// stay.
    pub fn within(&self, x: (f64, f64), y: (f64, f64)) -> Self {
        let is_near = |quad: &&[u32; 4]| {
            let corners = quad.map(|point| self.points[point as usize]);
            let overlaps = |axis: usize, (from, to): (f64, f64)| {
                corners.iter().any(|corner| corner[axis] >= from)
                    && corners.iter().any(|corner| corner[axis] <= to)
            };
            overlaps(0, x) && overlaps(1, y)
        };
        let quads = self.quads.iter().filter(is_near).copied().collect();
        Self { quads, ..self.clone() }
    }

    /// Returns the sides of all quads as lines, each side once.
    pub fn lines(&self) -> Vec<Vec<[f64; 2]>> {
        let mut open: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        for quad in &self.quads {
            for k in 0..4 {
                let [a, b] = [quad[k], quad[(k + 1) % 4]];
                open.entry(a).or_default().insert(b);
                open.entry(b).or_default().insert(a);
            }
        }
        let mut lines = Vec::new();
        while let Some((&start, ends)) = open.first_key_value() {
            if ends.is_empty() {
                open.pop_first();
                continue;
            }
            let (mut here, mut line) = (start, vec![self.points[start as usize]]);
            while let Some(next) = open.get_mut(&here).and_then(BTreeSet::pop_last) {
                open.get_mut(&next).map(|back| back.remove(&here));
                line.push(self.points[next as usize]);
                here = next;
            }
            lines.push(line);
        }
        lines
    }

    /// Returns the quads whose values are all finite.
    pub(crate) fn finite_quads(&self) -> impl Iterator<Item = [u32; 4]> {
        let is_finite = |quad: &[u32; 4]| quad.iter().all(|k| self.values[*k as usize].is_finite());
        self.quads.iter().copied().filter(is_finite)
    }

    /// Returns the smallest and the largest value of the quads; `None` without quads.
    pub fn range(&self) -> Option<(f64, f64)> {
        let values = self.finite_quads().flatten().map(|point| self.values[point as usize]);
        values.fold(None, |range, value| {
            let (from, to) = range.unwrap_or((value, value));
            Some((value.min(from), value.max(to)))
        })
    }
}

/// The sides of quads by the point at which they begin.
pub(super) struct Sides {
    /// Where the sides of each point begin in `all`, and where those of the last one end.
    first: Vec<usize>,
    /// The other end of a side, its quad and its number there.
    all: Vec<(u32, usize, usize)>,
}

impl Sides {
    /// Sorts the sides of quads on so many points.
    pub fn of(quads: &[[u32; 4]], n_points: usize) -> Self {
        // Counted two places further on, so that filling `all` moves each beginning to its place.
        let mut first = vec![0; n_points + 2];
        quads.as_flattened().iter().for_each(|&point| first[point as usize + 2] += 1);
        for point in 2..first.len() {
            first[point] += first[point - 1];
        }
        let mut all = vec![(0, 0, 0); 4 * quads.len()];
        for (cell, quad) in quads.iter().enumerate() {
            for (k, &from) in quad.iter().enumerate() {
                let place = &mut first[from as usize + 1];
                all[*place] = (quad[(k + 1) % 4], cell, k);
                *place += 1;
            }
        }
        Self { first, all }
    }

    /// Returns the quad with a side from one point to another, and the number of the side there.
    pub fn find(&self, [from, to]: [u32; 2]) -> Option<(usize, usize)> {
        let from = from as usize;
        let sides = &self.all[self.first[from]..self.first[from + 1]];
        sides.iter().rev().find(|side| side.0 == to).map(|&(_, cell, k)| (cell, k))
    }
}
