//! Errors of laws, fits and calibrations as failures, with the options that help.

use fem::calibrate::CalibrationFault;
use fem::fit::FitError;
use fem::laws::{LawFault, ParameterError};
use fem_laws::LawError;

use crate::text::failure::Failure;

impl From<LawFault> for Failure {
    fn from(fault: LawFault) -> Self {
        let message = fault.to_string();
        match fault {
            LawFault::Case(error) => error.into(),
            LawFault::Data(error) => error.into(),
            LawFault::Parameter(error) => error.into(),
            LawFault::Fit(error) => error.into(),
            LawFault::Missing { key, free, .. } => {
                let give = format!("give it with --param {key}=VALUE");
                Failure::bad_input(message).with_help(match &free[..] {
                    [] => give,
                    free => format!("{give}, or fit it with --free {},{key}", free.join(",")),
                })
            }
            LawFault::NeedsTimes { key, .. } => Failure::bad_input(message).with_help(format!(
                "leave {key} out of --free to use Hertz' contact time, or give contact times with a column \
                 contact_time_s and --contact-time"
            )),
            LawFault::Grains(_, help)
            | LawFault::Sticks(_, help)
            | LawFault::Unheld(_, help) => Failure::bad_input(message).with_help(help),
            LawFault::Compared { .. } => Failure::bad_input(format!("--compare {message}"))
                .with_help("leave it out, or fit it alone with --law"),
            LawFault::Bound(_) => Failure::bad_input(message).with_help(
                "give what is missing, name measured values with --data, or write --as-elastic to take it as it is",
            ),
        }
    }
}

impl From<ParameterError> for Failure {
    fn from(error: ParameterError) -> Self {
        let help = match error {
            ParameterError::Lossless { .. } => {
                Some("choose another law; docs/fits.md lists them".to_string())
            }
            _ => error.help(),
        };
        Failure::bad_input(error.to_string()).with_help_if(help)
    }
}

/// All of them are bad input: data and options are the user's.
impl From<FitError> for Failure {
    fn from(error: FitError) -> Self {
        let failure = Failure::bad_input(error.to_string());
        let help = match error {
            FitError::TooFewData { .. } => "free fewer parameters, or measure at more speeds",
            FitError::Degenerate { .. } => {
                "hold one of them with --param KEY=VALUE and leave it out of --free, or measure over \
                 a wider range of speeds"
            }
            FitError::Insensitive { .. } => "the restitutions are all 1, or all 0",
            FitError::NotConverged { .. } => {
                "give a start with --param KEY=VALUE, or a range with --bounds KEY=LOW..HIGH"
            }
            FitError::NoSolution { .. } => {
                "no value of this parameter gives it: choose another law"
            }
            FitError::OwnEnd { .. } => {
                "leave --end out; zhang_whiten with another end is the law tsuji"
            }
            FitError::BondedPlate => "compute restitutions by fem-run sweep with model fem",
            FitError::NoRelaxation => "give a material a [material.NAME.relaxation] table",
            _ => return failure,
        };
        failure.with_help(help)
    }
}

impl From<LawError> for Failure {
    fn from(error: LawError) -> Self {
        FitError::from(error).into()
    }
}

impl From<CalibrationFault> for Failure {
    fn from(fault: CalibrationFault) -> Self {
        let message = fault.to_string();
        match fault {
            CalibrationFault::Case(error) => error.into(),
            CalibrationFault::Data(error) => error.into(),
            CalibrationFault::Fit(error) => calibration_failure(error),
            CalibrationFault::OtherMaterial { name, materials } => {
                Failure::bad_input(format!("--material {name}: no body has this material"))
                    .with_help(format!("the bodies are made of {}", materials.join(" and ")))
            }
            CalibrationFault::TwoMaterials { materials } => Failure::bad_input(message)
                .with_help(format!("name the one to calibrate: --material {}", materials[0])),
            CalibrationFault::NoPrior { .. } => Failure::bad_input(message).with_help(
                "make one with fem-run relaxation and name its file in the case, relaxation = { file = \"...\" }, or leave \
                 --prior out",
            ),
            CalibrationFault::NoUncertainties => Failure::bad_input(message)
                .with_help("give --uncertainty, the standard uncertainty of a restitution"),
            CalibrationFault::Flow { .. } => Failure::bad_input(message).with_help(
                "give the material a yield strength: fem-run fit CASE --data FILE --law mean_pressure",
            ),
            CalibrationFault::Plate => Failure::bad_input(message)
                .with_help("write --model ting, which has free plates; bonded ones need model fem"),
            CalibrationFault::NoMesh { .. } => Failure::bad_input(message).with_help(
                "split the data by speed, give mesh.contact_element_size, or use --model ting, which \
                 has no mesh",
            ),
        }
    }
}

/// Bad input, unless a collision failed.
fn calibration_failure(error: FitError) -> Failure {
    let message = error.to_string();
    match error {
        FitError::TooFewData { .. } => Failure::bad_input(message)
            .with_help("lower --terms, measure at more speeds, or give --regularisation above 0"),
        FitError::Collision { .. } => Failure::failed(message).with_help(
            "leave out the speeds at which the bodies are not linear, or give slower --times",
        ),
        FitError::NotConverged { .. } => {
            Failure::failed(message).with_help("lower --terms, or raise --regularisation")
        }
        error => error.into(),
    }
}
