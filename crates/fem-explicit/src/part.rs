//! Parts of a step: stress, forces on nodes and contact.

use std::any::Any;
use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;

use fem_collision::EnergyLedger;

/// A field of pairs (r, y), one per node of a body.
pub type Field = [[f64; 2]];

/// A field that a body owns.
pub type NodalField = Vec<[f64; 2]>;

/// A part of the step: a stress, a force on the nodes or a contact.
///
/// A part is chosen once, when the model is built, and is constant over a run. Its state are the fields of history that
/// it declares: the run keeps them, zero at first, passes them to every call, and lets the part advance them at the end
/// of each step. A part that a body does not have stores and computes nothing.
pub trait Part: Any + Debug + Send + Sync {
    /// Returns the number of its nodal fields of history for a body. A part without history is not asked to advance.
    fn n_history(&self) -> usize {
        0
    }

    /// Takes the time step (s) once, when the model is built. If the stiffness of a body changes, it is the longest of
    /// a run ([`Motion::time_step`]).
    fn set_time_step(&mut self, _: f64) {}
}

/// The motion of a body at time t_n, as parts see it.
#[derive(Debug, Clone, Copy)]
pub struct Motion<'a> {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Time step Δt, s: that of the model, or shorter.
    pub time_step: f64,
    /// Displacements of the nodes, m.
    pub displacement: &'a Field,
    /// Velocities at t_n − Δt/2, m/s.
    pub velocity: &'a Field,
    /// Lumped masses, mass scaling included, kg; 0 for the one node of a wall.
    pub nodal_mass: &'a [f64],
}

/// Energies and powers of the parts of both bodies at an instant.
#[derive(Debug, Clone, Copy, Default)]
pub struct Accounts {
    /// Energies stored, or exchanged since first touch, J.
    pub energies: EnergyLedger,
    /// Powers into accounts, W, which are integrated over time from first touch.
    pub powers: EnergyLedger,
}

/// The motion of a body at the end of a step, for a contact that moves some of its nodes itself.
#[derive(Debug)]
pub struct MotionMut<'a> {
    /// Time since the start of the case, s.
    pub time: f64,
    /// Time step, s.
    pub time_step: f64,
    /// Displacements of the nodes, m.
    pub displacement: &'a mut Field,
    /// Velocities over the step, m/s.
    pub velocity: &'a mut Field,
    /// Lumped masses, mass scaling included, kg; 0 for the one node of a wall.
    pub nodal_mass: &'a [f64],
    /// History of the stress of the body at the end of the step.
    pub stress_history: &'a mut [NodalField],
}

impl MotionMut<'_> {
    /// Returns the motion as parts see it.
    pub fn as_motion(&self) -> Motion<'_> {
        let &Self { time, time_step, ref displacement, ref velocity, nodal_mass, .. } = self;
        Motion { time, time_step, displacement, velocity, nodal_mass }
    }
}

/// A part of a body, and the range of its own fields in the history of the body.
#[derive(Debug)]
pub(crate) struct Placed<P: ?Sized> {
    pub part: Arc<P>,
    pub fields: Range<usize>,
}

impl<P: Part + ?Sized> Placed<P> {
    /// Places a part behind a number of fields of other parts, and adds its own to the number.
    pub fn behind(n_fields: &mut usize, part: Arc<P>) -> Self {
        let first = *n_fields;
        *n_fields += part.n_history();
        Self { part, fields: first..*n_fields }
    }

    /// Returns whether it has a history to advance.
    pub fn has_history(&self) -> bool {
        !self.fields.is_empty()
    }

    /// Returns its own fields of the history of a body.
    pub fn of<'a>(&self, history: &'a [NodalField]) -> &'a [NodalField] {
        &history[self.fields.clone()]
    }

    /// Returns its own fields of the history of a body, mutably.
    pub fn of_mut<'a>(&self, history: &'a mut [NodalField]) -> &'a mut [NodalField] {
        &mut history[self.fields.clone()]
    }
}

impl<P: ?Sized> Clone for Placed<P> {
    fn clone(&self) -> Self {
        Self { part: Arc::clone(&self.part), fields: self.fields.clone() }
    }
}
