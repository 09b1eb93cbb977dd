//! Search for elements whose law has lost its stability (loss of ellipticity).
//!
//! After loss of ellipticity strain localises in a band that depends on the mesh. Either the energy of the run stops
//! adding up, or the time step becomes ever shorter: then the run stops for this reason. If neither happens, the
//! instability was local, and the run ends with a warning.

use fem_collision::{StepInstant, Stop};
use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::model::ExplicitBodies;
use crate::state::State;
use crate::stress::UnstableElement;

/// Sampled instants from one search to the next: about fifty searches per contact, each as expensive as a few steps.
const INSTANTS_BETWEEN_SEARCHES: u64 = 32;
/// Share of the initial time step below which a run only follows localising elements.
const STALLED_STEP_SHARE: f64 = 0.1;

/// The first unstable element of a run that was found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct FirstUnstableElement {
    at: StepInstant,
    body: usize,
    element: usize,
    /// Its centre (r, y) before the collision, m.
    place: [f64; 2],
    stretches: [f64; 3],
    law: String,
}

/// The result of the search so far.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct MaterialStability {
    n_seen: u64,
    unstable: Option<FirstUnstableElement>,
}

impl MaterialStability {
    /// Takes note of a sampled instant, and whether the energy adds up there.
    ///
    /// # Errors
    /// A law has lost its stability, and the energy does not add up or the step is below a tenth of the initial one.
    pub fn observe(
        &mut self,
        model: &ExplicitBodies,
        state: &State,
        adds_up: bool,
    ) -> Result<(), Stop> {
        if !can_be_lost(model) {
            return Ok(());
        }
        if self.unstable.is_none()
            && (!adds_up || self.n_seen.is_multiple_of(INSTANTS_BETWEEN_SEARCHES))
        {
            self.unstable = find(model, state);
        }
        self.n_seen = self.n_seen.saturating_add(1);
        let is_stalled = || state.time_step(model) < STALLED_STEP_SHARE * model.time_step();
        match &self.unstable {
            Some(unstable) if !adds_up || is_stalled() => Err(unstable.stop()),
            _ => Ok(()),
        }
    }

    /// Returns the stop of a run in which an element has collapsed, if a law had lost its stability.
    pub fn stop_of_collapse(&mut self, model: &ExplicitBodies, state: &State) -> Option<Stop> {
        if self.unstable.is_none() && can_be_lost(model) {
            self.unstable = find(model, state);
        }
        self.unstable.as_ref().map(FirstUnstableElement::stop)
    }

    /// Returns the warning of a run that has passed an instability.
    pub fn warning(&self) -> Option<String> {
        let stop = self.unstable.as_ref()?.stop();
        Some(format!(
            "{stop}; what follows depends on the mesh there: name another material.NAME.hyperelastic, as neo-hooke, \
             which is stable at any deformation"
        ))
    }

    /// Returns whether it can belong to a run of a model in a state.
    pub fn fits(&self, model: &ExplicitBodies, state: &State) -> bool {
        self.unstable.as_ref().is_none_or(|unstable| {
            let n_elements = model.bodies().get(unstable.body).map_or(0, |body| body.n_elements());
            unstable.element < n_elements && unstable.at.time <= state.time
        })
    }
}

impl FirstUnstableElement {
    fn stop(&self) -> Stop {
        let Self { at: StepInstant { time, step }, body, element, place, stretches, .. } = *self;
        Stop::StabilityLost {
            at: StepInstant { time, step },
            body,
            element,
            place,
            stretches,
            law: self.law.clone(),
        }
    }
}

/// Returns whether a body has a law that can lose its stability.
fn can_be_lost(model: &ExplicitBodies) -> bool {
    let mut stresses = model.bodies().iter().filter_map(Body::finite_strain);
    stresses.any(|stress| stress.can_lose_stability())
}

/// Finds the least stable element of a body that has an unstable one.
fn find(model: &ExplicitBodies, state: &State) -> Option<FirstUnstableElement> {
    let of = |body: usize| {
        let (own, state_of_body) = (&model.bodies()[body], &state.bodies[body]);
        let stress = own.finite_strain().filter(|stress| stress.can_lose_stability())?;
        let history = own.stress.as_ref()?.of(&state_of_body.history);
        let UnstableElement { element, stretches, law } =
            stress.unstable_element(&state_of_body.displacement, history)?;
        let place = own.element_centre(element);
        let at = StepInstant { time: state.time, step: state.step };
        Some(FirstUnstableElement { at, body, element, place, stretches, law: law.to_string() })
    };
    [0, 1].into_iter().find_map(of)
}
