//! Errors of a mesh or its description.

use fem_material::engineering::{number, show};
use thiserror::Error;

/// The reason why a body cannot be meshed or a mesh is rejected.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeshError {
    /// A length that must be positive and finite is not.
    #[error("{name} is {value}; it must be positive and finite", value = length(*value))]
    Length {
        /// Name of the length.
        name: &'static str,
        /// Value that was given, m.
        value: f64,
    },
    /// The elements at the contact are too large to describe the sphere.
    #[error(
        "contact element size {size} is too large for a sphere of radius {radius}; \
         at most a quarter of the radius, {}, is allowed",
        length(radius / 4.0), radius = length(*radius), size = length(*size)
    )]
    ElementSize {
        /// Element size asked for, m.
        size: f64,
        /// Radius of the sphere, m.
        radius: f64,
    },
    /// The uniformly fine block does not fit into the sphere.
    #[error(
        "refined radius {refined_radius} is too large for a sphere of radius {radius}; \
         at most that radius is allowed",
        refined_radius = length(*refined_radius), radius = length(*radius)
    )]
    RefinedRadius {
        /// Half-width of the fine block, m.
        refined_radius: f64,
        /// Radius of the sphere, m.
        radius: f64,
    },
    /// The far boundary of a half-space is too near.
    #[error(
        "far radius {far_radius} is too small for a refined radius of {refined_radius}; at least \
         twice that, {}, is needed",
        length(2.0 * refined_radius), refined_radius = length(*refined_radius), far_radius = length(*far_radius)
    )]
    FarRadius {
        /// Distance of the far boundary, m.
        far_radius: f64,
        /// Half-width of the fine block, m.
        refined_radius: f64,
    },
    /// The uniformly fine block does not fit into the plate.
    #[error(
        "a plate of thickness {thickness} is too thin for its contact; at least {least} is needed",
        thickness = length(*thickness), least = length(*least)
    )]
    ThinPlate {
        /// Thickness of the plate, m.
        thickness: f64,
        /// Least thickness, m.
        least: f64,
    },
    /// The rim of the plate is too near.
    #[error(
        "a plate of radius {radius} is too narrow for its thickness; at least {least} is needed",
        radius = length(*radius), least = length(*least)
    )]
    NarrowPlate {
        /// Radius of the plate, m.
        radius: f64,
        /// Least radius, m.
        least: f64,
    },
    /// Successive rings cannot grow by this factor.
    #[error("growth {} is not allowed; it must lie above 1 and not above 2", number(*.0, 5))]
    Growth(f64),
    /// The mesh would have more nodes than indices.
    #[error("the mesh would have {0:.1e} elements; at most {max} can be numbered", max = u32::MAX / 2)]
    TooLarge(f64),
    /// An imported mesh is not a half disc at the required position.
    #[error("{0}")]
    Import(String),
}

/// Returns a length with a prefix.
fn length(metres: f64) -> String {
    show(metres, "m")
}
