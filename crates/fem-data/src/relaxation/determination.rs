//! Whether the moduli determine the shifts of blocks.
//!
//! The curvature of the misfit gives the uncertainty of a shift only where the misfit depends on it. On a plateau a block meets one series
//! about as well wherever it is put beyond its neighbours. Therefore each block is moved away from the reference by [`REACH`], alone and
//! with all blocks behind it, and a series is fitted to all moduli again. Where the misfit does not show the move, nothing determines the
//! shift.
//!
//! Limits: vertical factors do not follow the moves.

use nalgebra::Matrix2;

use super::joint::Joint;
use super::superposition::DENSITY;

/// Distance by which blocks are moved, decades, and the standard deviations by which the misfit must grow to show the move: an
/// uncertainty is then at most a decade.
const REACH: f64 = 3.0;

impl Joint<'_> {
    /// Returns whether the moduli determine the shift of each block but the reference.
    pub(super) fn determined(&self, shifts: &[f64], whitening: &Matrix2<f64>) -> Vec<bool> {
        let misfit = |shifts: &[f64]| self.misfit_on_grid(shifts, whitening, DENSITY);
        let (own, freedom) = misfit(shifts);
        let n = self.moving.len();
        let is_seen = |moved: &dyn Fn(usize) -> bool, decades: f64| {
            let mut shifts = shifts.to_vec();
            for k in (0..n).filter(|k| moved(*k)) {
                shifts[k] += decades * std::f64::consts::LN_10;
            }
            misfit(&shifts).0 - own > REACH * REACH * own / freedom
        };
        let is_colder = |k: usize| self.moving[k] < self.reference;
        let n_colder = (0..n).filter(|k| is_colder(*k)).count();
        // Colder blocks are slower: their frequencies count as higher ones.
        let away = |k: usize| if is_colder(k) { REACH } else { -REACH };
        let is_seen_alone = (0..n).map(|k| is_seen(&|other| other == k, away(k)));
        let mut determined: Vec<bool> = is_seen_alone.collect();
        if let Some(k) = (0..n_colder).rev().find(|k| !is_seen(&|other| other <= *k, REACH)) {
            determined[..=k].fill(false);
        }
        if let Some(k) = (n_colder..n).find(|k| !is_seen(&|other| other >= *k, -REACH)) {
            determined[k..].fill(false);
        }
        determined
    }
}
