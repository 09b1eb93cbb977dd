//! How far a result may be from the truth, in two parts.
//!
//! **Discretisation**: the truth of the continuum problem that the model poses, with the effects that it has,
//! is expected within it. **Model**: nature is expected within both together; it is what effects that are
//! left out change ([`crate::effects::Doubt`]), and how far the laws are apart that a material may follow
//! beyond Hooke's where the case names none. It is as good as what closed forms foretell: within a factor of
//! three. Of a material of the library whose loss in an impact is not published the restitution's is not
//! known. Of a contact law's own numbers, which are the user's, it knows nothing.

mod discretisation;
mod stated;

pub(crate) use discretisation::Seen;
pub(crate) use stated::of_noise;

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
        let doubts = self.model_doubts(collision, effects);
        let sum = |doubts: &mut dyn Iterator<Item = Doubt>| doubts.fold(Doubt::NOTHING, Doubt::and);
        let model = sum(&mut doubts.iter().copied());
        let told = sum(&mut doubts.iter().copied().map(Doubt::told));
        UncertaintySummary::by(|headline| {
            let of = |doubt: &Doubt| numbers.number(headline).and(doubt.size(headline));
            let model = of(&model);
            let told = of(&told).filter(|told| model.is_none() && *told > 0.0);
            Parts { discretisation: of(&discretisation), model, model_at_least: told }
        })
    }

    /// What each effect that the collision lacks would change, and a loss that nobody has published.
    fn model_doubts(&self, collision: &Collision, effects: &[EffectSummary]) -> Vec<Doubt> {
        let Some(estimate) = self.estimate(collision) else { return vec![Doubt::default()] };
        let estimate = estimate.as_came(collision);
        let scene = self.scene_of_model();
        let doubt = |EffectSummary { verdict, error_if_left_out }: &EffectSummary| {
            let standing =
                Standing { is_lacking: verdict.is_lacking, left_out: *error_if_left_out };
            let effect = EFFECTS.iter().find(|effect| effect.name() == verdict.name)?;
            Some(effect.doubt(&scene, &estimate, &standing))
        };
        let loss = self.case().scene().unpublished_loss().map(|_| Doubt::of_loss());
        effects.iter().filter_map(doubt).chain(loss).collect()
    }
}
