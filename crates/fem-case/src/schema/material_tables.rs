//! `[material.NAME]` as written.

use serde::{Deserialize, Serialize};

use crate::quantity::{Density, Number, Quantity, Rate, Stress, SurfaceEnergy, Temperature, Time};
use crate::schema::flow_table::FlowTable;
use crate::schema::macros::{keywords, optional_keys};

/// `[material.NAME]`: density, exactly two of the four instantaneous moduli, and relaxation or plastic flow.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
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
    /// Yield strength in uniaxial tension, > 0. A body flows with perfect plasticity where the impact exceeds it, unless the
    /// table `flow` gives another rule.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yield_strength: Option<Quantity<Stress>>,
    /// Surface energy of one surface, > 0. It serves the estimate of adhesion and the decision whether bodies stick.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_energy: Option<Quantity<SurfaceEnergy>>,
    /// Hyperelastic law at finite strain; `"neo-hooke"` if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hyperelastic: Option<HyperelasticLaw>,
    /// Whether the material is meant to be elastic but for what this table gives: no other loss and no other strength are unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elastic: Option<bool>,
    /// A Prony series; without one the loss of the material is unknown, unless it flows or is meant to be elastic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relaxation: Option<RelaxationTable>,
    /// Plastic flow with hardening or a dependence on the strain rate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flow: Option<FlowTable>,
}

impl MaterialTable {
    /// Creates an elastic material from Young's modulus and Poisson's ratio.
    pub fn from_youngs_modulus_poissons_ratio(
        density: impl Into<Quantity<Density>>,
        youngs_modulus: impl Into<Quantity<Stress>>,
        poissons_ratio: impl Into<Quantity<Number>>,
    ) -> Self {
        Self {
            youngs_modulus: Some(youngs_modulus.into()),
            poissons_ratio: Some(poissons_ratio.into()),
            ..Self::without_moduli(density.into())
        }
    }

    /// Creates an elastic material from bulk and shear modulus.
    pub fn from_bulk_shear(
        density: impl Into<Quantity<Density>>,
        bulk_modulus: impl Into<Quantity<Stress>>,
        shear_modulus: impl Into<Quantity<Stress>>,
    ) -> Self {
        Self {
            bulk_modulus: Some(bulk_modulus.into()),
            shear_modulus: Some(shear_modulus.into()),
            ..Self::without_moduli(density.into())
        }
    }

    /// Returns this material, meant to be elastic.
    pub fn elastic(self) -> Self {
        Self { elastic: Some(true), ..self }
    }

    /// Returns this material with this Prony series; the moduli are instantaneous.
    pub fn relaxing(self, acts_on: ActsOn, terms: impl IntoIterator<Item = TermTable>) -> Self {
        Self { relaxation: Some(RelaxationTable::new(acts_on, terms)), ..self }
    }

    fn without_moduli(density: Quantity<Density>) -> Self {
        Self {
            density,
            youngs_modulus: None,
            shear_modulus: None,
            bulk_modulus: None,
            poissons_ratio: None,
            yield_strength: None,
            surface_energy: None,
            hyperelastic: None,
            elastic: None,
            relaxation: None,
            flow: None,
        }
    }
}

keywords! {
    /// The strain energy density of a solid at finite strain.
    HyperelasticLaw {
        /// G/2 (J^(−2/3) tr b − 3) + K/2 (J − 1)².
        NeoHooke = "neo-hooke",
        /// G/2 (tr b − 3) − G ln J + λ/2 ln² J.
        NeoHookeLn = "neo-hooke-ln",
        /// Hooke's law in the logarithmic strain.
        Hencky = "hencky",
        /// Hooke's law in the Green-Lagrange strain.
        SaintVenantKirchhoff = "saint-venant-kirchhoff",
    }
}

impl From<HyperelasticLaw> for fem_material::finite::HyperelasticLaw {
    fn from(law: HyperelasticLaw) -> Self {
        match law {
            HyperelasticLaw::NeoHooke => Self::NeoHooke,
            HyperelasticLaw::NeoHookeLn => Self::NeoHookeLn,
            HyperelasticLaw::Hencky => Self::Hencky,
            HyperelasticLaw::SaintVenantKirchhoff => Self::SaintVenantKirchhoff,
        }
    }
}

/// `[material.NAME.relaxation]`: a Prony series.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as [material.glass.relaxation]")]
pub struct RelaxationTable {
    /// Path of a TOML file with the other keys of this table, relative to the case; a case that was read has these keys
    /// instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The moduli that relax; required without `file`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acts_on: Option<ActsOn>,
    /// One table per Prony term; required without `file`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<TermTable>,
    /// Temperature at which the relaxation times hold, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_temperature: Option<Quantity<Temperature>>,
    /// How the relaxation times depend on the temperature; not at all if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift: Option<ShiftTable>,
    /// Frequencies at which the moduli are measured, at the reference temperature.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub band: Option<BandTable>,
    /// Young's modulus of the series at its highest frequencies, > 0, with which that of the material is compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Quantity<Stress>>,
    /// The shear modulus instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_modulus: Option<Quantity<Stress>>,
}

impl RelaxationTable {
    /// Creates a table of terms without a dependence on temperature.
    pub fn new(acts_on: ActsOn, terms: impl IntoIterator<Item = TermTable>) -> Self {
        Self {
            file: None,
            acts_on: Some(acts_on),
            terms: terms.into_iter().collect(),
            reference_temperature: None,
            shift: None,
            band: None,
            youngs_modulus: None,
            shear_modulus: None,
        }
    }
}

optional_keys! {
    /// `shift = { … }`: exactly one key.
    ShiftTable, "a table such as { wlf = { c1 = 17.4, c2 = 51.6 } }" {
        /// The law of Williams, Landel and Ferry.
        wlf: WlfTable,
        /// The law of Arrhenius.
        arrhenius: ArrheniusTable,
        /// Temperatures, rising, with log10 a_T, between which it is interpolated linearly.
        table: Vec<(Quantity<Temperature>, Quantity<Number>)>,
    }
}

/// `wlf = { … }`: log10 a_T = −C1 ΔT/(C2 + ΔT).
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { c1 = 17.4, c2 = 51.6 }")]
pub struct WlfTable {
    /// The first constant, C1.
    pub c1: Quantity<Number>,
    /// The second constant, C2, in kelvin, not 0.
    pub c2: Quantity<Number>,
}

/// `arrhenius = { … }`: ln a_T = Θ (1/T − 1/T_r).
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { activation_temperature = 12000 }")]
pub struct ArrheniusTable {
    /// Activation energy over the gas constant, Θ, in kelvin, ≥ 0.
    pub activation_temperature: Quantity<Number>,
}

/// `band = { … }`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { from = \"0.1 Hz\", to = \"100 Hz\" }")]
pub struct BandTable {
    /// The lowest frequency, > 0.
    pub from: Quantity<Rate>,
    /// The highest frequency, above the lowest.
    pub to: Quantity<Rate>,
    /// Frequencies, rising, with the standard uncertainty of the loss modulus over its value, from 0 to 1.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loss_uncertainty: Vec<(Quantity<Rate>, Quantity<Number>)>,
}

keywords! {
    /// The moduli that relax.
    ActsOn {
        /// Shear and bulk modulus relax alike: Poisson's ratio is constant.
        All = "all",
        /// The shear modulus relaxes; the bulk modulus is elastic.
        Shear = "shear",
    }
}

impl From<fem_material::ActsOn> for ActsOn {
    fn from(acts_on: fem_material::ActsOn) -> Self {
        match acts_on {
            fem_material::ActsOn::All => Self::All,
            fem_material::ActsOn::Shear => Self::Shear,
        }
    }
}

impl From<ActsOn> for fem_material::ActsOn {
    fn from(acts_on: ActsOn) -> Self {
        match acts_on {
            ActsOn::All => Self::All,
            ActsOn::Shear => Self::Shear,
        }
    }
}

/// A Prony term: its weight and exactly one of decay rate and relaxation time.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(
    deny_unknown_fields,
    expecting = "a table such as { weight = 1.0, decay_rate = \"2708 1/s\" }"
)]
pub struct TermTable {
    /// G_k/G_0, > 0; all weights together at most 1.
    pub weight: Quantity<Number>,
    /// Decay rate 1/τ_k, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decay_rate: Option<Quantity<Rate>>,
    /// Relaxation time τ_k, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relaxation_time: Option<Quantity<Time>>,
}

impl TermTable {
    /// Creates a term from g_k = G_k/G_0 and 1/τ_k.
    pub fn with_decay_rate(
        weight: impl Into<Quantity<Number>>,
        decay_rate: impl Into<Quantity<Rate>>,
    ) -> Self {
        let (weight, decay_rate) = (weight.into(), Some(decay_rate.into()));
        Self { weight, decay_rate, relaxation_time: None }
    }

    /// Creates a term from g_k = G_k/G_0 and τ_k.
    pub fn with_relaxation_time(
        weight: impl Into<Quantity<Number>>,
        relaxation_time: impl Into<Quantity<Time>>,
    ) -> Self {
        let (weight, relaxation_time) = (weight.into(), Some(relaxation_time.into()));
        Self { weight, decay_rate: None, relaxation_time }
    }
}
