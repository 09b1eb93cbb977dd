//! One body as the solver sees it: constant over a run.

use std::sync::Arc;

use fem_collision::{BodyFields, StressField};
use fem_material::Material;
use fem_mesh::SphereMesh;

use crate::forces::NodeForce;
use crate::lumped::{LumpedBody, LumpedMesh, RigidSphere};
use crate::part::{Accounts, Field, Motion, NodalField, Placed};
use crate::state::BodyState;
use crate::stress::Stress;
use crate::time_step::ChangingBound;

/// A body, constant over a run. A rigid sphere is a body of one node, which has all of its mass; a
/// wall is one with infinite mass and without parts. A half-space has infinite mass too, and its far
/// boundary keeps its velocity.
#[derive(Debug, Clone)]
pub struct Body {
    /// A rigid body has none.
    pub(crate) stress: Option<Placed<dyn Stress>>,
    pub(crate) node_forces: Vec<Placed<dyn NodeForce>>,
    /// Nodal fields of history of all its parts.
    n_history: usize,
    /// Fields of history of its elements, which are those of its stress.
    n_element_history: usize,
    /// Lumped masses, mass scaling included, kg.
    pub(crate) nodal_mass: Vec<f64>,
    /// Inverse masses of (r, y); 0 for what cannot move.
    pub(crate) inverse_mass: Vec<[f64; 2]>,
    pub(crate) velocity: f64,
    /// Of a body that moves, where the stiffness of either changes.
    pub(crate) bound: Option<Arc<ChangingBound>>,
    mesh: Option<SphereMesh>,
    material: Option<Material>,
    mass: f64,
    added_mass: f64,
    /// Whether its mass centre does not move.
    pub(crate) held: bool,
    /// That uniform forces on its nodes give it along +y, m/s².
    pub(crate) acceleration: f64,
}

impl Body {
    /// A body that moves, with the masses that a critical time step (s) asks for, at a velocity (m/s) and
    /// a time step, s, in a run whose time step follows the stiffness or does not.
    pub(crate) fn of_lumped(
        lumped: LumpedBody,
        velocity: f64,
        critical: f64,
        time_step: f64,
        changes_stiffness: bool,
    ) -> Self {
        match lumped {
            LumpedBody::Meshed(meshed) => {
                let (nodal_mass, added_mass) = meshed.bound.scale_mass(critical);
                let of =
                    || Arc::new(ChangingBound::of(meshed.bound.clone(), Some(&*meshed.stress)));
                let bound = changes_stiffness.then(of);
                let body = Self::of_mesh(*meshed, velocity, nodal_mass, added_mass, time_step);
                Self { bound, ..body }
            }
            LumpedBody::Rigid(sphere) => {
                let of = || Arc::new(ChangingBound::of(sphere.bound.clone(), None));
                let bound = changes_stiffness.then(of);
                Self { bound, ..Self::rigid(sphere, velocity, time_step) }
            }
        }
    }

    /// A wall.
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
            added_mass: 0.0,
            held: false,
            acceleration: 0.0,
        }
    }

    /// A rigid sphere at the given time step (s).
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

    /// A sphere or a half-space whose nodes carry `nodal_mass` (kg), `added_mass` of it where mass
    /// scaling has put it, at the given time step (s).
    pub(crate) fn of_mesh(
        lumped: LumpedMesh,
        velocity: f64,
        nodal_mass: Vec<f64>,
        added_mass: f64,
        time_step: f64,
    ) -> Self {
        let LumpedMesh { mesh, material, mut stress, node_forces, bound } = lumped;
        // What has no mass the step does not accelerate.
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
            added_mass,
            held: false,
            acceleration,
        }
    }

    /// This body, its mass centre held in its place or not.
    pub(crate) fn with_held(self, held: bool) -> Self {
        Self { held, ..self }
    }

    /// Adds the forces on its nodes beside stress and contact; their sum along +y, N.
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

    /// Whether it is a wall, which nothing moves.
    pub fn is_wall(&self) -> bool {
        self.mesh.is_none() && self.mass.is_infinite()
    }

    /// Its mesh; a rigid body has none.
    pub fn mesh(&self) -> Option<&SphereMesh> {
        self.mesh.as_ref()
    }

    /// Lumped masses of the nodes, mass scaling included, kg; all of a rigid sphere's is that of its
    /// one node, and a wall's has none.
    pub fn nodal_mass(&self) -> &[f64] {
        &self.nodal_mass
    }

    /// Its material; a rigid body has none.
    pub fn material(&self) -> Option<&Material> {
        self.material.as_ref()
    }

    /// Stress of its fields; a rigid body has none.
    pub fn stress(&self, fields: &BodyFields) -> StressField {
        match (&self.mesh, &self.material) {
            (Some(mesh), Some(material)) => StressField::of(mesh, material, fields),
            _ => StressField::default(),
        }
    }

    /// Mass, kg; infinite for a wall or a half-space.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Mass that mass scaling has added to light nodes and taken from others, kg.
    pub fn added_mass(&self) -> f64 {
        self.added_mass
    }

    /// Number of elements.
    pub fn n_elements(&self) -> usize {
        self.mesh.as_ref().map_or(0, |mesh| mesh.quads().len())
    }

    /// Number of its elements that are at finite strain.
    pub fn n_finite_elements(&self) -> usize {
        self.stress.as_ref().map_or(0, |stress| stress.part.n_finite_elements())
    }

    /// Number of nodes of its mesh: a rigid body has none to show.
    pub fn n_nodes(&self) -> usize {
        self.mesh.as_ref().map_or(0, |mesh| mesh.nodes().len())
    }

    /// Number of nodal fields of history that its parts keep: none of an elastic body, one and one
    /// for each Prony term of a relaxing body, one of a body that relaxes at finite strain.
    pub fn n_history(&self) -> usize {
        self.n_history
    }

    /// Number of fields of history that its elements keep: some for each Prony term of a body that
    /// relaxes at finite strain, none of any other.
    pub fn n_element_history(&self) -> usize {
        self.n_element_history
    }

    /// Lengths of the fields of its history: those of its elements, then those of its nodes.
    pub(crate) fn field_lengths(&self) -> impl Iterator<Item = usize> {
        let of_elements = std::iter::repeat_n(self.n_elements(), self.n_element_history);
        of_elements.chain(std::iter::repeat_n(self.nodal_mass.len(), self.n_history))
    }

    /// Number of them.
    pub(crate) fn n_fields(&self) -> usize {
        self.n_element_history + self.n_history
    }

    /// Whether its mass centre moves: a wall and a half-space keep their velocity.
    pub(crate) fn is_free(&self) -> bool {
        self.mass.is_finite()
    }

    /// A node that keeps the velocity of a body that is not free.
    pub(crate) fn held_node(&self) -> usize {
        self.held_nodes().first().map_or(0, |&node| node as usize)
    }

    /// Nodes of a half-space that keep its velocity.
    pub(crate) fn held_nodes(&self) -> &[u32] {
        self.mesh.as_ref().map_or(&[], SphereMesh::far_boundary)
    }

    /// 1/m of the mass centre, 1/kg; 0 of a body that is held, and of a wall.
    pub(crate) fn inverse_mass_of_centre(&self) -> f64 {
        if self.held { 0.0 } else { self.mass.recip() }
    }

    /// Takes the acceleration of the mass centre out of all forces on its nodes; what that adds to their
    /// sum along +y, N.
    pub(crate) fn hold(&self, forces: &mut Field) -> f64 {
        let resultant: f64 = forces.iter().map(|force| force[1]).sum();
        let acceleration = resultant / self.mass;
        for (force, mass) in forces.iter_mut().zip(&self.nodal_mass) {
            force[1] -= mass * acceleration;
        }
        -resultant
    }

    /// Whether forces from outside, beside the contact, change its momentum.
    pub(crate) fn is_pushed(&self) -> bool {
        self.held || !self.node_forces.is_empty()
    }

    /// Mass-weighted mean of a field's y component; its value far away for a body that is not free.
    pub(crate) fn centre(&self, field: &Field) -> f64 {
        if !self.is_free() {
            return field[self.held_node()][1];
        }
        self.sum_mass(field) / self.mass
    }

    /// Σ m x_y, 0 for a wall.
    pub(crate) fn sum_mass(&self, field: &Field) -> f64 {
        self.nodal_mass.iter().zip(field).map(|(m, x)| m * x[1]).sum()
    }

    /// What its stress follows from: displacement, effective displacement, stress of the elements.
    pub(crate) fn update_stress_fields(&self, state: &BodyState, fields: &mut BodyFields) {
        fields.displacement.clone_from(&state.displacement);
        match self.effective() {
            Some(field) => fields.effective.clone_from(&state.history[field]),
            None => fields.effective.clear(),
        }
        if let Some(Placed { part, fields: own }) = &self.stress {
            let history = &state.history[own.clone()];
            part.update_cauchy_stress(&state.displacement, history, &mut fields.stress);
        }
    }

    /// Which field of its history is the effective displacement of relaxing stress.
    pub(crate) fn effective(&self) -> Option<usize> {
        self.stress.as_ref().and_then(|stress| Some(stress.fields.start + stress.part.effective()?))
    }

    /// Adds what its parts store, give and dissipate.
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

/// Forces at their place in the history, with the step.
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

/// Acceleration of the mass centre by forces that act on all masses alike, m/s².
fn acceleration(node_forces: &[Placed<dyn NodeForce>]) -> f64 {
    node_forces.iter().map(|force| force.part.acceleration()).sum()
}
