//! What a member is known by: equal for members that compute the same.

use fem_case::{Case, CaseError, CaseFile};

use super::members::Members;
use crate::identity::identified;

/// A member of a sweep, resolved.
#[derive(Clone, Debug)]
pub struct Member {
    /// Its place in the sweep.
    pub index: usize,
    /// See [`Identity::result`](crate::Identity::result).
    pub identity: String,
    /// The resolved case.
    pub case: CaseFile,
}

impl Member {
    /// The member of a sweep that is this case.
    ///
    /// # Errors
    /// What the case's method refuses before it makes anything; a mesh file that cannot be read.
    pub fn of(index: usize, case: &Case) -> Result<Self, CaseError> {
        let (identity, case) = identified(case)?;
        Ok(Self { index, identity: identity.result, case })
    }
}

/// All members, in order.
///
/// # Errors
/// The first member that is no valid case.
pub fn identify(members: &(impl Members + ?Sized)) -> Result<Vec<Member>, CaseError> {
    let member = |index| members.build(index, |case| Member::of(index, &case));
    (0..members.n_members()).map(member).collect()
}
