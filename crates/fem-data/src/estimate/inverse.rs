//! The values of one parameter with which a collision has a wanted restitution.
//!
//! The parameter is scanned over all decades (a plain number over its limits) around its natural
//! size, and each crossing is refined. There may be several: a solid that does not flow loses most at
//! the rate that matches the contact time, and less on both sides of it.

use fem_laws::bisection::falling_zero;
use fem_laws::{LawParameter, MIN_RESTITUTION, ParameterRole};

use crate::estimate::error::FitError;
use crate::estimate::model::Model;

/// The values of a parameter that give a wanted restitution.
#[derive(Debug, Clone, PartialEq)]
pub struct Inversion {
    /// Values of the parameter, SI, ascending; at least one.
    pub solutions: Vec<f64>,
    /// Smallest and largest restitution in the scan.
    pub reach: (f64, f64),
}

/// Decades around the natural size that are scanned: from a negligible loss to a nearly complete one.
const DECADES: f64 = 8.0;
/// Decades of a rate that are scanned; the loss of Ting's model falls on both sides.
const DECADES_OF_A_RATE: f64 = 5.0;
const STEPS_PER_DECADE: f64 = 4.0;
/// Error of the restitution at a crossing that is a jump of the law.
const JUMP: f64 = 1e-6;
/// Number of steps over the limits of a plain number.
const SEARCH_STEPS: f64 = 60.0;

/// Returns the range that is scanned: decades around the natural size, or the limits of a plain number.
fn scanned(parameter: &LawParameter) -> (f64, f64) {
    match parameter.role {
        ParameterRole::Number => parameter.limits,
        ParameterRole::Rate => (-DECADES_OF_A_RATE, DECADES_OF_A_RATE),
        // Bodies stronger than Hertz' peak pressure do not flow.
        ParameterRole::Strength => (-DECADES, 0.0),
        _ => (-DECADES, DECADES),
    }
}

/// Returns all values of the parameter of an index that give `restitution` at `speed`, m/s. The other
/// parameters have the given `values`.
///
/// # Errors
/// The restitution is outside (0, 1), no value gives it, or the speed is not positive and finite.
pub fn invert(
    model: &Model,
    index: usize,
    values: &[f64],
    speed: f64,
    restitution: f64,
) -> Result<Inversion, FitError> {
    if !(restitution > 0.0 && restitution < 1.0) {
        let (quantity, allowed) = ("restitution", "greater than 0 and less than 1");
        return Err(FitError::OutOfRange { quantity, value: restitution, allowed });
    }
    let parameter = &model.family().parameters()[index];
    let size = model.natural_size(parameter, values, speed)?;
    let is_number = parameter.role == ParameterRole::Number;
    let value_at = |theta: f64| if is_number { theta } else { size * 10f64.powf(theta) };
    let (low, high) = scanned(parameter);
    let excess = |theta: f64| {
        let mut all = values.to_vec();
        all[index] = value_at(theta);
        model.outcome(&all, speed).map(|outcome| outcome.restitution - restitution)
    };
    let n_steps = if is_number { SEARCH_STEPS } else { ((high - low) * STEPS_PER_DECADE).round() };
    let mut solutions = Vec::new();
    let mut reach = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut previous, mut fault) = (None::<(f64, f64)>, None);
    for step in 0..=n_steps as usize {
        let theta = low + (high - low) * step as f64 / n_steps;
        // Values that are so extreme that there is no collision are skipped.
        let here = match excess(theta) {
            Ok(here) => here,
            Err(error) => {
                (previous, fault) = (None, Some(error));
                continue;
            }
        };
        reach = (reach.0.min(here + restitution), reach.1.max(here + restitution));
        if let Some((before, value)) = previous
            && (value > 0.0) != (here > 0.0)
        {
            let sign = if value > 0.0 { 1.0 } else { -1.0 };
            let signed = |theta: f64| excess(theta).map_or(-1.0, |excess| sign * excess);
            let found = falling_zero(before, theta, signed);
            // A law may jump over the restitution.
            let is_met = excess(found).is_ok_and(|excess| excess.abs() < JUMP);
            solutions.extend(is_met.then(|| value_at(found)));
        }
        previous = Some((theta, here));
        // More damping leaves a smaller restitution, and its creep takes long to compute.
        if parameter.role == ParameterRole::Damping && here + restitution < MIN_RESTITUTION {
            break;
        }
    }
    if let Some(fault) = fault.filter(|_| reach.0 > reach.1) {
        return Err(fault.into());
    }
    if solutions.is_empty() {
        return Err(FitError::NoSolution {
            parameter,
            wanted: restitution,
            speed,
            range: (value_at(low), value_at(high)),
            least: reach.0,
            most: reach.1,
        });
    }
    Ok(Inversion { solutions, reach })
}
