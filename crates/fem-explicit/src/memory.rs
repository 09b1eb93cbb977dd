//! All that a run knows beside its model: what a restart needs, and nothing else.

use fem_collision::{Approach, Ending, Expectation, History, OutputRequest, Snapshot};
use serde::{Deserialize, Serialize};

use crate::contact_log::ContactLog;
use crate::fingerprint::fingerprint;
use crate::ledger::Ledger;
use crate::model::Model;
use crate::observed::Observed;
use crate::probing;
use crate::recorder::Recorder;
use crate::sound::LastSound;
use crate::stability::Stability;
use crate::state::State;

/// The memory of a run between two steps. A run that is resumed from it goes on to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    pub(crate) state: State,
    pub(crate) log: ContactLog,
    pub(crate) ledger: Ledger,
    pub(crate) observed: Observed,
    /// Of a run that is asked for rows.
    pub(crate) history: Option<History>,
    pub(crate) recorder: Recorder,
    /// What probes have seen so far.
    pub(crate) probes: Vec<Snapshot>,
    /// Of a run that has not come to its end.
    pub(crate) sound: LastSound,
    /// Of laws that can lose it.
    pub(crate) stability: Stability,
    /// Of a run that has ended.
    pub(crate) ending: Option<Ending>,
    /// What closed forms expect.
    pub(crate) expected: Expectation,
    /// What the run was asked for.
    want: OutputRequest,
    /// Of the model that it belongs to, as are the next.
    approach: Approach,
    /// See [`fingerprint`].
    fingerprint: u64,
    /// Radius out to which that looks for contact, m.
    candidate_radius: f64,
}

impl Memory {
    /// Of a run that has not begun.
    pub(crate) fn new(model: &Model, expected: Expectation, want: &OutputRequest) -> Self {
        let expected_steps = expected.contact_time / model.time_step();
        let state = State::at_first_touch(model);
        Self {
            log: ContactLog::new(model, &state),
            ledger: Ledger::new(model, &state),
            state,
            observed: Observed::new(model, expected_steps),
            history: (want.history_rows > 0)
                .then(|| History::new(want.history_rows, expected_steps)),
            recorder: Recorder::new(&want.snapshots, model, expected),
            probes: Vec::new(),
            sound: LastSound::of(want),
            stability: Stability::default(),
            ending: None,
            expected,
            want: want.clone(),
            approach: *model.approach(),
            fingerprint: fingerprint(model),
            candidate_radius: model.candidate_radius(),
        }
    }

    /// Steps done.
    pub fn step(&self) -> u64 {
        self.state.step
    }

    /// Time since the start of the case, s.
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// How the bodies met: those of its model must meet alike.
    pub fn approach(&self) -> &Approach {
        &self.approach
    }

    /// Radius out to which the run looks for contact, m: its model must have the same.
    pub fn candidate_radius(&self) -> f64 {
        self.candidate_radius
    }

    /// What the run was asked for when it began.
    pub fn want(&self) -> &OutputRequest {
        &self.want
    }

    /// What closed forms expected when it began.
    pub fn expected(&self) -> Expectation {
        self.expected
    }

    /// How the run ended; `None` while it is under way.
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    /// The run gives up this long after first touch, s.
    pub(crate) fn max_time(&self) -> f64 {
        self.want.give_up_after * self.expected.contact_time
    }

    /// Whether it can be of a run of this model: its approach, its region of contact, its fingerprint,
    /// fields of its sizes, and parts that do not contradict each other. What was computed is not
    /// computed again: another number in its place is seen only where it contradicts something.
    pub(crate) fn fits(&self, model: &Model) -> bool {
        let Self { state, .. } = self;
        let history_fits = |history: &History| {
            history.is_sound() && history.rows().last().is_none_or(|row| row.time <= state.time)
        };
        self.approach == *model.approach()
            && self.fingerprint == fingerprint(model)
            && self.candidate_radius.to_bits() == model.candidate_radius().to_bits()
            && !self.max_time().is_nan()
            && state.fits(model)
            && self.log.fits(state)
            && self.ledger.fits(model, state)
            && self.observed.fits(model, state)
            && self.history.is_some() == (self.want.history_rows > 0)
            && self.history.as_ref().is_none_or(history_fits)
            && self.recorder.fits(model, &self.want.snapshots)
            && probing::fits(&self.probes, &self.want, state.time)
            && self.sound.fits(model, state, &self.want)
            && self.stability.fits(model, state)
    }
}

#[cfg(test)]
mod tests;
