//! Reads quadrilateral meshes and named arrays from a `.vtu`.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::read::decode::{decode, place};
use crate::read::vtu_xml::{ArrayEntry, FormatError, VtuXml, tame};
use crate::values::{Numbers, first_not_finite};
use crate::vtk_types::{Section, VTK_QUAD};

/// The types of single points, and of lines of two or more points.
const POINTS_AND_LINES: RangeInclusive<i64> = 1..=4;

/// Points and quadrilaterals of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadMesh {
    /// Coordinates, all finite.
    pub points: Vec<[f64; 3]>,
    /// Point numbers from 0, all below `points.len()`, in the order of the file.
    pub quads: Vec<[u32; 4]>,
}

/// A data array of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadArray {
    /// Number of values per tuple, at least 1.
    pub components: usize,
    /// All values, tuple after tuple; floating-point values are finite.
    pub values: Numbers,
}

impl ReadArray {
    /// Returns the values if the file has them as floating-point numbers.
    pub fn as_float(&self) -> Option<&[f64]> {
        match &self.values {
            Numbers::Float(values) => Some(values),
            Numbers::Integer(_) => None,
        }
    }

    /// Returns the values if the file has them as integers.
    pub fn as_integer(&self) -> Option<&[i64]> {
        match &self.values {
            Numbers::Integer(values) => Some(values),
            Numbers::Float(_) => None,
        }
    }
}

/// Reads points and quadrilaterals of a `.vtu`; `VtuFile` reads data arrays as well.
///
/// # Errors
///
/// The errors are those of [`VtuFile::open`] and [`VtuFile::quad_mesh`].
pub fn read_quad_mesh(path: impl AsRef<Path>) -> Result<QuadMesh, Error> {
    VtuFile::open(path)?.quad_mesh()
}

/// A `.vtu` in memory; its arrays are decoded when they are requested.
///
/// Accepted: one piece; ascii, inline base64, appended base64 or raw; zlib blocks or uncompressed;
/// headers of 32 or 64 bits; every VTK number type; little-endian.
#[derive(Debug)]
pub struct VtuFile {
    path: PathBuf,
    bytes: Vec<u8>,
    xml: VtuXml,
}

impl VtuFile {
    /// Reads the file and parses its XML.
    ///
    /// # Errors
    ///
    /// The file cannot be read; its XML is broken or ends early; it is a VTK file of another type, byte order or
    /// compressor; or it does not have exactly one piece.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes =
            std::fs::read(path).map_err(|source| Error::Io { path: path.to_path_buf(), source })?;
        Self::from_bytes(path, bytes)
    }

    /// Parses the bytes of a file, as [`VtuFile::open`] does; `path` only names them in errors.
    ///
    /// # Errors
    ///
    /// The errors are those of [`VtuFile::open`].
    pub fn from_bytes(path: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, Error> {
        let path = path.as_ref().to_path_buf();
        match VtuXml::parse(&bytes) {
            Ok(xml) => Ok(Self { path, bytes, xml }),
            Err(error) => Err(malformed(&path, error)),
        }
    }

    /// Returns points and quadrilaterals. Points and lines, which mesh generators write for named boundaries, are left out.
    ///
    /// # Errors
    ///
    /// There are no points or cells; a point does not have three finite coordinates; a cell is of another type; a point
    /// number is out of range; or the data are damaged.
    pub fn quad_mesh(&self) -> Result<QuadMesh, Error> {
        let VtuXml { n_points, n_cells, .. } = self.xml;
        if n_points == 0 || n_cells == 0 {
            return Err(self.error(
                "Piece",
                format!("{n_points} points, {n_cells} cells"),
                "at least one of each",
            ));
        }
        let points = self.read_points()?;
        let types = self.read_per_cell("types")?;
        let ends = self.read_per_cell("offsets")?;
        let connectivity = self.read_integers("connectivity")?;
        let mut quads = Vec::with_capacity(n_cells);
        let mut start = 0;
        for (cell, (&kind, &end)) in types.iter().zip(&ends).enumerate() {
            let wrong = |array, found: String, allowed: &str| {
                self.error(format!("Cells array \"{array}\""), found, allowed)
            };
            let corners = usize::try_from(end).ok().and_then(|end| connectivity.get(start..end));
            let corners = corners.ok_or_else(|| {
                let allowed = format!("{start} to {}", connectivity.len());
                wrong("offsets", format!("{end} at cell {cell}"), &allowed)
            })?;
            start += corners.len();
            if POINTS_AND_LINES.contains(&kind) {
                continue;
            } else if kind != i64::from(VTK_QUAD) {
                let found = format!("cell {cell} of type {}", cell_type_name(kind));
                return Err(wrong("types", found, &remedy(kind)));
            }
            let corners = <[i64; 4]>::try_from(corners).map_err(|_| {
                let found = format!("{} points of cell {cell}", corners.len());
                wrong("offsets", found, "four for a quadrilateral")
            })?;
            let mut quad = [0; 4];
            for (corner, point) in corners.into_iter().enumerate() {
                let in_range = usize::try_from(point).is_ok_and(|point| point < n_points);
                quad[corner] = u32::try_from(point).ok().filter(|_| in_range).ok_or_else(|| {
                    let found = format!("point {point} at corner {corner} of cell {cell}");
                    wrong("connectivity", found, &format!("0 to {}", n_points - 1))
                })?;
            }
            quads.push(quad);
        }
        self.check_length("Cells array \"connectivity\"", connectivity.len(), start, 1)?;
        Ok(QuadMesh { points, quads })
    }

    /// Returns an array of point data, with `n_points` tuples.
    ///
    /// # Errors
    ///
    /// The array does not exist, is damaged, has a wrong length, or has a value that is not finite.
    pub fn point_data(&self, name: &str) -> Result<ReadArray, Error> {
        self.read_sized(Section::PointData, name, self.xml.n_points)
    }

    /// Returns an array of cell data, with `n_cells` tuples.
    ///
    /// # Errors
    ///
    /// The array does not exist, is damaged, has a wrong length, or has a value that is not finite.
    pub fn cell_data(&self, name: &str) -> Result<ReadArray, Error> {
        self.read_sized(Section::CellData, name, self.xml.n_cells)
    }

    /// Returns an array of the whole file, such as `TimeValue`.
    ///
    /// # Errors
    ///
    /// The array does not exist, is damaged, has an incomplete tuple, or has a value that is not finite.
    pub fn field_data(&self, name: &str) -> Result<ReadArray, Error> {
        let entry = self.find(Section::FieldData, name)?;
        let array = self.read_entry(entry)?;
        if !array.values.len().is_multiple_of(array.components) {
            let found = format!("{} values", array.values.len());
            return Err(self.error(
                place(entry),
                found,
                format!("a multiple of {}", array.components),
            ));
        }
        Ok(array)
    }

    /// Returns the names of the point data, in the order of the file.
    pub fn point_data_names(&self) -> impl Iterator<Item = &str> {
        self.names(Section::PointData)
    }

    /// Returns the names of the cell data, in the order of the file.
    pub fn cell_data_names(&self) -> impl Iterator<Item = &str> {
        self.names(Section::CellData)
    }

    fn names(&self, section: Section) -> impl Iterator<Item = &str> {
        let arrays = self.xml.arrays.iter();
        arrays.filter(move |entry| entry.section == section).map(|entry| entry.name.as_str())
    }

    fn read_points(&self) -> Result<Vec<[f64; 3]>, Error> {
        let mut arrays = self.xml.arrays.iter().filter(|entry| entry.section == Section::Points);
        let (Some(entry), None) = (arrays.next(), arrays.next()) else {
            return Err(self.error("Points", "none or several arrays", "one DataArray"));
        };
        let array = self.read_entry(entry)?;
        let place = place(entry);
        match &array.values {
            Numbers::Float(values) if array.components == 3 => {
                self.check_length(&place, values.len(), self.xml.n_points, 3)?;
                Ok(values.as_chunks().0.to_vec())
            }
            _ => {
                let found =
                    format!("{} components of type {}", array.components, entry.scalar_type);
                Err(self.error(place, found, "3 components of type Float32 or Float64"))
            }
        }
    }

    fn read_per_cell(&self, name: &str) -> Result<Vec<i64>, Error> {
        let numbers = self.read_integers(name)?;
        self.check_length(&format!("Cells array \"{name}\""), numbers.len(), self.xml.n_cells, 1)?;
        Ok(numbers)
    }

    fn read_integers(&self, name: &str) -> Result<Vec<i64>, Error> {
        let entry = self.find(Section::Cells, name)?;
        match self.read_entry(entry)?.values {
            Numbers::Integer(values) => Ok(values),
            Numbers::Float(_) => {
                Err(self.error(place(entry), format!("type {}", entry.scalar_type), "integers"))
            }
        }
    }

    fn read_sized(
        &self,
        section: Section,
        name: &str,
        n_tuples: usize,
    ) -> Result<ReadArray, Error> {
        let entry = self.find(section, name)?;
        let array = self.read_entry(entry)?;
        self.check_length(&place(entry), array.values.len(), n_tuples, array.components)?;
        Ok(array)
    }

    fn find(&self, section: Section, name: &str) -> Result<&ArrayEntry, Error> {
        let arrays = &self.xml.arrays;
        arrays.iter().find(|entry| entry.section == section && entry.name == name).ok_or_else(
            || {
                let available: Vec<&str> = self.names(section).collect();
                let available =
                    if available.is_empty() { "none".to_owned() } else { available.join(", ") };
                Error::MissingArray {
                    path: self.path.clone(),
                    section: section.name(),
                    name: name.to_owned(),
                    available: tame(available),
                }
            },
        )
    }

    fn read_entry(&self, entry: &ArrayEntry) -> Result<ReadArray, Error> {
        let (components, values) =
            decode(&self.bytes, &self.xml, entry).map_err(|error| malformed(&self.path, error))?;
        if let Numbers::Float(floats) = &values
            && let Some((index, value)) = first_not_finite(floats)
        {
            let found = format!(
                "{value} at index {} (component {})",
                index / components,
                index % components
            );
            return Err(self.error(place(entry), found, "finite numbers"));
        }
        Ok(ReadArray { components, values })
    }

    fn check_length(
        &self,
        place: &str,
        found: usize,
        tuples: usize,
        components: usize,
    ) -> Result<(), Error> {
        if tuples.checked_mul(components) == Some(found) {
            return Ok(());
        }
        Err(self.error(
            place,
            format!("{found} values"),
            format!("{tuples} tuples x {components} components"),
        ))
    }

    fn error(
        &self,
        place: impl Into<String>,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Error {
        malformed(&self.path, FormatError::new(place, found, allowed))
    }
}

fn malformed(path: &Path, error: FormatError) -> Error {
    let FormatError { place, found, allowed } = error;
    Error::Malformed { path: path.to_path_buf(), place, found, allowed }
}

/// Returns what a mesh needs in place of cells of a type, with the options of gmsh that write it.
fn remedy(kind: i64) -> String {
    let in_gmsh = match kind {
        5 => {
            "; in gmsh: Mesh.RecombineAll = 1 or Recombine Surface, with Mesh.SubdivisionAlgorithm = 1"
        }
        22 | 23 | 28 => "; in gmsh: Mesh.ElementOrder = 1",
        _ => "",
    };
    format!("only four-node quadrilaterals (9, VTK_QUAD){in_gmsh}")
}

/// Returns number and name of a cell type of usual meshes.
fn cell_type_name(kind: i64) -> String {
    let name = match kind {
        5 => "VTK_TRIANGLE",
        7 => "VTK_POLYGON",
        8 => "VTK_PIXEL",
        10 => "VTK_TETRA",
        12 => "VTK_HEXAHEDRON",
        22 => "VTK_QUADRATIC_TRIANGLE",
        23 => "VTK_QUADRATIC_QUAD",
        28 => "VTK_BIQUADRATIC_QUAD",
        _ => return kind.to_string(),
    };
    format!("{kind} ({name})")
}
