//! What changes in a run.

use std::any::Any;

use fem_collision::Snapshot;
use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::contact_work::Pushed;
use crate::model::Model;
use crate::pace::Pace;
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
    /// Of a model whose stiffness changes.
    pub pace: Option<Pace>,
    pub bodies: [BodyState; 2],
}

/// An instant t_n and the step Δt there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    /// Since the start of the case, s.
    pub time: f64,
    /// s.
    pub time_step: f64,
}

/// Forces of the present step, and buffers; nothing that is read across steps decides a bit.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// Nodal forces of both bodies, N.
    pub forces: [NodalField; 2],
    /// What the forces on nodes beside stress and contact add up to along +y, N.
    pub resultants: [f64; 2],
    /// What of the forces is of the contact.
    pub pushed: [Pushed; 2],
    /// Bounds of the stiffness at the nodes of bodies of which it changes, N/m.
    pub stiffness: [Vec<f64>; 2],
    /// What the bounds of the contact's damping at those nodes have grown by, N s/m.
    pub damping: [Vec<f64>; 2],
    /// Snapshots that are not needed any more, to be overwritten.
    pub pool: Vec<Snapshot>,
    /// The contact's own.
    pub contact: Box<dyn Any + Send + Sync>,
}

impl State {
    /// The bodies at first touch, undeformed.
    pub fn at_first_touch(model: &Model) -> Self {
        let time = model.approach().first_touch();
        let pace = Pace::of(model);
        let time_step = pace.map_or(model.time_step(), |pace| pace.time_step(model));
        let n_history = model.contact().n_history();
        let bodies = model.bodies().each_ref().map(|body| {
            let mut state = BodyState::in_flight(body, n_history, time);
            state.go_back_half_a_step(body, Clock { time, time_step });
            state
        });
        Self { step: 0, time, pace, bodies }
    }

    /// Time step at t_n, s.
    pub fn time_step(&self, model: &Model) -> f64 {
        match &self.pace {
            None => model.time_step(),
            Some(pace) => pace.time_step(model),
        }
    }

    /// Time after a step whose number is this or a later one, at the time step of now, s.
    pub fn time_after(&self, step: u64, model: &Model) -> f64 {
        match &self.pace {
            None => model.time_after(step),
            Some(pace) => pace.time_after(step, model),
        }
    }

    /// Whether its fields are of the model's sizes, and its time that of its step.
    pub fn fits(&self, model: &Model) -> bool {
        let n_contact = model.contact().n_history();
        self.step <= MOST_STEPS
            && self.pace.is_some() == model.changes_stiffness()
            && self.pace.is_none_or(|pace| pace.is_sound_at(self.step))
            && self.time == self.time_after(self.step, model)
            && self
                .bodies
                .iter()
                .zip(model.bodies())
                .all(|(state, body)| state.fits(body, n_contact))
    }

    /// Both bodies as their parts see them.
    pub fn motions<'a>(&'a self, model: &'a Model) -> [Motion<'a>; 2] {
        let clock = self.clock(model);
        [0, 1].map(|side: usize| self.bodies[side].motion(&model.bodies()[side], clock))
    }

    /// Its time and time step.
    pub fn clock(&self, model: &Model) -> Clock {
        Clock { time: self.time, time_step: self.time_step(model) }
    }

    /// The fields that the contact keeps of both bodies.
    pub fn contact_history(&self, model: &Model) -> [&[NodalField]; 2] {
        [0, 1].map(|side: usize| &self.bodies[side].history[model.bodies()[side].n_fields()..])
    }
}

impl BodyState {
    /// Undeformed, after a time (s) of free flight; the contact keeps `n_contact` fields of it.
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

    /// Velocities are those of half a step before: takes back what the forces on nodes do in it.
    fn go_back_half_a_step(&mut self, body: &Body, clock: Clock) {
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

    /// As the parts of its body see it.
    pub fn motion<'a>(&'a self, body: &'a Body, clock: Clock) -> Motion<'a> {
        Motion {
            time: clock.time,
            time_step: clock.time_step,
            displacement: &self.displacement,
            velocity: &self.velocity,
            nodal_mass: &body.nodal_mass,
        }
    }

    /// What the contact may change of it at the end of a step.
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

    fn fits(&self, body: &Body, n_contact: usize) -> bool {
        let n = body.nodal_mass.len();
        let lengths = body.field_lengths().chain(std::iter::repeat_n(n, n_contact));
        self.displacement.len() == n
            && self.velocity.len() == n
            && self.history.iter().map(Vec::len).eq(lengths)
    }
}

impl Scratch {
    pub fn new(model: &Model) -> Self {
        let forces = model.bodies().each_ref().map(|body| vec![[0.0; 2]; body.nodal_mass.len()]);
        let stiffness = model.bodies().each_ref().map(|body| match body.bound {
            Some(_) => vec![0.0; body.nodal_mass.len()],
            None => Vec::new(),
        });
        let (damping, contact) = (stiffness.clone(), model.contact().buffers());
        let pushed = [Pushed::new(model, 0), Pushed::new(model, 1)];
        let pool = Vec::new();
        Self { forces, resultants: [0.0; 2], pushed, stiffness, damping, pool, contact }
    }
}
