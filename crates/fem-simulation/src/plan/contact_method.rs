//! The contact method of explicit elements, and the settings that reduce contact noise.
//!
//! A massless boundary neither chatters nor gains energy: the force scatters by 0.01 % of its peak. At finite strain and
//! with bulk viscosity, springs act on nodes with mass instead. With the default penalty factor the force then
//! scatters by less than 0.4 % of its peak (measured from factors of 1 to 300: docs/contact.md), and softer springs reduce
//! the scatter.

use fem_case::defaults::{CONTACT_METHOD, PENALTY_FACTOR};
use fem_case::engineering::show;
use fem_case::{ContactMethod, Scene, Switch};

use crate::effects::FiniteStrain;
use crate::estimate::Estimate;
use crate::estimate::quasi_static::surfaces_slip;
use crate::plan::Plan;
use crate::plan::element_size::MACH_OF_SLOW_IMPACTS;

/// Returns the contact method at small strain.
pub fn contact_method(scene: &Scene) -> ContactMethod {
    match scene.contact_method().unwrap_or(CONTACT_METHOD) {
        ContactMethod::Massless if !massless_is_possible(scene) => ContactMethod::Penalty,
        ContactMethod::NodeToSurface if surfaces_slip(scene) => ContactMethod::Penalty,
        method => method,
    }
}

/// Returns whether the surface nodes of a scene can be massless at small strain.
fn massless_is_possible(scene: &Scene) -> bool {
    scene.effects().bulk_viscosity != Some(Switch::On)
}

/// Returns a warning if the case names a method that the scene does not allow.
pub fn ignored_method_warning(scene: &Scene, is_at_finite_strain: bool) -> Option<String> {
    if is_at_finite_strain {
        let word = scene.contact_method()?.word();
        return Some(format!(
            "contact.method = \"{word}\" has no effect at finite strain, where springs between the deformed surfaces are used"
        ));
    }
    let named = scene.contact_method().filter(|named| *named != contact_method(scene))?;
    let why = match named {
        ContactMethod::NodeToSurface => "with surface slip, which its springs do not follow",
        _ => "with bulk viscosity, which needs nodes with mass",
    };
    let word = named.word();
    Some(format!("contact.method = \"{word}\" has no effect {why}: \"penalty\" is used"))
}

/// Penalty factor below which the overlap of the surfaces is reported.
const SOFTEST_ADVISED_FACTOR: f64 = 0.25;

/// Returns the factor on the penalty stiffness of a case that names none. In fast impacts of bodies that flow plastically,
/// each node that touches excites the springs anew: in 49 random scenes a factor of 1 leaves an energy residual of up to 2.4e-4,
/// 0.25 one of up to 7e-5, and changes the restitution by 0.003.
pub(crate) fn default_penalty_factor(estimate: &Estimate) -> f64 {
    match estimate.flow.is_some() && estimate.mach > MACH_OF_SLOW_IMPACTS {
        true => SOFTEST_ADVISED_FACTOR,
        false => PENALTY_FACTOR,
    }
}

/// The setting that reduces contact noise in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactNoiseAdvice {
    /// Smaller time steps of condensed bodies.
    MoreSteps,
    /// Smaller time steps with a massless boundary.
    ShorterSteps,
    /// A massless boundary instead of springs at nodes with mass.
    Massless,
    /// Smaller elements of bodies that flow, whose force is a staircase.
    FinerElements {
        /// Size of the elements at the contact, m.
        size: f64,
    },
    /// Softer springs at nodes with mass.
    Softer {
        /// Penalty factor of the run.
        penalty_factor: f64,
    },
}

impl ContactNoiseAdvice {
    /// Returns the advice for a run with explicit elements.
    pub(crate) fn of_elements(scene: &Scene, plan: &Plan) -> Self {
        let is_finite = FiniteStrain::is_on(scene, &plan.estimate);
        let is_possible = massless_is_possible(scene) && !is_finite;
        match (is_possible, plan.contact_method) {
            (true, ContactMethod::Massless) => Self::ShorterSteps,
            (true, _) => Self::Massless,
            (false, _) if plan.estimate.flow.is_some() && plan.penalty_factor <= PENALTY_FACTOR => {
                Self::FinerElements { size: 0.5 * plan.contact_element_size }
            }
            (false, _) => Self::Softer { penalty_factor: plan.penalty_factor },
        }
    }

    /// Returns the advice for an energy residual. With default or softer springs the residual falls with the square of the
    /// time step: at finite strain a step factor of 0.4 leaves a fifth of it.
    pub(crate) fn advice_on_energy(&self) -> String {
        match *self {
            Self::FinerElements { .. } => "lower time.step_factor".to_string(),
            Self::Softer { penalty_factor } if penalty_factor <= PENALTY_FACTOR => {
                "lower time.step_factor".to_string()
            }
            Self::Softer { .. } => {
                format!("write contact.penalty_factor = {PENALTY_FACTOR}")
            }
            _ => self.advice(),
        }
    }

    /// Returns the advice for a scattering contact force.
    pub(crate) fn advice(&self) -> String {
        match *self {
            Self::MoreSteps => "raise model.condensed.steps".to_string(),
            Self::ShorterSteps => "lower time.step_factor".to_string(),
            Self::Massless => "write contact.method = \"massless\"".to_string(),
            Self::FinerElements { size } => {
                format!("write mesh.contact_element_size = \"{}\"", show(size, "m"))
            }
            Self::Softer { penalty_factor } if penalty_factor > PENALTY_FACTOR => {
                format!("write contact.penalty_factor = {PENALTY_FACTOR}")
            }
            Self::Softer { penalty_factor } if penalty_factor > SOFTEST_ADVISED_FACTOR => {
                format!("write contact.penalty_factor = {SOFTEST_ADVISED_FACTOR}")
            }
            Self::Softer { .. } => "write time.mass_scaling = 0".to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Softer springs do not reduce an energy residual, nor do shorter steps reduce the noise of springs.
    #[test]
    fn noise_and_energy_have_their_own_advice() {
        let softer = |penalty_factor| ContactNoiseAdvice::Softer { penalty_factor };
        for (advice, of_noise, of_energy) in [
            (
                ContactNoiseAdvice::MoreSteps,
                "raise model.condensed.steps",
                "raise model.condensed.steps",
            ),
            (ContactNoiseAdvice::ShorterSteps, "lower time.step_factor", "lower time.step_factor"),
            (softer(10.0), "write contact.penalty_factor = 1", "write contact.penalty_factor = 1"),
            (softer(1.0), "write contact.penalty_factor = 0.25", "lower time.step_factor"),
            (softer(0.25), "write time.mass_scaling = 0", "lower time.step_factor"),
            (
                ContactNoiseAdvice::FinerElements { size: 5e-5 },
                "write mesh.contact_element_size = \"50.00 µm\"",
                "lower time.step_factor",
            ),
        ] {
            assert_eq!(advice.advice(), of_noise, "{advice:?}");
            assert_eq!(advice.advice_on_energy(), of_energy, "{advice:?}");
        }
    }
}
