//! Small dense matrices.

use faer::{Mat, Side};

/// Returns the lower Cholesky factor; `None` if the matrix is not positive definite.
pub(crate) fn cholesky(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    let n = matrix.nrows();
    let mut lower = Mat::<f64>::zeros(n, n);
    for i in 0..n {
        for j in 0..=i {
            let product: f64 = (0..j).map(|k| lower[(i, k)] * lower[(j, k)]).sum();
            let rest = matrix[(i, j)] - product;
            if i > j {
                lower[(i, j)] = rest / lower[(j, j)];
            } else if rest > 0.0 {
                lower[(i, i)] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    Some(lower)
}

/// Returns the inverse of a lower triangular matrix.
pub(crate) fn invert_lower(lower: &Mat<f64>) -> Mat<f64> {
    let n = lower.nrows();
    let mut inverse = Mat::<f64>::zeros(n, n);
    for j in 0..n {
        inverse[(j, j)] = lower[(j, j)].recip();
        for i in j + 1..n {
            let sum: f64 = (j..i).map(|k| lower[(i, k)] * inverse[(k, j)]).sum();
            inverse[(i, j)] = -sum / lower[(i, i)];
        }
    }
    inverse
}

/// Returns the eigenvalues in rising order and the eigenvectors of a symmetric matrix; `None` if the iteration does
/// not converge (entries that are not finite).
pub(crate) fn symmetric_eigen(matrix: &Mat<f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let eigen = matrix.self_adjoint_eigen(Side::Lower).ok()?;
    let values = eigen.S().column_vector().iter().copied().collect();
    Some((values, eigen.U().to_owned()))
}
