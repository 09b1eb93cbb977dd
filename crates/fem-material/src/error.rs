//! Errors of material data.

use thiserror::Error;

use crate::engineering::show;

/// A material that cannot exist. Quantities carry the names that case files give them.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MaterialError {
    /// Zero, negative, infinite or NaN where only a positive number has a meaning.
    #[error("{quantity} must be positive and finite, found {value:?}")]
    NotPositive {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value that was found.
        value: f64,
    },

    /// Negative, infinite or NaN where zero and positive numbers are allowed.
    #[error("{quantity} must be zero or positive and finite, found {value:?}")]
    Negative {
        /// Name of the quantity.
        quantity: &'static str,
        /// Value that was found.
        value: f64,
    },

    /// Poisson's ratio at or beyond a limit of stability, or not a number.
    #[error("poissons_ratio must lie in -1 < poissons_ratio < 0.5, found {value:?}")]
    PoissonsRatio {
        /// Value that was found.
        value: f64,
    },

    /// Two moduli that no stable isotropic solid has together.
    #[error(
        "youngs_modulus {youngs_modulus:?} with {other} {other_value:?} implies poissons_ratio \
         {implied:?}; -1 < poissons_ratio < 0.5 needs youngs_modulus < {limit:?}"
    )]
    ImpliedPoissonsRatio {
        /// Young's modulus found.
        youngs_modulus: f64,
        /// Name of the other modulus.
        other: &'static str,
        /// Value of the other modulus.
        other_value: f64,
        /// Poisson's ratio that the two imply, rounded.
        implied: f64,
        /// Bound on Young's modulus that the other modulus sets.
        limit: f64,
    },

    /// Fewer or more than two elastic constants.
    #[error(
        "exactly two of youngs_modulus, shear_modulus, bulk_modulus, poissons_ratio are needed, \
         found {}",
        listed(given)
    )]
    ModuliCount {
        /// Names of those given.
        given: Vec<&'static str>,
    },

    /// A relaxation table without terms.
    #[error("relaxation needs at least one term, found none; leave it out for an elastic material")]
    NoRelaxationTerms,

    /// A relaxation weight that is negative, infinite or NaN.
    #[error("relaxation term {index}: weight must be finite and at least 0, found {value:?}")]
    RelaxationWeight {
        /// Index of the term, from 0.
        index: usize,
        /// Weight that was found.
        value: f64,
    },

    /// Weights that leave a negative equilibrium modulus.
    #[error("relaxation weights must sum to at most 1, found {sum:?}")]
    RelaxationWeightSum {
        /// Sum that was found.
        sum: f64,
    },

    /// A relaxation time that is zero, negative, infinite or NaN.
    #[error(
        "relaxation term {index}: relaxation_time must be positive and finite, found {value:?}"
    )]
    RelaxationTime {
        /// Index of the term, from 0.
        index: usize,
        /// Relaxation time found, s.
        value: f64,
    },

    /// Plastic flow of a material that relaxes.
    #[error("plastic flow and relaxation in the same material are not computed")]
    FlowWithRelaxation,

    /// Plastic flow with another hyperelastic law than Hencky's.
    #[error("plastic flow is computed with the hyperelastic law \"hencky\", found {law:?}")]
    FlowWithLaw {
        /// Name of the law.
        law: &'static str,
    },

    /// An exponent of Swift's power law outside its range.
    #[error("flow.hardening.swift.exponent must be above 0 and at most 1, found {value:?}")]
    HardeningExponent {
        /// Exponent that was found.
        value: f64,
    },

    /// A table of flow stress without rows, or with too many.
    #[error("a table of flow stress needs 1 to {} rows, found {found}", crate::flow::MAX_FLOW_ROWS)]
    FlowRows {
        /// Number of rows found.
        found: usize,
    },

    /// Plastic strains of a table of flow stress that do not start at 0 or do not increase.
    #[error(
        "point {} of the flow stress: plastic strains start at 0 and increase, found {value:?}",
        row + 1
    )]
    FlowStrain {
        /// Index of the row, from 0.
        row: usize,
        /// Plastic strain found.
        value: f64,
    },

    /// Flow stresses of a table that are not positive or decrease.
    #[error(
        "point {} of the flow stress: {}; stresses are positive and do not fall from one point to the next",
        row + 1,
        show(*value, "Pa")
    )]
    FlowStress {
        /// Index of the row, from 0.
        row: usize,
        /// Flow stress found, Pa.
        value: f64,
    },
}

/// Returns `value` if it is positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, MaterialError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(MaterialError::NotPositive { quantity, value })
    }
}

/// Returns `value` if it is zero or positive and finite.
pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<f64, MaterialError> {
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(MaterialError::Negative { quantity, value })
    }
}

fn listed(names: &[&str]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
