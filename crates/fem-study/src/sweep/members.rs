//! Sources of the cases of a sweep, and the identity of a member, which is equal for members that compute the same.

use fem_case::{Case, CaseError, CaseFile, Sweep};
use fem_simulation::{identified, name_of};

/// A member of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its index in the sweep.
    pub index: usize,
    /// Its identity as a number.
    pub(super) digest: u64,
}

impl Member {
    /// Creates the member of a sweep that is this case.
    ///
    /// # Errors
    /// The case's method does not support the case, or a mesh file cannot be read.
    pub fn of(index: usize, case: &Case) -> Result<Self, CaseError> {
        Ok(Self::resolved(index, case)?.0)
    }

    /// Creates the member and its resolved case.
    ///
    /// # Errors
    /// As [`Member::of`].
    pub(super) fn resolved(index: usize, case: &Case) -> Result<(Self, CaseFile), CaseError> {
        let (digest, case) = identified(case)?;
        Ok((Self { index, digest }, case))
    }

    /// Returns the identity as text; see [`Identity::result`](fem_simulation::Identity::result).
    pub fn identity(&self) -> String {
        name_of(self.digest)
    }
}

/// A source of cases, each made when it is needed.
///
/// A sweep file is such a source, and so are [`Variations`](super::Variations) and a slice of cases.
pub trait Members: Sync {
    /// Returns the number of members.
    fn n_members(&self) -> usize;

    /// Returns the result of `make` for a member's case.
    ///
    /// # Errors
    /// The member is no valid case, or `make` fails. A sweep file names the value that causes the error, for which it
    /// may make other cases.
    fn build<T>(
        &self,
        index: usize,
        make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> Result<T, CaseError>;

    /// Adds the other errors of the source, if that is text, to the first error; `make` is applied to each member.
    fn with_other_faults<T>(
        &self,
        first: CaseError,
        _make: impl Fn(Case) -> Result<T, CaseError>,
    ) -> CaseError {
        first
    }

    /// Returns the case of a member.
    ///
    /// # Errors
    /// The member is no valid case.
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
/// As [`Sweep::load`].
pub fn load(path: &std::path::Path, overrides: &[String]) -> Result<Sweep, CaseError> {
    Sweep::load(path, overrides, &fem_data::table::rows_below)
}
