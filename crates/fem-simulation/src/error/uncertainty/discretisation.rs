//! What mesh, springs, added mass and steps may be off by: what companions tell, and no less than warnings state.

use std::sync::PoisonError;

use fem_collision::{Approach, Collision, QuantityOfInterest};

use super::stated::stated;
use crate::effects::{Doubt, FiniteStrain, Verdict};
use crate::error::discretisation_errors;
use crate::simulation::Simulation;

/// What closed forms are off by: rounding.
const ROUNDING: f64 = 1e-12;
/// Of motions of one degree of freedom, over their tolerance: approach, radius and pressure are read from
/// the instants of a history.
const OF_HISTORY: f64 = 20.0;

/// What tells a collision of a case from another one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seen {
    approach: Approach,
    values: [Option<f64>; 6],
    element_updates: Option<u64>,
    is_complete: bool,
}

impl Seen {
    fn of(collision: &Collision) -> Self {
        Self {
            approach: collision.approach,
            values: QuantityOfInterest::ALL.map(|headline| headline.of(collision)),
            element_updates: collision.element_updates,
            is_complete: collision.is_complete(),
        }
    }
}

impl Simulation {
    /// Of the quantities of a collision: of elements by companions, of one degree of freedom by its
    /// tolerance. Companions take time: what they told of the last collision is kept.
    pub(crate) fn discretisation(&self, collision: &Collision) -> Doubt {
        let now = Seen::of(collision);
        // Who panicked has left nothing half written.
        let mut errors = self.errors.lock().unwrap_or_else(PoisonError::into_inner);
        match &*errors {
            Some((seen, doubt)) if *seen == now => *doubt,
            _ => {
                let doubt = of(self, collision);
                *errors = Some((now, doubt));
                doubt
            }
        }
    }
}

/// Whether a collision was computed at finite strain.
fn is_at_finite_strain(simulation: &Simulation, collision: &Collision) -> bool {
    let verdicts = simulation.decisions(collision).verdicts;
    verdicts.iter().any(|verdict: &Verdict| verdict.name == FiniteStrain::NAME && verdict.active)
}

fn of(simulation: &Simulation, collision: &Collision) -> Doubt {
    use fem_case::ModelChoice::{Auto, Condensed, Fem, Hertz, Law, Ting};
    match *simulation.scene_of_model().model() {
        Fem | Condensed(_) => {
            let is_finite = is_at_finite_strain(simulation, collision);
            let told = discretisation_errors(simulation, collision, is_finite);
            Doubt::by(|headline| {
                let floor = headline.scale(headline.of(collision)?)
                    * stated(simulation, collision, headline);
                told.size(headline).map(|size| size.max(floor))
            })
        }
        Hertz { .. } => of_tolerance(collision, ROUNDING),
        Ting { tolerance, .. } | Law { tolerance, .. } => of_tolerance(collision, tolerance),
        // Its choice is one of the others.
        Auto => Doubt::default(),
    }
}

fn of_tolerance(collision: &Collision, tolerance: f64) -> Doubt {
    Doubt::by(|headline| {
        let share = match headline {
            QuantityOfInterest::Restitution
            | QuantityOfInterest::ContactTime
            | QuantityOfInterest::PeakForce => tolerance,
            _ => OF_HISTORY * tolerance,
        };
        headline.of(collision).map(|value| share * headline.scale(value))
    })
}
