//! Errors of a calibration.

use crate::fit::FitError;
use fem_case::CaseError;
use fem_case::engineering::show;
use fem_laws::LawError;

use crate::measured::DataError;

/// An error in the case, data or settings of a calibration, or a collision that fails.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CalibrationFault {
    /// The case with the sizes and the speeds of the data is invalid.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// The data are faulty.
    #[error(transparent)]
    Data(#[from] DataError),
    /// The data and settings do not determine a series, or a collision cannot be computed.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// No body is made of the material.
    #[error("no body is made of {name}")]
    OtherMaterial {
        /// The material that was asked for.
        name: String,
        /// The materials of the bodies.
        materials: Vec<String>,
    },
    /// There are two materials and none is named.
    #[error("the bodies are made of {}", materials.join(" and "))]
    TwoMaterials {
        /// The materials of the bodies.
        materials: Vec<String>,
    },
    /// A mesh with elements that are small enough for the slowest collision has too many.
    #[error(
        "no mesh for all speeds from {} to {}: elements of {} are needed for the smallest contact, \
         {reason}",
        show(speeds.0, "m/s"),
        show(speeds.1, "m/s"),
        show(*element_size, "m")
    )]
    NoMesh {
        /// Slowest and fastest speed, m/s.
        speeds: (f64, f64),
        /// The element size that is needed at the contact, m.
        element_size: f64,
        /// The reason why there is no such mesh.
        reason: String,
    },
}

/// The closed forms reject the pair of bodies.
impl From<LawError> for CalibrationFault {
    fn from(error: LawError) -> Self {
        Self::Fit(error.into())
    }
}
