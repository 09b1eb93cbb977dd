//! Meshes of the unit tests.

use fem_mesh::{HalfDisc, Side, SphereMesh};

pub(crate) fn sphere(radius: f64, size: f64, refined_radius: f64, side: Side) -> SphereMesh {
    HalfDisc { radius, contact_element_size: size, refined_radius, growth: None, edge: None }
        .build()
        .unwrap()
        .on_side(side)
}
