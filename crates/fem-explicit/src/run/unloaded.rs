//! The bodies after a contact in which they flowed: displacement, residual stress and locked-in energy without vibration.
//!
//! The displacements of the sampled instants after the last contact are averaged with the weights sin²(π s) of the share s
//! of the time until the end of the run. A vibration of the period of the lowest mode is lowered fourfold by that, higher
//! ones by more. The elastic energy at the mean displacement, with the internal variables at the end, is that of the
//! residual stress: a body that had stopped vibrating would hold it. Waves in a half-space and the bending of a plate do not
//! average out: of flat bodies only the elements at finite strain count, out to three radii a_p, where the residual stress is.

use std::f64::consts::PI;

use fem_collision::{POST_CONTACT_FRACTION, Snapshot, SnapshotInstant};
use serde::{Deserialize, Serialize};

use super::contact_log::ContactLog;
use crate::model::ExplicitBodies;
use crate::part::{Motion, NodalField};
use crate::state::State;

/// Weighted sums of the displacements since the last contact.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct UnloadedState {
    weight: f64,
    /// Sums of the displacements (m) of both bodies; empty before the first instant after a contact.
    sums: [NodalField; 2],
}

impl UnloadedState {
    /// Adds an instant; a contact begins the sums anew.
    pub fn observe(&mut self, state: &State, log: &ContactLog, is_closed: bool) {
        let Some((first, last)) = log.first_contact.zip(log.last_contact) else { return };
        if is_closed {
            *self = Self::default();
            return;
        }
        let share = (state.time - last) / (POST_CONTACT_FRACTION * (last - first));
        let weight = if share < 1.0 { (PI * share).sin().powi(2) } else { 0.0 };
        self.weight += weight;
        for (sums, body) in self.sums.iter_mut().zip(&state.bodies) {
            sums.resize(body.displacement.len(), [0.0; 2]);
            for (sum, u) in sums.iter_mut().zip(&body.displacement) {
                for axis in 0..2 {
                    sum[axis] += weight * u[axis];
                }
            }
        }
    }

    /// Returns whether it can belong to a run in this state.
    pub fn fits(&self, state: &State) -> bool {
        let is_empty = self.sums.iter().all(Vec::is_empty);
        let mut bodies = self.sums.iter().zip(&state.bodies);
        let has_sizes = bodies.all(|(sums, body)| sums.len() == body.displacement.len());
        self.weight >= 0.0 && (is_empty || has_sizes)
    }

    /// Returns the mean displacement of the nodes of a body; `None` if there was no instant after the contact.
    pub fn displacement(&self, side: usize) -> Option<NodalField> {
        let mean = |sum: &[f64; 2]| sum.map(|sum| sum / self.weight);
        (self.weight > 0.0).then(|| self.sums[side].iter().map(mean).collect())
    }

    /// Returns the snapshot of the bodies without vibration and the elastic energies (J) that they hold; `None` if there
    /// was no instant after the contact. `velocity` is that of the mass centres, m/s.
    pub fn finish(
        &self,
        model: &ExplicitBodies,
        state: &mut State,
        velocity: [f64; 2],
    ) -> Option<(Snapshot, [f64; 2])> {
        let displacements = [self.displacement(0)?, self.displacement(1)?];
        let mut snapshot = Snapshot {
            label: Some(SnapshotInstant::AfterSeparation),
            time: state.time,
            ..Snapshot::default()
        };
        let clock = state.clock(model);
        let mut locked_in = [0.0; 2];
        for (side, (body, mean)) in model.bodies().iter().zip(displacements).enumerate() {
            let own = &mut state.bodies[side];
            own.displacement = mean;
            if body.mesh().is_none() {
                continue;
            }
            let fields = &mut snapshot.bodies[side];
            body.update_stress_fields(own, fields);
            fields.velocity = vec![[0.0, velocity[side]]; body.n_nodes()];
            let at_rest = vec![[0.0; 2]; body.n_nodes()];
            let motion = Motion { velocity: &at_rest, ..own.motion(body, clock) };
            locked_in[side] = body.residual_energy(&motion, &own.history);
        }
        Some((snapshot, locked_in))
    }
}
