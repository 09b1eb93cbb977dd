//! Restitutions by their pair of bodies.

use fem_case::CaseFile;
use fem_case::engineering::show;

use super::restitutions::Restitutions;

/// Restitutions by pairs of bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredPairs {
    /// All points, in the order of the data.
    pub data: Restitutions,
    /// The pairs, in the order of their first points.
    pub pairs: Vec<MeasuredPair>,
}

/// The points of one pair.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredPair {
    /// Diameters that replace those of the case, m.
    pub diameters: [Option<f64>; 2],
    /// Indices of its points in the data.
    pub points: Vec<usize>,
}

impl MeasuredPair {
    /// Gives the spheres of a case the diameters of the data.
    pub fn resize(&self, file: &mut CaseFile) {
        for (body, diameter) in file.body.iter_mut().zip(self.diameters) {
            if let (Some(sphere), Some(diameter)) = (&mut body.sphere, diameter) {
                sphere.diameter = diameter.into();
            }
        }
    }
}

/// All points belong to the case's own pair.
impl From<Restitutions> for MeasuredPairs {
    fn from(data: Restitutions) -> Self {
        Self::sorted(data, |_| [None, None])
    }
}

impl MeasuredPairs {
    /// Sorts points by the diameters (m) that replace those of the case.
    pub fn sorted(data: Restitutions, diameters: impl Fn(usize) -> [Option<f64>; 2]) -> Self {
        let mut pairs: Vec<MeasuredPair> = Vec::new();
        for point in 0..data.points.len() {
            let diameters = diameters(point);
            match pairs.iter_mut().find(|known| known.diameters == diameters) {
                Some(known) => known.points.push(point),
                None => pairs.push(MeasuredPair { diameters, points: vec![point] }),
            }
        }
        Self { data, pairs }
    }

    /// Returns the points that are kept, with a note about the others: they are too fast for a model.
    pub fn kept(self, is_kept: &[bool]) -> Self {
        let diameters: Vec<_> =
            (0..is_kept.len()).map(|k| self.pairs[self.pair_of(k)].diameters).collect();
        let chosen: Vec<usize> = (0..is_kept.len()).filter(|k| is_kept[*k]).collect();
        let mut data = self.data;
        let fast = data.points.iter().zip(is_kept).filter(|(_, kept)| !**kept);
        let slowest = fast.map(|(point, _)| point.speed).fold(f64::INFINITY, f64::min);
        if slowest.is_finite() {
            data.notes.push(format!(
                "{} of {} points, from {} on, are left out: their contacts are too large for the model",
                is_kept.len() - chosen.len(),
                is_kept.len(),
                show(slowest, "m/s")
            ));
        }
        data.points = chosen.iter().map(|k| data.points[*k]).collect();
        data.lines = chosen.iter().filter_map(|k| data.lines.get(*k).copied()).collect();
        Self::sorted(data, |k| diameters[chosen[k]])
    }

    /// Returns the restitutions of all points.
    pub fn restitutions(&self) -> Vec<f64> {
        self.data.points.iter().map(|point| point.restitution).collect()
    }

    /// Returns the standard uncertainties of all points, if all have one.
    pub fn uncertainties(&self) -> Option<Vec<f64>> {
        self.data.points.iter().map(|point| point.restitution_uncertainty).collect()
    }

    /// Returns for each point the first point of the same collision, with the same pair and speed.
    pub fn collisions(&self) -> Vec<usize> {
        let points = &self.data.points;
        let is_same = |a: usize, b: usize| {
            let (first, second) = (points[a].speed, points[b].speed);
            // Conversions of units are rounded.
            (first - second).abs() <= 1e-12 * first && self.pair_of(a) == self.pair_of(b)
        };
        (0..points.len()).map(|k| (0..k).find(|j| is_same(*j, k)).unwrap_or(k)).collect()
    }

    /// Returns the pair of a point.
    pub fn pair_of(&self, point: usize) -> usize {
        self.pairs.iter().position(|pair| pair.points.contains(&point)).unwrap_or(0)
    }
}
