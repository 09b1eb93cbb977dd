//! Writes and reads VTK XML files of quadrilateral meshes, without a VTK library.
//!
//! Writing: [`VtuWriter`] writes one `.vtu` (`UnstructuredGrid` of `VTK_QUAD` cells) per snapshot, a series on one
//! [`VtuGrid`]. [`write_collection`] writes a `.pvd` and a `.vtu.series` with the times of the files. They are for
//! ParaView ≥ 5.11, VTK ≥ 9.2 and meshio 5.3; `.ci/check_vtk.py` reads them with the last two.
//!
//! Reading: [`read_quad_mesh`] reads a `.vtu` of quadrilaterals from ParaView, VTK, meshio or this crate, and
//! [`VtuFile`] any named array of such a file. Lengths in a file are compared with its bytes before anything is
//! allocated.
//!
//! Format: the *VTK File Formats* document, "XML File Formats", version 1.0 (`UInt64` headers).
//!
//! ```
//! use fem_vtk::{VtuFile, VtuWriter};
//!
//! let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
//! let quads = [[0, 1, 2, 3]];
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("square.vtu");
//! VtuWriter::new(&points, &quads)
//!     .time(1.5e-6)
//!     .point_data("displacement", 3, &[0.0; 12])
//!     .cell_data("body", 1, &[0_i32])
//!     .write(&path)?;
//!
//! let file = VtuFile::open(&path)?;
//! assert_eq!(file.quad_mesh()?.quads, quads);
//! assert_eq!(file.field_data("TimeValue")?.as_float(), Some(&[1.5e-6][..]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blocks;
mod error;
mod read;
mod values;
mod vtk_types;
mod write;

pub use error::Error;
pub use read::reader::{QuadMesh, ReadArray, VtuFile, read_quad_mesh};
pub use values::{Numbers, Values, pad_vectors};
pub use write::collection::write_collection;
pub use write::grid::VtuGrid;
pub use write::writer::VtuWriter;
