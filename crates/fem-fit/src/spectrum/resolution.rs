//! Which combinations of weights the data determine.
//!
//! With the singular values of the Jacobian, J/ρ = U S Vᵀ, the combination v_i·w is known to σ/s_i.
//! A weight is between 0 and 1 whatever the data say, so one is worth measuring that is known better
//! than to 1/2: s_i > 2σ. The ridge keeps s²/(s² + λ²) of it, and R = V S²/(S² + λ²) Vᵀ says how much
//! of each weight is the data's (its diagonal) and how many weights' worth in all (its trace;
//! Menke, *Geophysical Data Analysis*, ch. 4).

use nalgebra::{DMatrix, DVector};

/// A combination of known error that is worth so much is determined.
const WORTH: f64 = 0.5;

/// A combination v·w, |v| = 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// s: the change of all restitutions, root of the sum of squares, for a change of 1; 0 if
    /// rounding.
    pub singular_value: f64,
    /// v; its largest coefficient is positive.
    pub coefficients: Vec<f64>,
    /// v·w of the best weights.
    pub value: f64,
    /// Standard error σ/s of the combination.
    pub standard_error: f64,
    /// Whether the data know it better than to 1/2.
    pub is_determined: bool,
}

/// What the data determine.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolution {
    /// Best determined first; as many as weights.
    pub combinations: Vec<Combination>,
    /// How much of each weight is the data's and not the ridge's, 0 to 1.
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
            let kept = singular_value.powi(2);
            let kept = if kept > 0.0 { kept / (kept + ridge * ridge) } else { 0.0 };
            for (share, v) in shares.iter_mut().zip(direction.iter()) {
                *share += kept * v * v;
            }
            combinations.push(Combination {
                singular_value,
                value: direction.iter().zip(weights).map(|(v, w)| v * w).sum(),
                standard_error: error / singular_value,
                is_determined: error < WORTH * singular_value,
                coefficients: direction.iter().copied().collect(),
            });
        }
        Self { combinations, shares }
    }

    /// How many combinations are determined.
    pub fn n_determined(&self) -> usize {
        self.combinations.iter().filter(|combination| combination.is_determined).count()
    }
}
