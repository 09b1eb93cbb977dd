//! Faults of a calibration, with the options that help.

use fem::calibrate::CalibrationFault;
use fem_fit::FitError;

use crate::failure::Failure;

impl From<CalibrationFault> for Failure {
    fn from(fault: CalibrationFault) -> Self {
        let message = fault.to_string();
        match fault {
            CalibrationFault::Case(error) => error.into(),
            CalibrationFault::Data(error) => error.into(),
            CalibrationFault::Fit(error) => of_fit(error),
            CalibrationFault::OtherMaterial { name, materials } => {
                Failure::bad_input(format!("--material {name}: no body is made of it"))
                    .with_help(format!("the bodies are made of {}", materials.join(" and ")))
            }
            CalibrationFault::TwoMaterials { materials } => Failure::bad_input(message)
                .with_help(format!("say which to calibrate: --material {}", materials[0])),
            CalibrationFault::NoMesh { .. } => Failure::bad_input(message).with_help(
                "split the data by speed, give mesh.contact_element_size, or use --model ting, which \
                 has no mesh",
            ),
        }
    }
}

/// Bad input, unless it is a collision that failed.
fn of_fit(error: FitError) -> Failure {
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
