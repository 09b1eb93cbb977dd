//! The Cholesky factor of a body's stiffness, K = L Lᵀ: of a band where that is narrow, else of fronts.

use faer::prelude::{Reborrow, ReborrowMut};
use faer::{ColMut, Mat, MatMut};

use crate::band::BandFactor;
use crate::elements::{ElementEquations, Lower};
use crate::error::CondensedError;
use crate::fronts::FrontFactor;
use crate::numbering::{Numbering, Order};

/// Factor of a matrix that is given in the order of elimination.
#[derive(Debug)]
pub(crate) enum Factor {
    Band(BandFactor),
    Fronts(FrontFactor),
}

/// What an elimination is worth.
#[derive(Debug)]
pub(crate) struct Elimination<F> {
    /// L, where it is kept.
    pub factor: Option<F>,
    /// Lower triangle of the factor's last columns.
    pub trailing: Mat<f64>,
    /// y of L y = b for the right-hand side that was given.
    pub forward: Vec<f64>,
}

impl Elimination<Factor> {
    /// Of elements whose matrices are made when they are asked for, down to the contact unknowns.
    ///
    /// # Errors
    /// A matrix that is not positive definite; missing memory.
    pub fn new(
        numbering: &Numbering,
        elements: &[ElementEquations],
        matrix: impl FnMut(usize) -> Lower,
        right: Vec<f64>,
        keeps_factor: bool,
    ) -> Result<Self, CondensedError> {
        let n_trailing = numbering.n_contact;
        Ok(match &numbering.order {
            Order::Band(profile) => {
                let made = BandFactor::eliminate(*profile, elements, matrix, right, n_trailing)?;
                made.with(|factor| keeps_factor.then_some(Factor::Band(factor)))
            }
            Order::Fronts(ends) => {
                FrontFactor::eliminate(ends, elements, matrix, right, n_trailing, keeps_factor)?
                    .with(|factor| Some(Factor::Fronts(factor)))
            }
        })
    }
}

impl<F> Elimination<F> {
    fn with<G>(self, make: impl FnOnce(F) -> Option<G>) -> Elimination<G> {
        let Self { factor, trailing, forward } = self;
        Elimination { factor: factor.and_then(make), trailing, forward }
    }
}

impl Factor {
    /// Overwrites the right-hand sides with the solutions of K x = b.
    pub fn solve(&self, mut right: MatMut<'_, f64>) {
        self.solve_lower(right.rb_mut());
        self.solve_transposed(right);
    }

    /// Overwrites the right-hand sides with the solutions of L y = b.
    pub fn solve_lower(&self, right: MatMut<'_, f64>) {
        match self {
            Self::Band(factor) => each(right, |column| factor.solve_lower(column)),
            Self::Fronts(factor) => factor.solve_lower(right),
        }
    }

    /// Overwrites the right-hand sides with the solutions of Lᵀ x = y.
    pub fn solve_transposed(&self, right: MatMut<'_, f64>) {
        match self {
            Self::Band(factor) => each(right, |column| factor.solve_transposed(column)),
            Self::Fronts(factor) => factor.solve_transposed(right),
        }
    }

    /// Bytes of the factor's values and indices.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Band(factor) => factor.bytes(),
            Self::Fronts(factor) => factor.bytes(),
        }
    }
}

/// Each column of a matrix.
fn each(mut right: MatMut<'_, f64>, solve: impl Fn(&mut [f64])) {
    let mut values = Vec::with_capacity(right.nrows());
    for mut column in right.rb_mut().col_iter_mut() {
        values.clear();
        values.extend(column.rb().iter().copied());
        solve(&mut values);
        column.rb_mut().iter_mut().zip(&values).for_each(|(to, value)| *to = *value);
    }
}

/// The only column of a matrix, if it has no more.
pub(crate) fn single(right: MatMut<'_, f64>) -> Option<&mut [f64]> {
    let is_single = right.ncols() == 1;
    is_single.then(|| right.col_mut(0).try_as_col_major_mut())?.map(ColMut::as_slice_mut)
}
