//! `[model]` as written: which model computes the collision, and its keys.

use fem_laws::EndRule;
use serde::{Deserialize, Serialize};

use crate::empty_table::EmptyTable;
use crate::keyword::keywords;
use crate::quantity::{Count, Damping, Number, Quantity, Speed, Stiffness, Time, Viscosity};
#[cfg(test)]
use crate::quantity::{Kind, QuantityKind};

/// `[model]`: exactly one key.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as [model] with fem = {}")]
pub struct ModelTable {
    /// Explicit finite elements.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fem: Option<EmptyTable>,
    /// Linear bodies condensed to their contact nodes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub condensed: Option<CondensedTable>,
    /// Quasi-static viscoelastic half-space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ting: Option<TingTable>,
    /// Quasi-static elastic half-space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hertz: Option<HertzTable>,
    /// A contact law of one degree of freedom.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<LawTable>,
    /// The cheapest that serves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub auto: Option<EmptyTable>,
}

/// Models with their defaults. A table with keys becomes a model by `into()`.
///
/// ```
/// use fem_case::schema::{CondensedTable, KuwabaraKonoTable, ModelTable};
///
/// let quasi_static = ModelTable::condensed();
/// let vibrating: ModelTable =
///     CondensedTable { vibration_modes: Some(12.into()), ..Default::default() }.into();
/// let law =
///     ModelTable::law(KuwabaraKonoTable { a: Some("1 us".into()), ..Default::default() });
/// # assert!(quasi_static.condensed.is_some() && vibrating.condensed.is_some());
/// # assert_eq!(law.law.unwrap().given(), ["kuwabara_kono"]);
/// ```
impl ModelTable {
    /// The names of models that need no key.
    pub const NAMES: &'static [&'static str] = &["fem", "condensed", "ting", "hertz", "auto"];

    /// Explicit finite elements.
    pub fn fem() -> Self {
        Self { fem: Some(EmptyTable {}), ..Self::default() }
    }

    /// The cheapest that serves.
    pub fn auto() -> Self {
        Self { auto: Some(EmptyTable {}), ..Self::default() }
    }

    /// Linear bodies condensed to their contact nodes.
    pub fn condensed() -> Self {
        CondensedTable::default().into()
    }

    /// Quasi-static viscoelastic half-space.
    pub fn ting() -> Self {
        TingTable::default().into()
    }

    /// Quasi-static elastic half-space.
    pub fn hertz() -> Self {
        HertzTable::default().into()
    }

    /// A contact law of one degree of freedom, by its table.
    pub fn law(law: impl Into<LawTable>) -> Self {
        law.into().into()
    }
}

impl From<CondensedTable> for ModelTable {
    fn from(table: CondensedTable) -> Self {
        Self { condensed: Some(table), ..Self::default() }
    }
}

impl From<TingTable> for ModelTable {
    fn from(table: TingTable) -> Self {
        Self { ting: Some(table), ..Self::default() }
    }
}

impl From<HertzTable> for ModelTable {
    fn from(table: HertzTable) -> Self {
        Self { hertz: Some(table), ..Self::default() }
    }
}

impl From<LawTable> for ModelTable {
    fn from(table: LawTable) -> Self {
        Self { law: Some(table), ..Self::default() }
    }
}

/// `condensed = { … }`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { vibration_modes = 12 }")]
pub struct CondensedTable {
    /// Modes of free vibration of each body, 0 to 100; 0 is quasi-static.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vibration_modes: Option<Quantity<Count>>,
    /// Steps over the elastic contact time, 50 to 100,000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<Quantity<Count>>,
    /// Whether the penalty springs of model fem resist overlap; false: nothing overlaps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub penalty_springs: Option<bool>,
}

/// `ting = { … }`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { finite_size = true }")]
pub struct TingTable {
    /// Whether the spheres' finite size adds to the approach.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finite_size: Option<bool>,
    /// Accuracy of restitution, time and force, 1e-10 to 1e-2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Quantity<Number>>,
}

/// `hertz = { … }`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { finite_size = true }")]
pub struct HertzTable {
    /// Whether the spheres' finite size adds to the approach.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finite_size: Option<bool>,
}

keywords! {
    /// When a contact with a law is over.
    End {
        /// The force falls to zero: the surfaces cannot pull.
        ZeroForce = "zero_force",
        /// The overlap falls to zero; until then the dashpot may pull.
        ZeroOverlap = "zero_overlap",
    }
}

impl From<EndRule> for End {
    fn from(rule: EndRule) -> Self {
        match rule {
            EndRule::ZeroForce => Self::ZeroForce,
            EndRule::ZeroOverlap => Self::ZeroOverlap,
        }
    }
}

impl From<End> for EndRule {
    fn from(end: End) -> Self {
        match end {
            End::ZeroForce => Self::ZeroForce,
            End::ZeroOverlap => Self::ZeroOverlap,
        }
    }
}

/// One table a law, `end` and `tolerance` in each, and the table `law` around them.
macro_rules! law_tables {
    ($(
        $(#[$doc:meta])*
        $law:ident: $table:ident = $example:literal {
            $($(#[$key_doc:meta])* $key:ident: $kind:ty,)*
        }
    )+) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
            #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
            #[serde(deny_unknown_fields, expecting = $example)]
            pub struct $table {
                $(
                    $(#[$key_doc])*
                    #[serde(skip_serializing_if = "Option::is_none")]
                    pub $key: Option<Quantity<$kind>>,
                )*
                /// When the contact is over.
                #[serde(skip_serializing_if = "Option::is_none")]
                pub end: Option<End>,
                /// Accuracy of restitution, time and force, 1e-10 to 1e-2.
                #[serde(skip_serializing_if = "Option::is_none")]
                pub tolerance: Option<Quantity<Number>>,
            }

            impl From<$table> for LawTable {
                fn from(table: $table) -> Self {
                    Self { $law: Some(table), ..Self::default() }
                }
            }
        )+

        /// `law = { NAME = { … } }`: exactly one law; `end` and `tolerance` may stand beside it.
        #[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[serde(
            deny_unknown_fields,
            expecting = "a table such as { kuwabara_kono = { a = \"1e-6 s\" } }"
        )]
        pub struct LawTable {
            $(
                $(#[$doc])*
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $law: Option<$table>,
            )+
            /// When the contact is over.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub end: Option<End>,
            /// Accuracy of restitution, time and force, 1e-10 to 1e-2.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub tolerance: Option<Quantity<Number>>,
        }

        impl LawTable {
            /// The names of all laws.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($law),)+];

            /// Law, key and kind of every number.
            #[cfg(test)]
            const KEYS: &'static [(&'static str, &'static str, Kind)] =
                &[$($((stringify!($law), stringify!($key), <$kind>::KIND),)*)+];

            /// The names of the laws that are given.
            pub fn given(&self) -> Vec<&'static str> {
                let mut given = Vec::new();
                $(if self.$law.is_some() { given.push(stringify!($law)) })+
                given
            }

            /// `end` and `tolerance` of the law that is given.
            pub(crate) fn inner(&self) -> (Option<End>, Option<&Quantity<Number>>) {
                $(if let Some(table) = &self.$law { return (table.end, table.tolerance.as_ref()) })+
                (None, None)
            }

            /// This law with `end` and `tolerance` in its own table.
            #[must_use]
            pub fn filled(mut self, end: End, tolerance: f64) -> Self {
                (self.end, self.tolerance) = (None, None);
                $(if let Some(table) = &mut self.$law {
                    table.end = Some(end);
                    table.tolerance = Some(Quantity::from_si(tolerance));
                })+
                self
            }
        }
    };
}

law_tables! {
    /// F = k ξ + c ξ̇.
    linear: LinearTable = "a table such as { k = \"1e7 N/m\", c = \"30 N s/m\" }" {
        /// Stiffness, > 0; with `c`.
        k: Stiffness,
        /// Damping, ≥ 0; 0 if absent.
        c: Damping,
        /// Restitution, > 0 and ≤ 1; with `contact_time`, in place of `k` and `c`.
        e: Number,
        /// > 0.
        contact_time: Time,
    }
    /// F = k ξ^gamma + c ξ^n ξ̇.
    power: PowerTable = "a table such as { k = 3e9, gamma = 1.5, c = 1e4, n = 0.5 }" {
        /// Stiffness, N/m^gamma, > 0.
        k: Number,
        /// Exponent of the spring, > 0.
        gamma: Number,
        /// Damping, N s/m^(n+1), ≥ 0; 0 if absent.
        c: Number,
        /// Exponent of the dashpot, ≥ 0; wanted with `c`.
        n: Number,
    }
    /// Hertz' spring without a dashpot, integrated as a law.
    hertz: HertzLawTable = "a table such as {}" {}
    /// Hertz' spring with the damping of a Kelvin solid.
    kuwabara_kono: KuwabaraKonoTable = "a table such as { a = \"1e-6 s\" }" {
        /// Dissipation time A, ≥ 0; absent: from `eta_1` and `eta_2`, or else from the materials.
        a: Time,
        /// Viscosity in shear, ≥ 0; with `eta_2`.
        eta_1: Viscosity,
        /// Viscosity in compression, ≥ 0.
        eta_2: Viscosity,
    }
    /// Hertz' spring with damping in proportion to its force.
    hunt_crossley: HuntCrossleyTable = "a table such as { e = 0.9 }" {
        /// Restitution wanted, > 0 and ≤ 1.
        e: Number,
        /// Approach speed at which it is wanted, > 0; the case's if absent.
        v: Speed,
    }
    /// Hertz' spring with a restitution independent of speed.
    tsuji: TsujiTable = "a table such as { e = 0.9 }" {
        /// Restitution wanted, > 0 and ≤ 1, under the law's `end`.
        e: Number,
        /// Damping coefficient α, ≥ 0, in place of `e`.
        alpha: Number,
    }
    /// The law of `tsuji` for a contact that ends at zero force.
    zhang_whiten: ZhangWhitenTable = "a table such as { e = 0.9 }" {
        /// Restitution wanted, > 0 and ≤ 1.
        e: Number,
        /// Damping coefficient α, ≥ 0, in place of `e`.
        alpha: Number,
    }
    /// Hertz' spring with the damping c ξ^(1/4) ξ̇.
    falcon: FalconTable = "a table such as { c = 500 }" {
        /// Damping, N s/m^(5/4), ≥ 0.
        c: Number,
    }
    /// F = k ξ^(8/5) + c ξ^(4/5) ξ̇.
    mishra_murty: MishraMurtyTable = "a table such as { k = 1e10, c = 1e5 }" {
        /// Stiffness, N/m^(8/5), > 0.
        k: Number,
        /// Damping, N s/m^(9/5), ≥ 0.
        c: Number,
    }
    /// Kelvin's damping from the viscosities of the material.
    schwager_poeschel: SchwagerPoeschelTable = "a table such as { a = \"1e-6 s\" }" {
        /// Normal damping C_n, ≥ 0; or `eta_1` and `eta_2`.
        a: Time,
        /// Viscosity in shear, > 0; with `eta_2`.
        eta_1: Viscosity,
        /// Viscosity in compression, > 0.
        eta_2: Viscosity,
    }
    /// Hertz' spring with a damping of the spring's own form.
    morgado_oppenheim: MorgadoOppenheimTable =
        "a table such as { eta_1 = \"1e4 Pa s\", eta_2 = 0.2 }" {
        /// Viscoelastic coefficient in place of E, ≥ 0.
        eta_1: Viscosity,
        /// Viscoelastic coefficient in place of ν, between −1 and 1.
        eta_2: Number,
    }
    /// Hertz' spring with the damping 2 A E* R*^(1−n) ξ^n ξ̇.
    bordbar_hyppanen: BordbarHyppanenTable = "a table such as { a = \"1e-6 s\", n = 0.65 }" {
        /// Dissipation time A, ≥ 0.
        a: Time,
        /// Exponent of the dashpot, ≥ 0.
        n: Number,
    }
}

/// Whether a table holds at most one of these two keys, so that an override with the one takes the
/// place of the other.
pub(crate) fn exclude_each_other(table: &[&str], key: &str, other: &str) -> bool {
    let is_law = |key| LawTable::NAMES.contains(&key);
    match table {
        ["model"] => key != other,
        ["model", "law"] => key != other && is_law(key) && is_law(other),
        _ => false,
    }
}

/// Whether a name stands for the table of this name, with its defaults, at this path.
pub(crate) fn is_choice(path: &[&str], name: &str) -> bool {
    match path {
        ["model"] => ModelTable::NAMES.contains(&name),
        ["model", "law"] => LawTable::NAMES.contains(&name),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use fem_laws::LawFamily;

    use super::*;

    /// What a fit prints can be written into a case: every law, every key, in the same unit.
    #[test]
    fn tables_are_those_of_the_families() {
        let families = || LawFamily::ALL.into_iter().filter(|family| *family != LawFamily::Ting);
        assert_eq!(families().map(LawFamily::name).collect::<Vec<_>>(), LawTable::NAMES);
        for family in families() {
            for parameter in family.parameters() {
                let is_it =
                    |key: &&(&str, &str, Kind)| (key.0, key.1) == (family.name(), parameter.key);
                let found = LawTable::KEYS.iter().find(is_it);
                let (_, _, kind) = found.unwrap_or_else(|| panic!("{family:?} {parameter:?}"));
                let [m, kg, s] = parameter.dimension;
                assert_eq!(kind.dimension.0, [m, kg, s, 0], "{family:?} {parameter:?}");
                assert!(kind.si == parameter.unit || kind.si.is_empty(), "{parameter:?}");
            }
        }
    }
}
