//! Errors of a mesh or its description.

use thiserror::Error;

/// The reason why a body cannot be meshed or a mesh is rejected.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeshError {
    /// A length that must be positive and finite is not.
    #[error("{name} is {value:?} m; it must be positive and finite", value = short(*value))]
    Length {
        /// Name of the length.
        name: &'static str,
        /// Value that was given, m.
        value: f64,
    },
    /// The elements at the contact are too large to describe the sphere.
    #[error(
        "contact element size {size:?} m is too large for a sphere of radius {radius:?} m; \
         at most a quarter of the radius, {:?} m, is allowed",
        short(radius / 4.0), radius = short(*radius), size = short(*size)
    )]
    ElementSize {
        /// Element size asked for, m.
        size: f64,
        /// Radius of the sphere, m.
        radius: f64,
    },
    /// The uniformly fine block does not fit into the sphere.
    #[error(
        "refined radius {refined_radius:?} m is too large for a sphere of radius {radius:?} m; \
         at most that radius is allowed",
        refined_radius = short(*refined_radius), radius = short(*radius)
    )]
    RefinedRadius {
        /// Half-width of the fine block, m.
        refined_radius: f64,
        /// Radius of the sphere, m.
        radius: f64,
    },
    /// The far boundary of a half-space is too near.
    #[error(
        "far radius {far_radius:?} m is too small for a refined radius of {refined_radius:?} m; at least \
         twice that, {:?} m, is needed",
        short(2.0 * refined_radius), refined_radius = short(*refined_radius), far_radius = short(*far_radius)
    )]
    FarRadius {
        /// Distance of the far boundary, m.
        far_radius: f64,
        /// Half-width of the fine block, m.
        refined_radius: f64,
    },
    /// The uniformly fine block does not fit into the plate.
    #[error(
        "a plate of thickness {thickness:?} m is too thin for its contact; at least {least:?} m is needed",
        thickness = short(*thickness), least = short(*least)
    )]
    ThinPlate {
        /// Thickness of the plate, m.
        thickness: f64,
        /// Least thickness, m.
        least: f64,
    },
    /// The rim of the plate is too near.
    #[error(
        "a plate of radius {radius:?} m is too narrow for its thickness; at least {least:?} m is needed",
        radius = short(*radius), least = short(*least)
    )]
    NarrowPlate {
        /// Radius of the plate, m.
        radius: f64,
        /// Least radius, m.
        least: f64,
    },
    /// Successive rings cannot grow by this factor.
    #[error("growth {} is not allowed; it must lie above 1 and not above 2", short(*.0))]
    Growth(f64),
    /// The mesh would have more nodes than indices.
    #[error("the mesh would have {0:.1e} elements; at most {max} can be numbered", max = u32::MAX / 2)]
    TooLarge(f64),
    /// An imported mesh is not a half disc at the required position.
    #[error("{0}")]
    Import(String),
}

/// Rounds a number of a message to five digits.
fn short(number: f64) -> f64 {
    format!("{number:.4e}").parse().unwrap_or(number)
}
