//! Writes one snapshot of a quadrilateral mesh with its data as a `.vtu`.

use std::collections::BTreeSet;
use std::path::Path;

use crate::error::Error;
use crate::values::Values;
use crate::vtk_types::Section;
use crate::write::grid::VtuGrid;
use crate::write::render::RenderedFile;
use crate::write::write_atomically;

/// Collects borrowed arrays, then validates and writes them.
///
/// Arrays are flat, tuple after tuple: `n_points * components` values for point data, `n_cells * components` for cell data.
/// Numbers keep their type, and the connectivity is `Int64`; the bytes are little-endian in zlib blocks. The first scalar
/// and the first vector of point and cell data are marked as active, so that readers show them first.
pub struct VtuWriter<'a> {
    pub(super) grid: VtuGrid<'a>,
    /// Time of the snapshot, s.
    pub(super) time: Option<f64>,
    arrays: Vec<NamedArray<'a>>,
}

/// An array to write.
pub(super) struct NamedArray<'a> {
    pub(super) section: Section,
    pub(super) name: &'a str,
    pub(super) components: usize,
    pub(super) values: Values<'a>,
}

impl<'a> VtuWriter<'a> {
    /// Creates a writer of a mesh: points in metres, and the four corners of each cell as point numbers from 0.
    pub fn new(points: &'a [[f64; 3]], quads: &'a [[u32; 4]]) -> Self {
        Self::on(&VtuGrid::new(points, quads))
    }

    /// Creates a writer on a grid that several files share.
    pub fn on(grid: &VtuGrid<'a>) -> Self {
        Self { grid: grid.clone(), time: None, arrays: Vec::new() }
    }

    /// Sets the time of the snapshot in seconds, the field data `TimeValue`.
    pub fn time(mut self, time: f64) -> Self {
        self.time = Some(time);
        self
    }

    /// Adds an array with `n_points * components` values; 1, 3 or more components.
    pub fn point_data(
        self,
        name: &'a str,
        components: usize,
        values: impl Into<Values<'a>>,
    ) -> Self {
        self.array(Section::PointData, name, components, values.into())
    }

    /// Adds an array with `n_cells * components` values; 1, 3 or more components.
    pub fn cell_data(
        self,
        name: &'a str,
        components: usize,
        values: impl Into<Values<'a>>,
    ) -> Self {
        self.array(Section::CellData, name, components, values.into())
    }

    /// Adds an array of the whole file with any number of tuples.
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

    /// Validates the arrays, writes a temporary file next to `path` and renames it to `path`: after an error `path` is
    /// unchanged.
    ///
    /// # Errors
    ///
    /// There are no points, cells or values; a length is not `components` times points or cells; an array has two
    /// components; a name is repeated in its section, empty, or has control characters; a value is not finite; a cell has
    /// a point that does not exist; or the file cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        self.check()?;
        let io_error = |source| Error::Io { path: path.to_path_buf(), source };
        let file = RenderedFile::new(self).map_err(io_error)?;
        write_atomically(path, &file.parts())
    }

    /// Returns the arrays of a section, in the order in which they were added.
    pub(super) fn of_section(&self, section: Section) -> impl Iterator<Item = &NamedArray<'a>> {
        self.arrays.iter().filter(move |array| array.section == section)
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
        let (is_valid, expected) = match section {
            Section::FieldData => {
                (values.len().is_multiple_of(components), format!("a multiple of {components}"))
            }
            _ => self.expected_length(section, components, values.len()),
        };
        if !is_valid {
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
