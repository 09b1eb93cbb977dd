//! Advice against contact chatter and spurious energy growth.
//!
//! A boundary without mass does neither: the force scatters by 0.01 % of its peak. Where springs pull at nodes
//! with mass, at finite strain and beside bulk viscosity, softer springs help: with the usual ones ([`USUAL`])
//! the force scatters by less than 0.4 % (measured from factors of 1 to 300: docs/contact.md).

use fem_case::Scene;

use crate::effects::FiniteStrain;
use crate::plan::Plan;
use crate::plan::contact_method::massless_is_possible;

/// Factor of the usual springs.
const USUAL: f64 = 1.0;
/// Penalty factor below which the overlap of the surfaces is reported.
const SOFTEST: f64 = 0.25;
/// The settings that reduce contact noise in a computed run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactNoiseAdvice {
    /// Smaller steps, of condensed bodies.
    MoreSteps,
    /// Smaller steps, of a boundary without mass.
    ShorterSteps,
    /// A boundary without mass instead of springs at nodes.
    Massless,
    /// Softer springs than those with this factor.
    Softer {
        /// Advice about the penalty springs.
        penalty_factor: f64,
    },
}

impl ContactNoiseAdvice {
    /// Returns the advice for a run with explicit elements.
    pub(crate) fn of_elements(scene: &Scene, plan: &Plan) -> Self {
        let is_finite = FiniteStrain::laws(scene, &plan.estimate) != [None; 2];
        let is_possible = massless_is_possible(scene) && !is_finite;
        match (is_possible, plan.contact_method) {
            (true, fem_case::ContactMethod::Massless) => Self::ShorterSteps,
            (true, _) => Self::Massless,
            (false, _) => Self::Softer { penalty_factor: plan.penalty_factor },
        }
    }

    /// In words, of energy that does not add up. Of springs that are the usual ones or softer it is the steps
    /// that lose it, with their square: at finite strain a factor of 0.4 leaves a fifth.
    pub(crate) fn advice_on_energy(&self) -> String {
        match *self {
            Self::Softer { penalty_factor } if penalty_factor <= USUAL => {
                "lower time.step_factor".to_string()
            }
            Self::Softer { .. } => format!("write contact.penalty_factor = {USUAL}"),
            _ => self.advice(),
        }
    }

    /// In words, of a force that scatters.
    pub(crate) fn advice(&self) -> String {
        match *self {
            Self::MoreSteps => "raise model.condensed.steps".to_string(),
            Self::ShorterSteps => "lower time.step_factor".to_string(),
            Self::Massless => "write contact.method = \"massless\"".to_string(),
            Self::Softer { penalty_factor } if penalty_factor > USUAL => {
                format!("write contact.penalty_factor = {USUAL}")
            }
            Self::Softer { penalty_factor } if penalty_factor > SOFTEST => {
                format!("write contact.penalty_factor = {SOFTEST}")
            }
            Self::Softer { .. } => "write time.mass_scaling = 0".to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Softer springs do not help against energy that steps lose, nor shorter steps against noise.
    #[test]
    fn noise_and_energy_have_remedies_of_their_own() {
        let softer = |penalty_factor| ContactNoiseAdvice::Softer { penalty_factor };
        for (quieter, of_noise, of_energy) in [
            (
                ContactNoiseAdvice::MoreSteps,
                "raise model.condensed.steps",
                "raise model.condensed.steps",
            ),
            (ContactNoiseAdvice::ShorterSteps, "lower time.step_factor", "lower time.step_factor"),
            (softer(10.0), "write contact.penalty_factor = 1", "write contact.penalty_factor = 1"),
            (softer(1.0), "write contact.penalty_factor = 0.25", "lower time.step_factor"),
            (softer(0.25), "write time.mass_scaling = 0", "lower time.step_factor"),
        ] {
            assert_eq!(quieter.advice(), of_noise, "{quieter:?}");
            assert_eq!(quieter.advice_on_energy(), of_energy, "{quieter:?}");
        }
    }
}
