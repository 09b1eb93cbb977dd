//! The combinations of weights that the data determine.
//!
//! With the singular values of the Jacobian, J/ρ = U S Vᵀ, the combination v_i·w is known to σ/s_i. Weights
//! are at least 0 and their sum is at most 1 for any data, so v_i·w is between its least and its largest
//! coefficient or 0. It is determined if two standard errors on either side are less than half
//! of that range. The ridge keeps s²/(s² + λ²) of it. The diagonal of R = V S²/(S² + λ²) Vᵀ is the share of each weight
//! that the data determine, and its trace their number in all (Menke, *Geophysical Data Analysis*, ch. 4).

use nalgebra::{DMatrix, DVector};

/// Largest standard error of a determined combination over its range: ±2 σ are half of it.
const WORTH: f64 = 1.0 / 8.0;

/// A combination v·w, |v| = 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// Singular value s: the root of the sum of squares of the changes of all restitutions for a change of 1; 0 if
    /// that is rounding.
    pub singular_value: f64,
    /// The coefficients v; the largest is positive.
    pub coefficients: Vec<f64>,
    /// The value v·w at the best weights.
    pub value: f64,
    /// Standard error σ/s of the combination.
    pub standard_error: f64,
    /// Whether the data restrict it to less than half of its range, with 95 % confidence.
    pub is_determined: bool,
}

impl Combination {
    /// Whether the value is zero within its error.
    pub fn may_be_zero(&self) -> bool {
        self.value.abs() < 2.0 * self.standard_error
    }
}

/// The combinations of weights that the data determine.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolution {
    /// The combinations, the best determined first; as many as weights.
    pub combinations: Vec<Combination>,
    /// Share of each weight that the data determine and not the regularisation, or prior knowledge, 0 to 1.
    pub shares: Vec<f64>,
}

impl Resolution {
    pub(super) fn of(jacobian: &DMatrix<f64>, error: f64, ridge: f64, weights: &[f64]) -> Self {
        let n = jacobian.ncols();
        // JᵀJ has all n directions, those without data too; s below 1e-7 of the largest is rounding.
        let normal = (jacobian.transpose() * jacobian).symmetric_eigen();
        let floor = normal.eigenvalues.max().max(0.0) * 1e-14;
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|i, j| normal.eigenvalues[*j].total_cmp(&normal.eigenvalues[*i]));
        let mut shares = vec![0.0; n];
        let mut combinations = Vec::new();
        for i in order {
            let squared = normal.eigenvalues[i];
            let singular_value = if squared > floor { squared.sqrt() } else { 0.0 };
            let mut direction: DVector<f64> = normal.eigenvectors.column(i).into_owned();
            let largest = direction[direction.icamax()];
            direction *= largest.signum();
            let span = direction.max().max(0.0) - direction.min().min(0.0);
            let kept = singular_value.powi(2);
            let kept = if kept > 0.0 { kept / (kept + ridge * ridge) } else { 0.0 };
            for (share, v) in shares.iter_mut().zip(direction.iter()) {
                *share += kept * v * v;
            }
            combinations.push(Combination {
                singular_value,
                value: direction.iter().zip(weights).map(|(v, w)| v * w).sum(),
                standard_error: error / singular_value,
                is_determined: error < WORTH * span * singular_value,
                coefficients: direction.iter().copied().collect(),
            });
        }
        Self { combinations, shares }
    }

    /// Returns the number of determined combinations.
    pub fn n_determined(&self) -> usize {
        self.combinations.iter().filter(|combination| combination.is_determined).count()
    }
}
