//! `[model]` as written: the model of the collision and its keys.

#[cfg(all(test, feature = "schema"))]
use fem_laws::KeyRange;
use fem_laws::{EndRule, LawFamily};
use serde::{Deserialize, Serialize};

use crate::quantity::{
    Count, Damping, Number, Quantity, QuantityInfo, QuantityKind, Speed, Stiffness, Stress, Time,
    Viscosity,
};
use crate::schema::body_tables::EmptyTable;
use crate::schema::flow_table::HardeningTable;
use crate::schema::macros::{keywords, optional_keys};

optional_keys! {
    /// `[model]`: exactly one key.
    ModelTable, "a table such as [model] with fem = {}" {
        /// Explicit finite elements.
        fem: EmptyTable,
        /// Linear finite elements condensed to their contact nodes.
        condensed: CondensedTable,
        /// Quasi-static viscoelastic half-spaces (Ting).
        ting: TingTable,
        /// Quasi-static elastic half-spaces (Hertz).
        hertz: HertzTable,
        /// A contact law of one degree of freedom.
        law: LawTable,
        /// The cheapest of the other models that meets the tolerances.
        auto: EmptyTable,
    }
}

/// Constructors of models with their defaults. A table with keys becomes a model by `into()`.
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

    /// Selects explicit finite elements.
    pub fn fem() -> Self {
        Self { fem: Some(EmptyTable {}), ..Self::default() }
    }

    /// Selects the cheapest of the other models that meets the tolerances.
    pub fn auto() -> Self {
        Self { auto: Some(EmptyTable {}), ..Self::default() }
    }

    /// Selects linear finite elements condensed to their contact nodes.
    pub fn condensed() -> Self {
        CondensedTable::default().into()
    }

    /// Selects quasi-static viscoelastic half-spaces (Ting).
    pub fn ting() -> Self {
        TingTable::default().into()
    }

    /// Selects quasi-static elastic half-spaces (Hertz).
    pub fn hertz() -> Self {
        HertzTable::default().into()
    }

    /// Selects a contact law of one degree of freedom by its table.
    pub fn law(law: impl Into<LawTable>) -> Self {
        law.into().into()
    }
}

/// A table of a model as `[model]`.
macro_rules! models {
    ($($key:ident: $table:ident,)+) => {
        $(impl From<$table> for ModelTable {
            fn from(table: $table) -> Self {
                Self { $key: Some(table), ..Self::default() }
            }
        })+
    };
}

models! {
    condensed: CondensedTable,
    ting: TingTable,
    hertz: HertzTable,
    law: LawTable,
}

optional_keys! {
    /// `condensed = { … }`.
    CondensedTable, "a table such as { vibration_modes = 12 }" {
        /// Modes of free vibration of each body, 0 to 100; 0 is quasi-static.
        vibration_modes: Quantity<Count>,
        /// Steps over the elastic contact time, 50 to 100,000.
        steps: Quantity<Count>,
        /// Whether the penalty springs of model fem resist overlap; without them nothing overlaps.
        penalty_springs: bool,
    }
}

optional_keys! {
    /// `ting = { … }`.
    TingTable, "a table such as { finite_size = true }" {
        /// Whether the spheres' finite size adds to the approach.
        finite_size: bool,
        /// Accuracy of restitution, time and force, 1e-10 to 1e-2.
        tolerance: Quantity<Number>,
    }
}

optional_keys! {
    /// `hertz = { … }`.
    HertzTable, "a table such as { finite_size = true }" {
        /// Whether the spheres' finite size adds to the approach.
        finite_size: bool,
    }
}

keywords! {
    /// The end of a contact with a law.
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

/// Makes, from the table of contact laws, one table per law, with `end` and `tolerance` in each, and the
/// table `law` around them.
macro_rules! law_tables {
    ($(
        $(#[$doc:meta])*
        $variant:ident, $law:ident, $table:ident, $example:literal;
        formula($pair:ident, [$($value:ident),*]) = $formula:expr;
        given by $([$($set_key:ident $(: $need:expr)?),*])+ $(, values $values:path)?;
        $(ends at $ends:ident;)?
        keys { $($(#[$key_doc:meta])* $key:ident: $kind:ident, $range:ident $(, $role:expr)?;)* }
    )+) => {
        $(
            $(#[$doc])*
            #[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
            #[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
            #[serde(deny_unknown_fields, expecting = $example)]
            pub struct $table {
                $(
                    $(#[$key_doc])*
                    #[serde(skip_serializing_if = "Option::is_none")]
                    pub $key: Option<Quantity<$kind>>,
                )*
                /// The end of the contact.
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

        /// `law = { NAME = { … } }`: exactly one law; `end` and `tolerance` may stand next to it.
        #[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
        #[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
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
            /// The end of the contact.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub end: Option<End>,
            /// Accuracy of restitution, time and force, 1e-10 to 1e-2.
            #[serde(skip_serializing_if = "Option::is_none")]
            pub tolerance: Option<Quantity<Number>>,
        }

        impl LawTable {
            /// The names of all laws.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($law),)+];

            /// All number keys of all laws.
            pub(crate) const KEYS: &'static [LawKey] = &[$($(LawKey {
                family: LawFamily::$variant,
                #[cfg(all(test, feature = "schema"))]
                table: stringify!($table),
                key: stringify!($key),
                kind: <$kind>::INFO,
                #[cfg(all(test, feature = "schema"))]
                range: KeyRange::$range,
            },)*)+];

            /// Returns the laws that are given.
            pub(crate) fn families(&self) -> Vec<LawFamily> {
                let mut given = Vec::new();
                $(if self.$law.is_some() { given.push(LawFamily::$variant) })+
                given
            }

            /// Returns the names of the laws that are given.
            pub fn given(&self) -> Vec<&'static str> {
                self.families().into_iter().map(LawFamily::name).collect()
            }

            /// Returns `end` and `tolerance` of the law that is given.
            pub(crate) fn inner(&self) -> (Option<End>, Option<&Quantity<Number>>) {
                $(if let Some(table) = &self.$law { return (table.end, table.tolerance.as_ref()) })+
                (None, None)
            }

            /// Returns this law with `end` and `tolerance` in its own table.
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

fem_laws::contact_laws!(law_tables);

/// One key of one law.
pub(crate) struct LawKey {
    pub family: LawFamily,
    /// The type of the law's table.
    #[cfg(all(test, feature = "schema"))]
    pub table: &'static str,
    pub key: &'static str,
    pub kind: QuantityInfo,
    #[cfg(all(test, feature = "schema"))]
    pub range: KeyRange,
}

/// A table that chooses one of its keys.
pub(crate) struct Choice {
    /// The keys that exclude each other; any key if empty.
    exclusive: &'static [&'static str],
    /// Names that stand for the table of this name with its defaults: `"ting"` for `{ ting = {} }`.
    pub names: &'static [&'static str],
}

/// Returns the choice at a path of keys, if there is one.
pub(crate) fn choice_at(path: &[&str]) -> Option<Choice> {
    let choice = |exclusive, names| Some(Choice { exclusive, names });
    match path {
        ["model"] => choice(&[], ModelTable::NAMES),
        ["model", "law"] => choice(LawTable::NAMES, LawTable::NAMES),
        ["material", _, "flow", "hardening"] => choice(&[], HardeningTable::NAMES),
        _ => None,
    }
}

impl Choice {
    /// Returns whether the table may have only one of these two keys, so that an override with one replaces the other.
    pub fn is_between(&self, key: &str, other: &str) -> bool {
        let is_exclusive = |key| self.exclusive.is_empty() || self.exclusive.contains(&key);
        key != other && is_exclusive(key) && is_exclusive(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fitted parameter can be written into a case: it has the unit of its key.
    #[test]
    fn parameters_have_the_units_of_their_keys() {
        for LawKey { family, key, kind, .. } in LawTable::KEYS {
            let mut parameters = family.parameters().iter();
            let Some(parameter) = parameters.find(|parameter| parameter.key == *key) else {
                continue;
            };
            let [m, kg, s] = parameter.dimension;
            assert_eq!(kind.dimension.0, [m, kg, s, 0], "{family:?} {parameter:?}");
            assert!(kind.si == parameter.unit || kind.si.is_empty(), "{parameter:?}");
        }
    }

    /// Every key belongs to a set of keys, and every set is of keys that the law has.
    #[test]
    fn law_key_sets_contain_every_key_of_the_law() {
        for family in LawFamily::ALL {
            let keys = LawTable::KEYS.iter().filter(|key| key.family == family);
            let keys: Vec<_> = keys.map(|key| key.key).collect();
            let sets = family.key_sets().iter().flat_map(|set| set.iter().map(|(key, _)| *key));
            let mut sets: Vec<_> = sets.collect();
            sets.sort_by_key(|key| keys.iter().position(|own| own == key));
            sets.dedup();
            assert_eq!(sets, keys, "{family:?}");
        }
    }
}
