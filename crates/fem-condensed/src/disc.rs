//! The contact problem of one instant, solved exactly.
//!
//! ```math
//! p \ge 0, \qquad E p - b \ge 0, \qquad p^T(E p - b) = 0
//! ```
//!
//! E (m/N) is what a force at a point closes at all points, b (m) the overlap that the forces have
//! to undo. Points are numbered outward. If contact is a disc, the first n of them, then with
//! E = L Lᵀ and L y = b forward substitution meets y_k ≤ 0 first at k = n: y_k L_kk is the overlap
//! left at point k once all before it are in contact. L grows row by row as contacts grow, and a
//! step costs n² operations without iteration. What the disc assumes is checked: no tension
//! inside, no overlap outside; if it fails, [`crate::complementarity`] takes over.

use faer::Mat;

use crate::complementarity::{self, NoState, ROUNDING};

/// A contact problem with its factor, which grows with the contact.
#[derive(Debug, Clone)]
pub(crate) struct DiscSolver {
    compliance: Mat<f64>,
    /// Rows of L, one after another.
    factor: Vec<f64>,
    n_factored: usize,
    solution: Vec<f64>,
    /// Forces of the last problem, if the disc was not its solution.
    fallback: Option<Vec<f64>>,
    /// Times the disc was not the solution.
    pub n_fallbacks: usize,
}

/// What a contact problem leaves beside the forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Disc {
    /// Points from the axis outward up to the last with a force.
    pub n_closed: usize,
}

impl DiscSolver {
    /// Of a symmetric positive definite compliance, m/N.
    pub fn new(compliance: Mat<f64>) -> Self {
        let n = compliance.nrows();
        Self {
            compliance,
            factor: Vec::with_capacity(n * (n + 1) / 2),
            n_factored: 0,
            solution: vec![0.0; n],
            fallback: None,
            n_fallbacks: 0,
        }
    }

    /// Row k of L.
    fn row(&self, k: usize) -> &[f64] {
        &self.factor[k * (k + 1) / 2..][..k + 1]
    }

    /// Makes row k of L from the rows before it; false if E is not positive definite.
    fn factor_row(&mut self, k: usize) -> bool {
        let mut row = vec![0.0; k + 1];
        for j in 0..k {
            let before = self.row(j);
            row[j] = (self.compliance[(k, j)] - dot(&row[..j], &before[..j])) / before[j];
        }
        let rest = self.compliance[(k, k)] - dot(&row[..k], &row[..k]);
        row[k] = rest.sqrt();
        self.factor.extend_from_slice(&row);
        self.n_factored = k + 1;
        rest > 0.0
    }

    /// Overlap that is left at point k, over L_kk: y_k.
    fn forward(&mut self, k: usize, overlap: f64) -> Option<f64> {
        if k >= self.n_factored && !self.factor_row(k) {
            return None;
        }
        let row = self.row(k);
        Some((overlap - dot(&row[..k], &self.solution[..k])) / row[k])
    }

    /// Forces (N) that undo the overlaps (m).
    ///
    /// # Errors
    /// No state was found.
    pub fn solve(&mut self, overlap: &[f64], forces: &mut [f64]) -> Result<Disc, NoState> {
        let n = overlap.len();
        forces.fill(0.0);
        let mut n_closed = 0;
        for k in 0..n {
            let y = self.forward(k, overlap[k]).ok_or(NoState)?;
            if y <= 0.0 {
                break;
            }
            self.solution[k] = y;
            n_closed = k + 1;
        }
        for k in (0..n_closed).rev() {
            // Column-oriented: what force k does to the unknowns before it.
            let start = k * (k + 1) / 2;
            let force = self.solution[k] / self.factor[start + k];
            forces[k] = force;
            for j in 0..k {
                self.solution[j] -= self.factor[start + j] * force;
            }
        }
        if self.is_solution(overlap, forces, n_closed) {
            self.fallback = None;
        } else {
            self.n_fallbacks += 1;
            // What was closed is the better guess.
            if let Some(before) = &self.fallback {
                forces.copy_from_slice(before);
            }
            complementarity::solve(&self.compliance, overlap, forces)?;
            self.fallback.get_or_insert_with(|| vec![0.0; n]).copy_from_slice(forces);
            n_closed = forces.iter().rposition(|&force| force > 0.0).map_or(0, |k| k + 1);
        }
        Ok(Disc { n_closed })
    }

    /// Gap at point k, m.
    fn gap(&self, k: usize, overlap: &[f64], forces: &[f64]) -> f64 {
        let closed: f64 =
            forces.iter().enumerate().map(|(j, force)| self.compliance[(j, k)] * force).sum();
        closed - overlap[k]
    }

    /// Whether nothing pulls inside the disc and nothing overlaps outside.
    fn is_solution(&self, overlap: &[f64], forces: &[f64], n_closed: usize) -> bool {
        let inside = &forces[..n_closed];
        let largest = inside.iter().copied().fold(0.0, f64::max);
        if inside.iter().any(|&force| force < -ROUNDING * largest) {
            return false;
        }
        let scale = ROUNDING * overlap.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        // The next point is open by construction; a point further out that b would close must
        // have been opened by the forces.
        (n_closed + 1..overlap.len()).all(|k| self.gap(k, overlap, inside) >= -scale)
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
