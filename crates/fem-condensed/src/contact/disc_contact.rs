//! The contact problem of one instant, solved exactly.
//!
//! ```math
//! p \ge 0, \qquad E p - b \ge 0, \qquad p^T(E p - b) = 0
//! ```
//!
//! E (m/N) is the compliance and b (m) the overlap that the forces have to remove. Points are numbered outward. If the
//! contact area is a disc, the first n points, then with E = L Lᵀ and L y = b forward substitution reaches y_k ≤ 0
//! first at k = n, because y_k L_kk is the overlap left at point k once all points before it are in contact. A step
//! costs n² operations without iteration. The assumptions, no tension inside and no overlap outside, are checked; if
//! they fail, the general solver (`complementarity`) is used.

use faer::Mat;

use crate::contact::complementarity::{self, NoContactState, ROUNDING};

/// A contact problem with its factor.
#[derive(Debug, Clone)]
pub(crate) struct DiscContactSolver {
    compliance: Mat<f64>,
    /// L by rows and by columns, as far as E is positive definite.
    rows: Vec<f64>,
    columns: Vec<f64>,
    n_factored: usize,
    /// y inside of the disc, remaining overlap outside, m.
    left: Vec<f64>,
    /// Overlap of each point once all points before it are closed, m, in the last problem and in
    /// the one before.
    reach: Vec<f64>,
    reach_before: Vec<f64>,
    /// s² of L s = 1, N/m: what a point adds to the stiffness of those before it.
    stiffness: Vec<f64>,
    /// Forces of the last problem, if the disc was not its solution.
    fallback: Option<Vec<f64>>,
    /// Whether the disc was not the solution of the previous problem.
    was_fallback: bool,
    /// Number of problems whose solution was not the disc.
    pub n_fallbacks: usize,
}

/// Changes of the force's slope by points that join or leave between two problems, at a share ξ of the step, N/m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct ForceCurvature {
    /// Correction of the work, Σ ± s² [½ ξ(1 − ξ) − 1/12].
    pub work: f64,
    /// Slope at the end less the mean slope of the step, Σ ± s² ξ.
    pub missed: f64,
}

/// Result of a contact problem in addition to the forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContactDisc {
    /// Number of points from the axis up to the last with a force.
    pub n_closed: usize,
}

impl DiscContactSolver {
    /// Creates a solver for a symmetric positive definite compliance, m/N.
    pub fn new(compliance: Mat<f64>) -> Self {
        let n = compliance.nrows();
        let mut solver = Self {
            compliance,
            rows: vec![0.0; n * n],
            columns: vec![0.0; n * n],
            n_factored: 0,
            left: vec![0.0; n],
            reach: vec![0.0; n],
            reach_before: vec![0.0; n],
            stiffness: vec![0.0; n],
            fallback: None,
            was_fallback: false,
            n_fallbacks: 0,
        };
        while solver.n_factored < n && solver.factor_row(solver.n_factored) {
            solver.n_factored += 1;
        }
        let mut s = vec![0.0; n];
        for k in 0..solver.n_factored {
            let row = &solver.rows[k * n..][..=k];
            s[k] = (1.0 - dot(&row[..k], &s)) / row[k];
            solver.stiffness[k] = s[k] * s[k];
        }
        solver
    }

    /// Sets the overlaps (m) of the previous problem, in which all points are open.
    pub fn opened(self, overlap: Vec<f64>) -> Self {
        Self { reach: overlap, ..self }
    }

    /// Returns the changes by points that have joined (+) or left (−) since the previous problem, for the numbers of
    /// closed points before and now; zero if a contact area was not a disc.
    pub fn bends(&self, before: usize, now: usize) -> ForceCurvature {
        let mut bends = ForceCurvature::default();
        if self.fallback.is_some() || self.was_fallback {
            return bends;
        }
        let sign = if now > before { 1.0 } else { -1.0 };
        for k in before.min(now)..before.max(now) {
            let [then, now] = [self.reach_before[k], self.reach[k]];
            let part = (then / (then - now)).clamp(0.0, 1.0);
            bends.work += sign * self.stiffness[k] * (0.5 * part * (1.0 - part) - 1.0 / 12.0);
            bends.missed += sign * self.stiffness[k] * part;
        }
        bends
    }

    /// Computes row k of L from the rows before it; returns false if E is not positive definite.
    fn factor_row(&mut self, k: usize) -> bool {
        let n = self.left.len();
        for j in 0..=k {
            let [row, before] = [k, j].map(|i| &self.rows[i * n..][..j]);
            let rest = self.compliance[(k, j)] - dot(row, before);
            let entry = if j == k { rest.sqrt() } else { rest / self.rows[j * n + j] };
            self.rows[k * n + j] = entry;
            self.columns[j * n + k] = entry;
        }
        self.rows[k * n + k] > 0.0
    }

    /// Computes the forces (N) that remove the overlaps (m).
    ///
    /// # Errors
    /// No state is found.
    pub fn solve(
        &mut self,
        overlap: &[f64],
        forces: &mut [f64],
    ) -> Result<ContactDisc, NoContactState> {
        let n = overlap.len();
        forces.fill(0.0);
        self.was_fallback = self.fallback.is_some();
        std::mem::swap(&mut self.reach, &mut self.reach_before);
        self.left.copy_from_slice(overlap);
        let mut n_closed = 0;
        for k in 0..n {
            if k >= self.n_factored {
                return Err(NoContactState);
            }
            let column = &self.columns[k * n..][..n];
            let y = self.left[k] / column[k];
            if y <= 0.0 {
                break;
            }
            (self.reach[k], self.left[k]) = (self.left[k], y);
            let outside = self.left[k + 1..].iter_mut().zip(&column[k + 1..]);
            outside.for_each(|(left, entry)| *left -= entry * y);
            n_closed = k + 1;
        }
        self.reach[n_closed..].copy_from_slice(&self.left[n_closed..]);
        for k in (0..n_closed).rev() {
            let row = &self.rows[k * n..][..=k];
            let force = self.left[k] / row[k];
            forces[k] = force;
            let inside = self.left[..k].iter_mut().zip(row);
            inside.for_each(|(left, entry)| *left -= entry * force);
        }
        if self.is_solution(overlap, &forces[..n_closed]) {
            self.fallback = None;
        } else {
            self.n_fallbacks += 1;
            // The previous closed points are the better guess.
            if let Some(before) = &self.fallback {
                forces.copy_from_slice(before);
            }
            complementarity::solve(&self.compliance, overlap, forces)?;
            self.fallback.get_or_insert_with(|| vec![0.0; n]).copy_from_slice(forces);
            n_closed = forces.iter().rposition(|&force| force > 0.0).map_or(0, |k| k + 1);
        }
        Ok(ContactDisc { n_closed })
    }

    /// Returns whether there is no tension inside the disc and no overlap outside.
    fn is_solution(&self, overlap: &[f64], inside: &[f64]) -> bool {
        let largest = inside.iter().copied().fold(0.0, f64::max);
        if inside.iter().any(|&force| force < -ROUNDING * largest) {
            return false;
        }
        let scale = ROUNDING * overlap.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        // The next point is open by construction; a point further out that b would close must
        // have been opened by the forces.
        self.left.iter().skip(inside.len() + 1).all(|left| *left <= scale)
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The remaining overlap outside of a disc is that left by its forces.
    #[test]
    fn remaining_overlap_outside_the_disc_is_that_of_its_forces() {
        let n = 6;
        let near = |i: usize, j: usize| (-0.3 * i.abs_diff(j) as f64).exp();
        let mut solver = DiscContactSolver::new(Mat::from_fn(n, n, near));
        for height in [0.1, 1.0, 3.0] {
            let overlap: Vec<f64> = (0..n).map(|k| height - 0.2 * (k * k) as f64).collect();
            let mut forces = vec![0.0; n];
            let ContactDisc { n_closed } = solver.solve(&overlap, &mut forces).unwrap();
            assert!(n_closed > 0 && n_closed < n && solver.n_fallbacks == 0);
            for (k, overlap) in overlap.iter().enumerate() {
                let closed: f64 = (0..n).map(|j| near(k, j) * forces[j]).sum();
                let left = if k < n_closed { 0.0 } else { solver.left[k] };
                assert!((overlap - closed - left).abs() < 1e-14, "{height} {k}");
                assert!(forces[k] >= 0.0 && (k < n_closed || left <= 0.0));
            }
        }
    }
}
