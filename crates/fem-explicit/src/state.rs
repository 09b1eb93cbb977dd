//! The state of a run, which changes from step to step, and its scratch space.

use std::any::Any;

use fem_collision::Snapshot;
use serde::{Deserialize, Serialize};

use crate::body::{BodyState, Clock};
use crate::contact::PushedNodes;
use crate::model::ExplicitBodies;
use crate::part::{Motion, NodalField};
use crate::time::StepControl;

/// More steps than any run takes; up to here step numbers are exact as floating-point numbers.
const MAX_STEPS: u64 = 1 << f64::MANTISSA_DIGITS;

/// The state of both bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    /// Number of steps taken.
    pub step: u64,
    /// Time since the start of the case, s.
    pub time: f64,
    /// Present if the stiffness of the model changes.
    pub step_control: Option<StepControl>,
    pub bodies: [BodyState; 2],
}

/// Forces of the present step, and buffers. Nothing that is read across steps changes a bit of the result.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// Nodal forces of both bodies, N.
    pub forces: [NodalField; 2],
    /// Sum of the forces on nodes other than stress and contact along +y, N.
    pub resultants: [f64; 2],
    /// Share of the contact in the forces.
    pub pushed: [PushedNodes; 2],
    /// Bounds of the stiffness at the nodes of bodies of which it changes, N/m.
    pub stiffness: [Vec<f64>; 2],
    /// Growth of the bounds of the contact's damping at those nodes, N s/m.
    pub damping: [Vec<f64>; 2],
    /// Snapshots that are no longer needed; their memory is used again.
    pub pool: Vec<Snapshot>,
    /// Buffers of the contact.
    pub contact: Box<dyn Any + Send + Sync>,
}

impl State {
    /// Returns the state at first touch, undeformed.
    pub fn at_first_touch(model: &ExplicitBodies) -> Self {
        let time = model.approach().first_touch();
        let step_control = model.changes_stiffness().then(|| {
            let critical = model.time_step() / model.step_factor();
            StepControl::new(time, model.time_step(), critical, model.first_strain_rate())
        });
        let time_step =
            step_control.map_or(model.time_step(), |control| control.time_step(model.time_step()));
        let n_history = model.contact().n_history();
        let bodies = model.bodies().each_ref().map(|body| {
            let mut state = BodyState::in_flight(body, n_history, time);
            state.go_back_half_a_step(body, Clock { time, time_step });
            state
        });
        Self { step: 0, time, step_control, bodies }
    }

    /// Returns the time step at t_n, s.
    pub fn time_step(&self, model: &ExplicitBodies) -> f64 {
        match &self.step_control {
            None => model.time_step(),
            Some(control) => control.time_step(model.time_step()),
        }
    }

    /// Returns the time (s) after a step with this number or a later one, at the present time step.
    pub fn time_after(&self, step: u64, model: &ExplicitBodies) -> f64 {
        match &self.step_control {
            None => model.time_after(step),
            Some(control) => control.time_after(step, model.time_step()),
        }
    }

    /// Returns whether its fields have the sizes of the model, and its time is that of its step.
    pub fn fits(&self, model: &ExplicitBodies) -> bool {
        let n_contact = model.contact().n_history();
        self.step <= MAX_STEPS
            && self.step_control.is_some() == model.changes_stiffness()
            && self.step_control.is_none_or(|control| control.is_valid_at(self.step))
            && self.time == self.time_after(self.step, model)
            && self
                .bodies
                .iter()
                .zip(model.bodies())
                .all(|(state, body)| state.fits(body, n_contact))
    }

    /// Returns both bodies as their parts see them.
    pub fn motions<'a>(&'a self, model: &'a ExplicitBodies) -> [Motion<'a>; 2] {
        let clock = self.clock(model);
        [0, 1].map(|side: usize| self.bodies[side].motion(&model.bodies()[side], clock))
    }

    /// Returns its time and time step.
    pub fn clock(&self, model: &ExplicitBodies) -> Clock {
        Clock { time: self.time, time_step: self.time_step(model) }
    }

    /// Returns the fields that the contact keeps of both bodies.
    pub fn contact_history(&self, model: &ExplicitBodies) -> [&[NodalField]; 2] {
        [0, 1].map(|side: usize| &self.bodies[side].history[model.bodies()[side].n_fields()..])
    }
}

impl Scratch {
    /// Allocates the scratch space of a run.
    pub fn new(model: &ExplicitBodies) -> Self {
        let forces = model.bodies().each_ref().map(|body| vec![[0.0; 2]; body.nodal_mass.len()]);
        let stiffness = model.bodies().each_ref().map(|body| match body.bound {
            Some(_) => vec![0.0; body.nodal_mass.len()],
            None => Vec::new(),
        });
        let (damping, contact) = (stiffness.clone(), model.contact().buffers());
        let pushed = [0, 1].map(|side: usize| PushedNodes::new(model.contact(), side));
        let pool = Vec::new();
        Self { forces, resultants: [0.0; 2], pushed, stiffness, damping, pool, contact }
    }
}
