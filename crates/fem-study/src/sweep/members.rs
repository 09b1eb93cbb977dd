//! Where the cases of a sweep come from.

use fem_case::{Case, CaseError, Sweep};

/// A number of cases, each made when it is needed.
///
/// A sweep file is one such source, [`Variations`](super::Variations) made in code another, and
/// cases at hand are a third.
pub trait Members: Sync {
    /// Returns the number of members.
    fn n_members(&self) -> usize;

    /// Returns the result of `make` for a member's case.
    ///
    /// # Errors
    /// A member that is no valid case, or of which `make` can make nothing. A sweep file points at
    /// the value that is to blame, for which it may make other cases.
    fn build<T>(
        &self,
        index: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError>;

    /// The first fault of the members with what else is wrong with their source, where that is text; `make` is
    /// what was to be made of each.
    fn with_other_faults<T>(
        &self,
        first: CaseError,
        _make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> CaseError {
        first
    }

    /// A member's case.
    ///
    /// # Errors
    /// A member that is no valid case.
    fn case(&self, index: usize) -> Result<Case, CaseError> {
        self.build(index, Ok)
    }
}

impl Members for Sweep {
    fn n_members(&self) -> usize {
        Sweep::n_members(self)
    }

    fn build<T>(
        &self,
        index: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError> {
        Sweep::build(self, index, make)
    }

    fn with_other_faults<T>(
        &self,
        first: CaseError,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> CaseError {
        Sweep::with_other_faults(self, first, make)
    }
}

impl Members for [Case] {
    fn n_members(&self) -> usize {
        self.len()
    }

    fn build<T>(
        &self,
        index: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError> {
        make(self[index].clone())
    }
}

/// Reads a sweep file, the tables that it names and its base case; `overrides` are those of the base case.
///
/// # Errors
/// Those of [`Sweep::load`].
#[cfg(feature = "csv")]
pub fn load(path: &std::path::Path, overrides: &[String]) -> Result<Sweep, CaseError> {
    Sweep::load(path, overrides, &crate::measured::rows_below)
}
