//! A run from first touch to separation, as a stepper that is advanced in pieces.
//!
//! ```text
//! step                   one step as a list of its phases
//! phases                 forces, step control, motion to the next instant
//! current_critical_step  critical time step of deformed bodies
//! contact_log            first and last contact, extremes
//! sampled_history        what is derived from sampled instants
//! material_stability     search for elements whose law has lost its stability
//! stops                  reasons to stop
//! restart_state          all that a restart needs
//! outcome                the collision that a run returns
//! ```

mod contact_log;
mod current_critical_step;
mod material_stability;
mod outcome;
mod phases;
mod restart_state;
mod sampled_history;
mod step;
mod stops;

use std::ops::Deref;

use fem_collision::{
    Collision, Ending, Expectation, Monitor, OutputRequest, POST_CONTACT_FRACTION, Phase, Progress,
    STEPS_BETWEEN_REPORTS, StepInstant, Stop,
};

use crate::error::ModelError;
use crate::model::ExplicitBodies;
use crate::snapshots::Probing;
use crate::state::Scratch;
#[cfg(test)]
pub(crate) use contact_log::ContactLog;
#[cfg(test)]
pub(crate) use current_critical_step::step_demand;
use outcome::outcome;
#[cfg(test)]
pub(crate) use phases::{advance, update_forces, update_time_step};
pub use restart_state::RunState;
use step::{record_stop, step};

/// Runs a model from first touch until the force has been zero for a fifth of the contact time and the bodies recede.
///
/// Nothing is allocated inside a step, except the states of snapshots until their pool is filled.
pub fn collide(
    model: &ExplicitBodies,
    expected: Expectation,
    request: &OutputRequest,
    monitor: &mut dyn Monitor,
) -> Collision {
    monitor.enter(Phase::Collision);
    let mut run = Run::new(model, expected, request);
    while monitor.report(run.progress()) && run.advance(STEPS_BETWEEN_REPORTS).is_none() {}
    run.finish()
}

/// A run under way. Between two calls of [`Run::advance`] its [`RunState`] is all that the rest of the run depends on.
///
/// It borrows or shares its model: `M` is `&ExplicitBodies` or `Arc<ExplicitBodies>`.
///
/// ```
/// use fem_collision::{Approach, BodyInput, Ending, Expectation, OutputRequest};
/// use fem_explicit::{ExplicitBodies, Run, Settings};
/// # use fem_material::{ElasticModuli, Material};
/// # use fem_mesh::{HalfDisc, Side};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244)?;
/// # let material = Material::new(2390.0, moduli, None)?;
/// # let disc = HalfDisc {
/// #     radius: 1e-2,
/// #     contact_element_size: 0.2e-3,
/// #     refined_radius: 0.6e-3,
/// #     growth: None,
/// #     edge: None,
/// # };
/// # let mesh = disc.build()?.on_side(Side::Below);
/// # let settings = Settings {
/// #     contact_stiffness: 6e11,
/// #     candidate_radius: 0.8e-3,
/// #     step_factor: 0.9,
/// #     mass_scaling: 1e-3,
/// #     mass_times: [1.0; 2],
/// # };
/// let bodies = [BodyInput::Sphere { mesh, material }, BodyInput::Wall];
/// let model = ExplicitBodies::new(bodies, Approach::at(0.5)?, &settings)?;
/// let expected = Expectation { contact_time: 80e-6, approach: 20e-6 };
/// let mut run = Run::new(&model, expected, &OutputRequest::quantities());
/// assert_eq!(run.advance(100), None);
/// // The run is resumed from its restart state, perhaps in another process.
/// let state = run.restart_state().clone();
/// let mut resumed = Run::resume(&model, state)?;
/// while resumed.advance(100).is_none() {}
/// let collision = resumed.finish();
/// assert_eq!(collision.ending, Ending::Parted);
/// assert!((collision.restitution.unwrap() - 1.0).abs() < 2e-3);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Run<M> {
    model: M,
    pub(crate) restart_state: RunState,
    scratch: Scratch,
    probing: Probing,
}

impl<M: Deref<Target = ExplicitBodies>> Run<M> {
    /// Starts a run at first touch.
    pub fn new(model: M, expected: Expectation, request: &OutputRequest) -> Self {
        let restart_state = RunState::new(&model, expected, request);
        Self::from_state(model, restart_state)
    }

    /// Makes a run in a state of its model.
    fn from_state(model: M, restart_state: RunState) -> Self {
        let (scratch, probing) =
            (Scratch::new(&model), Probing::new(&model, restart_state.request()));
        Self { model, restart_state, scratch, probing }
    }

    /// Starts a run of bodies that meet again in the same place, as an ended run of the same bodies has left them
    /// ([`ExplicitBodies::approaching`]): with dents, residual stresses and internal variables, without vibration.
    ///
    /// # Errors
    /// The ended run is one of other bodies.
    pub fn again(
        model: M,
        expected: Expectation,
        request: &OutputRequest,
        before: &RunState,
    ) -> Result<Self, ModelError> {
        if !before.state.fits(&model) {
            return Err(ModelError::ForeignRestartState);
        }
        let restart_state = RunState::again(&model, expected, request, before);
        Ok(Self::from_state(model, restart_state))
    }

    /// Resumes a run of the same model from its restart state; a run that had ended has ended.
    ///
    /// # Errors
    /// The restart state belongs to another model or version (other meshes, masses, materials, forces, contact, approach or
    /// time step), or its parts contradict each other.
    pub fn resume(model: M, restart_state: RunState) -> Result<Self, ModelError> {
        if !restart_state.fits(&model) {
            return Err(ModelError::ForeignRestartState);
        }
        Ok(Self::from_state(model, restart_state))
    }

    /// Returns the model, as the run borrows or shares it.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// Returns all that a restart needs.
    pub fn restart_state(&self) -> &RunState {
        &self.restart_state
    }

    /// Returns the progress of the run.
    pub fn progress(&self) -> Progress {
        let RunState { state, log, expected, .. } = &self.restart_state;
        let length = (1.0 + POST_CONTACT_FRACTION) * expected.contact_time;
        let elapsed = state.time - self.model.approach().first_touch();
        Progress {
            time: state.time,
            step: state.step,
            fraction: Progress::share(elapsed, length),
            contact_force: log.force,
        }
    }

    /// Takes up to `n_steps` steps. Returns how the run has ended; then no further step is taken.
    pub fn advance(&mut self, n_steps: u64) -> Option<&Ending> {
        let Self { model, restart_state, scratch, probing } = self;
        advance_run(restart_state, model, scratch, probing, n_steps);
        restart_state.ending.as_ref()
    }

    /// Returns the results up to here. A run that has not ended counts as interrupted.
    pub fn finish(self) -> Collision {
        let Self { model, mut restart_state, mut scratch, .. } = self;
        let ending = restart_state.ending.take().unwrap_or_else(|| {
            let (time, step) = (restart_state.state.time, restart_state.state.step);
            Ending::Stopped(Stop::Interrupted { at: StepInstant { time, step } })
        });
        if let Ending::Stopped(_) = ending {
            record_stop(&mut restart_state, &model, &mut scratch);
        }
        outcome(&model, restart_state, ending)
    }
}

/// Takes up to `n_steps` steps of a run that has not ended; compiled once for all holders of a model.
fn advance_run(
    run: &mut RunState,
    model: &ExplicitBodies,
    scratch: &mut Scratch,
    probing: &mut Probing,
    n_steps: u64,
) {
    for _ in 0..n_steps {
        if run.ending.is_some() {
            return;
        }
        run.ending = match step(run, model, scratch, probing) {
            Ok(ending) => ending.inspect(|_| run.last_valid.forget()),
            Err(stop) => Some(Ending::Stopped(stop)),
        };
    }
}

#[cfg(test)]
mod tests;
