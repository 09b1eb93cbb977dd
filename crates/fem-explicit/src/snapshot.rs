//! Fields of both bodies at an instant.

use crate::model::Model;
use crate::nodes::advance_motion;
use crate::recorder::n_kept;
use crate::state::{Scratch, State};

/// The named instants of a collision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Label {
    /// Approach at half its maximum, going in.
    MidCompression,
    /// Approach at its maximum.
    Maximum,
    /// Approach at half its maximum, coming out.
    MidSeparation,
    /// The last step with a contact force.
    LastContact,
}

impl Label {
    /// All of them, in the order of time.
    pub const ALL: [Self; 4] =
        [Self::MidCompression, Self::Maximum, Self::MidSeparation, Self::LastContact];

    /// The name in case and file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::MidCompression => "mid-compression",
            Self::Maximum => "maximum",
            Self::MidSeparation => "mid-separation",
            Self::LastContact => "last-contact",
        }
    }
}

/// Which snapshots a run keeps.
#[derive(Debug, Clone, PartialEq)]
pub enum SnapshotRequest {
    /// At named instants.
    Labels(Vec<Label>),
    /// So many, evenly over the contact.
    Count(usize),
    /// At these times since the start of the case, s.
    Times(Vec<f64>),
}

impl SnapshotRequest {
    /// States that a run keeps in memory beyond the ladder for the labels.
    pub fn n_states(&self) -> usize {
        match self {
            Self::Labels(_) => 0,
            Self::Count(n) => n_kept(*n),
            Self::Times(times) => times.len(),
        }
    }
}

/// Nodal fields of one body; empty for a wall.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyFields {
    /// Total displacement (r, y), m.
    pub displacement: Vec<[f64; 2]>,
    /// Velocity (r, y), m/s.
    pub velocity: Vec<[f64; 2]>,
    /// Effective displacement that the relaxing stress sees, m; empty for an
    /// elastic body.
    pub(crate) effective: Vec<[f64; 2]>,
}

/// Both bodies at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Which instant, for named ones.
    pub label: Option<Label>,
    /// Time since the start of the case, s.
    pub time: f64,
    /// Approach, m.
    pub approach: f64,
    /// Lower and upper body.
    pub bodies: [BodyFields; 2],
}

impl Snapshot {
    pub(crate) fn empty() -> Self {
        Self { label: None, time: 0.0, approach: 0.0, bodies: Default::default() }
    }

    /// Overwrites this snapshot with the state at t_n, whose forces are in
    /// `scratch`; buffers are used again.
    pub(crate) fn take(
        &mut self,
        model: &Model,
        state: &State,
        scratch: &Scratch,
        approach: f64,
        label: Option<Label>,
    ) {
        self.label = label;
        self.time = state.time;
        self.approach = approach;
        for (side, fields) in self.bodies.iter_mut().enumerate() {
            let body = &model.bodies()[side];
            if body.mesh().is_none() {
                continue;
            }
            let state = &state.bodies[side];
            fields.effective.clone_from(&state.w);
            fields.velocity.clone_from(&state.v);
            fields.displacement.clone_from(&state.u);
            // Half a step brings the velocity to t_n; the displacement does not
            // move with it and is taken anew.
            advance_motion(
                0.5 * model.time_step(),
                &body.inverse_mass,
                &scratch.forces[side],
                &mut fields.velocity,
                &mut fields.displacement,
            );
            fields.displacement.copy_from_slice(&state.u);
        }
    }

    /// Rigid motion at a time before first touch (s).
    pub(crate) fn in_free_flight(model: &Model, time: f64) -> Self {
        let bodies = model.bodies().each_ref().map(|body| {
            let n = body.n_nodes();
            let relaxing = if body.n_branches() > 0 { n } else { 0 };
            let displacement = [0.0, body.velocity * time];
            BodyFields {
                displacement: vec![displacement; n],
                velocity: vec![[0.0, body.velocity]; n],
                effective: vec![displacement; relaxing],
            }
        });
        let approach = model.approach_speed() * time - model.gap();
        Self { label: None, time, approach, bodies }
    }
}
