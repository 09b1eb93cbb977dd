//! The linear complementarity problem of a contact area that is not a disc.
//!
//! Block principal pivoting solves on a set of closed points, moves every point that violates its sign to
//! the other set, and repeats (Kostreva 1978; Júdice & Pires 1994). This is fast but may cycle. If
//! the number of violations does not decrease for some rounds, points are closed one at a time, the one with the
//! largest overlap first, and points in tension are opened (Lawson & Hanson 1974, ch. 23). Then ½ pᵀE p − bᵀp falls
//! in each round, so that no set of points occurs twice; about n rounds are sufficient in practice.

use faer::Mat;

use crate::condensation::dense::cholesky;

/// Rounding of overlap or tension, relative to the largest overlap or force.
pub(crate) const ROUNDING: f64 = 1e-11;

/// Number of rounds without progress before points are moved one at a time.
const ROUNDS_WITHOUT_PROGRESS: usize = 8;
/// Largest number of points that are closed one at a time, over that of all points; more are a cycle by rounding.
const MAX_ROUNDS: usize = 10;

/// Error: no state without tension and overlap was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NoContactState;

/// Computes forces p ≥ 0 (N) with E p − b ≥ 0 and no force on an open point. `forces` gives the first guess of the
/// closed points.
pub(crate) fn solve(
    compliance: &Mat<f64>,
    overlap: &[f64],
    forces: &mut [f64],
) -> Result<(), NoContactState> {
    let n = overlap.len();
    let scale = ROUNDING * overlap.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let mut closed: Vec<bool> = forces.iter().map(|&force| force > 0.0).collect();
    let (mut fewest, mut rounds_left) = (n + 1, ROUNDS_WITHOUT_PROGRESS);
    while rounds_left > 0 {
        solve_closed(compliance, overlap, &closed, forces).ok_or(NoContactState)?;
        let largest = forces.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let violated: Vec<usize> = (0..n)
            .filter(|&k| match closed[k] {
                true => forces[k] < -ROUNDING * largest,
                false => left_overlap(compliance, overlap, forces, k) > scale,
            })
            .collect();
        if violated.is_empty() {
            forces.iter_mut().for_each(|force| *force = force.max(0.0));
            return Ok(());
        }
        if violated.len() < fewest {
            (fewest, rounds_left) = (violated.len(), ROUNDS_WITHOUT_PROGRESS);
        } else {
            rounds_left -= 1;
        }
        violated.iter().for_each(|&k| closed[k] = !closed[k]);
    }
    descend(compliance, overlap, scale, forces).map(|_| ())
}

/// Solves the problem one point at a time, beginning with none, and returns how many were closed. Overlap up to
/// `scale` (m) is ignored.
fn descend(
    compliance: &Mat<f64>,
    overlap: &[f64],
    scale: f64,
    forces: &mut [f64],
) -> Result<usize, NoContactState> {
    let n = overlap.len();
    let (mut closed, mut next) = (vec![false; n], vec![0.0; n]);
    forces.fill(0.0);
    for round in 0..MAX_ROUNDS * n.max(1) {
        let open = (0..n).filter(|&k| !closed[k]);
        let left = open.map(|k| (k, left_overlap(compliance, overlap, forces, k)));
        let Some((worst, _)) =
            left.filter(|(_, left)| *left > scale).max_by(|a, b| a.1.total_cmp(&b.1))
        else {
            return Ok(round);
        };
        closed[worst] = true;
        loop {
            solve_closed(compliance, overlap, &closed, &mut next).ok_or(NoContactState)?;
            // The step ends where the first point would be in tension.
            let pulls = (0..n).filter(|&k| closed[k] && next[k] <= 0.0);
            let reach = pulls.map(|k| (k, forces[k] / (forces[k] - next[k])));
            let Some((first, part)) = reach.min_by(|a, b| a.1.total_cmp(&b.1)) else { break };
            for (force, next) in forces.iter_mut().zip(&next) {
                *force += part * (next - *force);
            }
            for k in 0..n {
                if closed[k] && (k == first || forces[k] <= 0.0) {
                    (closed[k], forces[k]) = (false, 0.0);
                }
            }
        }
        forces.copy_from_slice(&next);
    }
    Err(NoContactState)
}

/// Returns the remaining overlap at an open point, m.
fn left_overlap(compliance: &Mat<f64>, overlap: &[f64], forces: &[f64], point: usize) -> f64 {
    let closing: f64 =
        forces.iter().enumerate().map(|(j, force)| compliance[(j, point)] * force).sum();
    overlap[point] - closing
}

/// Returns the forces that close the gap at the closed points; zero at the others.
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

    fn problem(seed: usize) -> (Mat<f64>, Vec<f64>) {
        let n = 1 + seed % 17;
        let root = Mat::from_fn(n, n, |i, j| noise(seed * 1000 + i * n + j * j));
        let mut compliance = &root * root.transpose();
        for i in 0..n {
            compliance[(i, i)] += 1e-3;
        }
        (compliance, (0..n).map(|k| noise(seed * 77 + 3 * k)).collect())
    }

    /// Random problems: the conditions themselves are the test.
    #[test]
    fn random_contact_problems_satisfy_complementarity() {
        for seed in 0..200 {
            let (compliance, overlap) = problem(seed);
            let n = overlap.len();
            let [mut forces, mut one_by_one] = [vec![0.0; n], vec![0.0; n]];
            solve(&compliance, &overlap, &mut forces).unwrap();
            let n_rounds = descend(&compliance, &overlap, 0.0, &mut one_by_one).unwrap();
            // Few points are closed twice.
            assert!(n_rounds <= 2 * n, "{seed}: {n_rounds} of {n}");
            for forces in [forces, one_by_one] {
                let largest = forces.iter().copied().fold(0.0, f64::max);
                for k in 0..n {
                    let gap = -left_overlap(&compliance, &overlap, &forces, k);
                    // Rounding times the condition number, 1e4.
                    assert!(forces[k] >= 0.0 && gap >= -1e-10, "{seed}: {forces:?}");
                    assert!(forces[k] * gap.abs() <= 1e-10 * largest, "{seed}: {forces:?}");
                }
            }
        }
    }

    /// Points that follow each other closely, as Gauss points of soft bodies do, pushed as no disc is.
    #[test]
    fn active_set_iterations_do_not_exceed_the_number_of_points() {
        for n in [10, 40, 160] {
            // 1/(1 + |i − j|) is positive definite: a convex function of the distance (Pólya).
            let compliance =
                Mat::from_fn(n, n, |i, j| (1.0 + 0.1 * (i as f64 - j as f64).abs()).recip());
            for seed in 0..10 {
                let overlap: Vec<f64> = (0..n).map(|k| noise(seed * 501 + k)).collect();
                let mut forces = vec![0.0; n];
                let n_rounds = descend(&compliance, &overlap, 0.0, &mut forces).unwrap();
                assert!(n_rounds <= n, "{seed}: {n_rounds} of {n}");
                let mut others = vec![0.0; n];
                solve(&compliance, &overlap, &mut others).unwrap();
                let largest = forces.iter().copied().fold(0.0, f64::max);
                for (one, other) in forces.iter().zip(&others) {
                    assert!((one - other).abs() < 1e-9 * largest, "{n} {seed}: {one} {other}");
                }
            }
        }
    }
}
