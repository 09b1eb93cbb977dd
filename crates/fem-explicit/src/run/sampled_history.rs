//! Quantities that a run derives from sampled instants, whether or not their rows are kept.

use fem_collision::{
    Account, BalanceSide, ForceNoise, ForcePulse, HistoryRow, OutputRequest, PostContactVibration,
    RelativeMotion, RestCriterion, SamplingInterval, StepInstant,
};
use serde::{Deserialize, Serialize};

use crate::model::ExplicitBodies;
use crate::state::State;

/// Share of the kinetic energy of a half-space that certainly does not come back: in outgoing waves strain energy and
/// kinetic energy agree within some per cent.
const GONE_WITH_WAVES: f64 = 0.95;

/// Quantities derived from the instants that have been sampled so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SampledHistory {
    sampling_interval: SamplingInterval,
    /// Means and peaks of force, contact radius and pressure.
    pub pulse: ForcePulse,
    /// Scatter of the contact force from step to step.
    pub force_noise: ForceNoise,
    /// Vibration since the last contact; `None` before the first one.
    pub vibration_after: Option<PostContactVibration>,
    /// Row of the last sampled instant.
    pub last: Option<HistoryRow>,
    rest_criterion: RestCriterion,
}

impl SampledHistory {
    /// Starts for a contact of an expected number of steps.
    pub fn new(model: &ExplicitBodies, expected_steps: f64) -> Self {
        Self {
            sampling_interval: SamplingInterval::new(OutputRequest::ROWS, expected_steps),
            pulse: ForcePulse::default(),
            force_noise: ForceNoise::default(),
            vibration_after: None,
            last: None,
            rest_criterion: RestCriterion::new(&model.frame()),
        }
    }

    /// Returns whether this step is to be sampled.
    pub fn is_due(&self, step: u64) -> bool {
        self.sampling_interval.is_due(step)
    }

    /// Takes note of a step with a contact force, sampled or not: the time after the last contact begins anew.
    pub fn touch(&mut self) {
        self.vibration_after = Some(PostContactVibration::default());
    }

    /// Returns whether the bodies stay together, by the last sampled instant, a time (s) after first touch, at a rate
    /// of the approach, m/s.
    ///
    /// Waves that leave into a half-space carry equal strain and kinetic energy, neither of which can separate the
    /// bodies, so both are left out.
    pub fn stays_together(
        &mut self,
        model: &ExplicitBodies,
        is_closed: bool,
        time: f64,
        rate: f64,
    ) -> bool {
        let Some(row) = &self.last else { return false };
        let is_stored =
            |account: Account| account.side() == BalanceSide::Held && account != Account::Kinetic;
        let stored = row.energies.entries().filter(|(account, _)| is_stored(*account));
        let mut inner_energy: f64 =
            row.vibration.into_iter().chain(stored.map(|(_, energy)| energy)).sum();
        for (body, vibration) in model.bodies().iter().zip(row.vibration) {
            if !body.held_nodes().is_empty() {
                inner_energy -= 2.0 * GONE_WITH_WAVES * vibration;
            }
        }
        let force = row.contact_force;
        self.rest_criterion.observe(&RelativeMotion { time, is_closed, force, rate, inner_energy })
    }

    /// Takes the row of an instant, the impulse of the contact so far (N s), the step, and whether the contact is
    /// closed.
    pub fn take(&mut self, row: HistoryRow, impulse: f64, step: u64, is_closed: bool) {
        self.sampling_interval.count();
        let (radius, pressure) = (row.contact_radius, row.centre_pressure);
        self.pulse.observe(row.time, impulse, radius.unwrap_or(0.0), pressure.unwrap_or(0.0));
        self.force_noise.observe(row.contact_force, StepInstant { time: row.time, step });
        if let Some(vibration) = &mut self.vibration_after {
            vibration.observe(is_closed, row.vibration);
        }
        self.last = Some(row);
    }

    /// Returns whether it can belong to a run of a model in a state.
    pub fn fits(&self, model: &ExplicitBodies, state: &State) -> bool {
        self.sampling_interval.is_consistent()
            && self.rest_criterion.is_of(&model.frame())
            && self.pulse.is_consistent()
            && self.pulse.last_time().is_none_or(|time| time <= state.time)
            && self.last.is_none_or(|row| row.time <= state.time)
    }
}
