//! The scalar springs of a body whose shear modulus relaxes and whose bulk modulus does not.
//!
//! With K = K_bulk + K_dev and the Carson transform g(s) of the relaxation function,
//!
//! ```math
//! \mathbf u = (K_{bulk} + g K_{dev})^{-1}\hat B\mathbf p
//! = \sum_j (1-g)^j\,(K^{-1}K_{dev})^j\,K^{-1}\hat B\mathbf p .
//! ```
//!
//! Galerkin's method on the first terms, the block Krylov space [U, K⁻¹K_dev U, …] with U = K⁻¹B̂,
//! made orthonormal in K (block Lanczos), leaves a small symmetric T = VᵀK_devV. Its eigenvalues
//! θ_j ∈ [0, 1] are the deviatoric shares of the energy of modes that do not see each other:
//!
//! ```math
//! (1-\theta_j)\,z_j + \theta_j\,(g * \dot z_j) = \Phi_j^T\mathbf p, \qquad \mathbf u_c = \Phi\mathbf z .
//! ```
//!
//! n blocks reproduce 2 n terms of the series. θ = 1 throughout is constant Poisson's ratio, exact
//! with Φ the Cholesky factor of C; θ = 0 an elastic body.

use faer::Mat;

use crate::CondensedError;
use crate::body::CondensedBody;
use crate::dense::{invert_lower, symmetric_eigen};

/// Directions with less than this share of a block's energy are left out.
const NEGLIGIBLE: f64 = 1e-10;

/// Spring modes of a body.
#[derive(Debug, Clone)]
pub(crate) struct ShearSprings {
    /// Displacement of the contact nodes in each mode, m/√J.
    pub contact: Mat<f64>,
    /// Deviatoric share of each mode's energy.
    pub deviatoric_share: Vec<f64>,
    /// Displacement of all equations in each mode, the ground's last, m/√J.
    pub fields: Mat<f64>,
}

impl ShearSprings {
    /// From so many blocks, at least 1.
    ///
    /// # Errors
    /// Missing memory; a stiffness that is not positive definite to rounding.
    pub fn new(body: &CondensedBody, n_blocks: usize) -> Result<Self, CondensedError> {
        let mut first = body.balanced_loads();
        body.solve_balanced(&mut first)?;
        let mut blocks = vec![first * invert_lower(&body.compliance_factor).transpose()];
        let mut forces: Vec<Mat<f64>> = Vec::new();
        loop {
            let last = &blocks[blocks.len() - 1];
            let force = body.apply_deviatoric(last);
            if blocks.len() < n_blocks.max(1)
                && let Some(next) = next_block(body, &blocks, &force)?
            {
                blocks.push(next);
                forces.push(force);
            } else {
                forces.push(force);
                break;
            }
        }
        let fields = side_by_side(&blocks);
        let projected = fields.transpose() * side_by_side(&forces);
        let (shares, vectors) =
            symmetric_eigen(&projected).ok_or(CondensedError::NotPositiveDefinite)?;
        let n_contact = body.numbering.n_contact;
        // Only the first block moves the contact nodes: the others are orthogonal to U in K.
        let contact = &body.compliance_factor * vectors.subrows(0, n_contact);
        Ok(Self {
            contact,
            deviatoric_share: shares.into_iter().map(|share| share.clamp(0.0, 1.0)).collect(),
            fields: fields * vectors,
        })
    }
}

/// K⁻¹ of the last block's deviatoric forces, orthonormal to all blocks; `None` if nothing is left.
fn next_block(
    body: &CondensedBody,
    blocks: &[Mat<f64>],
    force: &Mat<f64>,
) -> Result<Option<Mat<f64>>, CondensedError> {
    let mut next = force.clone();
    body.solve_balanced(&mut next)?;
    let mut gram = force.transpose() * &next;
    let scale = (0..gram.nrows()).map(|i| gram[(i, i)]).fold(0.0, f64::max);
    for block in blocks {
        let share = block.transpose() * force;
        gram -= share.transpose() * &share;
        next -= block * share;
    }
    let (values, vectors) = symmetric_eigen(&gram).ok_or(CondensedError::NotPositiveDefinite)?;
    let first = values.partition_point(|&value| value <= NEGLIGIBLE * scale);
    if first == values.len() {
        return Ok(None);
    }
    let kept = Mat::from_fn(vectors.nrows(), values.len() - first, |i, j| {
        vectors[(i, first + j)] / values[first + j].sqrt()
    });
    Ok(Some(next * kept))
}

fn side_by_side(blocks: &[Mat<f64>]) -> Mat<f64> {
    let n_columns = blocks.iter().map(Mat::ncols).sum();
    let mut whole = Mat::zeros(blocks[0].nrows(), n_columns);
    let mut start = 0;
    for block in blocks {
        whole.as_mut().subcols_mut(start, block.ncols()).copy_from(block);
        start += block.ncols();
    }
    whole
}
