//! What mesh, springs, added mass and steps may be off by.

use fem_collision::{Collision, Headline};

use crate::accuracy::discretisation_errors;
use crate::effects::{Doubt, FiniteStrain};
use crate::results::EffectSummary;
use crate::simulation::Simulation;

/// What closed forms are off by: rounding.
const ROUNDING: f64 = 1e-12;
/// Of motions of one degree of freedom, over their tolerance: approach, radius and pressure are read from
/// the instants of a history.
const OF_HISTORY: f64 = 20.0;

/// Of the quantities of a collision: of elements by companions, of one degree of freedom by its tolerance.
pub(super) fn of(
    simulation: &Simulation,
    collision: &Collision,
    effects: &[EffectSummary],
) -> Doubt {
    use fem_case::ModelChoice::{Auto, Condensed, Fem, Hertz, Law, Ting};
    match *simulation.scene_of_model().model() {
        Fem | Condensed(_) => {
            discretisation_errors(simulation, collision, is_at_finite_strain(effects))
        }
        Hertz { .. } => of_tolerance(collision, ROUNDING),
        Ting { tolerance, .. } | Law { tolerance, .. } => of_tolerance(collision, tolerance),
        // Its choice is one of the others.
        Auto => Doubt::default(),
    }
}

/// Whether a collision was computed with large strains.
fn is_at_finite_strain(effects: &[EffectSummary]) -> bool {
    effects.iter().any(|effect| effect.verdict.name == FiniteStrain::NAME && effect.verdict.active)
}

fn of_tolerance(collision: &Collision, tolerance: f64) -> Doubt {
    Doubt::by(|headline| {
        let share = match headline {
            Headline::Restitution | Headline::ContactTime | Headline::PeakForce => tolerance,
            _ => OF_HISTORY * tolerance,
        };
        headline.of(collision).map(|value| share * headline.scale(value))
    })
}
