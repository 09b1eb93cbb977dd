//! The scalar modes of a body whose shear modulus relaxes and whose bulk modulus does not.
//!
//! With K = K_bulk + K_dev and the Carson transform g(s) of the relaxation function,
//!
//! ```math
//! \mathbf u = (K_{bulk} + g K_{dev})^{-1}\hat B\mathbf p
//! = \sum_j (1-g)^j\,(K^{-1}K_{dev})^j\,K^{-1}\hat B\mathbf p .
//! ```
//!
//! Galerkin's method on the first terms, the block Krylov space [U, K⁻¹K_dev U, …] with U = K⁻¹B̂,
//! made orthonormal in K (block Lanczos), gives a small symmetric T = VᵀK_devV. Its eigenvalues
//! θ_j ∈ [0, 1] are the deviatoric shares of the energy of uncoupled modes:
//!
//! ```math
//! (1-\theta_j)\,z_j + \theta_j\,(g * \dot z_j) = \Phi_j^T\mathbf p, \qquad \mathbf u_c = \Phi\mathbf z .
//! ```
//!
//! n blocks reproduce 2 n terms of the series. θ = 1 for all modes is constant Poisson's ratio, exact
//! with the Cholesky factor of C as Φ; θ = 0 is an elastic body.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};

use crate::condensation::condensed_body::CondensedBody;
use crate::condensation::dense::symmetric_eigen;
use crate::error::CondensedError;

/// Share of a block's energy below which a direction is left out.
const NEGLIGIBLE_ENERGY_SHARE: f64 = 1e-10;

/// Modes of a body with a relaxing shear modulus.
#[derive(Debug, Clone)]
pub(crate) struct ShearSprings {
    /// Displacement of the contact nodes in each mode, m/√J.
    pub contact: Mat<f64>,
    /// Deviatoric share of each mode's energy.
    pub deviatoric_share: Vec<f64>,
    /// Displacement of all equations in the basis, that of the ground last, m/√J, block by block.
    basis: Vec<Mat<f64>>,
    /// Coordinates of the modes in the basis.
    vectors: Mat<f64>,
}

impl ShearSprings {
    /// Computes the modes from a basis of `n_blocks` ≥ 1 blocks.
    ///
    /// # Errors
    /// Missing memory; a stiffness that is not positive definite to rounding.
    pub fn new(body: &CondensedBody, n_blocks: usize) -> Result<Self, CondensedError> {
        let mut blocks = vec![body.orthonormal_responses()?];
        let mut projected = Vec::with_capacity(n_blocks);
        loop {
            let force = body.apply_deviatoric(&blocks[blocks.len() - 1]);
            let shares: Vec<_> = blocks.iter().map(|block| block.transpose() * &force).collect();
            let next = if blocks.len() < n_blocks.max(1) {
                next_block(body, &blocks, force, &shares)?
            } else {
                None
            };
            projected.push(shares);
            match next {
                Some(next) => blocks.push(next),
                None => break,
            }
        }
        let projected = side_by_side(&projected);
        let (shares, vectors) =
            symmetric_eigen(&projected).ok_or(CondensedError::NotPositiveDefinite)?;
        let n_contact = body.numbering.n_contact;
        // Only the first block moves the contact nodes: the others are orthogonal to U in K.
        let contact = &body.compliance_factor * vectors.subrows(0, n_contact);
        Ok(Self {
            contact,
            deviatoric_share: shares.into_iter().map(|share| share.clamp(0.0, 1.0)).collect(),
            basis: blocks,
            vectors,
        })
    }

    /// Returns the displacement of all equations (m) for displacements of the modes (√J), one state per column.
    pub fn fields(&self, springs: &Mat<f64>) -> Mat<f64> {
        let shares = &self.vectors * springs;
        let mut fields = Mat::zeros(self.basis[0].nrows(), springs.ncols());
        let mut start = 0;
        for block in &self.basis {
            fields += block * shares.subrows(start, block.ncols());
            start += block.ncols();
        }
        fields
    }
}

/// Assembles the lower triangle of VᵀK_devV from the projections of each block's forces on the blocks up to it.
fn side_by_side(shares: &[Vec<Mat<f64>>]) -> Mat<f64> {
    let widths = shares.iter().map(|shares| shares[0].ncols());
    let starts: Vec<usize> =
        widths.clone().scan(0, |end, n| Some(std::mem::replace(end, *end + n))).collect();
    let n = widths.sum();
    let mut projected = Mat::zeros(n, n);
    for (&row, shares) in starts.iter().zip(shares) {
        for (&column, share) in starts.iter().zip(shares) {
            projected
                .submatrix_mut(row, column, share.ncols(), share.nrows())
                .copy_from(share.transpose());
        }
    }
    projected
}

/// Returns K⁻¹ times the last block's deviatoric forces, orthonormal to all blocks; `None` if nothing is left.
/// `shares` are the projections of the forces on the blocks.
fn next_block(
    body: &CondensedBody,
    blocks: &[Mat<f64>],
    mut force: Mat<f64>,
    shares: &[Mat<f64>],
) -> Result<Option<Mat<f64>>, CondensedError> {
    let n = body.numbering.n_equations;
    force.as_mut().row_mut(n).fill(0.0);
    // fᵀK⁻¹f = yᵀy with L y = f.
    let factor = &body.solver()?.factor;
    factor.solve_lower(force.as_mut().subrows_mut(0, n));
    let mut gram = force.transpose() * &force;
    for share in shares {
        gram -= share.transpose() * share;
    }
    let scale = (0..gram.nrows()).map(|i| gram[(i, i)]).fold(0.0, f64::max);
    let (values, vectors) = symmetric_eigen(&gram).ok_or(CondensedError::NotPositiveDefinite)?;
    let first = values.partition_point(|&value| value <= NEGLIGIBLE_ENERGY_SHARE * scale);
    if first == values.len() {
        return Ok(None);
    }
    let kept = Mat::from_fn(vectors.nrows(), values.len() - first, |i, j| {
        vectors[(i, first + j)] / values[first + j].sqrt()
    });
    let mut next = force;
    factor.solve_transposed(next.as_mut().subrows_mut(0, n));
    for (block, share) in blocks.iter().zip(shares) {
        matmul(next.as_mut(), Accum::Add, block.as_ref(), share.as_ref(), -1.0, Par::Seq);
    }
    Ok(Some(next * kept))
}
