//! A model's support for an effect, combined with its relevance.

use fem_case::Switch;

use crate::effects::decision::relevance::Relevance;

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
