//! What the contact does to the balance of energy and momentum, at every step.
//!
//! Leapfrog keeps the energy of bodies alone exactly ([`crate::ledger`]). The forces p of the contact change
//! it over a step by ½ Δt v_{n+1/2}·(p_n + p_{n+1}), as follows from the equations of motion at t_n and t_{n+1};
//! on nodes without mass p is what keeps them in balance. What the springs hold, C, and dashpots have taken,
//! W, has to grow by as much as that takes:
//!
//! ```math
//! \Delta_n = \tfrac12 \Delta t\, v_{n+1/2} \cdot (p_n + p_{n+1}) + (C + W)_{n+1} - (C + W)_n
//! ```
//!
//! is energy from nowhere, and a pass over the contact's nodes tells it, where the whole balance takes one over
//! all elements. Its sum since the last balance is how far the energy is off now: exact for bodies of small
//! strain that are elastic, to what relaxation is off between two balances for others. Finite strain has errors
//! of its own between them, which only a balance shows.

use fem_contact::ContactForces;
use serde::{Deserialize, Serialize};

use crate::model::Model;
use crate::part::{Accounts, Field};
use crate::state::{BodyState, Scratch, State};

/// Forces of the contact on the nodes of a body that it can push.
#[derive(Debug)]
pub(crate) struct Pushed {
    nodes: Vec<usize>,
    /// N.
    forces: Vec<[f64; 2]>,
}

impl Pushed {
    /// Of a side of a model.
    pub fn new(model: &Model, side: usize) -> Self {
        let mut nodes: Vec<_> = model.contact().pushed_nodes(side);
        nodes.sort_unstable();
        nodes.dedup();
        let nodes: Vec<_> = nodes.into_iter().map(|node| node as usize).collect();
        Self { forces: vec![[0.0; 2]; nodes.len()], nodes }
    }

    /// Told all forces before those of the contact.
    pub fn begin(&mut self, all: &Field) {
        for (force, &node) in self.forces.iter_mut().zip(&self.nodes) {
            *force = all[node];
        }
    }

    /// Told all forces with those of the contact.
    pub fn end(&mut self, all: &Field) {
        for (force, &node) in self.forces.iter_mut().zip(&self.nodes) {
            *force = [all[node][0] - force[0], all[node][1] - force[1]];
        }
    }

    /// Power at the velocities of the nodes, W.
    fn power(&self, state: &BodyState) -> f64 {
        let nodes = self.forces.iter().zip(&self.nodes);
        nodes
            .map(|(force, &node)| {
                let v = state.velocity[node];
                force[0] * v[0] + force[1] * v[1]
            })
            .sum()
    }

    /// Along +y, N.
    fn resultant(&self) -> f64 {
        self.forces.iter().map(|force| force[1]).sum()
    }
}

/// What is known of a step before the forces at its end are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Pending {
    /// s.
    time_step: f64,
    /// Power of the forces at the beginning, W.
    power: f64,
    /// C + W at the beginning, J.
    held: f64,
}

/// What the contact has added since the last balance.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ContactWork {
    /// Σ Δ, J.
    pub energy: f64,
    /// Of both bodies, walls not counted, beyond the impulse on a wall, N s.
    pub momentum: f64,
    pending: Option<Pending>,
}

impl ContactWork {
    /// Told the state and the forces at the end of a step.
    pub fn end_step(
        &mut self,
        model: &Model,
        state: &State,
        scratch: &Scratch,
        contact: &ContactForces,
    ) {
        if let Some(Pending { time_step, power, held }) = self.pending.take() {
            let work = 0.5 * time_step * (power + power_of(state, scratch));
            self.energy += work + (held_by(model, state, contact) - held);
        }
    }

    /// Told the forces of a step (s) that the nodes have just done.
    pub fn begin_step(
        &mut self,
        model: &Model,
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

    /// Begins anew, after a balance.
    pub fn restart(&mut self) {
        (self.energy, self.momentum) = (0.0, 0.0);
    }
}

fn power_of(state: &State, scratch: &Scratch) -> f64 {
    let sides = scratch.pushed.iter().zip(&state.bodies);
    sides.map(|(pushed, body)| pushed.power(body)).sum()
}

/// What springs hold and dashpots have taken, J.
pub(crate) fn held_by(model: &Model, state: &State, contact: &ContactForces) -> f64 {
    let mut accounts = Accounts::default();
    model.contact().add_energies(state.contact_history(model), &mut accounts);
    contact.energy + accounts.energies.entries().map(|(_, energy)| energy).sum::<f64>()
}
