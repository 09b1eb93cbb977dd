//! Linear least squares over the weights of a series: w ≥ 0, Σ w ≤ 1.
//!
//! The remaining weight g∞ = 1 − Σ w is an additional unknown, so all unknowns are non-negative
//! and sum to 1. That sum, and a combination that is held, are rows with a thousand times the weight of
//! the data (exact to 1e-6 of a multiplier). Non-negative least squares follow Lawson & Hanson,
//! *Solving Least Squares Problems*, ch. 23.

use nalgebra::{DMatrix, DVector};

/// Weight of the constraints, over the norm of the data's rows.
const HEAVY: f64 = 1e3;
/// Ridge over that norm that makes every set of columns independent.
const MIN_RIDGE: f64 = 1e-8;

/// Residuals a w − b, linear in the weights.
#[derive(Debug, Clone)]
pub struct Linear {
    /// Matrix a, for restitutions ∂e_i/∂w_k / ρ_i.
    pub a: DMatrix<f64>,
    /// Right-hand side b of the linear problem.
    pub b: DVector<f64>,
}

impl Linear {
    /// Returns Σ (a w − b)².
    pub fn misfit(&self, weights: &[f64]) -> f64 {
        (&self.a * DVector::from_row_slice(weights) - &self.b).norm_squared()
    }

    /// Returns a problem whose misfit differs by a constant, with at most one row more than weights.
    pub fn compressed(&self) -> Self {
        let n = self.a.ncols();
        if self.a.nrows() <= n + 1 {
            return self.clone();
        }
        let mut whole = self.a.clone().insert_column(n, 0.0);
        whole.set_column(n, &self.b);
        let r = whole.qr().r();
        Self { a: r.columns(0, n).into_owned(), b: r.column(n).into_owned() }
    }

    /// Returns the weights with the least misfit plus λ² Σ w²; a combination c·w may be held at a value.
    pub fn solve(&self, ridge: f64, held: Option<(&[f64], f64)>) -> Vec<f64> {
        let (m, n) = self.a.shape();
        let scale = self.a.norm().max(f64::MIN_POSITIVE);
        let heavy = HEAVY * scale;
        let mut a = DMatrix::zeros(m + n + 2, n + 1);
        let mut b = DVector::zeros(m + n + 2);
        a.view_mut((0, 0), (m, n)).copy_from(&self.a);
        b.rows_mut(0, m).copy_from(&self.b);
        for k in 0..n {
            a[(m + k, k)] = ridge.max(MIN_RIDGE * scale);
        }
        a.row_mut(m + n).fill(heavy);
        b[m + n] = heavy;
        if let Some((combination, value)) = held {
            let length = combination.iter().map(|c| c * c).sum::<f64>().sqrt();
            for (k, c) in combination.iter().enumerate() {
                a[(m + n + 1, k)] = heavy * c / length;
            }
            b[m + n + 1] = heavy * value / length;
        }
        let mut weights: Vec<f64> = non_negative(&a, &b).iter().take(n).copied().collect();
        let sum: f64 = weights.iter().sum();
        if sum > 1.0 {
            weights.iter_mut().for_each(|weight| *weight /= sum);
        }
        weights
    }
}

/// Returns the x ≥ 0 with the least |a x − b|.
pub fn non_negative(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let n = a.ncols();
    let tolerance: Vec<f64> =
        a.column_iter().map(|column| 1e-14 * column.norm() * b.norm()).collect();
    let mut x = DVector::zeros(n);
    let mut passive = vec![false; n];
    for _ in 0..10 * n {
        let gradient = a.transpose() * (b - a * &x);
        let rises = |k: &usize| !passive[*k] && gradient[*k] > tolerance[*k];
        let steepest = (0..n).filter(rises).max_by(|i, j| gradient[*i].total_cmp(&gradient[*j]));
        let Some(joins) = steepest else { break };
        passive[joins] = true;
        loop {
            let free: Vec<usize> = (0..n).filter(|k| passive[*k]).collect();
            let Some(best) = unconstrained(a, b, &free) else { return x };
            let blocked = free.iter().zip(best.iter()).filter(|(_, best)| **best <= 0.0);
            let shares = blocked.map(|(k, best)| x[*k] / (x[*k] - best));
            let share = shares.fold(1.0, f64::min);
            for (k, best) in free.iter().zip(best.iter()) {
                x[*k] += share * (best - x[*k]);
            }
            let is_inside = best.iter().all(|best| *best > 0.0);
            if is_inside {
                break;
            }
            for (k, best) in free.iter().zip(best.iter()) {
                if *best <= 0.0 && x[*k] <= 1e-15 {
                    (x[*k], passive[*k]) = (0.0, false);
                }
            }
            if !passive.contains(&true) {
                break;
            }
        }
    }
    x
}

fn unconstrained(a: &DMatrix<f64>, b: &DVector<f64>, free: &[usize]) -> Option<DVector<f64>> {
    let qr = a.select_columns(free).qr();
    qr.r().solve_upper_triangular(&(qr.q().transpose() * b))
}
