//! Errors of a calibration.

use fem_case::CaseError;
use fem_case::engineering::show;
use fem_data::estimate::FitError;
use fem_laws::LawError;

use super::flow::FlowFit;
use fem_data::table::DataError;

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
    /// The relaxation of the case cannot be prior knowledge.
    #[error("the relaxation of {material} has no measured uncertainties for these moduli")]
    NoPrior {
        /// The material that is calibrated.
        material: String,
    },
    /// Prior knowledge and data without uncertainties cannot be compared.
    #[error("prior knowledge needs data with uncertainties")]
    NoUncertainties,
    /// The data are those of plastic flow, and no series makes them.
    #[error(
        "plastic flow explains these restitutions, and no relaxation does: a yield strength of {} has an rms error of \
         {:.4}, the best series {series_rms:.4}{}",
        show(flow.yield_strength, "Pa"),
        flow.rms,
        exponent.map_or(String::new(), |value| format!(
            "; 1 - e grows as the speed to the power {value:.2}, and that of a linear relaxation to 0.2 at most"
        ))
    )]
    Flow {
        /// The yield strength that explains the data.
        flow: FlowFit,
        /// The rms error of the best series.
        series_rms: f64,
        /// The exponent of the speed in 1 − e, if it is above that of any series.
        exponent: Option<f64>,
    },
    /// The model has no plate that bends.
    #[error("the condensed model of a calibration has no plate that bends")]
    Plate,
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
