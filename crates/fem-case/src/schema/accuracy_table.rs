//! `[accuracy]` as written.

use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::quantity::{Number, Quantity, QuantityKind};

/// `[accuracy]`: how far results may be off.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a table [accuracy]")]
pub struct AccuracyTable {
    /// One for all, or one each.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<ToleranceValue>,
}

/// `tolerance`: a share, or a table of shares.
#[derive(Clone, Debug, PartialEq)]
pub enum ToleranceValue {
    /// Of the restitution (absolute), the contact time and the peak force; three times that of the
    /// peak pressure.
    Share(Quantity<Number>),
    /// Of each.
    Table(ToleranceTable),
}

/// `tolerance = { … }`: what is left out keeps its default.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, expecting = "a share such as \"1 %\", or a table of shares")]
pub struct ToleranceTable {
    /// Tolerance of the restitution, absolute.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<Quantity<Number>>,
    /// Tolerance of the contact time, relative.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_time: Option<Quantity<Number>>,
    /// Of the peak force, relative.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_force: Option<Quantity<Number>>,
    /// Of the peak pressure, relative.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_pressure: Option<Quantity<Number>>,
}

impl Serialize for ToleranceValue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Share(share) => share.serialize(serializer),
            Self::Table(table) => table.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for ToleranceValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl<'de> serde::de::Visitor<'de> for Visitor {
            type Value = ToleranceValue;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, "{}, such as \"1 %\", or a table of such", Number::KIND.name)
            }

            fn visit_i64<E>(self, share: i64) -> Result<ToleranceValue, E> {
                Ok(ToleranceValue::Share((share as f64).into()))
            }

            fn visit_f64<E>(self, share: f64) -> Result<ToleranceValue, E> {
                Ok(ToleranceValue::Share(share.into()))
            }

            fn visit_str<E>(self, share: &str) -> Result<ToleranceValue, E> {
                Ok(ToleranceValue::Share(share.into()))
            }

            fn visit_map<A: serde::de::MapAccess<'de>>(
                self,
                map: A,
            ) -> Result<ToleranceValue, A::Error> {
                let table = ToleranceTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(ToleranceValue::Table(table))
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}
