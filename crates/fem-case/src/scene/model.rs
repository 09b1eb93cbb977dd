//! The model that a case selects, with validated numbers.

use fem_laws::{EndRule, LawInput};

use crate::scene::defaults;

/// The model of the collision.
#[derive(Clone, Debug, PartialEq)]
pub enum ModelChoice {
    /// Explicit finite elements.
    Fem,
    /// The cheapest of the other models that meets the tolerances.
    Auto,
    /// Linear finite elements condensed to their contact nodes.
    Condensed(CondensedOptions),
    /// Quasi-static elastic half-spaces (Hertz).
    Hertz {
        /// Whether the spheres' finite size adds to the approach.
        finite_size: bool,
    },
    /// Quasi-static viscoelastic half-spaces (Ting).
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
        /// The end of the contact.
        end_rule: EndRule,
        /// Accuracy of restitution, time and force.
        tolerance: f64,
    },
}

impl ModelChoice {
    /// Returns the model's key in `[model]`.
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

    /// Returns the dotted key of the model's table.
    pub fn path(&self) -> String {
        match self {
            ModelChoice::Law { law, .. } => format!("model.law.{}", law.family.name()),
            _ => format!("model.{}", self.name()),
        }
    }
}

/// The settings of `model.condensed`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CondensedOptions {
    /// Number of vibration modes of each body.
    pub vibration_modes: usize,
    /// Number of steps over the elastic contact time.
    pub steps: usize,
    /// Whether the penalty springs of the explicit model resist overlap.
    pub penalty_springs: bool,
}

impl Default for CondensedOptions {
    fn default() -> Self {
        defaults::CONDENSED
    }
}
