//! The model that a case chooses, its numbers checked. One variant a model.

use fem_laws::{EndRule, LawInput};

/// How the collision is computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum ModelChoice {
    /// Explicit finite elements.
    #[default]
    Fem,
    /// The cheapest of the others that serves what the case asks for.
    Auto,
    /// Linear finite elements condensed to their contact nodes.
    Condensed(CondensedOptions),
    /// Elastic half-spaces.
    Hertz {
        /// Whether the spheres' finite size adds to the approach.
        finite_size: bool,
    },
    /// Viscoelastic half-spaces, quasi-static.
    Ting {
        /// Whether the spheres' finite size adds to the approach.
        finite_size: bool,
        /// Accuracy of restitution, time and force.
        tolerance: f64,
    },
    /// A contact law.
    Law {
        /// The law and the values of its keys.
        law: LawInput,
        /// When the contact is over.
        end_rule: EndRule,
        /// Accuracy of restitution, time and force.
        tolerance: f64,
    },
}

impl ModelChoice {
    /// Its key under `[model]`.
    pub fn name(&self) -> &'static str {
        match self {
            ModelChoice::Fem => "fem",
            ModelChoice::Auto => "auto",
            ModelChoice::Condensed(_) => "condensed",
            ModelChoice::Hertz { .. } => "hertz",
            ModelChoice::Ting { .. } => "ting",
            ModelChoice::Law { .. } => "law",
        }
    }

    /// The dotted key of its table.
    pub fn path(&self) -> String {
        match self {
            ModelChoice::Law { law, .. } => format!("model.law.{}", law.family.name()),
            _ => format!("model.{}", self.name()),
        }
    }
}

/// The keys of `model.condensed`, resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CondensedOptions {
    /// Modes of free vibration of each body.
    pub vibration_modes: usize,
    /// Steps over the elastic contact time.
    pub steps: usize,
    /// Whether overlap is resisted by the explicit model's springs.
    pub penalty_springs: bool,
}

impl Default for CondensedOptions {
    fn default() -> Self {
        Self { vibration_modes: 0, steps: 250, penalty_springs: false }
    }
}
