//! The linear complementarity problem of a contact that is no disc.
//!
//! Principal pivoting: solve on a set of closed points, move every point that violates its sign to
//! the other side, repeat (Kostreva 1978; Júdice & Pires 1994). That is fast and may cycle; when
//! the number of violations has not fallen for a while, only the violation with the highest number
//! is moved (Murty 1974), which ends for every positive definite matrix.

use faer::Mat;

use crate::dense::cholesky;

/// Overlap or tension that is rounding, relative to the largest overlap or force.
pub(crate) const ROUNDING: f64 = 1e-11;

/// Rounds without progress before single pivots begin.
const PATIENCE: usize = 8;

/// No state without tension and overlap was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NoState;

/// Forces p ≥ 0 (N) with E p − b ≥ 0 and no force on an open point. `forces` gives the first guess
/// of the closed points.
///
/// # Errors
/// No state was found within 2ⁿ, or a thousand a point, rounds.
pub(crate) fn solve(
    compliance: &Mat<f64>,
    overlap: &[f64],
    forces: &mut [f64],
) -> Result<(), NoState> {
    let n = overlap.len();
    let scale = ROUNDING * overlap.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let mut closed: Vec<bool> = forces.iter().map(|&force| force > 0.0).collect();
    let (mut fewest, mut rounds_left) = (n + 1, PATIENCE);
    for _ in 0..1000 * n.max(1) {
        solve_closed(compliance, overlap, &closed, forces).ok_or(NoState)?;
        let largest = forces.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let violated: Vec<usize> = (0..n)
            .filter(|&k| {
                if closed[k] {
                    forces[k] < -ROUNDING * largest
                } else {
                    let gap: f64 =
                        (0..n).map(|j| compliance[(j, k)] * forces[j]).sum::<f64>() - overlap[k];
                    gap < -scale
                }
            })
            .collect();
        let Some(&last) = violated.last() else {
            forces.iter_mut().for_each(|force| *force = force.max(0.0));
            return Ok(());
        };
        if violated.len() < fewest {
            (fewest, rounds_left) = (violated.len(), PATIENCE);
        } else {
            rounds_left = rounds_left.saturating_sub(1);
        }
        if rounds_left > 0 {
            violated.iter().for_each(|&k| closed[k] = !closed[k]);
        } else {
            closed[last] = !closed[last];
        }
    }
    Err(NoState)
}

/// Forces that close the gap at the closed points; zero at the others.
fn solve_closed(
    compliance: &Mat<f64>,
    overlap: &[f64],
    closed: &[bool],
    forces: &mut [f64],
) -> Option<()> {
    let set: Vec<usize> = (0..closed.len()).filter(|&k| closed[k]).collect();
    let m = set.len();
    let factor = cholesky(&Mat::from_fn(m, m, |i, j| compliance[(set[i], set[j])]))?;
    let mut x: Vec<f64> = set.iter().map(|&k| overlap[k]).collect();
    for i in 0..m {
        let sum: f64 = (0..i).map(|j| factor[(i, j)] * x[j]).sum();
        x[i] = (x[i] - sum) / factor[(i, i)];
    }
    for i in (0..m).rev() {
        let sum: f64 = (i + 1..m).map(|j| factor[(j, i)] * x[j]).sum();
        x[i] = (x[i] - sum) / factor[(i, i)];
    }
    forces.fill(0.0);
    for (&k, x) in set.iter().zip(x) {
        forces[k] = x;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without pattern, in −1/2 .. 1/2.
    fn noise(k: usize) -> f64 {
        (k as f64 * 0.618_033_988_749_895 + 0.29).fract() - 0.5
    }

    /// Random problems: the conditions themselves are the test.
    #[test]
    fn the_conditions_hold() {
        for seed in 0..200 {
            let n = 1 + seed % 17;
            let root = Mat::from_fn(n, n, |i, j| noise(seed * 1000 + i * n + j * j));
            let mut compliance = &root * root.transpose();
            for i in 0..n {
                compliance[(i, i)] += 1e-3;
            }
            let overlap: Vec<f64> = (0..n).map(|k| noise(seed * 77 + 3 * k)).collect();
            let mut forces = vec![0.0; n];
            solve(&compliance, &overlap, &mut forces).unwrap();
            let largest = forces.iter().copied().fold(0.0, f64::max);
            for k in 0..n {
                let closing: f64 = (0..n).map(|j| compliance[(k, j)] * forces[j]).sum();
                let gap = closing - overlap[k];
                // Rounding times the condition number, 1e4.
                assert!(forces[k] >= 0.0 && gap >= -1e-10, "{seed}: {forces:?}");
                assert!(forces[k] * gap.abs() <= 1e-10 * largest, "{seed}: {forces:?}");
            }
        }
    }
}
