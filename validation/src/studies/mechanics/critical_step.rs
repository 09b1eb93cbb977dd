//! The critical time step against the exact largest eigenvalue.
//!
//! Small pairs of spheres are assembled from the element matrices, with the springs of a contact that
//! is closed over all candidates; the largest ω² of K x = ω² M x comes from a dense solver. The ratio
//! is the critical step that a model assumes over 2/ω_max. `free.largest` and `free.smallest` are its
//! extremes over single bodies without contact, `closed.largest` and `closed.smallest` over pairs in
//! contact, and `counted.largest` and `counted.smallest` over pairs whose springs are stiffer by the number of times that
//! the bound counts them. `rigid_motions` is the largest number of motions of a single body
//! without energy.

use faer::{Mat, Side as Triangle};
use fem_collision::{Approach, BodyInput};
use fem_element::{QuadGeometry, mean_gradient};
use fem_explicit::{Body, ExplicitBodies, FreeMotion, Settings};
use fem_figure::{Axis, Chart, Curve, GREY};
use fem_material::{ElasticModuli, Material};
use fem_mesh::{HalfDisc, Side, SphereMesh};
use rayon::prelude::*;
use serde::Deserialize;

use crate::{Findings, Laboratory, StudyError, run::no_springs};

/// Half-width of the block in elements, so that few elements reach any size.
const BLOCK: f64 = 2.0;
/// Eigenvalues below this share of the largest belong to motions without energy.
const NO_ENERGY: f64 = 1e-10;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    poissons_ratio: f64,
    element_sizes: Vec<[f64; 2]>,
    penalty_factors: Vec<f64>,
    /// Added mass over mass.
    mass_scaling: Vec<f64>,
    /// Number of times that the bound counts each spring.
    spring_count: f64,
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(
        2.0 * (1.0 + parameters.poissons_ratio),
        parameters.poissons_ratio,
    )?;
    let material = Material::new(1.0, moduli, None)?;
    let mut findings = Findings::new();
    for &size in parameters.element_sizes.iter().flatten() {
        let (ratio, n_rigid) = laboratory.work(|| Ok((alone(&material, size)?, 0)))?;
        extremes(&mut findings, "free", ratio);
        findings.measure_worst("rigid_motions", n_rigid as f64);
    }
    let mut chart = Chart::new(
        Axis::new("penalty factor").logarithmic(),
        Axis::new("critical step / 2/ω max").from_to(0.0, 1.05),
    );
    for &scaling in &parameters.mass_scaling {
        for &sizes in &parameters.element_sizes {
            let ratios = |&penalty: &f64| {
                let pair = Pair { material: &material, sizes, penalty, scaling };
                laboratory.work(|| Ok((pair.ratios(parameters.spring_count)?, 0)))
            };
            let ratios: Vec<[f64; 2]> = (parameters.penalty_factors.par_iter().map(ratios))
                .collect::<Result<_, StudyError>>()?;
            for [closed, counted] in &ratios {
                extremes(&mut findings, "closed", *closed);
                extremes(&mut findings, "counted", *counted);
            }
            let closed = ratios.iter().map(|ratios| ratios[0]);
            let points = parameters.penalty_factors.iter().copied().zip(closed).collect();
            let [lower, upper] = sizes;
            let label = format!("elements {lower} and {upper} R, added mass {scaling}");
            chart = chart.with(Curve::points_on_line(label, points));
        }
    }
    let limit = parameters.penalty_factors.iter().map(|&penalty| (penalty, 1.0)).collect();
    let chart = chart.with(Curve::dashed("limit of stability", limit).coloured(GREY));
    let caption = "The critical step that a model assumes over the true one, with a closed contact. \
                   Above 1 it would be unstable. Contact springs are counted four times, for points \
                   that open and close: where they decide, the step is about half of the true one.";
    findings.draw("ratio", caption, &[chart]);
    Ok(findings)
}

fn extremes(findings: &mut Findings, name: &str, ratio: f64) {
    findings.measure_worst(&format!("{name}.largest"), ratio);
    let smallest = format!("{name}.smallest");
    let so_far = findings.quantities.get(&smallest).copied().unwrap_or(f64::INFINITY);
    // `max` would drop a NaN.
    findings.measure(smallest, if so_far <= ratio { so_far } else { ratio });
}

fn sphere(size: f64, side: Side) -> Result<SphereMesh, StudyError> {
    let disc = HalfDisc {
        radius: 1.0,
        contact_element_size: size,
        refined_radius: BLOCK * size,
        growth: None,
        edge: None,
    };
    Ok(disc.build()?.on_side(side))
}

/// Returns the ratio of one body without contact, and the number of motions without energy.
fn alone(material: &Material, size: f64) -> Result<(f64, usize), StudyError> {
    let motion = FreeMotion::new(sphere(size, Side::Above)?, material, 1.0)?;
    let eigenvalues = eigenvalues(&Assembly::of(&[motion.body()], material))?;
    let largest = eigenvalues[eigenvalues.len() - 1];
    let n_rigid = eigenvalues.iter().filter(|value| value.abs() < NO_ENERGY * largest).count();
    Ok((motion.time_step() * largest.sqrt() / 2.0, n_rigid))
}

struct Pair<'a> {
    material: &'a Material,
    sizes: [f64; 2],
    penalty: f64,
    /// Added mass over mass.
    scaling: f64,
}

impl Pair<'_> {
    fn model(&self) -> Result<ExplicitBodies, StudyError> {
        let body = |k: usize, side: Side| {
            let (mesh, material) = (sphere(self.sizes[k], side)?, self.material.clone());
            Ok::<_, StudyError>(BodyInput::Sphere { mesh, material })
        };
        let contact_modulus = 0.5 * self.material.instantaneous().plane_strain_modulus();
        let settings = Settings {
            contact_stiffness: self.penalty * contact_modulus,
            candidate_radius: BLOCK * self.sizes[0].max(self.sizes[1]),
            step_factor: 1.0,
            mass_scaling: self.scaling,
            mass_times: [1.0; 2],
        };
        let bodies = [body(0, Side::Below)?, body(1, Side::Above)?];
        Ok(ExplicitBodies::new(bodies, Approach::at(1.0)?, &settings)?)
    }

    /// Returns the ratio with all candidates closed, and that with springs stiffer by a factor.
    fn ratios(&self, spring_count: f64) -> Result<[f64; 2], StudyError> {
        let model = self.model()?;
        let [lower, upper] = model.bodies();
        let mut assembly = Assembly::of(&[lower, upper], self.material);
        let mut ratio = |more_springs: f64| {
            assembly.add_contact(&model, more_springs)?;
            let eigenvalues = eigenvalues(&assembly)?;
            Ok::<_, StudyError>(model.time_step() * eigenvalues[eigenvalues.len() - 1].sqrt() / 2.0)
        };
        Ok([ratio(1.0)?, ratio(spring_count - 1.0)?])
    }
}

/// Stiffness and 1/√mass by degree of freedom; fixed degrees have an infinite mass.
struct Assembly {
    stiffness: Mat<f64>,
    inverse_root_mass: Vec<f64>,
    /// First degree of freedom of each body.
    first: Vec<usize>,
}

impl Assembly {
    fn of(bodies: &[&Body], material: &Material) -> Self {
        let mut inverse_root_mass = Vec::new();
        let mut first = Vec::new();
        for body in bodies {
            first.push(inverse_root_mass.len());
            let begin = inverse_root_mass.len();
            inverse_root_mass.extend(body.nodal_mass().iter().flat_map(|m| [m.sqrt().recip(); 2]));
            for &node in body.mesh().map_or(&[][..], SphereMesh::axis) {
                inverse_root_mass[begin + 2 * node as usize] = 0.0;
            }
        }
        let n = inverse_root_mass.len();
        let mut stiffness = Mat::zeros(n, n);
        let moduli = material.instantaneous();
        for (body, first) in bodies.iter().zip(&first) {
            let Some(mesh) = body.mesh() else { continue };
            for (element, quad) in mesh.quads().iter().enumerate() {
                let part = mean_gradient(&QuadGeometry::new(&mesh.corners(element)))
                    .combine(moduli.bulk_modulus(), moduli.shear_modulus());
                let place = |i: usize| first + 2 * quad[i / 2] as usize + i % 2;
                for i in 0..8 {
                    for j in 0..8 {
                        stiffness[(place(i), place(j))] += part[(i, j)];
                    }
                }
            }
        }
        Self { stiffness, inverse_root_mass, first }
    }

    /// Adds the springs of all candidates times a factor, from the forces of a deep penetration, which are
    /// linear.
    fn add_contact(&mut self, model: &ExplicitBodies, times: f64) -> Result<(), StudyError> {
        let springs = model.interface().ok_or_else(no_springs)?;
        let deep = |n: usize, u: f64| vec![[0.0, u]; n];
        let n_nodes = model.bodies().each_ref().map(|body| body.nodal_mass().len());
        let forces = |u: &[Vec<[f64; 2]>; 2]| {
            let mut forces = n_nodes.map(|n| deep(n, 0.0));
            let [lower, upper] = &mut forces;
            springs.add_forces([&u[0], &u[1]], [lower, upper]);
            forces
        };
        // A penetration of one radius is varied by a hundredth.
        let mut u = [deep(n_nodes[0], 0.0), deep(n_nodes[1], -1.0)];
        let before = forces(&u);
        let step = 0.01;
        for side in 0..2 {
            for node in springs.candidate_nodes(side) {
                let node = node as usize;
                u[side][node][1] += step;
                let after = forces(&u);
                u[side][node][1] -= step;
                let column = self.first[side] + 2 * node + 1;
                for other in 0..2 {
                    for (k, (a, b)) in after[other].iter().zip(&before[other]).enumerate() {
                        let row = self.first[other] + 2 * k + 1;
                        self.stiffness[(row, column)] -= times * (a[1] - b[1]) / step;
                    }
                }
            }
        }
        Ok(())
    }
}

/// Returns ω² of M^(−1/2) K M^(−1/2) in ascending order, without those of fixed degrees of freedom.
fn eigenvalues(assembly: &Assembly) -> Result<Vec<f64>, StudyError> {
    let free: Vec<usize> = (0..assembly.inverse_root_mass.len())
        .filter(|&i| assembly.inverse_root_mass[i] > 0.0)
        .collect();
    let scaled = Mat::from_fn(free.len(), free.len(), |i, j| {
        let (i, j) = (free[i], free[j]);
        let mean = 0.5 * (assembly.stiffness[(i, j)] + assembly.stiffness[(j, i)]);
        mean * assembly.inverse_root_mass[i] * assembly.inverse_root_mass[j]
    });
    let values = scaled.self_adjoint_eigenvalues(Triangle::Lower);
    values.map_err(|error| StudyError::parameters(format!("no eigenvalues: {error:?}")))
}
