//! Writes one snapshot of a quadrilateral mesh with its data as a `.vtu`.

use std::path::Path;

use crate::atomic::write_atomically;
use crate::contents::{Contents, NamedArray};
use crate::encoding::Encoding;
use crate::error::Error;
use crate::grid::VtuGrid;
use crate::render::RenderedFile;
use crate::section::Section;
use crate::values::Values;

/// Collects borrowed arrays, then checks and writes them in one go.
///
/// Arrays are flat, tuple after tuple: `n_points * components` values for point data,
/// `n_cells * components` for cell data. Numbers are written in their own
/// type, connectivity as `Int64`; bytes are little-endian in zlib blocks. The first scalar and the
/// first vector of point and cell data are marked as active, so readers show them first.
pub struct VtuWriter<'a> {
    contents: Contents<'a>,
}

impl<'a> VtuWriter<'a> {
    /// Points in metres and the four corners of each cell, point numbers from 0.
    pub fn new(points: &'a [[f64; 3]], quads: &'a [[u32; 4]]) -> Self {
        Self::on(&VtuGrid::new(points, quads))
    }

    /// On a grid that other files show too.
    pub fn on(grid: &VtuGrid<'a>) -> Self {
        let (grid, encoding) = (grid.clone(), Encoding::default());
        Self { contents: Contents { grid, time: None, encoding, arrays: Vec::new() } }
    }

    /// The snapshot's time in seconds: field data `TimeValue`.
    pub fn time(mut self, time: f64) -> Self {
        self.contents.time = Some(time);
        self
    }

    /// Where the bytes go; [`Encoding::AppendedBase64`] by default.
    pub fn encoding(mut self, encoding: Encoding) -> Self {
        self.contents.encoding = encoding;
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
        self.contents.arrays.push(NamedArray { section, name, components, values });
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
        self.contents.check()?;
        let io_error = |source| Error::Io { path: path.to_path_buf(), source };
        let file = RenderedFile::new(&self.contents).map_err(io_error)?;
        write_atomically(path, &file.parts())
    }
}
