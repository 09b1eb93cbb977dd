//! The state of one body, and its motion over a step.

use serde::{Deserialize, Serialize};

use super::Body;
use crate::part::{Field, Motion, MotionMut, NodalField};
use crate::stress::Collapse;
use crate::time::advance_motion;

/// The state of a body at time t_n.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct BodyState {
    /// Displacements of the nodes, m.
    pub displacement: NodalField,
    /// Velocities of the nodes at t_n − Δt/2, m/s.
    pub velocity: NodalField,
    /// History of the parts of the body, then the fields that the contact keeps of it.
    pub history: Vec<NodalField>,
}

/// An instant t_n and the step Δt there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    /// Time since the start of the case, s.
    pub time: f64,
    /// The step Δt, s.
    pub time_step: f64,
}

impl BodyState {
    /// Returns the undeformed state after a time (s) of free flight, with room for `n_contact` fields of the contact.
    pub fn in_flight(body: &Body, n_contact: usize, time: f64) -> Self {
        let n = body.nodal_mass.len();
        let displacement = vec![[0.0, body.velocity * time]; n];
        let velocity = vec![[0.0, body.velocity]; n];
        let lengths = body.field_lengths().chain(std::iter::repeat_n(n, n_contact));
        let mut history: Vec<_> = lengths.map(|length| vec![[0.0; 2]; length]).collect();
        if let Some(stress) = &body.stress {
            stress.part.start_rigid(&displacement, stress.of_mut(&mut history));
        }
        Self { displacement, velocity, history }
    }

    /// Takes the velocities half a step back: subtracts what the forces on nodes do in it.
    pub fn go_back_half_a_step(&mut self, body: &Body, clock: Clock) {
        if body.node_forces.is_empty() {
            return;
        }
        let mut forces = vec![[0.0; 2]; body.nodal_mass.len()];
        body.add_node_forces(&self.motion(body, clock), &self.history, &mut forces);
        for ((v, force), inverse_mass) in
            self.velocity.iter_mut().zip(&forces).zip(&body.inverse_mass)
        {
            for axis in 0..2 {
                v[axis] -= 0.5 * clock.time_step * (inverse_mass[axis] * force[axis]);
            }
        }
    }

    /// Returns the body as its parts see it.
    pub fn motion<'a>(&'a self, body: &'a Body, Clock { time, time_step }: Clock) -> Motion<'a> {
        let Self { displacement, velocity, .. } = self;
        Motion { time, time_step, displacement, velocity, nodal_mass: &body.nodal_mass }
    }

    /// Splits off what the contact may change at the end of a step: the motion, and the fields that it keeps.
    pub fn split_contact<'a>(
        &'a mut self,
        body: &'a Body,
        Clock { time, time_step }: Clock,
    ) -> (MotionMut<'a>, &'a mut [NodalField]) {
        let Self { displacement, velocity, history } = self;
        let (of_parts, of_contact) = history.split_at_mut(body.n_fields());
        let stress_history = match &body.stress {
            Some(stress) => stress.of_mut(of_parts),
            None => &mut [],
        };
        let nodal_mass = &body.nodal_mass;
        let motion =
            MotionMut { time, time_step, displacement, velocity, nodal_mass, stress_history };
        (motion, of_contact)
    }

    /// Overwrites `forces` (N) with the internal forces, by their sign on the nodes.
    ///
    /// # Errors
    /// An element has collapsed.
    pub fn update_internal_forces(
        &self,
        body: &Body,
        clock: Clock,
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        forces.fill([0.0; 2]);
        let Some(stress) = &body.stress else { return Ok(()) };
        stress.part.subtract_forces(&self.motion(body, clock), stress.of(&self.history), forces)
    }

    /// Moves the nodes by a time step (s) under forces, N.
    pub fn advance_nodes(&mut self, body: &Body, time_step: f64, forces: &Field) {
        let Self { displacement, velocity, .. } = self;
        advance_motion(time_step, &body.inverse_mass, forces, velocity, displacement);
    }

    /// Takes the history of the stress to the end of a step in which the nodes have moved.
    pub fn advance_stress(&mut self, body: &Body, Clock { time, time_step }: Clock) {
        let Self { displacement, velocity, history } = self;
        let motion =
            Motion { time, time_step, displacement, velocity, nodal_mass: &body.nodal_mass };
        if let Some(stress) = body.stress.as_ref().filter(|stress| stress.has_history()) {
            stress.part.advance(&motion, stress.of_mut(history));
        }
    }

    /// Takes the history of the forces on nodes to the end of a step in which the nodes have moved.
    pub fn advance_node_forces(&mut self, body: &Body, Clock { time, time_step }: Clock) {
        let Self { displacement, velocity, history } = self;
        let motion =
            Motion { time, time_step, displacement, velocity, nodal_mass: &body.nodal_mass };
        for force in body.node_forces.iter().filter(|force| force.has_history()) {
            force.part.advance(&motion, force.of_mut(history));
        }
    }

    /// Returns whether its fields have the sizes of a body, with `n_contact` fields of the contact.
    pub fn fits(&self, body: &Body, n_contact: usize) -> bool {
        let n = body.nodal_mass.len();
        let lengths = body.field_lengths().chain(std::iter::repeat_n(n, n_contact));
        self.displacement.len() == n
            && self.velocity.len() == n
            && self.history.iter().map(Vec::len).eq(lengths)
    }
}
