//! The source of a body's mesh: a generated half disc, quarter disc or plate, or a file.

use std::f64::consts::TAU;
use std::path::Path;

use fem_case::engineering::show;
use fem_case::{Plate, PlateSupport};
use fem_material::Material;
use fem_mesh::{GradedPlate, HalfDisc, MeshError, QuarterDisc, Side, SphereMesh};

#[cfg(feature = "files")]
use fem_vtk::VtuFile;

use crate::plan::{Plan, divided_radius};
use crate::rejection::Rejection;

/// The source of a mesh. Equal sources give equal meshes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MeshSource {
    /// Generated for a sphere.
    HalfDisc(HalfDisc),
    /// Generated for a half-space.
    QuarterDisc(QuarterDisc),
    /// Generated for a plate.
    Plate(GradedPlate),
    /// Read from a file.
    File(Box<SphereMesh>),
}

impl MeshSource {
    /// Returns the number of elements without building the mesh.
    ///
    /// # Errors
    /// See [`HalfDisc::n_elements`].
    pub fn n_elements(&self) -> Result<usize, MeshError> {
        match self {
            Self::HalfDisc(half_disc) => half_disc.n_elements(),
            Self::QuarterDisc(quarter_disc) => quarter_disc.n_elements(),
            Self::Plate(plate) => plate.n_elements(),
            Self::File(mesh) => Ok(mesh.quads().len()),
        }
    }

    /// Returns whether the mesh is that of a bonded plate.
    pub fn is_bonded(&self) -> bool {
        matches!(self, Self::Plate(plate) if plate.is_bonded)
    }

    /// Builds the mesh of the lower body (0) or the upper one (1).
    ///
    /// # Errors
    /// See [`HalfDisc::build`].
    pub fn build(&self, body: usize) -> Result<SphereMesh, MeshError> {
        let mesh = match self {
            Self::HalfDisc(half_disc) => half_disc.build()?,
            Self::QuarterDisc(quarter_disc) => quarter_disc.build()?,
            Self::Plate(plate) => plate.build()?,
            Self::File(mesh) => mesh.as_ref().clone(),
        };
        Ok(mesh.on_side(if body == 0 { Side::Below } else { Side::Above }))
    }
}

/// Returns the half disc that the plan chooses for a sphere of this diameter (m), lower (0) or upper (1).
pub(crate) fn half_disc(plan: &Plan, side: usize, diameter: f64) -> HalfDisc {
    HalfDisc {
        radius: 0.5 * diameter,
        contact_element_size: plan.element_sizes()[side],
        refined_radius: plan.refined_radius,
        growth: plan.growth,
        edge: plan.contact_edge(),
    }
}

/// Returns the quarter disc that the plan chooses for a half-space, lower (0) or upper (1).
pub(crate) fn quarter_disc(plan: &Plan, side: usize) -> QuarterDisc {
    QuarterDisc {
        far_radius: plan.far_radius.unwrap_or_default(),
        contact_element_size: plan.element_sizes()[side],
        refined_radius: plan.refined_radius,
        growth: plan.growth,
        edge: plan.contact_edge(),
    }
}

/// The rings of a plate's mesh with a number of elements across the contact.
struct Rings {
    across: f64,
    /// Rings per length of the bending waves of the frequency 1/T, T the contact time.
    per_bending_wave: f64,
    /// Rings per distance that shear waves travel in the contact time.
    per_shear_wave: f64,
}

/// Half as many rings per bending wave change the restitution by up to 0.002, twice as many by 0.0005.
const RINGS: Rings = Rings { across: 6.0, per_bending_wave: 80.0, per_shear_wave: 40.0 };

/// Returns the mesh that the plan chooses for a plate, lower (0) or upper (1). A plate that ends before waves from its edge
/// matter is meshed to its free edge, a wider one to the far radius.
pub(crate) fn graded_plate(
    plan: &Plan,
    side: usize,
    plate: &Plate,
    material: &Material,
) -> GradedPlate {
    let own_radius = plate.diameter.map_or(f64::INFINITY, |diameter| 0.5 * diameter);
    // A contact that lasts on a plate begins with waves as short as those of a free one.
    let time = plan.estimate.contact_time.min(plan.estimate.hertz.contact_time());
    let moduli = material.instantaneous();
    // k⁴ = ω²ρh/D.
    let inertia_per_stiffness =
        12.0 * material.density() / (moduli.plane_strain_modulus() * plate.thickness.powi(2));
    let bending_wave = (TAU * time).sqrt() / inertia_per_stiffness.powf(0.25);
    let shear_wave = material.shear_wave_speed() * time;
    let coarseness = RINGS.across * plan.contact_element_size / divided_radius(&plan.estimate);
    GradedPlate {
        thickness: plate.thickness,
        radius: plan.far_radius.unwrap_or(own_radius),
        has_held_rim: plan.far_radius.is_some(),
        is_bonded: plate.support == PlateSupport::Bonded,
        contact_element_size: plan.element_sizes()[side],
        refined_radius: plan.refined_radius,
        growth: plan.growth,
        ring_width: coarseness
            * (bending_wave / RINGS.per_bending_wave).min(shear_wave / RINGS.per_shear_wave),
        edge: plan.contact_edge(),
    }
}

/// Returns the rejection of a mesh of the lower (0) or upper (1) body that cannot be generated, with the key that causes it.
/// A plate that is too thin needs another model, by its material and by whether it is bonded.
pub(crate) fn mesh_rejection(
    error: &MeshError,
    side: usize,
    material: &Material,
    is_bonded: bool,
) -> Rejection {
    let of_plate =
        |key: &str| Rejection::new(format!("body.{side}.plate.{key}"), error.to_string());
    let key = match error {
        MeshError::ThinPlate { .. } => {
            return of_plate("thickness").with_help(match (is_bonded, material.flow()) {
                (true, _) => "no model computes a thinner bonded plate; at a lower speed or with a smaller body the contact is smaller",
                (false, Some(_)) => "use law mean_pressure, which computes the flow of a body on a thin plate",
                (false, None) => "use model ting",
            });
        }
        MeshError::NarrowPlate { radius, least } => {
            let [diameter, least] = [radius, least].map(|radius| show(2.0 * radius, "m"));
            let message = format!(
                "a plate with a diameter of {diameter} is too narrow for its thickness; at least {least} is needed"
            );
            let help = "elements need three thicknesses; without diameter the plate has no edge, and no waves come back from there";
            return Rejection::new(format!("body.{side}.plate.diameter"), message).with_help(help);
        }
        MeshError::RefinedRadius { .. } => "mesh.refined_radius",
        MeshError::Growth(_) => "mesh.growth",
        MeshError::FarRadius { .. } => "mesh.far_radius",
        _ => "mesh.contact_element_size",
    };
    let rejection = Rejection::new(key, error.to_string());
    match error {
        MeshError::TooLarge(_) => rejection.with_help("use a larger mesh.contact_element_size"),
        _ => rejection,
    }
}

/// Reads the mesh of a sphere of this diameter (m) from a file, for the lower body (0) or the upper one (1).
pub(crate) fn import(k: usize, diameter: f64, path: &Path) -> Result<SphereMesh, Rejection> {
    read_sphere(diameter, path).map_err(|found| {
        let rejection = Rejection::new(format!("body.{k}.sphere.mesh"), format!("mesh {found}"));
        rejection.with_help(
            "a .vtu file of quadrilaterals in the plane (r, y, 0), in metres: the half disc \
             r >= 0 of the sphere with its contact pole at the origin; \
             `fem-run mesh CASE` writes such files, `meshio convert` makes them of gmsh's",
        )
    })
}

/// Reads the mesh, or describes the fault of the file.
#[cfg(feature = "files")]
fn read_sphere(diameter: f64, path: &Path) -> Result<SphereMesh, String> {
    let fault = |fault: String| format!("{}: {fault}", path.display());
    let bytes = fem_case::read_data_file(path).map_err(|error| fault(error.to_string()))?;
    let file = VtuFile::from_bytes(path, bytes);
    let mesh = file.and_then(|file| file.quad_mesh()).map_err(|error| error.to_string())?;
    if let Some(point) = mesh.points.iter().find(|point| point[2].abs() > 1e-6 * diameter) {
        return Err(fault(format!(
            "a point lies at z = {}, off the plane z = 0",
            show(point[2], "m")
        )));
    }
    let nodes = mesh.points.iter().map(|point| [point[0], point[1]]).collect();
    SphereMesh::import(0.5 * diameter, nodes, mesh.quads).map_err(|error| fault(error.to_string()))
}

#[cfg(not(feature = "files"))]
fn read_sphere(_: f64, path: &Path) -> Result<SphereMesh, String> {
    Err(format!("{}: no files are read here", path.display()))
}

/// Returns the length of the longest surface edge of both bodies that begins inside a contact of this radius, m.
pub(crate) fn longest_contact_edge(
    meshes: [Option<&SphereMesh>; 2],
    contact_radius: f64,
) -> Option<f64> {
    let edges = meshes.into_iter().flatten().flat_map(|mesh| {
        let ends = mesh.surface().windows(2).map(|ends| [ends[0], ends[1]]);
        let ends = ends.map(|ends| ends.map(|node| mesh.nodes()[node as usize]));
        // The first edge of each mesh is always inside.
        let is_in = move |(k, [p, _]): &(usize, [[f64; 2]; 2])| *k == 0 || p[0] < contact_radius;
        ends.enumerate().take_while(is_in).map(|(_, [p, q])| (q[0] - p[0]).hypot(q[1] - p[1]))
    });
    edges.reduce(f64::max)
}
