//! Patch tests of a meshed sphere: a rigid motion causes no strain, and a uniform pressure on its surface is balanced
//! by a uniform stress.
//!
//! Measures `translation`, the largest nodal force of a rigid translation by the radius over that of a strain
//! of 1; `load`, the largest difference of the nodal forces of u = −p x/3K from the consistent loads
//! ∫ N p n dA of the boundary, over the largest of these; `stress` and `recovered`, the largest
//! difference of element and nodal stress from −p I, over p. Each is the worst of all meshes and
//! Poisson's ratios.

use std::f64::consts::PI;

use fem_collision::nan_aware_max_abs;
use fem_explicit::FreeMotion;
use fem_material::{ElasticModuli, Material};
use fem_mesh::{HalfDisc, Side, SphereMesh};
use serde::Deserialize;

use crate::{Findings, Laboratory, StudyError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    poissons_ratios: Vec<f64>,
    meshes: Vec<Graded>,
}

/// Sizes over the radius.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Graded {
    element_size: f64,
    refined_radius: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let mut findings = Findings::new();
    for graded in &parameters.meshes {
        for &nu in &parameters.poissons_ratios {
            for side in [Side::Below, Side::Above] {
                let sphere = laboratory.work(|| Ok((unit_sphere(graded, nu, side)?, 0)))?;
                measure(&mut findings, sphere);
            }
        }
    }
    Ok(findings)
}

/// Radius, density and bulk modulus are 1.
fn unit_sphere(graded: &Graded, nu: f64, side: Side) -> Result<FreeMotion, StudyError> {
    let youngs_modulus = 3.0 * (1.0 - 2.0 * nu);
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(youngs_modulus, nu)?;
    let disc = HalfDisc {
        radius: 1.0,
        contact_element_size: graded.element_size,
        refined_radius: graded.refined_radius,
        growth: None,
        edge: None,
    };
    Ok(FreeMotion::new(disc.build()?.on_side(side), &Material::new(1.0, moduli, None)?, 1.0)?)
}

fn measure(findings: &mut Findings, mut sphere: FreeMotion) {
    // The displacement u = −x/3 is a dilatation of −1; its centre is not that of the sphere.
    sphere.set_displacement(|[r, y]| [-r / 3.0, -(y - 0.3) / 3.0]);
    let loads = sphere.body().mesh().map(pressure_loads).unwrap_or_default();
    let largest_load = largest(&loads);
    // The internal forces balance the load.
    let rest: Vec<[f64; 2]> = (sphere.internal_forces().iter().zip(&loads))
        .map(|(force, load)| [force[0] + load[0], force[1] + load[1]])
        .collect();
    let rest = inside_of_axis(&sphere, rest);
    findings.measure_worst("load", largest(&rest) / largest_load);
    let stress = sphere.stress();
    let off = |stress: &[[f64; 4]]| {
        let exact = [-1.0, -1.0, -1.0, 0.0];
        let differences =
            stress.iter().flat_map(|s| s.iter().zip(exact).map(|(s, exact)| (s - exact).abs()));
        differences.fold(0.0, nan_aware_max_abs)
    };
    findings.measure_worst("stress", off(&stress.cells));
    findings.measure_worst("recovered", off(&stress.points));
    sphere.set_displacement(|_| [0.0, 1.0]);
    findings.measure_worst("translation", largest(sphere.internal_forces()) / largest_load);
}

/// Returns the consistent loads of a unit pressure: over a straight piece of boundary from (r₁, y₁) to
/// (r₂, y₂), with the body to its left as seen from outside, ∫ N n 2πr ds = 2π (2r₁+r₂)/6 (∓Δy, ±Δr).
fn pressure_loads(mesh: &SphereMesh) -> Vec<[f64; 2]> {
    let mut loads = vec![[0.0; 2]; mesh.nodes().len()];
    let inward = if mesh.side() == Side::Above { 1.0 } else { -1.0 };
    for piece in mesh.surface().windows(2) {
        let [start, end] = [piece[0], piece[1]].map(|node| mesh.nodes()[node as usize]);
        let normal = [-inward * (end[1] - start[1]), inward * (end[0] - start[0])];
        for (node, near, far) in [(piece[0], start[0], end[0]), (piece[1], end[0], start[0])] {
            let share = 2.0 * PI * (2.0 * near + far) / 6.0;
            let load = &mut loads[node as usize];
            *load = [load[0] + share * normal[0], load[1] + share * normal[1]];
        }
    }
    loads
}

/// Removes the radial forces on the axis, where symmetry holds the nodes.
fn inside_of_axis(sphere: &FreeMotion, mut forces: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    for &node in sphere.body().mesh().map_or(&[][..], SphereMesh::axis) {
        forces[node as usize][0] = 0.0;
    }
    forces
}

fn largest(field: &[[f64; 2]]) -> f64 {
    field.iter().map(|f| f[0].hypot(f[1])).fold(0.0, nan_aware_max_abs)
}
