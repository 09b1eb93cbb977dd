//! What changes in a run.

use std::any::Any;

use fem_collision::Snapshot;
use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::model::Model;
use crate::part::{Motion, MotionMut, NodalField};

/// More steps than any run does; so many are exact as a floating-point number.
const MOST_STEPS: u64 = 1 << f64::MANTISSA_DIGITS;

/// State of a body at time t_n.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct BodyState {
    /// m.
    pub displacement: NodalField,
    /// At t_n − Δt/2, m/s.
    pub velocity: NodalField,
    /// Fields of its parts, then those that the contact keeps of it.
    pub history: Vec<NodalField>,
}

/// State of both bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    /// Steps done.
    pub step: u64,
    /// Time since the start of the case, s.
    pub time: f64,
    pub bodies: [BodyState; 2],
}

/// Forces of the present step, and buffers; nothing that is read across steps decides a bit.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// Nodal forces of both bodies, N.
    pub forces: [NodalField; 2],
    /// What the forces on nodes beside stress and contact add up to along +y, N.
    pub resultants: [f64; 2],
    /// Snapshots that are not needed any more, to be overwritten.
    pub pool: Vec<Snapshot>,
    /// The contact's own.
    pub contact: Box<dyn Any + Send + Sync>,
}

impl State {
    /// The bodies at first touch, undeformed.
    pub fn at_first_touch(model: &Model) -> Self {
        let time = model.approach().first_touch();
        let n_history = model.contact().n_history();
        let bodies = model.bodies().each_ref().map(|body| {
            let mut state = BodyState::in_flight(body, n_history, time);
            state.go_back_half_a_step(body, time, model.time_step());
            state
        });
        Self { step: 0, time, bodies }
    }

    /// Whether its fields are of the model's sizes, and its time that of its step.
    pub fn fits(&self, model: &Model) -> bool {
        let n_contact = model.contact().n_history();
        self.step <= MOST_STEPS
            && self.time == model.time_after(self.step)
            && self
                .bodies
                .iter()
                .zip(model.bodies())
                .all(|(state, body)| state.fits(body, n_contact))
    }

    /// Both bodies as their parts see them.
    pub fn motions<'a>(&'a self, model: &'a Model) -> [Motion<'a>; 2] {
        [0, 1].map(|side: usize| self.bodies[side].motion(&model.bodies()[side], self.time))
    }

    /// The fields that the contact keeps of both bodies.
    pub fn contact_history(&self, model: &Model) -> [&[NodalField]; 2] {
        [0, 1].map(|side: usize| &self.bodies[side].history[model.bodies()[side].n_history()..])
    }
}

impl BodyState {
    /// Undeformed, after a time (s) of free flight; the contact keeps `n_contact` fields of it.
    pub fn in_flight(body: &Body, n_contact: usize, time: f64) -> Self {
        let n = body.nodal_mass.len();
        let displacement = vec![[0.0, body.velocity * time]; n];
        let velocity = vec![[0.0, body.velocity]; n];
        let n_history = body.n_history() + n_contact;
        let mut history: Vec<_> = (0..n_history).map(|_| vec![[0.0; 2]; n]).collect();
        if let Some(stress) = &body.stress {
            stress.part.start_rigid(&displacement, stress.of_mut(&mut history));
        }
        Self { displacement, velocity, history }
    }

    /// Velocities are those of half a step before: takes back what the forces on nodes do in it.
    fn go_back_half_a_step(&mut self, body: &Body, time: f64, time_step: f64) {
        if body.node_forces.is_empty() {
            return;
        }
        let mut forces = vec![[0.0; 2]; body.nodal_mass.len()];
        body.add_node_forces(&self.motion(body, time), &self.history, &mut forces);
        for ((v, force), inverse_mass) in
            self.velocity.iter_mut().zip(&forces).zip(&body.inverse_mass)
        {
            for axis in 0..2 {
                v[axis] -= 0.5 * time_step * (inverse_mass[axis] * force[axis]);
            }
        }
    }

    /// As the parts of its body see it at its time, s.
    pub fn motion<'a>(&'a self, body: &'a Body, time: f64) -> Motion<'a> {
        Motion {
            time,
            displacement: &self.displacement,
            velocity: &self.velocity,
            nodal_mass: &body.nodal_mass,
        }
    }

    /// What the contact may change of it at the end of a step, its time in s.
    pub fn split_contact<'a>(
        &'a mut self,
        body: &'a Body,
        time: f64,
    ) -> (MotionMut<'a>, &'a mut [NodalField]) {
        let Self { displacement, velocity, history } = self;
        let (of_parts, of_contact) = history.split_at_mut(body.n_history());
        let stress_history = match &body.stress {
            Some(stress) => stress.of_mut(of_parts),
            None => &mut [],
        };
        let nodal_mass = &body.nodal_mass;
        (MotionMut { time, displacement, velocity, nodal_mass, stress_history }, of_contact)
    }

    fn fits(&self, body: &Body, n_contact: usize) -> bool {
        let n = body.nodal_mass.len();
        let fields = [&self.displacement, &self.velocity];
        self.history.len() == body.n_history() + n_contact
            && fields.into_iter().chain(&self.history).all(|field| field.len() == n)
    }
}

impl Scratch {
    pub fn new(model: &Model) -> Self {
        let forces = model.bodies().each_ref().map(|body| vec![[0.0; 2]; body.nodal_mass.len()]);
        let contact = model.contact().buffers();
        Self { forces, resultants: [0.0; 2], pool: Vec::new(), contact }
    }
}
