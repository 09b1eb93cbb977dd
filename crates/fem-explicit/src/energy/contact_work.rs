//! The share of the contact in the balance of energy and momentum, at every step.
//!
//! Leapfrog conserves the energy of the bodies alone exactly ([`Ledger`](super::Ledger)). The forces p of the contact
//! change it over a step by ½ Δt v_{n+1/2}·(p_n + p_{n+1}), as follows from the equations of motion at t_n and t_{n+1};
//! on nodes without mass p is the force that keeps them in balance. The energy C of the springs and the work W on
//! dashpots must grow by the same amount:
//!
//! ```math
//! \Delta_n = \tfrac12 \Delta t\, v_{n+1/2} \cdot (p_n + p_{n+1}) + (C + W)_{n+1} - (C + W)_n
//! ```
//!
//! is spurious energy. It costs a pass over the nodes of the contact, while the whole balance costs one over all
//! elements. Its sum since the last balance is the present residual: exactly for elastic bodies at small strain, and
//! except the error of the dissipated power between two balances for relaxing ones. At finite strain further errors
//! appear only in a balance.

use fem_contact::ContactForces;
use serde::{Deserialize, Serialize};

use crate::model::ExplicitBodies;
use crate::part::Accounts;
use crate::state::{Scratch, State};

/// The beginning of a step whose end is not known yet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Pending {
    /// The step, s.
    time_step: f64,
    /// Power of the forces at the beginning, W.
    power: f64,
    /// C + W at the beginning, J.
    held: f64,
}

/// Spurious energy and momentum by the contact since the last balance.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ContactWork {
    /// Σ Δ, J.
    pub energy: f64,
    /// Spurious momentum of both bodies, without walls, N s.
    pub momentum: f64,
    pending: Option<Pending>,
}

impl ContactWork {
    /// Takes the state and the forces at the end of a step.
    pub fn end_step(
        &mut self,
        model: &ExplicitBodies,
        state: &State,
        scratch: &Scratch,
        contact: &ContactForces,
    ) {
        if let Some(Pending { time_step, power, held }) = self.pending.take() {
            let work = 0.5 * time_step * (power + power_of(state, scratch));
            self.energy += work + (held_by(model, state, contact) - held);
        }
    }

    /// Takes the forces of a step (s) in which the nodes have just moved, the contact force (N), and the energy that
    /// the contact stored before (J).
    pub fn begin_step(
        &mut self,
        model: &ExplicitBodies,
        held: f64,
        time_step: f64,
        state: &State,
        scratch: &Scratch,
        force: f64,
    ) {
        self.pending = Some(Pending { time_step, power: power_of(state, scratch), held });
        for (side, body) in model.bodies().iter().enumerate() {
            let sign = [-1.0, 1.0][side];
            if !body.is_wall() {
                let lacking = scratch.pushed[side].resultant() - sign * force;
                self.momentum += time_step * lacking;
            }
        }
    }

    /// Begins anew after a balance.
    pub fn restart(&mut self) {
        (self.energy, self.momentum) = (0.0, 0.0);
    }
}

fn power_of(state: &State, scratch: &Scratch) -> f64 {
    let sides = scratch.pushed.iter().zip(&state.bodies);
    sides.map(|(pushed, body)| pushed.power(&body.velocity)).sum()
}

/// Returns the energy of the springs and the work on dashpots, J.
pub(crate) fn held_by(model: &ExplicitBodies, state: &State, contact: &ContactForces) -> f64 {
    let mut accounts = Accounts::default();
    model.contact().add_energies(state.contact_history(model), &mut accounts);
    contact.energy + accounts.energies.entries().map(|(_, energy)| energy).sum::<f64>()
}
