//! Errors of a pair of surfaces.

use thiserror::Error;

/// The reason why no contact interface can be built.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ContactError {
    /// Neither body can deform.
    #[error("two rigid bodies cannot be in contact; one of them must deform")]
    BothRigid,
    /// Neither body has a pole that could touch first.
    #[error(
        "two planes cannot be in contact: a half-space meets a sphere, and neither a wall nor \
         another half-space"
    )]
    TwoPlanes,
    /// A number that must be positive and finite is not.
    #[error("{name} is {value}; it must be positive and finite")]
    NotPositive {
        /// Name of the number.
        name: &'static str,
        /// Value that was found.
        value: f64,
    },
}
