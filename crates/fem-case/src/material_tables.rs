//! `[material.NAME]` as written.

use serde::{Deserialize, Serialize};

use crate::keyword::keywords;
use crate::quantity::{Density, Number, Quantity, Rate, Stress, Time};

/// `[material.NAME]`: density, exactly two of the four instantaneous moduli, and relaxation.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields, expecting = "a table such as [material.glass]")]
pub struct MaterialTable {
    /// Mass per volume, > 0.
    pub density: Quantity<Density>,
    /// Young's modulus E, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Quantity<Stress>>,
    /// Shear modulus G, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_modulus: Option<Quantity<Stress>>,
    /// Bulk modulus K, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bulk_modulus: Option<Quantity<Stress>>,
    /// Poisson's ratio ν, between −1 and 1/2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poissons_ratio: Option<Quantity<Number>>,
    /// Absent: elastic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relaxation: Option<RelaxationTable>,
}

/// `[material.NAME.relaxation]`: a Prony series.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields, expecting = "a table such as [material.glass.relaxation]")]
pub struct RelaxationTable {
    /// Which moduli relax.
    pub acts_on: ActsOn,
    /// One table a Prony term.
    pub terms: Vec<TermTable>,
}

keywords! {
    /// Which moduli relax.
    ActsOn {
        /// Shear and bulk modulus alike: Poisson's ratio stays constant.
        All = "all",
        /// The shear modulus; the bulk modulus stays elastic.
        Shear = "shear",
    }
}

/// A Prony term: its weight and exactly one of decay rate and relaxation time.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table such as { weight = 1.0, decay_rate = \"2708 1/s\" }"
)]
pub struct TermTable {
    /// G_k/G_0, > 0; all weights together at most 1.
    pub weight: Quantity<Number>,
    /// 1/τ_k, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decay_rate: Option<Quantity<Rate>>,
    /// τ_k, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relaxation_time: Option<Quantity<Time>>,
}
