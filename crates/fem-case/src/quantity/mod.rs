//! A quantity of a known kind (a length, a rate, …) as a case file gives it: a bare SI number or a string with a unit. The
//! kind is a type parameter only here; scenes use `f64`.

pub(crate) mod range;
pub(crate) mod uncertain;
pub(crate) mod unit_table;
pub(crate) mod units;

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error as _, MapAccess, Visitor};
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use crate::quantity::units::{Dimension, UnitError};

/// Name, dimension and notation of a kind of quantity.
#[derive(Clone, Copy, Debug)]
pub struct QuantityInfo {
    /// The name with its article: "a length".
    pub name: &'static str,
    /// The exponents of metre, kilogram, second and byte.
    pub dimension: Dimension,
    /// The SI unit of a bare number: "m".
    pub si: &'static str,
    /// An example as in a case file, with quotes if it needs them: `"22.2 mm"`.
    pub example: &'static str,
    /// Whether it is a count, which is shown and written without a decimal point.
    pub is_count: bool,
}

/// A type that stands for a kind of quantity.
pub trait QuantityKind {
    /// Name, dimension and notation of the kind.
    const INFO: QuantityInfo;
}

macro_rules! kinds {
    ($($marker:ident, $name:literal, $dimension:expr, $si:literal, $example:literal;)+) => {
        $(
            #[doc = concat!("Marks ", $name, ", such as ", $example, ".")]
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum $marker {}

            impl QuantityKind for $marker {
                const INFO: QuantityInfo = QuantityInfo {
                    name: $name,
                    dimension: Dimension($dimension),
                    si: $si,
                    example: $example,
                    is_count: false,
                };
            }
        )+

        /// The dimensions that have a name; those of a case file come first.
        const NAMED: &[(&str, [i32; 4])] = &[
            $(($name, $dimension),)+
            ("an area", [2, 0, 0, 0]),
            ("a volume", [3, 0, 0, 0]),
            ("a force", [1, 1, -2, 0]),
            ("an energy", [2, 1, -2, 0]),
            ("a power", [2, 1, -3, 0]),
        ];
    };
}

kinds! {
    Number, "a plain number", [0, 0, 0, 0], "", "0.2";
    Length, "a length", [1, 0, 0, 0], "m", "\"22.2 mm\"";
    Mass, "a mass", [0, 1, 0, 0], "kg", "\"10 g\"";
    Speed, "a speed", [1, 0, -1, 0], "m/s", "\"0.5 m/s\"";
    Acceleration, "an acceleration", [1, 0, -2, 0], "m/s^2", "\"9.81 m/s^2\"";
    Density, "a density", [-3, 1, 0, 0], "kg/m^3", "\"2390 kg/m^3\"";
    Stress, "a pressure", [-1, 1, -2, 0], "Pa", "\"63 GPa\"";
    Time, "a time", [0, 0, 1, 0], "s", "\"10 us\"";
    Stiffness, "a stiffness", [0, 1, -2, 0], "N/m", "\"1e7 N/m\"";
    SurfaceEnergy, "a surface energy", [0, 1, -2, 0], "J/m^2", "\"50 mJ/m^2\"";
    Damping, "a damping coefficient", [0, 1, -1, 0], "N s/m", "\"30 N s/m\"";
    Viscosity, "a viscosity", [-1, 1, -1, 0], "Pa s", "\"1e4 Pa s\"";
    Rate, "a rate", [0, 0, -1, 0], "1/s", "\"2708 1/s\"";
    Angle, "an angle", [0, 0, 0, 0], "rad", "\"30 deg\"";
    Bytes, "an amount of memory", [0, 0, 0, 1], "bytes", "\"8 GB\"";
    Temperature, "a temperature", [0, 0, 0, 0], "K", "\"23 degC\"";
}

/// Marks a whole number, such as 12.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {}

impl QuantityKind for Count {
    const INFO: QuantityInfo =
        QuantityInfo { name: "a whole number", example: "12", is_count: true, ..Number::INFO };
}

/// The largest count: above it `f64` does not represent all whole numbers.
const MAX_COUNT: f64 = 9e15;

/// Returns the name of a dimension: "a length", or "in kg m^2" if it has none.
fn name_dimension(dimension: Dimension) -> String {
    if let Some((name, _)) = NAMED.iter().find(|(_, known)| *known == dimension.0) {
        return name.to_string();
    }
    let symbols = ["m", "kg", "s", "B"].into_iter().zip(dimension.0);
    let factors = symbols.filter(|(_, exponent)| *exponent != 0).map(|(symbol, exponent)| {
        if exponent == 1 { symbol.to_string() } else { format!("{symbol}^{exponent}") }
    });
    format!("in {}", factors.collect::<Vec<_>>().join(" "))
}

/// The reason why a quantity has no SI value.
#[derive(Clone, Debug, PartialEq)]
pub enum QuantityError {
    /// The number is `nan`, `inf` or `-inf`.
    NotFinite(f64),
    /// The text is not a number with a known unit.
    Unit(UnitError),
    /// The unit has another dimension.
    WrongDimension(Dimension),
}

/// A quantity as written.
#[derive(Clone, Debug, PartialEq)]
enum Written {
    Si(f64),
    Text(String),
}

/// A quantity of kind `K` as a case file gives it. [`Quantity::si`] converts it. It serializes as a bare SI number, as a
/// table of value and uncertainty if it has one, or as its text if that has no SI value.
///
/// ```
/// use fem_case::{Count, Length, Quantity};
///
/// assert_eq!(Quantity::<Length>::from("22.2 mm").si(), Ok(0.0222));
/// assert_eq!(Quantity::<Length>::from(0.0222).si(), Ok(0.0222));
/// assert_eq!(Quantity::<Count>::from(12).si(), Ok(12.0));
/// assert_eq!(Quantity::<Length>::from("20 ± 0.1 mm").measured(), Ok((0.02, Some(1e-4))));
/// ```
#[derive(Clone, PartialEq)]
pub struct Quantity<K> {
    written: Written,
    kind: PhantomData<K>,
}

impl<K: QuantityKind> Quantity<K> {
    /// Creates a quantity from a value in SI units.
    pub fn from_si(value: f64) -> Self {
        Quantity { written: Written::Si(value), kind: PhantomData }
    }

    /// Creates a quantity from a number with its unit, as in a case file. Only [`Quantity::si`] checks it.
    pub fn from_text(text: &str) -> Self {
        Quantity { written: Written::Text(text.to_string()), kind: PhantomData }
    }

    /// Returns the value in SI units, which is finite.
    ///
    /// # Errors
    /// The number is not finite, the text is not a number with a unit, or the unit has another dimension.
    pub fn si(&self) -> Result<f64, QuantityError> {
        self.measured().map(|(value, _)| value)
    }

    /// Returns the value in SI units and its uncertainty, ≥ 0, if it is written with one: `"70 ± 2 GPa"`.
    ///
    /// # Errors
    /// Those of [`Quantity::si`].
    pub fn measured(&self) -> Result<(f64, Option<f64>), QuantityError> {
        match &self.written {
            Written::Si(value) if value.is_finite() => Ok((*value, None)),
            Written::Si(value) => Err(QuantityError::NotFinite(*value)),
            // A scale of temperature has an offset.
            Written::Text(text) if K::INFO.si == "K" => {
                uncertain::parse_uncertain_temperature(text).ok_or_else(|| {
                    let message = "its scale is degC, K or degF, above absolute zero";
                    QuantityError::Unit(UnitError::Malformed(message.to_string()))
                })
            }
            Written::Text(text) => match uncertain::parse(text) {
                Ok((value, uncertainty, found)) if found == K::INFO.dimension => {
                    Ok((value, uncertainty))
                }
                Ok((.., dimension)) => Err(QuantityError::WrongDimension(dimension)),
                Err(error) => Err(QuantityError::Unit(error)),
            },
        }
    }

    /// Returns the value of a count that is a whole number.
    fn whole(value: f64) -> Option<i64> {
        let is_whole = value.fract() == 0.0 && value.abs() <= MAX_COUNT;
        (K::INFO.is_count && is_whole).then_some(value as i64)
    }

    /// Returns the text, if the quantity was written as a string.
    pub fn text(&self) -> Option<&str> {
        match &self.written {
            Written::Si(_) => None,
            Written::Text(text) => Some(text),
        }
    }

    /// Returns message and help for an error of [`Quantity::si`] at this key.
    pub(crate) fn explain(&self, error: &QuantityError, key: &str) -> (String, String) {
        let QuantityInfo { name, si, example, is_count, .. } = K::INFO;
        let bare = match si {
            _ if is_count => format!("write {name}, such as {example}"),
            "" => format!("write a number, such as {example} or \"20 %\""),
            si => format!("write {name} with its unit, {example}, or a bare number in {si}"),
        };
        match error {
            QuantityError::NotFinite(_) => (format!("{key} is {self}, which is not finite"), bare),
            QuantityError::WrongDimension(found) => {
                let found = match found.0 {
                    [0, 0, 0, 0] => "has no unit".to_string(),
                    _ => format!("is {}", name_dimension(*found)),
                };
                let message = format!("{key} must be {name}, such as {example}; {self} {found}");
                (message, bare)
            }
            QuantityError::Unit(UnitError::UnknownUnit { symbol, suggestion }) => {
                let message = format!("unknown unit `{symbol}` in {self}; {key} must be {name}");
                match suggestion {
                    Some(near) => (message, format!("did you mean `{near}`? {bare}")),
                    None => (message, bare),
                }
            }
            QuantityError::Unit(error) => {
                (format!("{key} is {self}, which is not {name}: {error}"), bare)
            }
        }
    }
}

/// Converts a value in SI units: `0.0222`.
impl<K: QuantityKind> From<f64> for Quantity<K> {
    fn from(value: f64) -> Self {
        Self::from_si(value)
    }
}

/// Converts a number with its unit: `"22.2 mm"`.
impl<K: QuantityKind> From<&str> for Quantity<K> {
    fn from(text: &str) -> Self {
        Self::from_text(text)
    }
}

/// Converts a whole number: `12`.
impl From<u32> for Quantity<Count> {
    fn from(count: u32) -> Self {
        Self::from_si(f64::from(count))
    }
}

impl<K: QuantityKind> fmt::Display for Quantity<K> {
    /// Writes the quantity as written: `"22.2 mm"` with its quotes, or the number with its SI unit.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.written {
            Written::Text(text) => write!(f, "\"{text}\""),
            Written::Si(value) => match (Self::whole(*value), K::INFO.si) {
                (Some(count), _) => write!(f, "{count}"),
                (None, "") => write!(f, "{value:?}"),
                (None, si) => write!(f, "{value:?} {si}"),
            },
        }
    }
}

impl<K: QuantityKind> fmt::Debug for Quantity<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Serializes as a new type with the name of the SI unit, which most serializers ignore.
impl<K: QuantityKind> Serialize for Quantity<K> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match (self.measured(), &self.written) {
            (Ok((value, Some(uncertainty))), _) => {
                let mut table = serializer.serialize_struct("uncertain", 2)?;
                table.serialize_field("value", &InUnit(K::INFO.si, value))?;
                table.serialize_field("uncertainty", &InUnit(K::INFO.si, uncertainty))?;
                table.end()
            }
            (Ok((value, None)), _) | (Err(_), &Written::Si(value)) => match Self::whole(value) {
                Some(count) => serializer.serialize_newtype_struct(K::INFO.si, &count),
                None => serializer.serialize_newtype_struct(K::INFO.si, &value),
            },
            (Err(_), Written::Text(text)) => serializer.serialize_str(text),
        }
    }
}

/// A number in SI, serialized as a new type with the name of its unit.
struct InUnit(&'static str, f64);

impl Serialize for InUnit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_newtype_struct(self.0, &self.1)
    }
}

impl<'de, K: QuantityKind> Deserialize<'de> for Quantity<K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WrittenVisitor<K>(PhantomData<K>);
        impl<'de, K: QuantityKind> Visitor<'de> for WrittenVisitor<K> {
            type Value = Written;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{}, such as {}", K::INFO.name, K::INFO.example)
            }

            fn visit_i64<E>(self, value: i64) -> Result<Written, E> {
                Ok(Written::Si(value as f64))
            }

            fn visit_u64<E>(self, value: u64) -> Result<Written, E> {
                Ok(Written::Si(value as f64))
            }

            fn visit_f64<E>(self, value: f64) -> Result<Written, E> {
                Ok(Written::Si(value))
            }

            fn visit_str<E>(self, text: &str) -> Result<Written, E> {
                Ok(Written::Text(text.to_string()))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Written, A::Error> {
                const KEYS: [&str; 2] = ["value", "uncertainty"];
                let mut parts = [None, None];
                while let Some(key) = map.next_key::<String>()? {
                    let place = KEYS.iter().position(|known| *known == key);
                    let place = place.ok_or_else(|| A::Error::unknown_field(&key, &KEYS))?;
                    parts[place] = Some(match map.next_value::<Quantity<K>>()?.written {
                        Written::Si(value) => format!("{value:?} {}", K::INFO.si),
                        Written::Text(text) => text,
                    });
                }
                let [value, uncertainty] = parts;
                let value = value.ok_or_else(|| A::Error::missing_field(KEYS[0]))?;
                let uncertainty = uncertainty.ok_or_else(|| A::Error::missing_field(KEYS[1]))?;
                Ok(Written::Text(format!("{value} ± {uncertainty}")))
            }
        }
        let written = deserializer.deserialize_any(WrittenVisitor::<K>(PhantomData))?;
        Ok(Quantity { written, kind: PhantomData })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quantity<K: QuantityKind>(toml: &str) -> Quantity<K> {
        Quantity::deserialize(toml::de::ValueDeserializer::parse(toml).unwrap()).unwrap()
    }

    fn explained<K: QuantityKind>(toml: &str, key: &str) -> String {
        let quantity = quantity::<K>(toml);
        quantity.explain(&quantity.si().unwrap_err(), key).0
    }

    #[test]
    fn a_bare_number_is_si_and_a_string_has_a_unit() {
        assert_eq!(quantity::<Length>("0.0222").si(), Ok(0.0222));
        assert_eq!(quantity::<Length>("1").si(), Ok(1.0));
        assert_eq!(quantity::<Length>("'22.2 mm'").si(), Ok(0.0222));
        assert_eq!(quantity::<Number>("'1'").si(), Ok(1.0));
    }

    #[test]
    fn errors_name_quantity_and_key() {
        let is = |found: String, expected: &str| assert_eq!(found, expected);
        is(
            explained::<Length>("'22.2 kg'", "diameter"),
            "diameter must be a length, such as \"22.2 mm\"; \"22.2 kg\" is a mass",
        );
        is(
            explained::<Length>("'22.2'", "diameter"),
            "diameter must be a length, such as \"22.2 mm\"; \"22.2\" has no unit",
        );
        is(
            explained::<Stress>("'3 kg^2 m'", "youngs_modulus"),
            "youngs_modulus must be a pressure, such as \"63 GPa\"; \"3 kg^2 m\" is in m kg^2",
        );
        is(explained::<Length>("nan", "diameter"), "diameter is NaN m, which is not finite");
        is(explained::<Length>("-inf", "diameter"), "diameter is -inf m, which is not finite");
        is(
            explained::<Length>("'nan mm'", "diameter"),
            "diameter is \"nan mm\", which is not a length: it does not begin with a number",
        );
        is(
            explained::<Length>("'3 furlong'", "diameter"),
            "unknown unit `furlong` in \"3 furlong\"; diameter must be a length",
        );
    }

    #[test]
    fn a_count_reads_as_a_whole_number() {
        for written in ["101", "101.0", "'101'"] {
            let count = quantity::<Count>(written);
            assert_eq!(serde_json::to_string(&count).unwrap(), "101");
        }
        assert_eq!(quantity::<Count>("49.0").to_string(), "49");
        assert_eq!(quantity::<Count>("49.5").to_string(), "49.5");
        assert_eq!(quantity::<Number>("1").to_string(), "1.0");
        let many = quantity::<Count>("'many'");
        let (_, help) = many.explain(&many.si().unwrap_err(), "steps");
        assert_eq!(help, "write a whole number, such as 12");
    }

    #[test]
    fn quantity_serializes_as_the_si_number() {
        let json = |toml| serde_json::to_string(&quantity::<Length>(toml)).unwrap();
        assert_eq!(json("'22.2 mm'"), "0.0222");
        assert_eq!(json("3"), "3.0");
        let uncertain = json("'20 ± 0.5 mm'");
        assert_eq!(uncertain, r#"{"value":0.02,"uncertainty":0.0005}"#);
        assert_eq!(json("{ value = '20 mm', uncertainty = 0.0005 }"), uncertain);
        assert_eq!(serde_json::from_str::<Quantity<Length>>(&uncertain).unwrap().si(), Ok(0.02));
    }
}
