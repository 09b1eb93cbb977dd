//! The contact patch test: two elastic bodies with non-matching meshes, pressed flat onto each
//! other, transfer a uniform pressure exactly.
//!
//! Spheres so large that their surface is flat over the patch are in the uniform state σ_yy = −p,
//! all other stresses 0, and overlap by the depth at which the penalty makes the pressure p.
//! Within the patch, each relative to p times the node's area ∫ N 2πr dr:
//! `node_force`, the largest difference of a nodal contact force from that load; `equilibrium`, the
//! largest sum of contact and internal force. It also measures `balance`, the sum of all contact forces of
//! both bodies over that of one; `pressure`, the largest difference of the recovered nodal pressure
//! from p, over p. Each is the worst of all pairs of meshes.

use fem_contact::{ContactInterface, Surface};
use fem_explicit::FreeMotion;
use fem_material::{ElasticModuli, Material};
use fem_mesh::{HalfDisc, Side, SphereMesh, segment_measures};
use serde::Deserialize;

use crate::{Findings, Laboratory, StudyError};

/// Radius of the sphere over that of the patch; height and slope of its surface within the patch are of order 1e-9.
const SPHERE_RADIUS: f64 = 1e9;
const POISSONS_RATIO: f64 = 0.3;
/// Pressure over Young's modulus, p/E.
const STRAIN: f64 = 1e-3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Element sizes of the lower and the upper body over the radius of the patch.
    element_sizes: Vec<[f64; 2]>,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let mut findings = Findings::new();
    for &sizes in &parameters.element_sizes {
        laboratory.work(|| Ok((press(&mut findings, sizes)?, 0)))?;
    }
    Ok(findings)
}

/// Tests one pair that overlaps by 1, with E = 1.
fn press(findings: &mut Findings, sizes: [f64; 2]) -> Result<(), StudyError> {
    let mut lower = body(sizes[0], Side::Below)?;
    let mut upper = body(sizes[1], Side::Above)?;
    let squeezed =
        |offset: f64| move |[r, y]: [f64; 2]| [POISSONS_RATIO * STRAIN * r, offset - STRAIN * y];
    lower.set_displacement(squeezed(0.5));
    upper.set_displacement(squeezed(-0.5));
    let bodies = [&lower, &upper];
    let [Some(lower_mesh), Some(upper_mesh)] = bodies.map(|body| body.body().mesh()) else {
        return Err(StudyError::parameters("a body has no mesh"));
    };
    let stiffness = STRAIN * 0.5 * (sizes[0] + sizes[1]);
    let surfaces = [Surface::of_sphere(lower_mesh), Surface::of_sphere(upper_mesh)];
    let [below, above] = surfaces;
    let interface = ContactInterface::new(below, above, stiffness, 0.0, 1.0)
        .map_err(|error| StudyError::Model(error.into()))?;
    let u = bodies.map(FreeMotion::displacement);
    let mut forces = u.map(|u| vec![[0.0; 2]; u.len()]);
    let [on_lower, on_upper] = &mut forces;
    let total = interface.add_forces(u, [on_lower, on_upper]);
    for (side, mesh) in [lower_mesh, upper_mesh].into_iter().enumerate() {
        let direction = if side == 0 { -1.0 } else { 1.0 };
        for (node, area) in loaded_nodes(mesh, interface.candidate_radius()) {
            let (contact, internal) = (forces[side][node], bodies[side].internal_forces()[node]);
            let load = STRAIN * area;
            findings.measure_worst("node_force", (contact[1] / load - direction).abs());
            let rest = (contact[1] + internal[1]).hypot(internal[0] * f64::from(node > 0));
            findings.measure_worst("equilibrium", rest / load);
        }
    }
    let sum: f64 = forces.iter().flatten().map(|force| force[1]).sum();
    findings.measure_worst("balance", sum.abs() / total.force);
    for (_, pressure) in interface.nodal_pressure(u) {
        findings.measure_worst("pressure", (pressure / STRAIN - 1.0).abs());
    }
    Ok(())
}

fn body(size: f64, side: Side) -> Result<FreeMotion, StudyError> {
    let disc = HalfDisc {
        radius: SPHERE_RADIUS,
        contact_element_size: size,
        // Elements farther out have another size and so another penalty.
        refined_radius: 1.0 + 3.0 * size,
        growth: None,
        edge: None,
    };
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(1.0, POISSONS_RATIO)?;
    Ok(FreeMotion::new(disc.build()?.on_side(side), &Material::new(1.0, moduli, None)?, 1.0)?)
}

/// Returns the nodes whose segments are all loaded, from the axis outward, with ∫ N 2πr dr.
fn loaded_nodes(mesh: &SphereMesh, radius: f64) -> Vec<(usize, f64)> {
    let surface = mesh.surface();
    let r = |k: usize| mesh.nodes()[surface[k] as usize][0];
    let share = |k: usize, end: usize| segment_measures([r(k), 0.0], [r(k + 1), 0.0])[end];
    (0..surface.len() - 1)
        .take_while(|&k| r(k + 1) <= radius * (1.0 + 1e-9))
        .map(|k| {
            let inside = if k > 0 { share(k - 1, 1) } else { 0.0 };
            (surface[k] as usize, inside + share(k, 0))
        })
        .collect()
}
