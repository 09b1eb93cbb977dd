//! What the mesh of a body is made from: a half disc made here, or a file.

use fem_mesh::{HalfDisc, MeshError, QuarterDisc, Side, SphereMesh};

use crate::plan::Plan;
use crate::refusal::Refusal;

/// What a mesh is made from; equal ones make equal meshes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MeshSource {
    /// A sphere's, made here.
    HalfDisc(HalfDisc),
    /// A half-space's, made here.
    QuarterDisc(QuarterDisc),
    /// Read from a file.
    File(SphereMesh),
}

impl MeshSource {
    /// How many elements the mesh has, without making it.
    ///
    /// # Errors
    /// As [`HalfDisc::n_elements`].
    pub fn n_elements(&self) -> Result<usize, MeshError> {
        match self {
            Self::HalfDisc(half_disc) => half_disc.n_elements(),
            Self::QuarterDisc(quarter_disc) => quarter_disc.n_elements(),
            Self::File(mesh) => Ok(mesh.quads().len()),
        }
    }

    /// The mesh of the lower body, 0, or the upper one.
    ///
    /// # Errors
    /// As [`HalfDisc::build`].
    pub fn build(&self, body: usize) -> Result<SphereMesh, MeshError> {
        let mesh = match self {
            Self::HalfDisc(half_disc) => half_disc.build()?,
            Self::QuarterDisc(quarter_disc) => quarter_disc.build()?,
            Self::File(mesh) => mesh.clone(),
        };
        Ok(mesh.on_side(if body == 0 { Side::Below } else { Side::Above }))
    }
}

/// What the plan makes a sphere of this diameter (m) of.
pub(crate) fn half_disc(plan: &Plan, diameter: f64) -> HalfDisc {
    HalfDisc {
        radius: 0.5 * diameter,
        contact_element_size: plan.contact_element_size,
        refined_radius: plan.refined_radius,
        growth: plan.growth,
    }
}

/// What the plan makes a half-space of.
pub(crate) fn quarter_disc(plan: &Plan) -> QuarterDisc {
    QuarterDisc {
        far_radius: plan.far_radius.unwrap_or_default(),
        contact_element_size: plan.contact_element_size,
        refined_radius: plan.refined_radius,
        growth: plan.growth,
    }
}

/// The key that is to blame for a mesh that cannot be made.
pub(crate) fn mesh_refusal(error: &MeshError) -> Refusal {
    let key = match error {
        MeshError::RefinedRadius { .. } => "mesh.refined_radius",
        MeshError::Growth(_) => "mesh.growth",
        MeshError::FarRadius { .. } => "mesh.far_radius",
        _ => "mesh.contact_element_size",
    };
    let refusal = Refusal::new(key, error.to_string());
    match error {
        MeshError::TooLarge(_) => refusal.with_help("use a larger mesh.contact_element_size"),
        _ => refusal,
    }
}
