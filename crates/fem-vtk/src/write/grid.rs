//! The mesh of a series of `.vtu` files, compressed once.

use std::io;
use std::sync::{Arc, OnceLock};

use crate::blocks::{Compressed, compress};
use crate::values::Values;
use crate::vtk_types::VTK_QUAD;

/// Points and quadrilaterals that several files share.
///
/// A series of snapshots repeats its mesh in every file. The arrays of the mesh, half of the bytes, are compressed only
/// for the first file.
#[derive(Clone, Debug)]
pub struct VtuGrid<'a> {
    pub(crate) points: &'a [[f64; 3]],
    pub(crate) quads: &'a [[u32; 4]],
    /// Shared by all copies.
    compressed: Arc<OnceLock<CompressedGrid>>,
}

/// The arrays of the sections `Points` and `Cells`.
#[derive(Debug)]
pub(crate) struct CompressedGrid {
    pub(crate) points: Compressed,
    pub(crate) connectivity: Compressed,
    pub(crate) offsets: Compressed,
    pub(crate) types: Compressed,
}

impl<'a> VtuGrid<'a> {
    /// Creates a grid: points in metres, and the four corners of each cell as point numbers from 0.
    pub fn new(points: &'a [[f64; 3]], quads: &'a [[u32; 4]]) -> Self {
        Self { points, quads, compressed: Arc::default() }
    }

    pub(crate) fn compressed(&self) -> io::Result<&CompressedGrid> {
        if let Some(made) = self.compressed.get() {
            return Ok(made);
        }
        let made = self.compress()?;
        Ok(self.compressed.get_or_init(|| made))
    }

    fn compress(&self) -> io::Result<CompressedGrid> {
        let connectivity: Vec<i64> =
            self.quads.as_flattened().iter().map(|&point| point.into()).collect();
        let offsets: Vec<i64> = (1..=self.quads.len() as i64).map(|cell| 4 * cell).collect();
        let types = vec![VTK_QUAD; self.quads.len()];
        let array = |values: Values| compress(&values.to_le_bytes());
        Ok(CompressedGrid {
            points: array(Values::Float64(self.points.as_flattened()))?,
            connectivity: array(Values::Int64(&connectivity))?,
            offsets: array(Values::Int64(&offsets))?,
            types: array(Values::UInt8(&types))?,
        })
    }
}
