//! How far a result may be from the truth, in two parts.
//!
//! **Discretisation**: the truth of the continuum problem that the model poses, with the effects that it has,
//! is expected within it. **Model**: nature is expected within both together; it is what effects that are
//! left out change ([`crate::effects::Doubt`]), and how far the laws are apart that a material may follow
//! beyond Hooke's where the case names none. It is as good as what closed forms foretell: within a factor of
//! three. Of a contact law's own numbers, which are the user's, it knows nothing.

mod discretisation;

pub(crate) use discretisation::Seen;

use fem_collision::Collision;

use crate::effects::{Doubt, EFFECTS, Standing};
use crate::results::{EffectSummary, Parts, Quantities, UncertaintySummary};
use crate::simulation::Simulation;

impl Simulation {
    /// How far the quantities of a collision may be off that it has, of what was decided on the effects and by
    /// how much its numbers change without each; in SI, untold where there is no number.
    pub(crate) fn uncertainty(
        &self,
        collision: &Collision,
        numbers: &Quantities,
        effects: &[EffectSummary],
    ) -> UncertaintySummary {
        let discretisation = self.discretisation(collision);
        let model = self.model_doubt(collision, effects);
        UncertaintySummary::by(|headline| {
            let of = |doubt: &Doubt| numbers.number(headline).and(doubt.size(headline));
            Parts { discretisation: of(&discretisation), model: of(&model) }
        })
    }

    /// What the effects that the collision lacks would change, all together.
    fn model_doubt(&self, collision: &Collision, effects: &[EffectSummary]) -> Doubt {
        let Some(estimate) = self.estimate(collision) else { return Doubt::default() };
        let estimate = estimate.as_came(collision);
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
