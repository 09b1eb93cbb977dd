//! A body: its parts and masses, constant over a run, and its state.
//!
//! ```text
//! unscaled_body           a body before the time step and mass scaling are known
//! critical_time_step      bounds of the stiffness at its nodes, critical time step, mass scaling
//! massless_boundary_mass  masses of a body some of whose surface nodes carry none
//! equilibrium             a body that has flowed, at rest
//! state                   displacement, velocity and history, and their motion over a step
//! ```

mod critical_time_step;
mod equilibrium;
mod massless_boundary_mass;
mod state;
mod unscaled_body;

use std::sync::Arc;

use fem_collision::{Account, BodyFields, ContactProfile, StressField};
use fem_material::Material;
use fem_mesh::SphereMesh;

use crate::forces::NodeForce;
use crate::part::{Accounts, Field, Motion, NodalField, Placed};
use crate::stress::{FiniteStrainStress, StrainMeasure, Stress};
use critical_time_step::ChangingBound;
pub(crate) use state::{BodyState, Clock};
use unscaled_body::RigidSphere;
pub(crate) use unscaled_body::{UnscaledBody, UnscaledMesh};

/// A body, constant over a run. A rigid sphere has one node, which carries its mass. A wall has one node, infinite mass
/// and no parts. A half-space has infinite mass too, and its far boundary keeps its velocity.
#[derive(Debug, Clone)]
pub struct Body {
    /// `None` for a rigid body.
    pub(crate) stress: Option<Placed<dyn Stress>>,
    pub(crate) node_forces: Vec<Placed<dyn NodeForce>>,
    /// Number of nodal fields of history of all its parts.
    n_history: usize,
    /// Number of fields of history of its elements, all of which belong to the stress.
    n_element_history: usize,
    /// Lumped masses, mass scaling included, kg.
    pub(crate) nodal_mass: Vec<f64>,
    /// Inverse masses along r and y, 1/kg; 0 where a node cannot move.
    pub(crate) inverse_mass: Vec<[f64; 2]>,
    pub(crate) velocity: f64,
    /// Present for a body that moves in a model whose stiffness changes.
    pub(crate) bound: Option<Arc<ChangingBound>>,
    mesh: Option<SphereMesh>,
    material: Option<Material>,
    mass: f64,
    moved_mass: f64,
    /// Whether its mass centre is held in place.
    pub(crate) held: bool,
    /// Acceleration along +y by uniform forces on its nodes, m/s².
    pub(crate) acceleration: f64,
}

impl Body {
    /// Makes a body that moves at a velocity (m/s), with masses scaled for a critical time step (s) and a time step, s;
    /// `changes_stiffness` says whether the stiffness of the model changes.
    pub(crate) fn scaled(
        unscaled: UnscaledBody,
        velocity: f64,
        critical: f64,
        time_step: f64,
        changes_stiffness: bool,
    ) -> Self {
        match unscaled {
            UnscaledBody::Meshed(meshed) => {
                let (nodal_mass, moved_mass) = meshed.bound.scale_mass(critical);
                let stress = meshed.stress.strain_measure().finite();
                let of = || Arc::new(ChangingBound::new(meshed.bound.clone(), stress));
                let bound = changes_stiffness.then(of);
                let body = Self::of_mesh(*meshed, velocity, nodal_mass, moved_mass, time_step);
                Self { bound, ..body }
            }
            UnscaledBody::Rigid(sphere) => {
                let of = || Arc::new(ChangingBound::new(sphere.bound.clone(), None));
                let bound = changes_stiffness.then(of);
                Self { bound, ..Self::rigid(sphere, velocity, time_step) }
            }
        }
    }

    /// Makes a wall.
    pub(crate) fn wall(velocity: f64) -> Self {
        Self {
            stress: None,
            node_forces: Vec::new(),
            n_history: 0,
            n_element_history: 0,
            nodal_mass: vec![0.0],
            inverse_mass: vec![[0.0; 2]],
            velocity,
            bound: None,
            mesh: None,
            material: None,
            mass: f64::INFINITY,
            moved_mass: 0.0,
            held: false,
            acceleration: 0.0,
        }
    }

    /// Makes a rigid sphere for a time step (s).
    pub(crate) fn rigid(sphere: RigidSphere, velocity: f64, time_step: f64) -> Self {
        let RigidSphere { node_forces, bound } = sphere;
        let mass = bound.mass.iter().sum::<f64>();
        let mut n_history = 0;
        let node_forces = place(node_forces, &mut n_history, time_step);
        Self {
            acceleration: acceleration(&node_forces),
            node_forces,
            n_history,
            inverse_mass: vec![[0.0, mass.recip()]],
            nodal_mass: bound.mass,
            mass,
            ..Self::wall(velocity)
        }
    }

    /// Makes a sphere, a half-space or a plate with masses of its nodes (kg), of which mass scaling has moved `moved_mass` (kg),
    /// for a time step (s).
    pub(crate) fn of_mesh(
        unscaled: UnscaledMesh,
        velocity: f64,
        nodal_mass: Vec<f64>,
        moved_mass: f64,
        time_step: f64,
    ) -> Self {
        let UnscaledMesh { mesh, material, mut stress, node_forces, bound } = unscaled;
        // The step does not accelerate nodes without mass.
        let inverse = |m: &f64| if *m > 0.0 { [m.recip(); 2] } else { [0.0; 2] };
        let mut inverse_mass: Vec<_> = nodal_mass.iter().map(inverse).collect();
        for &node in mesh.axis() {
            inverse_mass[node as usize][0] = 0.0;
        }
        for &node in mesh.far_boundary() {
            inverse_mass[node as usize] = [0.0; 2];
        }
        stress.set_time_step(time_step);
        let n_element_history = stress.n_element_history();
        let mut n_fields = n_element_history;
        let mut stress = Placed::behind(&mut n_fields, Arc::from(stress));
        // The fields of its elements come first.
        stress.fields.start = 0;
        let stress = Some(stress);
        let node_forces = place(node_forces, &mut n_fields, time_step);
        let acceleration = acceleration(&node_forces);
        let mass = match mesh.is_half_space() {
            true => f64::INFINITY,
            false => bound.mass.iter().sum(),
        };
        Self {
            stress,
            node_forces,
            n_history: n_fields - n_element_history,
            n_element_history,
            nodal_mass,
            inverse_mass,
            velocity,
            bound: None,
            mesh: Some(mesh),
            material: Some(material),
            mass,
            moved_mass,
            held: false,
            acceleration,
        }
    }

    /// Returns this body with its mass centre held in place, or not.
    pub(crate) fn with_held(self, held: bool) -> Self {
        Self { held, ..self }
    }

    /// Adds the forces on the body's nodes other than stress and contact. Returns their sum along +y, N.
    pub(crate) fn add_node_forces(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        forces: &mut Field,
    ) -> f64 {
        let mut resultant = 0.0;
        for force in &self.node_forces {
            resultant += force.part.add_forces(motion, force.of(history), forces);
        }
        resultant
    }

    /// Returns whether it is a wall, which keeps its velocity.
    pub fn is_wall(&self) -> bool {
        self.mesh.is_none() && self.mass.is_infinite()
    }

    /// Returns its mesh; `None` for a rigid body.
    pub fn mesh(&self) -> Option<&SphereMesh> {
        self.mesh.as_ref()
    }

    /// Returns the lumped masses of the nodes, mass scaling included, kg. The one node of a rigid sphere has all of its
    /// mass, that of a wall has 0.
    pub fn nodal_mass(&self) -> &[f64] {
        &self.nodal_mass
    }

    /// Returns its material; `None` for a rigid body.
    pub fn material(&self) -> Option<&Material> {
        self.material.as_ref()
    }

    /// Returns the stress for given fields and the contact that its surface carries, if it is known; empty for a rigid body.
    pub fn stress(&self, fields: &BodyFields, contact: Option<&ContactProfile>) -> StressField {
        match (&self.mesh, &self.material) {
            (Some(mesh), Some(material)) => StressField::of(mesh, material, fields, contact),
            _ => StressField::default(),
        }
    }

    /// Returns its mass, kg; infinite for a wall or a half-space.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Returns the mass that mass scaling has moved from heavy to light nodes, kg.
    pub fn moved_mass(&self) -> f64 {
        self.moved_mass
    }

    /// Returns the number of elements.
    pub fn n_elements(&self) -> usize {
        self.mesh.as_ref().map_or(0, |mesh| mesh.quads().len())
    }

    /// Returns its stress if that is at finite strain, everywhere or in part.
    pub(crate) fn finite_strain(&self) -> Option<&dyn FiniteStrainStress> {
        self.stress.as_ref()?.part.strain_measure().finite()
    }

    /// Returns whether it flows plastically.
    pub fn flows(&self) -> bool {
        self.material().is_some_and(|material| material.flow().is_some())
    }

    /// Returns the number of its elements at finite strain.
    pub fn n_finite_elements(&self) -> usize {
        self.finite_strain().map_or(0, |stress| stress.n_elements())
    }

    /// Returns the centre (r, y) of an element before the collision, m.
    pub(crate) fn element_centre(&self, element: usize) -> [f64; 2] {
        let corners = self.mesh.as_ref().map(|mesh| mesh.corners(element));
        corners.map_or([f64::NAN; 2], |corners| {
            [0, 1].map(|axis: usize| corners.iter().map(|x| x[axis]).sum::<f64>() / 4.0)
        })
    }

    /// Returns the position (r, y) of a node before the collision, m; the origin for a rigid body.
    pub(crate) fn node_position(&self, node: usize) -> [f64; 2] {
        self.mesh.as_ref().map_or([0.0; 2], |mesh| mesh.nodes()[node])
    }

    /// Returns the number of nodes of its mesh; 0 for a rigid body.
    pub fn n_nodes(&self) -> usize {
        self.mesh.as_ref().map_or(0, |mesh| mesh.nodes().len())
    }

    /// Returns the number of nodal fields of history that its parts keep. The stress keeps none if it is elastic, one
    /// and one per Prony term if it relaxes at small strain, one if it relaxes at finite strain.
    pub fn n_history(&self) -> usize {
        self.n_history
    }

    /// Returns the number of fields of history that its elements keep: some per Prony term for a body that relaxes at
    /// finite strain, otherwise none.
    pub fn n_element_history(&self) -> usize {
        self.n_element_history
    }

    /// Returns the lengths of its fields of history: those of its elements, then those of its nodes.
    pub(crate) fn field_lengths(&self) -> impl Iterator<Item = usize> {
        let of_elements = std::iter::repeat_n(self.n_elements(), self.n_element_history);
        of_elements.chain(std::iter::repeat_n(self.nodal_mass.len(), self.n_history))
    }

    /// Returns the number of its fields of history.
    pub(crate) fn n_fields(&self) -> usize {
        self.n_element_history + self.n_history
    }

    /// Returns whether its mass is finite: a wall and a half-space keep their velocity.
    pub(crate) fn is_free(&self) -> bool {
        self.mass.is_finite()
    }

    /// Returns a node that keeps the velocity of a body that is not free; a plate with a free rim has none.
    pub(crate) fn held_node(&self) -> Option<usize> {
        self.held_nodes().first().map(|&node| node as usize)
    }

    /// Returns the nodes of a half-space or a plate that keep its velocity.
    pub(crate) fn held_nodes(&self) -> &[u32] {
        self.mesh.as_ref().map_or(&[], SphereMesh::far_boundary)
    }

    /// Returns 1/m of the mass centre, 1/kg; 0 for a body that is held and for a wall.
    pub(crate) fn inverse_mass_of_centre(&self) -> f64 {
        if self.held { 0.0 } else { self.mass.recip() }
    }

    /// Removes the acceleration of the mass centre from the forces on its nodes. Returns the change of their sum along
    /// +y, N.
    pub(crate) fn hold(&self, forces: &mut Field) -> f64 {
        let resultant: f64 = forces.iter().map(|force| force[1]).sum();
        let acceleration = resultant / self.mass;
        for (force, mass) in forces.iter_mut().zip(&self.nodal_mass) {
            force[1] -= mass * acceleration;
        }
        -resultant
    }

    /// Returns whether external forces other than the contact change its momentum.
    pub(crate) fn is_pushed(&self) -> bool {
        self.held || !self.node_forces.is_empty()
    }

    /// Returns the mass-weighted mean of the y component of a field; its value far away for a body that is not free.
    pub(crate) fn centre(&self, field: &Field) -> f64 {
        match self.held_node() {
            _ if self.is_wall() => field[0][1],
            Some(node) => field[node][1],
            None if self.is_free() => self.sum_mass(field) / self.mass,
            None => self.sum_mass(field) / self.nodal_mass.iter().sum::<f64>(),
        }
    }

    /// Returns Σ m x_y; 0 for a wall.
    pub(crate) fn sum_mass(&self, field: &Field) -> f64 {
        self.nodal_mass.iter().zip(field).map(|(m, x)| m * x[1]).sum()
    }

    /// Overwrites the fields from which its stress follows: displacement, effective displacement, stress of the
    /// elements.
    pub(crate) fn update_stress_fields(&self, state: &BodyState, fields: &mut BodyFields) {
        fields.displacement.clone_from(&state.displacement);
        match self.effective() {
            Some(field) => fields.effective.clone_from(&state.history[field]),
            None => fields.effective.clear(),
        }
        match (&self.stress, self.finite_strain()) {
            (Some(placed), Some(stress)) => {
                let history = placed.of(&state.history);
                stress.update_cauchy_stress(&state.displacement, history, &mut fields.stress);
                stress.update_plastic(history, &mut fields.plastic);
            }
            _ => {
                fields.stress.clear();
                fields.plastic.clear();
            }
        }
    }

    /// Returns which field of its history is the effective displacement, if its stress relaxes at small strain.
    pub(crate) fn effective(&self) -> Option<usize> {
        let stress = self.stress.as_ref()?;
        match stress.part.strain_measure() {
            StrainMeasure::Small(small) => Some(stress.fields.start + small.effective()?),
            StrainMeasure::Finite(_) => None,
        }
    }

    /// Returns the elastic energy, J, that its stress holds.
    pub(crate) fn elastic_energy(&self, motion: &Motion<'_>, history: &[NodalField]) -> f64 {
        let mut accounts = Accounts::default();
        if let Some(stress) = &self.stress {
            stress.part.add_energies(motion, stress.of(history), &mut accounts);
        }
        accounts.energies.get(Account::Strain).unwrap_or(0.0)
    }

    /// Adds the energies that its parts store, give and dissipate.
    pub(crate) fn add_energies(
        &self,
        motion: &Motion<'_>,
        history: &[NodalField],
        accounts: &mut Accounts,
    ) {
        if let Some(stress) = &self.stress {
            stress.part.add_energies(motion, stress.of(history), accounts);
        }
        for force in &self.node_forces {
            force.part.add_energies(motion, force.of(history), accounts);
        }
    }
}

/// Places forces in the history and gives them the time step.
fn place(
    node_forces: Vec<Box<dyn NodeForce>>,
    n_history: &mut usize,
    time_step: f64,
) -> Vec<Placed<dyn NodeForce>> {
    let place = |mut force: Box<dyn NodeForce>| {
        force.set_time_step(time_step);
        Placed::behind(n_history, Arc::from(force))
    };
    node_forces.into_iter().map(place).collect()
}

/// Returns the acceleration of the mass centre by uniform forces, m/s².
fn acceleration(node_forces: &[Placed<dyn NodeForce>]) -> f64 {
    node_forces.iter().map(|force| force.part.acceleration()).sum()
}
