//! Errors of the laws of a case.

use crate::fit::FitError;
use fem_case::CaseError;
use fem_laws::LawError;

use super::parameter::ParameterError;
use crate::measured::DataError;

/// An error in a law, in its data, or in a request.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LawFault {
    /// The law of the case itself, at its place.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A parameter that is named or given.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The data are faulty.
    #[error(transparent)]
    Data(#[from] DataError),
    /// The data do not determine the law.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A parameter that has neither a value nor a default.
    #[error("{law} needs a value of {key}")]
    Missing {
        /// Name of the law.
        law: &'static str,
        /// Key of the parameter.
        key: &'static str,
        /// The values that were searched for; empty if nothing more can be searched.
        free: Vec<&'static str>,
    },
    /// A law that is compared with another one.
    #[error("{law}: {error}")]
    Compared {
        /// The name of the law.
        law: &'static str,
        /// Why it cannot be fitted.
        error: FitError,
    },
    /// A stiffness that is searched for in restitutions alone.
    #[error("restitutions do not depend on {key} of {law}: only contact times determine it")]
    NeedsTimes {
        /// Name of the law.
        law: &'static str,
        /// Key of the parameter.
        key: &'static str,
    },
    /// Materials or sizes that are no spheres: what was found, and what is allowed.
    #[error("{0}")]
    Grains(String, String),
    /// A case of finite elements in whose place no reduced model can stand.
    #[error(transparent)]
    NoStandIn(FitError),
}

/// A collision that cannot happen.
impl From<LawError> for LawFault {
    fn from(error: LawError) -> Self {
        Self::Fit(error.into())
    }
}
