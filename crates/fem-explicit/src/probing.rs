//! What probes see of a run: a snapshot of the instants that are observed, reduced to their places.

use fem_collision::{OutputRequest, Probes, Snapshot};

use crate::model::Model;
use crate::snapshot::take;
use crate::state::{Scratch, State};

/// The probes of a run, and room for a snapshot; nothing of a run without.
#[derive(Debug)]
pub(crate) struct Probing {
    probes: Probes,
    all: Snapshot,
}

impl Probing {
    /// Finds the places in the meshes of a model.
    pub fn new(model: &Model, want: &OutputRequest) -> Self {
        let meshes = model.bodies().each_ref().map(|body| body.mesh());
        Self { probes: Probes::new(meshes, &want.probes), all: Snapshot::default() }
    }

    /// Adds what is seen at t_n, forces in `scratch`, to what has been.
    pub fn observe(
        &mut self,
        seen: &mut Vec<Snapshot>,
        model: &Model,
        state: &State,
        scratch: &Scratch,
        approach: f64,
    ) {
        if self.probes.is_empty() {
            return;
        }
        take(&mut self.all, model, state, &scratch.forces, approach, None);
        let materials = model.bodies().each_ref().map(|body| body.material());
        seen.push(self.probes.reduce(materials, &self.all));
    }
}

/// Whether this can have been seen until then (s) by what is asked for.
pub(crate) fn fits(seen: &[Snapshot], want: &OutputRequest, time: f64) -> bool {
    let n = want.probes.len();
    let is_of_all = |one: &Snapshot| {
        one.bodies.iter().all(|fields| {
            [fields.displacement.len(), fields.velocity.len(), fields.stress.len()] == [n; 3]
        })
    };
    (n > 0 || seen.is_empty())
        && seen.iter().all(is_of_all)
        && seen.is_sorted_by(|one, next| one.time < next.time)
        && seen.last().is_none_or(|last| last.time <= time)
}
