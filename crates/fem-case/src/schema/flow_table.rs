//! `[material.NAME.flow]` as written.

use serde::{Deserialize, Serialize};

use crate::quantity::{Number, Quantity, Rate, Stress};
use crate::schema::body_tables::EmptyTable;
use crate::schema::macros::optional_keys;

optional_keys! {
    /// `[material.NAME.flow]`: plastic flow with von Mises' yield condition and isotropic hardening.
    FlowTable, "a table such as [material.steel.flow]" {
        /// Yield strength, true stress in uniaxial tension at first yield, > 0; that of the material if absent.
        yield_strength: Quantity<Stress>,
        /// Flow stress over plastic strain; perfect plasticity if absent.
        hardening: HardeningTable,
        /// Flow stress over the rate of plastic strain; independent of it if absent.
        rate: RateTable,
    }
}

optional_keys! {
    /// `hardening = { … }`: exactly one key, or its name for `"perfect"`.
    HardeningTable, "\"perfect\", { modulus = \"2 GPa\" }, { swift = { strain = 0.002, exponent = 0.2 } } or { table = \"flow.csv\" }" {
        /// The flow stress does not depend on plastic strain.
        perfect: EmptyTable,
        /// Slope of the flow stress over plastic strain, >= 0.
        modulus: Quantity<Stress>,
        /// Swift's power law.
        swift: SwiftTable,
        /// Points of flow stress over plastic strain.
        table: FlowPoints,
    }
}

impl HardeningTable {
    /// The names of hardening that need no key.
    pub const NAMES: &'static [&'static str] = &["perfect"];
    /// The keys, of which one is given.
    pub const KEYS: &'static [&'static str] = &["perfect", "modulus", "swift", "table"];

    /// Returns the keys that are given.
    pub(crate) fn given(&self) -> Vec<&'static str> {
        let is_given = [
            self.perfect.is_some(),
            self.modulus.is_some(),
            self.swift.is_some(),
            self.table.is_some(),
        ];
        Self::KEYS.iter().copied().zip(is_given).filter_map(|(key, is)| is.then_some(key)).collect()
    }
}

/// `swift = { … }`: the flow stress Y (1 + ε/ε_s)ⁿ.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table such as { strain = 0.002, exponent = 0.2 }")]
pub struct SwiftTable {
    /// Reference strain ε_s, > 0.
    pub strain: Quantity<Number>,
    /// Exponent n, above 0 and at most 1.
    pub exponent: Quantity<Number>,
}

/// `rate = { … }`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(
    deny_unknown_fields,
    expecting = "a table such as { johnson_cook = { c = 0.014, reference_rate = \"1 1/s\" } }"
)]
pub struct RateTable {
    /// Johnson and Cook's factor 1 + C ln(ε̇/ε̇₀) above the reference rate.
    pub johnson_cook: JohnsonCookTable,
}

/// `johnson_cook = { … }`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[cfg_attr(all(test, feature = "schema"), derive(schemars::JsonSchema))]
#[serde(
    deny_unknown_fields,
    expecting = "a table such as { c = 0.014, reference_rate = \"1 1/s\" }"
)]
pub struct JohnsonCookTable {
    /// Coefficient C, >= 0.
    pub c: Quantity<Number>,
    /// Rate ε̇₀ at and below which the flow stress is that of the hardening, > 0.
    pub reference_rate: Quantity<Rate>,
}

/// `table = …`: points of flow stress over plastic strain, as rows or as the path of a CSV file.
#[derive(Clone, Debug, PartialEq)]
pub enum FlowPoints {
    /// Path of a CSV file, relative to the case; a case that was read has its rows instead.
    File(String),
    /// Plastic strain and flow stress.
    Rows(Vec<(Quantity<Number>, Quantity<Stress>)>),
}

impl Serialize for FlowPoints {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::File(path) => serializer.serialize_str(path),
            Self::Rows(rows) => rows.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for FlowPoints {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> serde::de::Visitor<'de> for Visitor {
            type Value = FlowPoints;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(
                    f,
                    "a list of plastic strains and flow stresses, [[0, \"235 MPa\"], [0.1, \"350 MPa\"]], or the path of a \
                     CSV file"
                )
            }

            fn visit_str<E>(self, path: &str) -> Result<FlowPoints, E> {
                Ok(FlowPoints::File(path.to_string()))
            }

            fn visit_seq<A: serde::de::SeqAccess<'de>>(
                self,
                mut sequence: A,
            ) -> Result<FlowPoints, A::Error> {
                let mut rows = Vec::new();
                while let Some(row) = sequence.next_element()? {
                    rows.push(row);
                }
                Ok(FlowPoints::Rows(rows))
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}
