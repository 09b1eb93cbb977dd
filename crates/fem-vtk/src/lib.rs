//! VTK XML files of quadrilateral meshes: an own writer and reader, no VTK library.
//!
//! Writing: one `.vtu` (`UnstructuredGrid` of `VTK_QUAD` cells) a snapshot with [`VtuWriter`] (a
//! series on one [`VtuGrid`]), and a `.pvd` with its `.vtu.series` twin that gives the files their
//! times with [`write_collection`]. They are for ParaView ≥ 5.11, VTK ≥ 9.2 and meshio 5.3;
//! `.ci/check_vtk.py` reads them with the last two.
//!
//! Reading: a `.vtu` of quadrilaterals from ParaView, VTK, meshio or this crate with
//! [`read_quad_mesh`], and any named array of such a file with [`VtuFile`]. Lengths that a file
//! states are checked against the bytes that it has, before anything is allocated.
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

mod atomic;
mod blocks;
mod collection;
mod contents;
mod decode;
mod document;
mod encoding;
mod error;
mod grid;
mod reader;
mod render;
mod scalar_type;
mod section;
mod values;
mod writer;

pub use collection::write_collection;
pub use encoding::Encoding;
pub use error::Error;
pub use grid::VtuGrid;
pub use reader::{QuadMesh, ReadArray, VtuFile, read_quad_mesh};
pub use values::{Numbers, Values, pad_vectors};
pub use writer::VtuWriter;
