//! One snapshot of a quadrilateral mesh with its data: what goes into a `.vtu`, and its checks.

use std::collections::BTreeSet;
use std::path::Path;

use crate::atomic::write_atomically;
use crate::render::RenderedFile;
use crate::section::Section;
use crate::values::Values;
use crate::{Encoding, Error, VtuGrid};

/// An array to write.
pub(crate) struct NamedArray<'a> {
    pub(crate) section: Section,
    pub(crate) name: &'a str,
    pub(crate) components: usize,
    pub(crate) values: Values<'a>,
}

/// Collects borrowed arrays, then checks and writes them in one go.
///
/// Arrays are flat, tuple after tuple: `n_points * components` values for point data,
/// `n_cells * components` for cell data. Floats are written as `Float64`, integers in their own
/// type, connectivity as `Int64`; bytes are little-endian in zlib blocks. The first scalar and the
/// first vector of point and cell data are marked as active, so readers show them first.
pub struct VtuWriter<'a> {
    pub(crate) grid: VtuGrid<'a>,
    pub(crate) time: Option<f64>,
    pub(crate) encoding: Encoding,
    pub(crate) arrays: Vec<NamedArray<'a>>,
}

impl<'a> VtuWriter<'a> {
    /// Points in metres and the four corners of each cell, point numbers from 0.
    pub fn new(points: &'a [[f64; 3]], quads: &'a [[u32; 4]]) -> Self {
        Self::on(&VtuGrid::new(points, quads))
    }

    /// On a grid that other files show too.
    pub fn on(grid: &VtuGrid<'a>) -> Self {
        let (time, encoding) = (None, Encoding::default());
        Self { grid: grid.clone(), time, encoding, arrays: Vec::new() }
    }

    /// The snapshot's time in seconds: field data `TimeValue`.
    pub fn time(mut self, time: f64) -> Self {
        self.time = Some(time);
        self
    }

    /// Where the bytes go; [`Encoding::AppendedBase64`] unless told otherwise.
    pub fn encoding(mut self, encoding: Encoding) -> Self {
        self.encoding = encoding;
        self
    }

    /// An array with `n_points * components` values; 1, 3 or more components.
    pub fn point_data(
        self,
        name: &'a str,
        components: usize,
        values: impl Into<Values<'a>>,
    ) -> Self {
        self.array(Section::PointData, name, components, values.into())
    }

    /// An array with `n_cells * components` values; 1, 3 or more components.
    pub fn cell_data(
        self,
        name: &'a str,
        components: usize,
        values: impl Into<Values<'a>>,
    ) -> Self {
        self.array(Section::CellData, name, components, values.into())
    }

    /// An array of the file as a whole, any number of tuples.
    pub fn field_data(
        self,
        name: &'a str,
        components: usize,
        values: impl Into<Values<'a>>,
    ) -> Self {
        self.array(Section::FieldData, name, components, values.into())
    }

    fn array(
        mut self,
        section: Section,
        name: &'a str,
        components: usize,
        values: Values<'a>,
    ) -> Self {
        self.arrays.push(NamedArray { section, name, components, values });
        self
    }

    /// Checks everything, then writes a temporary file beside `path` and renames it to `path`:
    /// after an error `path` is as it was before.
    ///
    /// # Errors
    ///
    /// No points, cells or values; a length that is not `components` times points or cells; two
    /// components; a name twice in one section, empty or with control characters; an infinity or
    /// NaN (array, index and component are named); a cell with a point that is not there; the file
    /// system.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        self.check()?;
        let io_error = |source| Error::Io { path: path.to_path_buf(), source };
        let file = RenderedFile::new(self).map_err(io_error)?;
        write_atomically(path, &file.parts())
    }

    fn check(&self) -> Result<(), Error> {
        if self.grid.points.is_empty() || self.grid.quads.is_empty() {
            return Err(Error::Empty { what: "mesh".to_owned() });
        }
        check_finite(
            Section::Points,
            "Points",
            3,
            &Values::Float64(self.grid.points.as_flattened()),
        )?;
        self.check_connectivity()?;
        let mut names = BTreeSet::new();
        if let Some(time) = self.time {
            check_finite(Section::FieldData, "TimeValue", 1, &Values::Float64(&[time]))?;
            names.insert((Section::FieldData, "TimeValue"));
        }
        for array in &self.arrays {
            self.check_array(array)?;
            if !names.insert((array.section, array.name)) {
                return Err(Error::DuplicateName {
                    section: array.section.name(),
                    name: array.name.to_owned(),
                });
            }
        }
        Ok(())
    }

    fn check_connectivity(&self) -> Result<(), Error> {
        let n_points = self.grid.points.len();
        for (cell, corners) in self.grid.quads.iter().enumerate() {
            if let Some(corner) = corners.iter().position(|&point| point as usize >= n_points) {
                return Err(Error::Connectivity { cell, corner, point: corners[corner], n_points });
            }
        }
        Ok(())
    }

    fn check_array(&self, array: &NamedArray) -> Result<(), Error> {
        let &NamedArray { section, name, components, ref values } = array;
        if name.is_empty() || name.contains(char::is_control) {
            return Err(Error::Name { section: section.name(), name: name.to_owned() });
        }
        if components == 0 || (components == 2 && section != Section::FieldData) {
            return Err(Error::Components {
                section: section.name(),
                name: name.to_owned(),
                components,
            });
        }
        if values.len() == 0 {
            return Err(Error::Empty { what: format!("{} array {name:?}", section.name()) });
        }
        let (sound, expected) = match section {
            Section::FieldData => {
                (values.len().is_multiple_of(components), format!("a multiple of {components}"))
            }
            _ => self.expected_length(section, components, values.len()),
        };
        if !sound {
            return Err(Error::Length {
                section: section.name(),
                name: name.to_owned(),
                found: values.len(),
                expected,
            });
        }
        check_finite(section, name, components, values)
    }

    fn expected_length(&self, section: Section, components: usize, found: usize) -> (bool, String) {
        let (entities, count) = match section {
            Section::PointData => ("points", self.grid.points.len()),
            _ => ("cells", self.grid.quads.len()),
        };
        let expected = format!("{count} {entities} x {components} components");
        (count.checked_mul(components) == Some(found), expected)
    }
}

fn check_finite(
    section: Section,
    name: &str,
    components: usize,
    values: &Values,
) -> Result<(), Error> {
    match values.first_not_finite() {
        None => Ok(()),
        Some((position, value)) => Err(Error::NotFinite {
            section: section.name(),
            name: name.to_owned(),
            index: position / components,
            component: position % components,
            value,
        }),
    }
}
