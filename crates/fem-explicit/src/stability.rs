//! Looks now and then whether the law of an element has lost its stability.
//!
//! Beyond it a band of elements gives way, which one the mesh decides, and the energy of the run stops adding up, or the
//! step follows the band to where the run has no end. Where elements come through it locally neither is so: then it is a
//! warning, else it is why the run ends.

use fem_collision::{StepInstant, Stop};
use serde::{Deserialize, Serialize};

use crate::model::Model;
use crate::state::State;
use crate::stress::Unstable;

/// Instants that are observed from one look to the next: some fifty looks over a contact, each as dear as a few
/// steps.
const STRIDE: u64 = 32;
/// Share of the step at rest below which a run follows elements that give way, and nothing else: a ball of which they do at
/// 25 m/s is there after a hundred steps, and went on for six thousand.
const STALLED: f64 = 0.1;

/// The first element of a run that was seen without stability.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Lost {
    moment: StepInstant,
    body: usize,
    element: usize,
    /// Its centre (r, y) before the collision, m.
    place: [f64; 2],
    stretches: [f64; 3],
    law: String,
}

/// What has been seen so far; in the memory of a run.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Stability {
    n_seen: u64,
    lost: Option<Lost>,
}

impl Stability {
    /// Told of every instant that is observed, and whether the energy adds up in it.
    ///
    /// # Errors
    /// It does not, or the step has become a small share of that at rest, and a law has lost its stability.
    pub fn observe(&mut self, model: &Model, state: &State, adds_up: bool) -> Result<(), Stop> {
        if !can_be_lost(model) {
            return Ok(());
        }
        if self.lost.is_none() && (!adds_up || self.n_seen.is_multiple_of(STRIDE)) {
            self.lost = look(model, state);
        }
        self.n_seen = self.n_seen.saturating_add(1);
        let is_stalled = || state.time_step(model) < STALLED * model.time_step();
        match &self.lost {
            Some(lost) if !adds_up || is_stalled() => Err(lost.stop()),
            _ => Ok(()),
        }
    }

    /// Why an element has collapsed, if a law had lost its stability.
    pub fn why(&mut self, model: &Model, state: &State) -> Option<Stop> {
        if self.lost.is_none() && can_be_lost(model) {
            self.lost = look(model, state);
        }
        self.lost.as_ref().map(Lost::stop)
    }

    /// What a run has to say that came through it, or ended for another reason.
    pub fn warning(&self) -> Option<String> {
        let stop = self.lost.as_ref()?.stop();
        Some(format!(
            "{stop}; what follows depends on the mesh there: name another material.NAME.hyperelastic, as neo-hooke, \
             which is stable at any deformation"
        ))
    }

    /// Whether it can be of a run of this model at this state.
    pub fn fits(&self, model: &Model, state: &State) -> bool {
        self.lost.as_ref().is_none_or(|lost| {
            let n_elements = model.bodies().get(lost.body).map_or(0, |body| body.n_elements());
            lost.element < n_elements && lost.moment.time <= state.time
        })
    }
}

impl Lost {
    fn stop(&self) -> Stop {
        let Self { moment: StepInstant { time, step }, body, element, place, stretches, .. } =
            *self;
        Stop::StabilityLost { time, step, body, element, place, stretches, law: self.law.clone() }
    }
}

/// Whether a body has a law that can lose it.
fn can_be_lost(model: &Model) -> bool {
    let mut stresses = model.bodies().iter().filter_map(|body| body.stress.as_ref());
    stresses.any(|stress| stress.part.can_lose_stability())
}

/// The element of either body that is not stable.
fn look(model: &Model, state: &State) -> Option<Lost> {
    let of = |body: usize| {
        let (own, state_of_body) = (&model.bodies()[body], &state.bodies[body]);
        let stress = own.stress.as_ref().filter(|stress| stress.part.can_lose_stability())?;
        let history = stress.of(&state_of_body.history);
        let Unstable { element, stretches, law } =
            stress.part.unstable_element(&state_of_body.displacement, history)?;
        let place = model.centre(body, element);
        let moment = StepInstant { time: state.time, step: state.step };
        Some(Lost { moment, body, element, place, stretches, law: law.to_string() })
    };
    [0, 1].into_iter().find_map(of)
}
