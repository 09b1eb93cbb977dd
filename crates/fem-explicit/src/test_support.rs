//! Helpers of the unit tests.

use fem_collision::{Account, Approach, BodyInput};
use fem_element::{QuadGeometry, mean_gradient};
use fem_material::finite::HyperelasticLaw;
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};
use fem_mesh::{HalfDisc, Side, SphereMesh};
use nalgebra::{DMatrix, DVector};

use crate::body::{Body, BodyState, Clock, UnscaledMesh};
use crate::model::{ExplicitBodies, ModelParts};
use crate::part::{Accounts, Field, Motion, NodalField};
use crate::run::update_forces;
use crate::settings::Settings;
use crate::state::{Scratch, State};
use crate::stress::{Moduli, Stress};

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

/// The unit glass sphere as a body.
pub(crate) fn glass_sphere(n: f64, side: Side) -> BodyInput {
    BodyInput::Sphere { mesh: unit_sphere(n, side), material: unit_glass() }
}

pub(crate) fn upper_at_finite_strain(law: HyperelasticLaw) -> ModelParts {
    ModelParts { finite_strain: [None, Some(law)], ..ModelParts::default() }
}

/// A model and its state at first touch.
pub(crate) fn started(
    bodies: [BodyInput; 2],
    approach: Approach,
    settings: &Settings,
    parts: ModelParts,
) -> (ExplicitBodies, State) {
    let model = ExplicitBodies::with_parts(bodies, approach, settings, parts).unwrap();
    let state = State::at_first_touch(&model);
    (model, state)
}

/// The upper body at rest, and so far from the lower one that they never meet.
pub(crate) fn far_apart(
    bodies: [BodyInput; 2],
    settings: &Settings,
    parts: ModelParts,
) -> (ExplicitBodies, State) {
    let approach = Approach::new([1.0, 0.0], 1e3).unwrap();
    let (model, mut state) = started(bodies, approach, settings, parts);
    // Back from first touch to the start.
    state.bodies[0].displacement.fill([0.0; 2]);
    (model, state)
}

/// A sphere alone and at rest: a wall far below never meets it.
pub(crate) fn free_sphere(
    mesh: SphereMesh,
    material: Material,
    step_factor: f64,
) -> (ExplicitBodies, State) {
    let bodies = [BodyInput::Wall, BodyInput::Sphere { mesh, material }];
    let settings = Settings { step_factor, ..settings() };
    far_apart(bodies, &settings, ModelParts::default())
}

/// −∂f/∂u of these bodies and their contact at a state, from the step's own forces.
pub(crate) fn tangent(model: &ExplicitBodies, state: &State, sides: &[usize]) -> DMatrix<f64> {
    let forces = |state: &State| {
        let mut scratch = Scratch::new(model);
        update_forces(model, state, &mut scratch).unwrap();
        let of_bodies = sides.iter().map(|&side| scratch.forces[side].as_flattened());
        of_bodies.collect::<Vec<_>>().concat()
    };
    let freedoms: Vec<_> = sides
        .iter()
        .flat_map(|&side| (0..2 * state.bodies[side].displacement.len()).map(move |j| (side, j)))
        .collect();
    let step = 1e-6;
    let mut matrix = DMatrix::zeros(freedoms.len(), freedoms.len());
    for (j, &(side, freedom)) in freedoms.iter().enumerate() {
        let moved = |by: f64| {
            let mut state = state.clone();
            state.bodies[side].displacement[freedom / 2][freedom % 2] += by;
            forces(&state)
        };
        for (i, (f, g)) in moved(-step).into_iter().zip(moved(step)).enumerate() {
            matrix[(i, j)] = (f - g) / (2.0 * step);
        }
    }
    (&matrix + matrix.transpose()) * 0.5
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

/// A body that does not move.
pub(crate) fn still(displacement: &Field) -> Motion<'_> {
    Motion { time: 0.0, time_step: 0.0, displacement, velocity: &[], nodal_mass: &[] }
}

pub(crate) fn scaled(shape: &Field, factor: f64) -> Vec<[f64; 2]> {
    shape.iter().map(|u| u.map(|u| factor * u)).collect()
}

/// The elements of a body on a path that the test chooses.
pub(crate) struct March {
    pub stress: Box<dyn Stress>,
    pub history: Vec<NodalField>,
    pub u: Vec<[f64; 2]>,
}

impl March {
    pub fn new(mut stress: Box<dyn Stress>, mesh: &SphereMesh, time_step: f64) -> Self {
        stress.set_time_step(time_step);
        let of_elements = vec![vec![[0.0; 2]; mesh.quads().len()]; stress.n_element_history()];
        let of_nodes = vec![vec![[0.0; 2]; mesh.nodes().len()]; stress.n_history()];
        let history = [of_elements, of_nodes].concat();
        Self { stress, history, u: vec![[0.0; 2]; mesh.nodes().len()] }
    }

    pub fn step(&mut self, time_step: f64, u: &Field) {
        let rate = |(after, before): (&[f64; 2], &[f64; 2])| {
            [0, 1].map(|axis: usize| (after[axis] - before[axis]) / time_step)
        };
        let velocity: Vec<_> = u.iter().zip(&self.u).map(rate).collect();
        self.u = u.to_vec();
        let motion = Motion { time_step, velocity: &velocity, ..still(&self.u) };
        self.stress.advance(&motion, &mut self.history);
    }

    pub fn forces(&self) -> Vec<[f64; 2]> {
        let mut f = vec![[0.0; 2]; self.u.len()];
        self.stress.subtract_forces(&still(&self.u), &self.history, &mut f).unwrap();
        f
    }

    /// Returns the stored energy and the dissipated power.
    pub fn energies(&self, u: &Field) -> (f64, f64) {
        let mut accounts = Accounts::default();
        self.stress.add_energies(&still(u), &self.history, &mut accounts);
        let power = accounts.powers.get(Account::ViscousDissipation).unwrap();
        (accounts.energies.get(Account::Strain).unwrap(), power)
    }
}

/// Asserts that forces at a displacement are the slope of an energy.
pub(crate) fn assert_forces_are_slopes(
    f: &Field,
    u: &Field,
    energy: impl Fn(&Field) -> f64,
    what: &dyn std::fmt::Debug,
) {
    let size = vector(f).amax();
    for k in (0..2 * u.len()).step_by(7) {
        // Errors of δ² and of rounding over δ are 1e-9 of the largest force.
        let delta = 1e-5;
        let at = |shift: f64| {
            let mut moved = u.to_vec();
            moved[k / 2][k % 2] += shift;
            energy(&moved)
        };
        let slope = (at(delta) - at(-delta)) / (2.0 * delta);
        let error = (slope + f[k / 2][k % 2]).abs();
        assert!(error < 1e-7 * size, "{what:?} {k}: {error:e} of {size}");
    }
}

/// Asserts that axial forces sum to zero.
pub(crate) fn assert_balance(f: &Field) {
    let (sum, size) = f.iter().fold((0.0, 0.0), |(sum, size), f| (sum + f[1], size + f[1].abs()));
    // Rounding of a hundred terms.
    assert!(f64::abs(sum) < 1e-15 * size, "{sum:e} {size}");
}
