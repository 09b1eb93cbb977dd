//! Errors of reading and writing, with file, array, index and value.

use std::path::PathBuf;

/// The error type of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file cannot be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// Path of the file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },

    /// A mesh, an array or a collection is empty.
    #[error("{what} is empty, and readers crash on empty arrays: remove it")]
    Empty {
        /// Name of the empty item.
        what: String,
    },

    /// The name of an array is empty or has control characters.
    #[error(
        "{section} array {name:?}: a name needs at least one character and no control characters"
    )]
    Name {
        /// `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the array.
        name: String,
    },

    /// Two arrays of one section share a name.
    #[error("{section}: two arrays are named {name:?}")]
    DuplicateName {
        /// `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the array.
        name: String,
    },

    /// An array has no components, or two at points or cells.
    #[error(
        "{section} array {name:?}: {components} components; allowed: 1, 3 or more \
         (readers abort on vectors of two components: pad them with `pad_vectors`)"
    )]
    Components {
        /// `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the array.
        name: String,
        /// The number of components given.
        components: usize,
    },

    /// An array does not have the number of values that the mesh needs.
    #[error("{section} array {name:?}: found {found} values; {expected} are needed")]
    Length {
        /// `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the array.
        name: String,
        /// The number of values given.
        found: usize,
        /// The expected number: points or cells times components.
        expected: String,
    },

    /// A value is not finite.
    #[error("{section} array {name:?}: value {value} at index {index} (component {component})")]
    NotFinite {
        /// `Points`, `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the array.
        name: String,
        /// Index of the point, cell or tuple.
        index: usize,
        /// Index of the component.
        component: usize,
        /// Value that was found.
        value: f64,
    },

    /// A cell has a point that does not exist.
    #[error(
        "cell {cell}, corner {corner}: point {point}; the mesh has {n_points} points, numbered from 0"
    )]
    Connectivity {
        /// Index of the cell.
        cell: usize,
        /// Index of the corner, 0 to 3.
        corner: usize,
        /// Index of the point.
        point: u32,
        /// The number of points.
        n_points: usize,
    },

    /// A time of a collection is not finite or not later than the previous one.
    #[error("{file}: time {time}; times must be finite and increase (previous time: {previous:?})")]
    Time {
        /// File name of the snapshot.
        file: String,
        /// Time of the snapshot, s.
        time: f64,
        /// The previous time, s.
        previous: Option<f64>,
    },

    /// A file name of a collection is not relative to it.
    #[error("{file:?} is not a relative file name with / between folders")]
    FileName {
        /// Name of the array.
        file: String,
    },

    /// A file is damaged or has a format that this crate does not read.
    #[error("{}: {place}: found {found}; allowed: {allowed}", path.display())]
    Malformed {
        /// Path of the file.
        path: PathBuf,
        /// XML element or array.
        place: String,
        /// Value that was found.
        found: String,
        /// The allowed values.
        allowed: String,
    },

    /// A requested array is not in the file.
    #[error("{}: {section} has no array {name:?}; it has: {available}", path.display())]
    MissingArray {
        /// Path of the file.
        path: PathBuf,
        /// `Points`, `Cells`, `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the requested array.
        name: String,
        /// Names of the arrays in the file.
        available: String,
    },
}
