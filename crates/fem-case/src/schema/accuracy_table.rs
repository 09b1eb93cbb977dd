//! `[accuracy]` as written.

use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::quantity::{Number, Quantity, QuantityKind};
use crate::schema::macros::optional_keys;

optional_keys! {
    /// `[accuracy]`: the tolerances of the results.
    AccuracyTable, "a table [accuracy]" {
        /// One tolerance for all results, or one per result.
        tolerance: ToleranceValue,
    }
}

/// `tolerance`: one number, or a table of numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum ToleranceValue {
    /// The tolerance of the restitution (absolute), the contact time and the peak force (relative); that of the peak
    /// pressure is three times as large.
    Share(Quantity<Number>),
    /// A tolerance for each result.
    Table(ToleranceTable),
}

optional_keys! {
    /// `tolerance = { … }`: absent keys have their default.
    ToleranceTable, "a number such as \"1 %\", or a table of such numbers" {
        /// Tolerance of the restitution, absolute.
        restitution: Quantity<Number>,
        /// Tolerance of the contact time, relative.
        contact_time: Quantity<Number>,
        /// Tolerance of the peak force, relative.
        peak_force: Quantity<Number>,
        /// Tolerance of the peak pressure, relative.
        peak_pressure: Quantity<Number>,
    }
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
                write!(f, "{}, such as \"1 %\", or a table of such numbers", Number::INFO.name)
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
