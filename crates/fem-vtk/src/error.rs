//! Errors of reading and writing, with the file, the array, the index and the value.

use std::path::PathBuf;

/// Every error of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The operating system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// Path of the file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },

    /// Nothing to write: no points, no cells, an array without values, a collection without files.
    #[error("{what}: empty, and readers crash on empty arrays; leave it out")]
    Empty {
        /// Name of the empty item.
        what: String,
    },

    /// An array name that XML or its readers cannot carry.
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

    /// Zero components, or two at points or cells.
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

    /// An array does not have as many values as the mesh asks for.
    #[error("{section} array {name:?}: found {found} values; {expected} are needed")]
    Length {
        /// `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the array.
        name: String,
        /// The number of values given.
        found: usize,
        /// Points or cells times components, in words and number.
        expected: String,
    },

    /// An infinity or a NaN.
    #[error("{section} array {name:?}: value {value} at index {index} (component {component})")]
    NotFinite {
        /// `Points`, `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// Name of the array.
        name: String,
        /// Point, cell or tuple.
        index: usize,
        /// Component within the tuple.
        component: usize,
        /// Value that was found.
        value: f64,
    },

    /// A cell names a point that is not there.
    #[error(
        "cell {cell}, corner {corner}: point {point}; the mesh has {n_points} points, numbered from 0"
    )]
    Connectivity {
        /// The cell, from 0.
        cell: usize,
        /// The corner, 0 to 3.
        corner: usize,
        /// The point it names.
        point: u32,
        /// The number of points.
        n_points: usize,
    },

    /// A time of a collection is not finite or not later than the one before.
    #[error(
        "{file}: time {time}; times must be finite and increase (the one before: {previous:?})"
    )]
    Time {
        /// The snapshot's file name.
        file: String,
        /// Its time in seconds.
        time: f64,
        /// The time before it.
        previous: Option<f64>,
    },

    /// A file name of a collection that is not relative to it.
    #[error("{file:?}: a collection lists relative file names with / between folders")]
    FileName {
        /// Name of the array.
        file: String,
    },

    /// A file that is not what this crate reads, or is damaged.
    #[error("{}: {place}: found {found}; allowed: {allowed}", path.display())]
    Malformed {
        /// Path of the file.
        path: PathBuf,
        /// The XML element or array.
        place: String,
        /// Value that was found.
        found: String,
        /// Allowed values.
        allowed: String,
    },

    /// An array that was asked for is not in the file.
    #[error("{}: {section} has no array {name:?}; it has: {available}", path.display())]
    MissingArray {
        /// Path of the file.
        path: PathBuf,
        /// `Points`, `Cells`, `PointData`, `CellData` or `FieldData`.
        section: &'static str,
        /// The name asked for.
        name: String,
        /// The names that are there.
        available: String,
    },
}
