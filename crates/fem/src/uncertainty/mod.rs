//! How far a result may be from the truth, in two parts.
//!
//! **Discretisation**: the truth of the continuum problem that the model poses, with the effects that it has,
//! is expected within it. **Model**: nature is expected within both together; it is what effects that are
//! left out change ([`crate::effects::Doubt`]), and how far the laws are apart that a material may follow
//! beyond Hooke's where the case names none. It is as good as what closed forms foretell: within a factor of
//! three. Of a contact law's own numbers, which are the user's, it knows nothing.

mod discretisation;

use fem_collision::Collision;

use crate::effects::{Doubt, EFFECTS, Standing};
use crate::results::{EffectSummary, Quantities};
use crate::simulation::Simulation;

/// How far each quantity of a result may be off, in SI: untold where there is no number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Uncertainty {
    /// From the truth of the model's own problem.
    pub discretisation: Doubt,
    /// Of that from nature.
    pub model: Doubt,
}

impl Simulation {
    /// How far the quantities of a collision may be off, of what was decided on the effects and by how much
    /// its numbers change without each.
    pub(crate) fn uncertainty(
        &self,
        collision: &Collision,
        effects: &[EffectSummary],
    ) -> Uncertainty {
        Uncertainty {
            discretisation: discretisation::of(self, collision),
            model: self.model_doubt(collision, effects),
        }
    }

    /// What the effects that the collision lacks would change, all together.
    fn model_doubt(&self, collision: &Collision, effects: &[EffectSummary]) -> Doubt {
        let Some(estimate) = self.estimate(collision) else { return Doubt::default() };
        let scene = self.scene_of_model();
        effects.iter().fold(Doubt::NOTHING, |sum, EffectSummary { verdict, error_if_left_out }| {
            let standing =
                Standing { is_lacking: verdict.is_lacking, left_out: *error_if_left_out };
            let effect = EFFECTS.iter().find(|effect| effect.name() == verdict.name);
            let doubt = effect.map(|effect| effect.doubt(&scene, &estimate, &standing));
            sum.and(doubt.unwrap_or(Doubt::NOTHING))
        })
    }
}

impl Uncertainty {
    /// Of the quantities that a collision has.
    pub(crate) fn of_numbers(self, numbers: &Quantities) -> Self {
        let [discretisation, model] = [self.discretisation, self.model].map(|doubt| Doubt {
            restitution: numbers.restitution.and(doubt.restitution),
            contact_time: numbers.contact_time_s.and(doubt.contact_time),
            peak_force: numbers.peak_force_n.and(doubt.peak_force),
            max_approach: numbers.max_approach_m.and(doubt.max_approach),
            max_contact_radius: numbers.max_contact_radius_m.and(doubt.max_contact_radius),
            peak_pressure: numbers.peak_pressure_pa.and(doubt.peak_pressure),
        });
        Self { discretisation, model }
    }
}
