//! The identity of a member, which is equal for members that compute the same.

use fem_case::{Case, CaseError, CaseFile};

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

#[cfg(test)]
mod tests {
    use super::*;

    /// A sweep may keep a million members.
    #[test]
    fn a_member_is_two_numbers() {
        assert_eq!(size_of::<Member>(), 16);
    }
}
