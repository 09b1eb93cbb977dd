//! Errors of the laws of a case.

use fem_case::CaseError;
use fem_data::estimate::FitError;
use fem_laws::LawError;

use fem_data::estimate::ParameterError;
use fem_data::table::DataError;

/// An error in a law, in its data, or in a request.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LawFault {
    /// The law of the case is invalid.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A named or given parameter is invalid.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The data are faulty.
    #[error(transparent)]
    Data(#[from] DataError),
    /// The data do not determine the law.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A parameter has neither a value nor a default.
    #[error("{law} needs a value of {key}")]
    Missing {
        /// Name of the law.
        law: &'static str,
        /// Key of the parameter.
        key: &'static str,
        /// The values that were searched for; empty if nothing more can be searched.
        free: Vec<&'static str>,
    },
    /// A law that is compared cannot be fitted.
    #[error("{law}: {error}")]
    Compared {
        /// The name of the law.
        law: &'static str,
        /// The reason of the failure.
        error: FitError,
    },
    /// A stiffness is searched for in restitutions without contact times.
    #[error("restitutions do not depend on {key} of {law}: only contact times determine it")]
    NeedsTimes {
        /// Name of the law.
        law: &'static str,
        /// Key of the parameter.
        key: &'static str,
    },
    /// Materials or sizes are no spheres: the message and the allowed values.
    #[error("{0}")]
    Grains(String, String),
    /// The restitution is a bound: the reasons.
    #[error("the restitution is a bound, and no number for a law: {}", .0.join("; "))]
    Bound(Vec<String>),
    /// A contact law to compile does not hold an effect of the case: the message and the way out.
    #[error("{0}")]
    Unheld(String, String),
    /// The bodies stay together: the message and the way out.
    #[error("{0}")]
    Sticks(String, String),
}

/// The collision is impossible.
impl From<LawError> for LawFault {
    fn from(error: LawError) -> Self {
        Self::Fit(error.into())
    }
}
