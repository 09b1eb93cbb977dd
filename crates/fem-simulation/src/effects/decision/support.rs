//! A model's support for an effect, combined with its relevance, and its adequacy in a choice between models.

use fem_case::{Scene, Switch};
use fem_collision::QuantityOfInterest;

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::{Effect, is_needed};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

/// A model's support for an effect.
#[derive(Clone, Debug, PartialEq)]
pub enum Support {
    /// The model computes the effect where the scene calls for it.
    Computes {
        /// Text that follows the deciding number if the scene does not call for the effect; may be empty.
        idle: &'static str,
    },
    /// The model always includes the effect and cannot leave it out.
    Inherent {
        /// Text that follows the deciding number if the scene does not call for the effect; may be empty.
        idle: &'static str,
    },
    /// The model lacks the effect; a scene that calls for it gets a warning.
    Lacks,
    /// The model decides by itself.
    Is {
        /// Whether the effect is on.
        active: bool,
        /// The reason, or a description.
        reason: String,
        /// Warnings for the user.
        warnings: Vec<String>,
    },
}

impl Support {
    /// Returns the support of a model that decides by itself.
    pub fn decided(active: bool, reason: impl Into<String>) -> Self {
        Self::Is { active, reason: reason.into(), warnings: Vec::new() }
    }

    /// Adds warnings to the support of a model that decides by itself.
    #[must_use]
    pub fn warning(mut self, more: impl IntoIterator<Item = String>) -> Self {
        if let Self::Is { warnings, .. } = &mut self {
            warnings.extend(more);
        }
        self
    }

    /// Returns whether the case's switch decides.
    pub(in crate::effects) fn obeys(&self) -> bool {
        matches!(self, Self::Computes { .. })
    }

    /// Returns whether the effect is on, the reason, and the warnings.
    pub(in crate::effects) fn of(
        self,
        relevance: Relevance,
        switch: Option<Switch>,
    ) -> (bool, String, Vec<String>) {
        let Relevance { is_needed, number, if_not_needed, open_error, warning } = relevance;
        let none = Vec::new;
        match self {
            Self::Is { active, reason, warnings } => (active, reason, warnings),
            Self::Computes { .. } if is_needed && switch == Some(Switch::Off) => {
                (false, joined([&number, "needed, but switched off", &open_error]), none())
            }
            Self::Computes { .. } | Self::Inherent { .. } if is_needed => (true, number, none()),
            Self::Computes { .. } if switch == Some(Switch::On) => {
                (true, joined([&number, &if_not_needed, "forced on"]), none())
            }
            Self::Computes { idle } | Self::Inherent { idle } => {
                (false, joined([&number, &if_not_needed, idle]), none())
            }
            Self::Lacks if is_needed => {
                let lacking = "needed, but not computed";
                let warnings = warning.into_iter().collect();
                (false, joined([&number, lacking, &open_error]), warnings)
            }
            Self::Lacks => {
                let warnings = warning.into_iter().collect();
                (false, joined([&number, &if_not_needed, ""]), warnings)
            }
        }
    }
}

/// A model that a case may choose.
pub struct ConsideredModel<'a> {
    /// The scene of the case, which leaves its model open.
    pub case: &'a Scene,
    /// The same scene with the model.
    pub own: &'a Scene,
    /// Closed-form estimate of the collision.
    pub estimate: &'a Estimate,
    /// The model's support for an effect.
    pub support: &'a dyn Fn(&dyn Effect) -> Option<Support>,
}

/// The adequacy of a model for one effect of a scene.
#[derive(Clone, Debug)]
pub struct Adequacy {
    /// Error of the model's own term, or by the lack of the effect; `None` if it cannot be estimated.
    pub error: Option<QuantityErrors>,
    /// Whether the error is due to the lack of the effect, or to a term that stands for it.
    pub is_lack: bool,
    /// Why the model cannot compute the scene.
    pub impossible: Option<String>,
    /// Why a result of the model would come with the advice to use another one.
    pub advice: Option<String>,
}

impl Adequacy {
    /// The adequacy for an effect that the model computes without an error, or by which no models differ.
    pub const FULL: Self =
        Self { error: Some(QuantityErrors::ZERO), is_lack: false, impossible: None, advice: None };
}

impl ConsideredModel<'_> {
    /// Returns whether the model lacks an effect, and not if it has the effect without a decision.
    pub(crate) fn lacks(&self, effect: &dyn Effect) -> bool {
        let support = (self.support)(effect);
        matches!(support, Some(Support::Lacks | Support::Is { active: false, .. }))
    }

    /// Returns the adequacy of a model that has an effect without an error, or lacks it.
    pub(in crate::effects) fn with_or_without(&self, effect: &dyn Effect) -> Adequacy {
        if !self.lacks(effect) {
            return Adequacy::FULL;
        }
        Adequacy { error: self.error_without(effect), is_lack: true, ..Adequacy::FULL }
    }

    /// Returns the model-form error by a neglected effect, `None` if the effect is called for and its size cannot be
    /// estimated.
    pub(in crate::effects) fn error_without(&self, effect: &dyn Effect) -> Option<QuantityErrors> {
        self.error_by(effect, |neglect_error| {
            let status = EffectStatus { is_lacking: true, neglect_error: Some(neglect_error) };
            effect.model_form_error(self.case, self.estimate, &status)
        })
    }

    /// Returns the same with the error that follows from the neglect error.
    pub(in crate::effects) fn error_by(
        &self,
        effect: &dyn Effect,
        error: impl Fn(NeglectError) -> QuantityErrors,
    ) -> Option<QuantityErrors> {
        let error = match effect.neglect_error(self.case, self.estimate) {
            None if is_needed(effect, self.case, self.estimate) => return None,
            None => return Some(QuantityErrors::ZERO),
            Some(neglect_error) => error(neglect_error),
        };
        // A contact that does not end has no contact time.
        let is_known = [QuantityOfInterest::Restitution, QuantityOfInterest::PeakForce]
            .into_iter()
            .all(|quantity| error.size(quantity).is_some());
        is_known.then(|| error.unknown_as_zero())
    }

    /// Returns whether the model does otherwise than the case's switch says for an effect.
    pub(crate) fn disobeys(&self, effect: &dyn Effect) -> bool {
        let switch = effect.switch(self.case.effects());
        // A switch that transforms the scene is obeyed by any model.
        let is_open = matches!(switch, None | Some(Switch::Auto));
        let transforms =
            || effect.transform(self.case, self.estimate).is_ok_and(|scene| scene.is_some());
        if is_open || transforms() {
            return false;
        }
        match (switch, (self.support)(effect)) {
            (Some(Switch::On), support) => support.is_none() || self.lacks(effect),
            (_, Some(Support::Is { active, .. })) => active,
            (_, Some(Support::Inherent { .. })) => effect.is_never_off(self),
            _ => false,
        }
    }
}

fn joined(parts: [&str; 3]) -> String {
    let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relevance(is_needed: bool) -> Relevance {
        Relevance {
            is_needed,
            number: "x = 1".into(),
            if_not_needed: "small".into(),
            open_error: "all of it is open".into(),
            warning: Some("x is large".into()),
        }
    }

    #[test]
    fn reasons_give_the_number_and_its_consequence() {
        let computes = || Support::Computes { idle: "nothing is kept" };
        let none = Vec::new;
        let auto = Some(Switch::Auto);
        assert_eq!(computes().of(relevance(true), auto), (true, "x = 1".into(), none()));
        let idle = "x = 1; small; nothing is kept";
        assert_eq!(computes().of(relevance(false), None), (false, idle.into(), none()));
        let warned = vec!["x is large".to_string()];
        assert_eq!(
            Support::Lacks.of(relevance(false), auto),
            (false, "x = 1; small".into(), warned)
        );
        let (active, reason, warnings) = Support::Lacks.of(relevance(true), auto);
        assert!(!active && reason.contains("not computed") && reason.contains("all of it"));
        assert_eq!(warnings, ["x is large"]);
        let own = Support::decided(true, "always").warning(["beware".to_string()]);
        assert_eq!(own.of(relevance(true), None), (true, "always".into(), vec!["beware".into()]));
    }

    #[test]
    fn a_computed_effect_obeys_its_switch() {
        let of = |is_needed, switch| {
            Support::Computes { idle: "" }.of(relevance(is_needed), Some(switch))
        };
        let (active, reason, warnings) = of(false, Switch::On);
        assert!(active && reason.contains("forced on") && warnings.is_empty());
        let (active, reason, warnings) = of(true, Switch::Off);
        assert!(!active && reason.contains("switched off") && reason.contains("all of it"));
        assert!(warnings.is_empty(), "`decide` warns, with the number");
        assert!(!of(false, Switch::Off).0 && of(true, Switch::On).0);
    }
}
