//! A Prony series with as few terms as a range of frequencies needs.
//!
//! The relaxation times are a grid, evenly spaced in the logarithm; for each number of terms the grid with the least error is taken, and
//! the first number within the tolerance. Weights are those of non-negative least squares, so that a passive series stays passive.
//! The error is that of the complex modulus relative to its size, over the range; a decade beyond it counts a tenth.

use fem_material::{PronyTerm, maxwell_element};
use nalgebra::{DMatrix, DVector};

use crate::estimate::spectrum::bounded::non_negative;

/// Samples of the modulus over the range and a decade on both sides.
const SAMPLES: usize = 48;
/// Most terms of a reduced series.
const MOST_TERMS: usize = 12;
/// Ends of the grids over the ends of the range.
const SHIFTS: [f64; 4] = [0.3, 1.0, 3.0, 10.0];

/// Returns the equilibrium weight and terms of a series that has the complex modulus of a given one from one angular frequency to
/// another, rad/s, within a relative tolerance; the given one if that has no more terms. No relaxation time is below `fastest`, s.
pub fn reduced_series(
    equilibrium_weight: f64,
    terms: &[PronyTerm],
    [low, high]: [f64; 2],
    fastest: f64,
    tolerance: f64,
) -> (f64, Vec<PronyTerm>) {
    let resolved = terms.iter().all(|term| term.relaxation_time >= fastest);
    let samples = Samples::of(equilibrium_weight, terms, [low, high]);
    let mut best: Option<(f64, f64, Vec<PronyTerm>)> = None;
    for n_terms in 1..=MOST_TERMS {
        if resolved && terms.len() <= n_terms {
            break;
        }
        for (first, last) in SHIFTS.iter().flat_map(|a| SHIFTS.map(|b| (*a, b))) {
            let (slowest, quickest) = (first / low, (1.0 / (last * high)).max(fastest));
            let time = |k: usize| match n_terms {
                1 => (slowest * quickest).sqrt(),
                n => slowest * (quickest / slowest).powf(k as f64 / (n - 1) as f64),
            };
            let times: Vec<f64> = (0..n_terms).map(time).collect();
            let (error, weight, terms) = samples.fitted(&times);
            if best.as_ref().is_none_or(|best| error < best.0) {
                best = Some((error, weight, terms));
            }
        }
        if best.as_ref().is_some_and(|best| best.0 <= tolerance) {
            break;
        }
    }
    match best {
        Some((error, weight, found)) if error <= tolerance || !resolved => (weight, found),
        _ => (equilibrium_weight, terms.to_vec()),
    }
}

/// The complex modulus at frequencies.
struct Samples {
    frequencies: Vec<f64>,
    /// Weight of the relative error at each frequency.
    weights: Vec<f64>,
    moduli: Vec<[f64; 2]>,
}

impl Samples {
    fn of(equilibrium_weight: f64, terms: &[PronyTerm], [low, high]: [f64; 2]) -> Self {
        let (from, to) = (0.1 * low, 10.0 * high);
        let share = |k: usize| k as f64 / (SAMPLES - 1) as f64;
        let frequencies: Vec<f64> =
            (0..SAMPLES).map(|k| from * (to / from).powf(share(k))).collect();
        let modulus = |frequency: &f64| {
            let parts = terms.iter().map(|term| {
                let own = maxwell_element(frequency * term.relaxation_time);
                own.map(|part| term.weight * part)
            });
            parts.fold([equilibrium_weight, 0.0], |sum, own| [sum[0] + own[0], sum[1] + own[1]])
        };
        let moduli: Vec<[f64; 2]> = frequencies.iter().map(modulus).collect();
        let weight = |(frequency, [real, imaginary]): (&f64, &[f64; 2])| {
            (frequency / low).min(high / frequency).min(1.0) / real.hypot(*imaginary)
        };
        let weights = frequencies.iter().zip(&moduli).map(weight).collect();
        Self { frequencies, weights, moduli }
    }

    /// Returns the largest error, the equilibrium weight and the terms of the best series with these relaxation times.
    fn fitted(&self, times: &[f64]) -> (f64, f64, Vec<PronyTerm>) {
        let element = |row: usize, column: usize| {
            let (k, part) = (row / 2, row % 2);
            let own = match column.checked_sub(1) {
                Some(term) => maxwell_element(self.frequencies[k] * times[term]),
                None => [1.0, 0.0],
            };
            self.weights[k] * own[part]
        };
        let a = DMatrix::from_fn(2 * SAMPLES, times.len() + 1, element);
        let b = DVector::from_fn(2 * SAMPLES, |row, _| {
            self.weights[row / 2] * self.moduli[row / 2][row % 2]
        });
        let weights = non_negative(&a, &b);
        let error = (a * &weights - b).amax();
        let terms = times.iter().zip(weights.iter().skip(1)).filter(|(_, weight)| **weight > 0.0);
        let terms =
            terms.map(|(time, weight)| PronyTerm { weight: *weight, relaxation_time: *time });
        (error, weights[0], terms.collect())
    }
}
