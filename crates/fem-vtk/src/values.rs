//! Numbers to write ([`Values`], borrowed) and numbers that were read ([`Numbers`], owned).

use crate::vtk_types::ScalarType;

/// Borrowed numbers to write, tuple after tuple; a slice converts by `into`.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Values<'a> {
    /// Values of type `f64`.
    Float64(&'a [f64]),
    /// Values of type `f32`.
    Float32(&'a [f32]),
    /// Values of type `u8`.
    UInt8(&'a [u8]),
    /// Values of type `i32`.
    Int32(&'a [i32]),
    /// Values of type `i64`.
    Int64(&'a [i64]),
}

macro_rules! values_from {
    ($($variant:ident($number:ty)),*) => {$(
        impl<'a> From<&'a [$number]> for Values<'a> {
            fn from(values: &'a [$number]) -> Self {
                Self::$variant(values)
            }
        }
        impl<'a> From<&'a Vec<$number>> for Values<'a> {
            fn from(values: &'a Vec<$number>) -> Self {
                Self::$variant(values)
            }
        }
        impl<'a, const N: usize> From<&'a [$number; N]> for Values<'a> {
            fn from(values: &'a [$number; N]) -> Self {
                Self::$variant(values)
            }
        }
    )*};
}

values_from!(Float64(f64), Float32(f32), UInt8(u8), Int32(i32), Int64(i64));

impl Values<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Float64(values) => values.len(),
            Self::Float32(values) => values.len(),
            Self::UInt8(values) => values.len(),
            Self::Int32(values) => values.len(),
            Self::Int64(values) => values.len(),
        }
    }

    pub(crate) fn scalar_type(&self) -> ScalarType {
        match self {
            Self::Float64(_) => ScalarType::Float64,
            Self::Float32(_) => ScalarType::Float32,
            Self::UInt8(_) => ScalarType::UInt8,
            Self::Int32(_) => ScalarType::Int32,
            Self::Int64(_) => ScalarType::Int64,
        }
    }

    /// Returns index and value of the first value that is not finite.
    pub(crate) fn first_not_finite(&self) -> Option<(usize, f64)> {
        match self {
            Self::Float64(values) => first_not_finite(values),
            Self::Float32(values) => {
                let mut values = values.iter().map(|value| f64::from(*value)).enumerate();
                values.find(|(_, value)| !value.is_finite())
            }
            _ => None,
        }
    }

    pub(crate) fn to_le_bytes(self) -> Vec<u8> {
        match self {
            Self::Float64(values) => little_endian(values, f64::to_le_bytes),
            Self::Float32(values) => little_endian(values, f32::to_le_bytes),
            Self::UInt8(values) => values.to_vec(),
            Self::Int32(values) => little_endian(values, i32::to_le_bytes),
            Self::Int64(values) => little_endian(values, i64::to_le_bytes),
        }
    }
}

fn little_endian<T: Copy, const N: usize>(values: &[T], bytes: fn(T) -> [u8; N]) -> Vec<u8> {
    let mut all = Vec::with_capacity(N * values.len());
    values.iter().for_each(|&value| all.extend_from_slice(&bytes(value)));
    all
}

/// Numbers read from a file, widened without loss.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Values of type `Float32` or `Float64`.
    Float(Vec<f64>),
    /// Values of any integer type.
    Integer(Vec<i64>),
}

impl Numbers {
    /// Returns the number of values: tuples times components.
    pub fn len(&self) -> usize {
        match self {
            Self::Float(values) => values.len(),
            Self::Integer(values) => values.len(),
        }
    }

    /// Returns whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Returns index and value of the first value that is not finite.
pub(crate) fn first_not_finite(values: &[f64]) -> Option<(usize, f64)> {
    values.iter().copied().enumerate().find(|(_, value)| !value.is_finite())
}

/// Returns `(r, y)` pairs as the `(r, y, 0)` triples that readers need; a last single value is dropped.
pub fn pad_vectors(pairs: &[f64]) -> Vec<f64> {
    let (pairs, _) = pairs.as_chunks::<2>();
    pairs.iter().flat_map(|&[r, y]| [r, y, 0.0]).collect()
}
