//! The Cholesky factor of a body's stiffness, K = L Lᵀ.

use dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::prelude::{Reborrow, ReborrowMut};
use faer::sparse::SparseColMat;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::{SupernodalLltRef, SymbolicSupernodalCholesky};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Accum, Mat, MatMut, Par, Side, Spec, dyn_stack};

use crate::error::CondensedError;

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

    /// Overwrites the right-hand sides with the solutions of K x = b.
    pub fn solve(&self, mut right: MatMut<'_, f64>) {
        self.solve_lower(right.rb_mut());
        self.solve_transposed(right);
    }

    /// Overwrites the right-hand sides with the solutions of L y = b.
    pub fn solve_lower(&self, mut right: MatMut<'_, f64>) {
        let mut below = self.workspace(right.ncols());
        for s in 0..self.supernodal().n_supernodes() {
            let supernode = self.factor().supernode(s);
            let pattern = supernode.pattern();
            let n_columns = supernode.val().ncols();
            let (top, bottom) = supernode.val().split_at_row(n_columns);
            let mut own = right.rb_mut().subrows_mut(supernode.start(), n_columns);
            solve_lower_triangular_in_place(top, own.rb_mut(), Par::Seq);
            let mut below = below.as_mut().subrows_mut(0, pattern.len());
            matmul(below.rb_mut(), Accum::Replace, bottom, own.rb(), 1.0, Par::Seq);
            for (from, mut to) in below.rb().col_iter().zip(right.rb_mut().col_iter_mut()) {
                for (value, &row) in from.iter().zip(pattern) {
                    to[row as usize] -= value;
                }
            }
        }
    }

    /// Overwrites the right-hand sides with the solutions of Lᵀ x = y.
    pub fn solve_transposed(&self, mut right: MatMut<'_, f64>) {
        let mut below = self.workspace(right.ncols());
        for s in (0..self.supernodal().n_supernodes()).rev() {
            let supernode = self.factor().supernode(s);
            let pattern = supernode.pattern();
            let n_columns = supernode.val().ncols();
            let (top, bottom) = supernode.val().split_at_row(n_columns);
            let mut below = below.as_mut().subrows_mut(0, pattern.len());
            for (from, to) in right.rb().col_iter().zip(below.rb_mut().col_iter_mut()) {
                for (value, &row) in to.iter_mut().zip(pattern) {
                    *value = from[row as usize];
                }
            }
            let mut own = right.rb_mut().subrows_mut(supernode.start(), n_columns);
            matmul(own.rb_mut(), Accum::Add, bottom.transpose(), below.rb(), -1.0, Par::Seq);
            solve_upper_triangular_in_place(top.transpose(), own, Par::Seq);
        }
    }

    /// Room for the rows below a supernode.
    fn workspace(&self, n_columns: usize) -> Mat<f64> {
        let factor = self.factor();
        let longest = (0..self.supernodal().n_supernodes())
            .map(|s| factor.supernode(s).pattern().len())
            .max();
        Mat::zeros(longest.unwrap_or(0), n_columns)
    }

    fn supernodal(&self) -> &SymbolicSupernodalCholesky<u32> {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => symbolic,
            SymbolicCholeskyRaw::Simplicial(_) => {
                unreachable!("the supernodal factorisation is forced")
            }
        }
    }

    fn factor(&self) -> SupernodalLltRef<'_, u32, f64> {
        SupernodalLltRef::new(self.supernodal(), &self.values)
    }

    /// Lower triangle of the factor's last n columns.
    pub fn trailing(&self, n: usize) -> Mat<f64> {
        let mut block = Mat::zeros(n, n);
        let (symbolic, factor) = (self.supernodal(), self.factor());
        let first = symbolic.nrows() - n;
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
        8 * self.values.len() + 4 * self.supernodal().row_idx().len()
    }
}
