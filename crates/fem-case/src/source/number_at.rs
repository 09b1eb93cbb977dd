//! The number at a key of a case, in SI, and its unit. A serializer finds it: each [`Quantity`](crate::Quantity)
//! serializes as a new type that has the name of its unit.

use std::fmt::Display;

use serde::ser::{Impossible, Serialize, SerializeMap, SerializeSeq, SerializeStruct, Serializer};

use crate::schema::CaseFile;

impl CaseFile {
    /// Returns the number at a key of these parts, in SI, and its unit, which is empty for a plain number; `None` if the
    /// case has no number there.
    ///
    /// ```
    /// use fem_case::CaseFile;
    /// use fem_case::schema::BodyTable;
    ///
    /// let ball = BodyTable::sphere("ball", "2 cm", "ice").approaching("1 m/s");
    /// let file = CaseFile::of_bodies(ball, BodyTable::wall("floor"));
    /// assert_eq!(file.number_at(["body", "0", "sphere", "diameter"]), Some((0.02, "m")));
    /// assert_eq!(file.number_at(["body", "0", "name"]), None);
    /// assert_eq!(file.number_at(["body", "1", "sphere", "diameter"]), None);
    /// ```
    pub fn number_at<'k>(
        &self,
        parts: impl IntoIterator<Item = &'k str>,
    ) -> Option<(f64, &'static str)> {
        let path: Vec<&str> = parts.into_iter().collect();
        self.serialize(Seek { path: &path, unit: "" }).ok().flatten()
    }
}

type Found = Option<(f64, &'static str)>;

/// Follows the rest of a path through a value; `unit` is the name of the new type around it.
#[derive(Clone, Copy)]
struct Seek<'p> {
    path: &'p [&'p str],
    unit: &'static str,
}

/// The value has no keys or numbers that can be sought.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct NotSought(String);

impl serde::ser::Error for NotSought {
    fn custom<T: Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

/// Seeks one part of the path in a table or an array.
struct Inside<'p> {
    part: &'p str,
    below: Seek<'p>,
    index: usize,
    is_next: bool,
    found: Found,
}

impl<'p> Seek<'p> {
    fn number(self, value: f64) -> Result<Found, NotSought> {
        Ok(self.path.is_empty().then_some((value, self.unit)))
    }

    fn inside(self) -> Result<Inside<'p>, NotSought> {
        let Some((part, rest)) = self.path.split_first() else {
            return Err(serde::ser::Error::custom("a table or an array"));
        };
        let below = Seek { path: rest, unit: self.unit };
        Ok(Inside { part, below, index: 0, is_next: false, found: None })
    }
}

/// Methods for values without a number.
macro_rules! no_number {
    ($($method:ident($($type:ty),*) -> $result:ty;)+) => {
        $(fn $method(self, $(_: $type),*) -> Result<$result, NotSought> {
            Err(serde::ser::Error::custom("no number"))
        })+
    };
}

/// Methods for numbers.
macro_rules! numbers {
    ($($method:ident($type:ty);)+) => {
        $(fn $method(self, value: $type) -> Result<Found, NotSought> {
            self.number(value as f64)
        })+
    };
}

impl<'p> Serializer for Seek<'p> {
    type Ok = Found;
    type Error = NotSought;
    type SerializeSeq = Inside<'p>;
    type SerializeMap = Inside<'p>;
    type SerializeStruct = Inside<'p>;
    type SerializeTuple = Impossible<Found, NotSought>;
    type SerializeTupleStruct = Impossible<Found, NotSought>;
    type SerializeTupleVariant = Impossible<Found, NotSought>;
    type SerializeStructVariant = Impossible<Found, NotSought>;

    numbers! {
        serialize_i8(i8);
        serialize_i16(i16);
        serialize_i32(i32);
        serialize_i64(i64);
        serialize_u8(u8);
        serialize_u16(u16);
        serialize_u32(u32);
        serialize_u64(u64);
        serialize_f32(f32);
        serialize_f64(f64);
    }

    no_number! {
        serialize_bool(bool) -> Found;
        serialize_char(char) -> Found;
        serialize_str(&str) -> Found;
        serialize_bytes(&[u8]) -> Found;
        serialize_none() -> Found;
        serialize_unit() -> Found;
        serialize_unit_struct(&'static str) -> Found;
        serialize_unit_variant(&'static str, u32, &'static str) -> Found;
        serialize_tuple(usize) -> Self::SerializeTuple;
        serialize_tuple_struct(&'static str, usize) -> Self::SerializeTupleStruct;
        serialize_tuple_variant(&'static str, u32, &'static str, usize) -> Self::SerializeTupleVariant;
        serialize_struct_variant(&'static str, u32, &'static str, usize) -> Self::SerializeStructVariant;
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<Found, NotSought> {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        name: &'static str,
        value: &T,
    ) -> Result<Found, NotSought> {
        value.serialize(Seek { unit: name, ..self })
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        _index: u32,
        _variant: &'static str,
        value: &T,
    ) -> Result<Found, NotSought> {
        value.serialize(self)
    }

    fn serialize_seq(self, _n: Option<usize>) -> Result<Inside<'p>, NotSought> {
        self.inside()
    }

    fn serialize_map(self, _n: Option<usize>) -> Result<Inside<'p>, NotSought> {
        self.inside()
    }

    /// A number with an uncertainty is a table of both; no other table has a key of this name.
    fn serialize_struct(self, _name: &'static str, _n: usize) -> Result<Inside<'p>, NotSought> {
        match self.path {
            [] => Seek { path: &["value"], ..self }.inside(),
            _ => self.inside(),
        }
    }
}

impl SerializeSeq for Inside<'_> {
    type Ok = Found;
    type Error = NotSought;

    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotSought> {
        if self.part.parse() == Ok(self.index) {
            self.found = value.serialize(self.below)?;
        }
        self.index += 1;
        Ok(())
    }

    fn end(self) -> Result<Found, NotSought> {
        Ok(self.found)
    }
}

impl SerializeStruct for Inside<'_> {
    type Ok = Found;
    type Error = NotSought;

    fn serialize_field<T: Serialize + ?Sized>(
        &mut self,
        key: &'static str,
        value: &T,
    ) -> Result<(), NotSought> {
        if self.part == key {
            self.found = value.serialize(self.below)?;
        }
        Ok(())
    }

    fn end(self) -> Result<Found, NotSought> {
        Ok(self.found)
    }
}

/// Tables whose keys a case chooses, such as its materials.
impl SerializeMap for Inside<'_> {
    type Ok = Found;
    type Error = NotSought;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), NotSought> {
        let key = toml::Value::try_from(key).ok();
        self.is_next = key.as_ref().and_then(toml::Value::as_str) == Some(self.part);
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NotSought> {
        if self.is_next {
            self.found = value.serialize(self.below)?;
        }
        Ok(())
    }

    fn end(self) -> Result<Found, NotSought> {
        Ok(self.found)
    }
}
