//! The mesh of a `.vtu`, compressed once for all files that show it.

use std::io;
use std::sync::{Arc, OnceLock};

use crate::blocks::{Compressed, compress};
use crate::values::Values;

/// The cell type of a four-node quadrilateral, `VTK_QUAD`.
pub(crate) const VTK_QUAD: u8 = 9;

/// Points and quadrilaterals that several files share.
///
/// A series of snapshots repeats its mesh in every file; its arrays, half of what can be compressed,
/// are compressed with the first of them.
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
    /// Points in metres and the four corners of each cell, point numbers from 0.
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
