//! Snapshots of the state, probes, and which states are kept.

mod last_valid_state;
mod recorder;

use fem_collision::{
    BodyFields, ContactProfilePoint, OutputRequest, Probes, Snapshot, SnapshotInstant,
    SnapshotRequest,
};

use crate::model::ExplicitBodies;
use crate::part::NodalField;
use crate::state::{Scratch, State};
use crate::time::advance_motion;
pub(crate) use last_valid_state::LastValidState;
pub(crate) use recorder::{Instant, Recorder};

/// Returns the number of states that a run keeps in memory for a request, in addition to the candidates for labels.
pub fn n_states(request: &SnapshotRequest) -> usize {
    match request {
        SnapshotRequest::Labels(_) => 0,
        SnapshotRequest::Count(n) => n_kept(*n),
        SnapshotRequest::Times(times) => times.len(),
    }
}

/// Returns the largest number of states that are kept for a number of snapshots evenly over the contact: two to four for
/// each, and at least 64, so that the middle of a few snapshots is found.
fn n_kept(n_snapshots: usize) -> usize {
    n_snapshots.max(16).saturating_mul(4)
}

/// Overwrites a snapshot with the state at t_n, given its forces (N); the memory of the snapshot is used again.
fn take(
    snapshot: &mut Snapshot,
    model: &ExplicitBodies,
    state: &State,
    forces: &[NodalField; 2],
    approach: f64,
    label: Option<SnapshotInstant>,
) {
    let time_step = state.time_step(model);
    snapshot.label = label;
    snapshot.time = state.time;
    snapshot.approach = approach;
    for (side, fields) in snapshot.bodies.iter_mut().enumerate() {
        let body = &model.bodies()[side];
        if body.mesh().is_none() {
            continue;
        }
        let state = &state.bodies[side];
        body.update_stress_fields(state, fields);
        fields.velocity.clone_from(&state.velocity);
        // Half a step brings the velocity to t_n; the displacement, which moves along, is restored afterwards.
        advance_motion(
            0.5 * time_step,
            &body.inverse_mass,
            &forces[side],
            &mut fields.velocity,
            &mut fields.displacement,
        );
        fields.displacement.copy_from_slice(&state.displacement);
    }
    let profile = model.contact().profile(&state.motions(model), state.contact_history(model));
    let profile = profile.closed();
    snapshot.contact.radius = profile.contact_radius;
    snapshot.contact.places.clear();
    snapshot.contact.places.extend(profile.points.iter().map(|point| ContactProfilePoint {
        is_node: point.is_node,
        radius: point.radius,
        pressure: point.pressure,
        gap: point.gap,
        radial: point.radial,
    }));
}

/// Returns the snapshot of rigid motion at a time before first touch (s).
fn in_free_flight(model: &ExplicitBodies, time: f64) -> Snapshot {
    let bodies = model.bodies().each_ref().map(|body| {
        let n = body.n_nodes();
        let n_effective = if body.effective().is_some() { n } else { 0 };
        let n_stresses = if body.finite_strain().is_some() { body.n_elements() } else { 0 };
        let displacement = [0.0, body.velocity * time];
        BodyFields {
            displacement: vec![displacement; n],
            velocity: vec![[0.0, body.velocity]; n],
            effective: vec![displacement; n_effective],
            stress: vec![[0.0; 4]; n_stresses],
            plastic: vec![[0.0; 2]; if body.flows() { body.n_elements() } else { 0 }],
        }
    });
    let approach = model.approach().speed() * time - model.approach().gap();
    Snapshot { time, approach, bodies, ..Snapshot::default() }
}

/// Whether the fields of a snapshot have the sizes of a model.
fn fits(snapshot: &Snapshot, model: &ExplicitBodies) -> bool {
    snapshot.bodies.iter().zip(model.bodies()).all(|(fields, body)| {
        let n = body.n_nodes();
        let n_effective = if body.effective().is_some() { n } else { 0 };
        let n_stresses = if body.finite_strain().is_some() { body.n_elements() } else { 0 };
        fields.displacement.len() == n
            && fields.velocity.len() == n
            && fields.effective.len() == n_effective
            && fields.stress.len() == n_stresses
            && fields.plastic.len() == if body.flows() { body.n_elements() } else { 0 }
    })
}

/// The probes of a run, and a snapshot to sample from; empty if no probes are requested.
#[derive(Debug)]
pub(crate) struct Probing {
    probes: Probes,
    all: Snapshot,
}

impl Probing {
    /// Finds the places of the requested probes in the meshes of a model.
    pub fn new(model: &ExplicitBodies, request: &OutputRequest) -> Self {
        let meshes = model.bodies().each_ref().map(|body| body.mesh());
        Self { probes: Probes::new(meshes, &request.probes), all: Snapshot::default() }
    }

    /// Appends the sample of an instant t_n to those so far; its forces are in `scratch`.
    pub fn observe(
        &mut self,
        samples: &mut Vec<Snapshot>,
        model: &ExplicitBodies,
        state: &State,
        scratch: &Scratch,
        approach: f64,
    ) {
        if self.probes.is_empty() {
            return;
        }
        take(&mut self.all, model, state, &scratch.forces, approach, None);
        let materials = model.bodies().each_ref().map(|body| body.material());
        samples.push(self.probes.reduce(materials, &self.all));
    }
}

/// Whether samples of probes can belong to a run with this request at a time, s.
pub(crate) fn probes_fit(samples: &[Snapshot], request: &OutputRequest, time: f64) -> bool {
    let n = request.probes.len();
    let is_complete = |one: &Snapshot| {
        one.bodies.iter().all(|fields| {
            [fields.displacement.len(), fields.velocity.len(), fields.stress.len()] == [n; 3]
        })
    };
    (n > 0 || samples.is_empty())
        && samples.iter().all(is_complete)
        && samples.is_sorted_by(|one, next| one.time < next.time)
        && samples.last().is_none_or(|last| last.time <= time)
}
