//! One body without contact: its free vibrations, and the forces of a given deformation.
//!
//! The body moves as in a collision, M ü = −f(u), by central differences with a step that is stable for it alone,
//! without mass scaling.

use fem_collision::{BalanceSide, BodyFields, StressField};
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;
use fem_mesh::SphereMesh;

use crate::body::{Body, BodyState, Clock, UnscaledMesh};
use crate::error::ModelError;
use crate::part::Accounts;
use crate::settings::check_step_factor;
use crate::stress::{Collapse, FiniteStrainChoice};

/// A sphere without contact, at rest until it is given a velocity or a deformation.
///
/// Displacement u_n and velocity v_{n−1/2} are half a step apart, as leapfrog requires.
///
/// ```
/// use fem_explicit::FreeMotion;
/// # use fem_material::{ElasticModuli, Material};
/// # use fem_mesh::HalfDisc;
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
/// let glass = Material::new(2390.0, moduli, None)?;
/// let disc = HalfDisc {
///     radius: 1e-2,
///     contact_element_size: 1e-3,
///     refined_radius: 5e-3,
///     growth: None,
///     edge: None,
/// };
/// let mut sphere = FreeMotion::new(disc.build()?, &glass, 0.9)?;
/// // It vibrates, and its energy is conserved.
/// sphere.set_velocity(|[r, y]| [r, y - 1e-2]);
/// let start = sphere.energy();
/// for _ in 0..100 {
///     sphere.step();
/// }
/// assert!((sphere.energy() / start - 1.0).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct FreeMotion {
    body: Body,
    time_step: f64,
    n_steps: u64,
    state: BodyState,
    /// Internal forces −f(u_n), N.
    forces: Vec<[f64; 2]>,
    collapse: Option<Collapse>,
}

impl FreeMotion {
    /// Makes a body at small strain, with a time step of `step_factor`, in (0, 1], times the critical one.
    ///
    /// # Errors
    /// The step factor is out of range.
    pub fn new(
        mesh: SphereMesh,
        material: &Material,
        step_factor: f64,
    ) -> Result<Self, ModelError> {
        Self::with_law(mesh, material, None, step_factor)
    }

    /// Makes a body at finite strain, by a law. The step stays that of the undeformed body, so a body that stiffens
    /// much may become unstable.
    ///
    /// # Errors
    /// The step factor is out of range, or the material has too many relaxation terms.
    pub fn at_finite_strain(
        mesh: SphereMesh,
        material: &Material,
        law: HyperelasticLaw,
        step_factor: f64,
    ) -> Result<Self, ModelError> {
        Self::with_law(mesh, material, Some(law), step_factor)
    }

    fn with_law(
        mesh: SphereMesh,
        material: &Material,
        law: Option<HyperelasticLaw>,
        step_factor: f64,
    ) -> Result<Self, ModelError> {
        check_step_factor(step_factor)?;
        let law = law.map(|law| FiniteStrainChoice { law, within: None });
        let sphere = UnscaledMesh::new(mesh, material.clone(), law, Vec::new(), &[])?;
        let time_step = step_factor * sphere.bound.critical_time_step();
        let nodal_mass = sphere.bound.mass.clone();
        let body = Body::of_mesh(sphere, 0.0, nodal_mass, 0.0, time_step);
        let state = BodyState::in_flight(&body, 0, 0.0);
        let forces = vec![[0.0; 2]; body.n_nodes()];
        Ok(Self { body, time_step, n_steps: 0, state, forces, collapse: None })
    }

    /// Returns the body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Returns the time step, s.
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// Returns the time since the start, s.
    pub fn time(&self) -> f64 {
        self.n_steps as f64 * self.time_step
    }

    /// Sets the velocity (r, y) of every node, m/s, as a function of its place (r, y), m.
    pub fn set_velocity(&mut self, velocity: impl Fn([f64; 2]) -> [f64; 2]) {
        self.state.velocity = self.at_nodes(velocity);
    }

    /// Sets the displacement (r, y) of every node, m, as a function of its place (r, y), m, instantaneously: nothing
    /// has relaxed.
    pub fn set_displacement(&mut self, displacement: impl Fn([f64; 2]) -> [f64; 2]) {
        self.state.displacement = self.at_nodes(displacement);
        let BodyState { displacement, history, .. } = &mut self.state;
        if let Some(stress) = &self.body.stress {
            stress.part.start_deformed(displacement, stress.of_mut(history));
        }
        self.update_forces();
    }

    /// Takes a time step.
    pub fn step(&mut self) {
        self.state.advance_nodes(&self.body, self.time_step, &self.forces);
        self.n_steps += 1;
        self.state.advance_stress(&self.body, self.clock());
        self.update_forces();
    }

    fn update_forces(&mut self) {
        let clock = self.clock();
        let done = self.state.update_internal_forces(&self.body, clock, &mut self.forces);
        self.collapse = done.err();
    }

    /// Returns an element that has collapsed; then forces and energy have no meaning.
    pub fn collapse(&self) -> Option<Collapse> {
        self.collapse
    }

    fn clock(&self) -> Clock {
        Clock { time: self.time(), time_step: self.time_step }
    }

    /// Returns the displacements (r, y) of the nodes, m.
    pub fn displacement(&self) -> &[[f64; 2]] {
        &self.state.displacement
    }

    /// Returns the velocities (r, y) of the nodes half a step ago, m/s.
    pub fn velocity(&self) -> &[[f64; 2]] {
        &self.state.velocity
    }

    /// Returns the internal forces (r, y) on the nodes, −f(u), N.
    pub fn internal_forces(&self) -> &[[f64; 2]] {
        &self.forces
    }

    /// Returns the energy ½ v_{n−1/2}·M v_{n+1/2} plus the stored energy, ½ u_n·K u_n for an elastic body, J. Leapfrog
    /// conserves it to rounding for an elastic body at small strain.
    pub fn energy(&self) -> f64 {
        let inverse_mass = self.body.inverse_mass.as_flattened();
        let forces = self.forces.as_flattened();
        let twice_kinetic: f64 = (self.state.velocity.as_flattened().iter().enumerate())
            .map(|(k, v)| {
                let next = v + self.time_step * (inverse_mass[k] * forces[k]);
                self.body.nodal_mass[k / 2] * v * next
            })
            .sum();
        let mut accounts = Accounts::default();
        let motion = self.state.motion(&self.body, self.clock());
        self.body.add_energies(&motion, &self.state.history, &mut accounts);
        let held =
            accounts.energies.entries().filter(|(account, _)| account.side() == BalanceSide::Held);
        0.5 * twice_kinetic + held.map(|(_, energy)| energy).sum::<f64>()
    }

    /// Returns the stress of the deformed body.
    pub fn stress(&self) -> StressField {
        let mut fields = BodyFields::default();
        self.body.update_stress_fields(&self.state, &mut fields);
        self.body.stress(&fields, None)
    }

    fn at_nodes(&self, field: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<[f64; 2]> {
        let nodes = self.body.mesh().map_or(&[][..], SphereMesh::nodes);
        nodes.iter().map(|&place| field(place)).collect()
    }
}
