//! The estimate of a collision's results with an effect that decides them and that the run lacks.
//!
//! Bodies that yield at once, or that adhere, have other results than those of a run without it: an error bar as large as
//! the number itself says less than the range of the closed forms, which leads then.

use fem_case::Scene;
use fem_collision::QuantityOfInterest;
use fem_laws::ImpactQuantities;

use crate::effects::{EffectDecision, effect_named};
use crate::estimate::Estimate;

/// Smallest change of the restitution by an effect whose estimate leads.
const LEADING_CHANGE: f64 = 0.05;

/// The range of the results with an effect, by closed forms.
#[derive(Clone, Debug, PartialEq)]
pub struct LeadingEstimate {
    /// Name of the effect.
    pub effect: &'static str,
    /// What gives the range, and why the effect is there: `elastic–plastic laws (a yields from 1.85 mm/s on)`.
    pub by: String,
    /// What the results of the run are beside it: `if it stayed elastic`.
    pub run_is: &'static str,
    /// Smaller and larger value of every quantity, SI, not finite where unknown.
    range: [(f64, f64); 6],
}

impl LeadingEstimate {
    /// Returns the range that impacts span.
    pub(in crate::effects) fn of_impacts(
        effect: &'static str,
        by: String,
        run_is: &'static str,
        impacts: [ImpactQuantities; 2],
    ) -> Self {
        let [one, other] = impacts.map(|impact| impact.in_order());
        let range = std::array::from_fn(|k| (one[k].min(other[k]), one[k].max(other[k])));
        Self { effect, by, run_is, range }
    }

    /// Replaces the range of the restitution.
    #[must_use]
    pub(in crate::effects) fn with_restitution(mut self, low: f64, high: f64) -> Self {
        self.range[QuantityOfInterest::Restitution as usize] = (low, high);
        self
    }

    /// Makes all quantities but the restitution unknown.
    #[must_use]
    pub(in crate::effects) fn of_restitution_alone(mut self) -> Self {
        self.range[1..].fill((f64::NAN, f64::NAN));
        self
    }

    /// Returns the smaller and the larger value of a quantity, SI; `None` if they are unknown.
    pub fn range(&self, quantity: QuantityOfInterest) -> Option<[f64; 2]> {
        let (low, high) = self.range[quantity as usize];
        (low.is_finite() && high.is_finite()).then_some([low, high])
    }

    /// Returns the estimate if the middle of its restitutions is far enough below that of the run without the effect.
    pub(in crate::effects) fn if_it_leads(self, without: f64) -> Option<Self> {
        let [low, high] = self.range(QuantityOfInterest::Restitution)?;
        (0.5 * (low + high) < without - LEADING_CHANGE).then_some(self)
    }

    /// Returns the estimate that leads among the effects that a run lacks, whose restitution is given: the one with the
    /// smallest restitution.
    pub(crate) fn of(
        scene: &Scene,
        estimate: &Estimate,
        decisions: &[EffectDecision],
        restitution: f64,
    ) -> Option<Self> {
        let lacking = decisions.iter().filter(|decision| decision.is_lacking && !decision.active);
        let estimates = lacking.filter_map(|decision| {
            effect_named(decision.name)?.leading_estimate(scene, estimate, restitution)
        });
        let highest = |estimate: &Self| estimate.range[QuantityOfInterest::Restitution as usize].1;
        estimates.min_by(|one, other| highest(one).total_cmp(&highest(other)))
    }
}
