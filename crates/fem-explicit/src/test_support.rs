//! Helpers of the unit tests.

use fem_collision::{Approach, BodyInput};
use fem_element::{QuadGeometry, mean_gradient};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, Side, SphereMesh};
use nalgebra::{DMatrix, DVector};

use crate::body::{Body, BodyState, Clock, UnscaledMesh};
use crate::model::ExplicitBodies;
use crate::part::{Accounts, Field};
use crate::settings::Settings;
use crate::state::State;
use crate::stress::Moduli;

/// ν = 0.244 in units of density, shear modulus and so of the shear wave's speed.
pub(crate) fn unit_glass() -> Material {
    material(None)
}

/// The same with the given Prony terms (weight, relaxation time).
pub(crate) fn relaxing_glass(terms: &[(f64, f64)], acts_on: ActsOn) -> Material {
    let terms =
        terms.iter().map(|&(weight, relaxation_time)| PronyTerm { weight, relaxation_time });
    material(Some(PronySeries::new(terms.collect(), acts_on).unwrap()))
}

fn material(relaxation: Option<PronySeries>) -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(2.0 * 1.244, 0.244).unwrap();
    Material::new(1.0, moduli, relaxation).unwrap()
}

pub(crate) fn moduli(material: &Material) -> Moduli {
    Moduli::of(material.instantaneous())
}

/// Unit sphere with `n` elements over the radius, nearly uniform.
pub(crate) fn unit_sphere(n: f64, side: Side) -> SphereMesh {
    sphere(1.0 / n, 0.5, side)
}

pub(crate) fn sphere(size: f64, refined_radius: f64, side: Side) -> SphereMesh {
    HalfDisc { radius: 1.0, contact_element_size: size, refined_radius, growth: None, edge: None }
        .build()
        .unwrap()
        .on_side(side)
}

/// Settings with a far-away contact and no mass scaling.
pub(crate) fn settings() -> Settings {
    Settings {
        contact_stiffness: 1.0,
        candidate_radius: 0.3,
        step_factor: 0.9,
        mass_scaling: 0.0,
        mass_times: [1.0; 2],
    }
}

/// A sphere alone and at rest: a wall far below never meets it.
pub(crate) fn free_sphere(
    mesh: SphereMesh,
    material: Material,
    step_factor: f64,
) -> (ExplicitBodies, State) {
    let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material }];
    let approach = Approach::new([1.0, 0.0], 1e3).unwrap();
    let settings = Settings { step_factor, ..settings() };
    let model = ExplicitBodies::new(bodies, approach, &settings).unwrap();
    let mut state = State::at_first_touch(&model);
    state.bodies[0].displacement.fill([0.0; 2]);
    state.bodies[0].velocity.fill([0.0; 2]);
    (model, state)
}

/// Numbers in −1/2 .. 1/2 without pattern: the golden ratio's multiples.
pub(crate) fn noise(k: usize) -> f64 {
    (k as f64 * 0.618_033_988_749_895 + 0.29).fract() - 0.5
}

/// A field without pattern that leaves the axis on the axis.
pub(crate) fn ragged(mesh: &SphereMesh, seed: usize) -> Vec<[f64; 2]> {
    let mut field: Vec<_> = (0..mesh.nodes().len())
        .map(|k| [noise(2 * k + seed), noise(2 * k + 1 + 7 * seed)])
        .collect();
    for &node in mesh.axis() {
        field[node as usize][0] = 0.0;
    }
    field
}

pub(crate) fn geometries(mesh: &SphereMesh) -> Vec<QuadGeometry> {
    (0..mesh.quads().len()).map(|element| QuadGeometry::new(&mesh.corners(element))).collect()
}

/// Without forces on its nodes.
pub(crate) fn lumped(mesh: &SphereMesh, material: Material) -> UnscaledMesh {
    UnscaledMesh::new(mesh.clone(), material, None, Vec::new(), &[]).unwrap()
}

/// Energies and powers of the parts of a body.
pub(crate) fn accounts(body: &Body, state: &BodyState) -> Accounts {
    let mut accounts = Accounts::default();
    let clock = Clock { time: 0.0, time_step: 0.0 };
    body.add_energies(&state.motion(body, clock), &state.history, &mut accounts);
    accounts
}

/// The assembled stiffness matrix, from the element matrices.
pub(crate) fn assembled(mesh: &SphereMesh, moduli: Moduli) -> DMatrix<f64> {
    let n = 2 * mesh.nodes().len();
    let mut matrix = DMatrix::zeros(n, n);
    for (element, quad) in mesh.quads().iter().enumerate() {
        let part = mean_gradient(&QuadGeometry::new(&mesh.corners(element)))
            .combine(moduli.bulk, moduli.shear);
        let place = |i: usize| 2 * quad[i / 2] as usize + i % 2;
        for i in 0..8 {
            for j in 0..8 {
                matrix[(place(i), place(j))] += part[(i, j)];
            }
        }
    }
    matrix
}

pub(crate) fn vector(field: &Field) -> DVector<f64> {
    DVector::from_row_slice(field.as_flattened())
}

/// Largest ω² of a stiffness matrix against the masses of the bodies, by a dense eigenvalue
/// solver.
pub(crate) fn largest_eigenvalue(matrix: &DMatrix<f64>, bodies: &[&Body]) -> f64 {
    let root: Vec<f64> = bodies
        .iter()
        .flat_map(|body| body.inverse_mass.as_flattened())
        .map(|inverse| inverse.sqrt())
        .collect();
    let scaled =
        DMatrix::from_fn(root.len(), root.len(), |i, j| matrix[(i, j)] * root[i] * root[j]);
    scaled.symmetric_eigenvalues().max()
}
