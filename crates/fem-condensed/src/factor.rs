//! The Cholesky factor of a body's stiffness, K = L Lᵀ.

use dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::SparseColMat;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Conj, Mat, MatMut, Par, Side, Spec, dyn_stack};

use crate::CondensedError;

/// Factor of a matrix that is given in the order of elimination.
#[derive(Debug)]
pub(crate) struct Factor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
}

impl Factor {
    /// Of the upper triangle of a symmetric matrix.
    ///
    /// # Errors
    /// A matrix that is not positive definite; missing memory.
    pub fn new(matrix: &SparseColMat<u32, f64>) -> Result<Self, CondensedError> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(
            matrix.symbolic(),
            Side::Upper,
            SymmetricOrdering::Identity,
            params,
        )
        .map_err(|_| CondensedError::OutOfMemory)?;
        let mut values = vec![0.0; symbolic.len_val()];
        let request = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(request).map_err(|_| CondensedError::OutOfMemory)?;
        symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix.as_ref(),
                Side::Upper,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Spec::default(),
            )
            .map_err(|_| CondensedError::NotPositiveDefinite)?;
        Ok(Self { symbolic, values })
    }

    /// Overwrites the right-hand sides with the solutions.
    ///
    /// # Errors
    /// Missing memory.
    pub fn solve(&self, right: MatMut<'_, f64>) -> Result<(), CondensedError> {
        let request = self.symbolic.solve_in_place_scratch::<f64>(right.ncols(), Par::Seq);
        let mut memory = MemBuffer::try_new(request).map_err(|_| CondensedError::OutOfMemory)?;
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            right,
            Par::Seq,
            MemStack::new(&mut memory),
        );
        Ok(())
    }

    /// Lower triangle of the factor's last n columns.
    pub fn trailing(&self, n: usize) -> Mat<f64> {
        let mut block = Mat::zeros(n, n);
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            unreachable!("the supernodal factorisation is forced");
        };
        let first = symbolic.nrows() - n;
        let factor = SupernodalLltRef::new(symbolic, &self.values);
        for s in (0..symbolic.n_supernodes()).rev() {
            let supernode = factor.supernode(s);
            let (start, values) = (supernode.start(), supernode.val());
            let n_columns = values.ncols();
            if start + n_columns <= first {
                break;
            }
            for column in first.saturating_sub(start)..n_columns {
                let j = start + column - first;
                for row in column..n_columns {
                    block[(start + row - first, j)] = values[(row, column)];
                }
                for (k, &row) in supernode.pattern().iter().enumerate() {
                    block[(row as usize - first, j)] = values[(n_columns + k, column)];
                }
            }
        }
        block
    }

    /// Bytes of the factor's values and indices.
    pub fn bytes(&self) -> usize {
        let indices = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => symbolic.row_idx().len(),
            SymbolicCholeskyRaw::Simplicial(symbolic) => symbolic.row_idx().len(),
        };
        8 * self.values.len() + 4 * indices
    }
}
