//! Faults of data that reach the model as edits of the case, and what of the case is left out.

use fem::measured::MeasuredPairs;
use fem_case::{Case, CaseError};

use super::experiment::{ModelName, STEPS};
use crate::engineering::show;
use crate::failure::Failure;

/// What of the case's own model a calibration does not look at.
pub fn unused_model(case: &Case, chosen: ModelName) -> Option<String> {
    let model = case.scene.model.path();
    let is_own = chosen == ModelName::Condensed && model == "model.condensed";
    let what = match is_own {
        true => "model.condensed.steps",
        false => model.as_str(),
    };
    case.gives(what).then(|| match is_own {
        true => format!("{what} is not looked at: calibrate takes {STEPS}"),
        false => format!("{what} is not looked at: --model chooses, here {}", chosen.word()),
    })
}

/// A fault of a case that was edited to the sizes and speeds of a point: with the point's line
/// where it is of a body and stands neither in the case file nor in an option.
pub(super) fn blame(error: CaseError, measured: &MeasuredPairs, point: usize) -> Failure {
    let is_of_body = error.key().is_some_and(|key| key.starts_with("body"));
    if error.line().is_some() || !is_of_body {
        return error.into();
    }
    let failure = Failure::from(measured.data.fault(point, error.message()));
    match error.help() {
        Some(help) => failure.with_help(help),
        None => failure,
    }
}

/// A mesh whose elements the speeds make too small; what else is wrong with a mesh is the case's.
pub(super) fn no_mesh(error: CaseError, size: f64, (slowest, fastest): (f64, f64)) -> Failure {
    let of_size = ["mesh.contact_element_size", "limits.memory", "output.snapshots"];
    if !error.key().is_some_and(|key| of_size.contains(&key)) {
        return error.into();
    }
    Failure::bad_input(format!(
        "no mesh for all speeds from {} to {}: elements of {} are needed for the smallest contact, \
         {}",
        show(slowest, "m/s"),
        show(fastest, "m/s"),
        show(size, "m"),
        error.message()
    ))
    .with_help(
        "split the data by speed, give mesh.contact_element_size, or use --model ting, which has \
         no mesh",
    )
}
