//! The number at a key of a case, in SI, and its unit: found on the way that writing the case takes,
//! where each quantity tells its unit ([`crate::Quantity`]).

use std::fmt::Display;

use serde::ser::{
    Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};

use crate::schema::CaseFile;

impl CaseFile {
    /// The number at a key of these parts, in SI, and its unit, empty of a plain number; none where
    /// the case has no number there.
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

/// What is found at a key.
type Found = Option<(f64, &'static str)>;

/// Goes down a path as far as the value has it.
#[derive(Clone, Copy)]
struct Seek<'p> {
    path: &'p [&'p str],
    unit: &'static str,
}

/// Never comes about.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
struct Never(String);

impl serde::ser::Error for Never {
    fn custom<T: Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

impl Seek<'_> {
    fn number(self, value: f64) -> Result<Found, Never> {
        Ok(self.path.is_empty().then_some((value, self.unit)))
    }
}

/// A table or an array on the way: the part that is sought in it, and what was found.
struct Inside<'p> {
    part: Option<&'p str>,
    below: Seek<'p>,
    index: usize,
    is_next: bool,
    found: Found,
}

impl<'p> Inside<'p> {
    fn of(seek: Seek<'p>) -> Self {
        let (part, rest) = match seek.path.split_first() {
            Some((part, rest)) => (Some(*part), rest),
            None => (None, seek.path),
        };
        let below = Seek { path: rest, unit: seek.unit };
        Self { part, below, index: 0, is_next: false, found: None }
    }

    fn field<T: Serialize + ?Sized>(&mut self, key: &str, value: &T) -> Result<(), Never> {
        if self.part == Some(key) {
            self.found = value.serialize(self.below)?;
        }
        Ok(())
    }

    fn item<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Never> {
        let index = self.index;
        self.index += 1;
        let is_it = self.part.and_then(|part| part.parse().ok()) == Some(index);
        self.found = if is_it { value.serialize(self.below)? } else { self.found };
        Ok(())
    }
}

/// Values without a number.
macro_rules! no_number {
    ($($method:ident($($argument:ident: $type:ty),*);)+) => {
        $(fn $method(self, $($argument: $type),*) -> Result<Found, Never> {
            Ok(None)
        })+
    };
}

/// Numbers.
macro_rules! numbers {
    ($($method:ident($type:ty);)+) => {
        $(fn $method(self, value: $type) -> Result<Found, Never> {
            self.number(value as f64)
        })+
    };
}

impl<'p> Serializer for Seek<'p> {
    type Ok = Found;
    type Error = Never;
    type SerializeSeq = Inside<'p>;
    type SerializeTuple = Inside<'p>;
    type SerializeTupleStruct = Inside<'p>;
    type SerializeTupleVariant = Inside<'p>;
    type SerializeMap = Inside<'p>;
    type SerializeStruct = Inside<'p>;
    type SerializeStructVariant = Inside<'p>;

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
        serialize_bool(_value: bool);
        serialize_char(_value: char);
        serialize_str(_value: &str);
        serialize_bytes(_value: &[u8]);
        serialize_none();
        serialize_unit();
        serialize_unit_struct(_name: &'static str);
        serialize_unit_variant(_name: &'static str, _index: u32, _variant: &'static str);
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<Found, Never> {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        name: &'static str,
        value: &T,
    ) -> Result<Found, Never> {
        value.serialize(Seek { unit: name, ..self })
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<Found, Never> {
        let mut inside = Inside::of(self);
        inside.field(variant, value)?;
        Ok(inside.found)
    }

    fn serialize_seq(self, _n: Option<usize>) -> Result<Inside<'p>, Never> {
        Ok(Inside::of(self))
    }

    fn serialize_tuple(self, _n: usize) -> Result<Inside<'p>, Never> {
        Ok(Inside::of(self))
    }

    fn serialize_tuple_struct(self, _name: &'static str, _n: usize) -> Result<Inside<'p>, Never> {
        Ok(Inside::of(self))
    }

    fn serialize_tuple_variant(
        self,
        _name: &'static str,
        _index: u32,
        _variant: &'static str,
        _n: usize,
    ) -> Result<Inside<'p>, Never> {
        Ok(Inside::of(self))
    }

    fn serialize_map(self, _n: Option<usize>) -> Result<Inside<'p>, Never> {
        Ok(Inside::of(self))
    }

    fn serialize_struct(self, _name: &'static str, _n: usize) -> Result<Inside<'p>, Never> {
        Ok(Inside::of(self))
    }

    fn serialize_struct_variant(
        self,
        _name: &'static str,
        _index: u32,
        _variant: &'static str,
        _n: usize,
    ) -> Result<Inside<'p>, Never> {
        Ok(Inside::of(self))
    }
}

/// Arrays and tuples.
macro_rules! items {
    ($($trait:ident :: $method:ident;)+) => {
        $(impl $trait for Inside<'_> {
            type Ok = Found;
            type Error = Never;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Never> {
                self.item(value)
            }

            fn end(self) -> Result<Found, Never> {
                Ok(self.found)
            }
        })+
    };
}

items! {
    SerializeSeq::serialize_element;
    SerializeTuple::serialize_element;
    SerializeTupleStruct::serialize_field;
    SerializeTupleVariant::serialize_field;
}

/// Tables of named fields.
macro_rules! fields {
    ($($trait:ident;)+) => {
        $(impl $trait for Inside<'_> {
            type Ok = Found;
            type Error = Never;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                key: &'static str,
                value: &T,
            ) -> Result<(), Never> {
                self.field(key, value)
            }

            fn end(self) -> Result<Found, Never> {
                Ok(self.found)
            }
        })+
    };
}

fields! {
    SerializeStruct;
    SerializeStructVariant;
}

/// Tables of names that a case chooses, such as its materials.
impl SerializeMap for Inside<'_> {
    type Ok = Found;
    type Error = Never;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Never> {
        let key = toml::Value::try_from(key).ok();
        self.is_next =
            self.part.is_some() && key.as_ref().and_then(toml::Value::as_str) == self.part;
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Never> {
        if self.is_next {
            self.found = value.serialize(self.below)?;
        }
        Ok(())
    }

    fn end(self) -> Result<Found, Never> {
        Ok(self.found)
    }
}
