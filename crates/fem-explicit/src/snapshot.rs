//! Snapshots of the explicit model's state.

use fem_collision::{BodyFields, ContactProfilePoint, Snapshot, SnapshotInstant, SnapshotRequest};

use crate::model::Model;
use crate::motion::advance_motion;
use crate::part::NodalField;
use crate::state::State;

/// States that a run keeps in memory for a request, beyond the ladder for the labels.
pub fn n_states(request: &SnapshotRequest) -> usize {
    match request {
        SnapshotRequest::Labels(_) => 0,
        SnapshotRequest::Count(n) => n_kept(*n),
        SnapshotRequest::Times(times) => times.len(),
    }
}

/// States kept at most for so many snapshots evenly over the contact: two to
/// four for each, and enough to find the middle of a few.
pub(crate) fn n_kept(n_snapshots: usize) -> usize {
    n_snapshots.max(16).saturating_mul(4)
}

/// Overwrites a snapshot with the state at t_n, whose forces (N) are these;
/// buffers are used again.
pub(crate) fn take(
    snapshot: &mut Snapshot,
    model: &Model,
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
        // Half a step brings the velocity to t_n; the displacement does not
        // move with it and is taken anew.
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

/// Rigid motion at a time before first touch (s).
pub(crate) fn in_free_flight(model: &Model, time: f64) -> Snapshot {
    let bodies = model.bodies().each_ref().map(|body| {
        let n = body.n_nodes();
        let n_effective = if body.effective().is_some() { n } else { 0 };
        let n_stresses = if body.bound.is_some() { body.n_elements() } else { 0 };
        let displacement = [0.0, body.velocity * time];
        BodyFields {
            displacement: vec![displacement; n],
            velocity: vec![[0.0, body.velocity]; n],
            effective: vec![displacement; n_effective],
            stress: vec![[0.0; 4]; n_stresses],
        }
    });
    let approach = model.approach().speed() * time - model.approach().gap();
    Snapshot { time, approach, bodies, ..Snapshot::default() }
}

/// Whether a snapshot's fields are of the model's sizes.
pub(crate) fn fits(snapshot: &Snapshot, model: &Model) -> bool {
    snapshot.bodies.iter().zip(model.bodies()).all(|(fields, body)| {
        let n = body.n_nodes();
        let n_effective = if body.effective().is_some() { n } else { 0 };
        let n_stresses = if body.bound.is_some() { body.n_elements() } else { 0 };
        fields.displacement.len() == n
            && fields.velocity.len() == n
            && fields.effective.len() == n_effective
            && fields.stress.len() == n_stresses
    })
}
