//! What the parts of a step have in common.

use std::any::Any;
use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;

use fem_collision::EnergyLedger;

/// A field of pairs (r, y), one a node of a body.
pub type Field = [[f64; 2]];

/// A field that a body owns.
pub type NodalField = Vec<[f64; 2]>;

/// A part of the step: a stress, a force on the nodes or a contact.
///
/// A part is chosen once, when the model is built, and constant over a run. What changes are the
/// fields of history that it declares: the run keeps them for it, zero at first, hands them to it
/// whenever it calls it, and has it advance them at the end of each step. A part that a body does
/// not have stores and computes nothing.
pub trait Part: Any + Debug + Send + Sync {
    /// Number of fields of history of a body, each one pair a node. A part without any is not asked
    /// to advance.
    fn n_history(&self) -> usize {
        0
    }

    /// Told once, when the model is built: the time step, s. Where the stiffness of a body changes, it is
    /// the longest of a run ([`Motion::time_step`]).
    fn set_time_step(&mut self, _: f64) {}
}

/// A body at time t_n, as parts see it.
#[derive(Debug, Clone, Copy)]
pub struct Motion<'a> {
    /// Since the start of the case, s.
    pub time: f64,
    /// Δt, s: the model's, or shorter.
    pub time_step: f64,
    /// Displacements, m.
    pub displacement: &'a Field,
    /// Velocities at t_n − Δt/2, m/s.
    pub velocity: &'a Field,
    /// Lumped masses, mass scaling included, kg; 0 for the one node of a wall.
    pub nodal_mass: &'a [f64],
}

/// What the parts of both bodies tell of energy at an instant.
#[derive(Debug, Clone, Copy, Default)]
pub struct Accounts {
    /// What is stored, or was given since first touch, J.
    pub energies: EnergyLedger,
    /// What goes into an account, W: summed over time from first touch.
    pub powers: EnergyLedger,
}

/// A body at the end of a step, for a contact that moves some of its nodes itself.
#[derive(Debug)]
pub struct MotionMut<'a> {
    /// Since the start of the case, s.
    pub time: f64,
    /// Of the step, s.
    pub time_step: f64,
    /// Displacements, m.
    pub displacement: &'a mut Field,
    /// Velocities over the step, m/s.
    pub velocity: &'a mut Field,
    /// Lumped masses, mass scaling included, kg; 0 for the one node of a wall.
    pub nodal_mass: &'a [f64],
    /// What the body's stress remembers at the end of the step.
    pub stress_history: &'a mut [NodalField],
}

impl MotionMut<'_> {
    /// The body as parts see it.
    pub fn as_motion(&self) -> Motion<'_> {
        let &Self { time, time_step, ref displacement, ref velocity, nodal_mass, .. } = self;
        Motion { time, time_step, displacement, velocity, nodal_mass }
    }
}

/// A part of a body, and which of the body's fields of history are its own.
#[derive(Debug)]
pub(crate) struct Placed<P: ?Sized> {
    pub part: Arc<P>,
    pub fields: Range<usize>,
}

impl<P: Part + ?Sized> Placed<P> {
    /// Behind so many fields of other parts, which it adds to.
    pub fn behind(n_fields: &mut usize, part: Arc<P>) -> Self {
        let first = *n_fields;
        *n_fields += part.n_history();
        Self { part, fields: first..*n_fields }
    }

    /// Whether it has something to advance.
    pub fn has_history(&self) -> bool {
        !self.fields.is_empty()
    }

    /// Its own of the fields of a body.
    pub fn of<'a>(&self, history: &'a [NodalField]) -> &'a [NodalField] {
        &history[self.fields.clone()]
    }

    /// Its own of the fields of a body, to be changed.
    pub fn of_mut<'a>(&self, history: &'a mut [NodalField]) -> &'a mut [NodalField] {
        &mut history[self.fields.clone()]
    }
}

impl<P: ?Sized> Clone for Placed<P> {
    fn clone(&self) -> Self {
        Self { part: Arc::clone(&self.part), fields: self.fields.clone() }
    }
}
