//! The restart state of a run: all that its continuation depends on apart from its model.

use fem_collision::{Account, Approach, Ending, Expectation, History, OutputRequest, Snapshot};
use serde::{Deserialize, Serialize};

use super::contact_log::ContactLog;
use super::material_stability::MaterialStability;
use super::sampled_history::SampledHistory;
use crate::energy::Ledger;
use crate::model::{ExplicitBodies, fingerprint};
use crate::snapshots::{LastValidState, Recorder, probes_fit};
use crate::state::State;

/// The state of a run between two steps, for a restart. A run that is resumed from it gives the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunState {
    pub(crate) state: State,
    pub(crate) log: ContactLog,
    pub(crate) ledger: Ledger,
    pub(crate) sampled: SampledHistory,
    /// Present if rows are requested.
    pub(crate) history: Option<History>,
    pub(crate) recorder: Recorder,
    /// Samples of the probes so far.
    pub(crate) probes: Vec<Snapshot>,
    /// Empty once the run has come to its end.
    pub(crate) last_valid: LastValidState,
    pub(crate) stability: MaterialStability,
    /// Present once the run has ended.
    pub(crate) ending: Option<Ending>,
    /// Estimates by closed forms.
    pub(crate) expected: Expectation,
    /// Output that was requested.
    request: OutputRequest,
    /// Approach of the model.
    approach: Approach,
    /// Approach for which the parts of the model were chosen: that of the first contact of bodies that meet again.
    made_for: Approach,
    /// Fingerprint of the model, see [`fingerprint`].
    fingerprint: u64,
    /// Radius of the candidate region of the model, m.
    candidate_radius: f64,
    /// Whether the bodies met on a dent.
    began_dented: bool,
}

impl RunState {
    /// Returns the state at first touch.
    pub(crate) fn new(
        model: &ExplicitBodies,
        expected: Expectation,
        request: &OutputRequest,
    ) -> Self {
        let expected_steps = expected.contact_time / model.time_step();
        let state = State::at_first_touch(model);
        Self {
            log: ContactLog::new(model, &state),
            ledger: Ledger::new(model, &state),
            state,
            sampled: SampledHistory::new(model, expected_steps),
            history: (request.history_rows > 0)
                .then(|| History::new(request.history_rows, expected_steps)),
            recorder: Recorder::new(&request.snapshots, model, expected),
            probes: Vec::new(),
            last_valid: LastValidState::new(request),
            stability: MaterialStability::default(),
            ending: None,
            expected,
            request: request.clone(),
            approach: *model.approach(),
            made_for: *model.approach(),
            began_dented: false,
            fingerprint: fingerprint(model),
            candidate_radius: model.candidate_radius(),
        }
    }

    /// Returns the state at the first touch of bodies that meet again in the same place, in equilibrium with the internal
    /// variables that an ended run has left. They are where undented bodies would touch, a depth of the dents apart.
    pub(crate) fn again(
        model: &ExplicitBodies,
        expected: Expectation,
        request: &OutputRequest,
        before: &Self,
    ) -> Self {
        let mut run = Self::new(model, expected, request);
        let clock = run.state.clock(model);
        for (side, body) in model.bodies().iter().enumerate().filter(|(_, body)| body.flows()) {
            let (mut left, state) =
                (before.state.bodies[side].clone(), &mut run.state.bodies[side]);
            body.settle(&mut left, clock);
            let centre = body.centre(&left.displacement);
            for (u, [radial, axial]) in state.displacement.iter_mut().zip(left.displacement) {
                *u = [radial, u[1] + (axial - centre)];
            }
            let n_fields = body.n_fields();
            state.history[..n_fields].clone_from_slice(&left.history[..n_fields]);
            // Its forces are those of the last step.
            state.advance_stress(body, clock);
        }
        run.ledger.inherit(model, &run.state);
        Self { made_for: before.made_for, began_dented: true, ..run }
    }

    /// Returns whether the run has ended and left a body dented, by itself or by an earlier run.
    pub fn is_dented(&self) -> bool {
        let work = self.sampled.last.and_then(|row| row.energy(Account::PlasticWork));
        let is_dented = self.began_dented || work.is_some_and(|work| work > 0.0);
        self.ending == Some(Ending::Parted) && is_dented
    }

    /// Returns the approach for which the parts of the model were chosen; [`ExplicitBodies::approaching`] turns such a model
    /// into that of this run.
    pub fn made_for(&self) -> &Approach {
        &self.made_for
    }

    /// Returns the number of steps taken.
    pub fn step(&self) -> u64 {
        self.state.step
    }

    /// Returns the time since the start of the case, s.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Returns how the bodies met; those of a model that resumes must meet alike.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// Returns the radius of the candidate region, m; a model that resumes must have the same.
    pub fn candidate_radius(&self) -> f64 {
        self.candidate_radius
    }

    /// Returns the output that was requested when the run began.
    pub fn request(&self) -> &OutputRequest {
        &self.request
    }

    /// Returns the estimates by closed forms from when the run began.
    pub fn expected(&self) -> Expectation {
        self.expected
    }

    /// Returns how the run has ended; `None` while it is under way.
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    /// Returns the time after first touch at which the run gives up, s.
    pub(crate) fn max_time(&self) -> f64 {
        self.request.max_contact_times * self.expected.contact_time
    }

    /// Returns whether it can belong to a run of a model: approach, candidate region, fingerprint and sizes of all
    /// fields agree, and its parts do not contradict each other. Computed numbers are not computed again: a wrong one
    /// is found only where it contradicts another.
    pub(crate) fn fits(&self, model: &ExplicitBodies) -> bool {
        let Self { state, .. } = self;
        let history_fits = |history: &History| {
            history.is_consistent()
                && history.rows().last().is_none_or(|row| row.time <= state.time)
        };
        self.approach == *model.approach()
            && self.made_for.gap() == self.approach.gap()
            && self.fingerprint == fingerprint(model)
            && self.candidate_radius.to_bits() == model.candidate_radius().to_bits()
            && !self.max_time().is_nan()
            && state.fits(model)
            && self.log.fits(state)
            && self.ledger.fits(model, state)
            && self.sampled.fits(model, state)
            && self.history.is_some() == (self.request.history_rows > 0)
            && self.history.as_ref().is_none_or(history_fits)
            && self.recorder.fits(model, &self.request.snapshots)
            && probes_fit(&self.probes, &self.request, state.time)
            && self.last_valid.fits(model, state, &self.request)
            && self.stability.fits(model, state)
    }
}
