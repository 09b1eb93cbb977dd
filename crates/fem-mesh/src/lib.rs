//! Graded axisymmetric quadrilateral meshes of spheres, half-spaces and plates.
//!
//! A sphere is meshed through its meridian half disc in coordinates (r, y):
//! r radial, y along the axis of revolution. Every mesh of this crate has its
//! contact pole at the origin, the sphere's centre on the axis, and knows two
//! boundary curves: the axis and the surface, both ordered from the contact
//! pole to the far pole.
//!
//! * [`HalfDisc`]: the graded mesh of a sphere, fine at the contact pole;
//! * [`QuarterDisc`]: a half-space, fine at the contact, out to any distance;
//! * [`GradedPlate`]: a plate, fine at the contact, out to its rim;
//! * [`SphereMesh::import`]: a sphere from foreign nodes and quads, checked;
//! * [`SphereMesh`]: nodes, quads, boundary curves and tributary measures;
//! * [`Quality`]: measures of the quality of a mesh.

mod contact_edge;
mod error;
mod graded_plate;
mod half_disc;
mod import;
mod measures;
mod quality;
mod quarter_disc;
mod rings;
mod sphere_mesh;

pub use error::MeshError;
pub use graded_plate::GradedPlate;
pub use half_disc::HalfDisc;
pub use measures::{cap_volume, lump_mass, segment_measures, sphere_volume};
pub use quality::Quality;
pub use quarter_disc::QuarterDisc;
pub use sphere_mesh::{Side, SphereMesh};
