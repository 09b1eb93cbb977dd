//! Time step control for bodies whose stiffness changes as they deform.
//!
//! **Levels.** A run takes steps of Δt_0 2^(−level/16), with the model's step Δt_0 and levels 0 to 160.
//!
//! **Bounds.** From time to time the critical step of the deformed bodies is bounded anew
//! ([`StepControl::after_bound`]): the sooner, the faster it changes and the faster the elements near the critical
//! nodes are strained. The level follows the bound down at once, and up when the longer step leaves a margin of 1 %.
//!
//! **Rate checks.** Between two bounds only the strain rate is evaluated, which is cheap
//! ([`StepControl::after_rate_check`]). If it asks for a shorter step, the bound is brought forward.
//!
//! **Strain per step.** No element is strained by more than [`STRAIN_PER_STEP`] in a step. Leapfrog is stable within
//! the critical step, but it conserves the energy of a body whose stiffness is constant during the step, and its error
//! grows with the square of the strain per step.
//!
//! **Change of step.** Where the step changes from Δt to Δt′ at t_n, velocities at t_n − Δt/2 become those at t_n −
//! Δt′/2,
//!
//! ```math
//! v \leftarrow v + \tfrac12 (\Delta t - \Delta t')\, f_n/m,
//! ```
//!
//! as if the run had always had its new step; impulses that are summed up to the half step change alike. The energy of
//! leapfrog changes by ⅛ (Δt² − Δt′²) f·f/m, which is of the order of its own error.

use serde::{Deserialize, Serialize};

/// Highest level: a thousandth of the model's step. Bodies that need shorter steps have collapsed.
const MAX_LEVELS: u32 = 160;
/// Steps before the first bound; by then the contact has stopped the nodes that touch first.
const FIRST_PAUSE: u64 = 4;
/// Largest strain of any element in a step. A rubber sphere of ν = 0 that hits a wall at a third of the wave speed
/// without bulk viscosity loses 1.1e-3 of its energy with 0.07 and 2e-4 with 0.04. Up to the wave speed bulk viscosity
/// alone keeps the strain per step below this.
const STRAIN_PER_STEP: f64 = 0.04;
/// Most steps from one bound to the next.
const LONGEST_PAUSE: f64 = 128.0;
/// Relative change of the critical step from one bound to the next that is aimed at.
const CHANGE_BETWEEN_BOUNDS: f64 = 0.02;
/// Strain of an element from one bound to the next at the present rate. The critical step shortens by about as much,
/// which is less than the margin of the step factor and of the bound. Elements whose nodes could bear a longer step may
/// take more ([`StepDemand::strain_allowance`]).
const STRAIN_BETWEEN_BOUNDS: f64 = 0.05;
/// Largest strain of any element from one bound to the next: a softening law can lose its stiffness suddenly.
const MAX_STRAIN_BETWEEN_BOUNDS: f64 = 0.15;
/// Margin by which a longer step has to be below the allowed one.
const MARGIN_TO_LENGTHEN: f64 = 1.01;
/// The step of the undeformed bodies is allowed despite rounding.
const ROUNDING_OF_STEP: f64 = 1.0 + 1e-9;

/// The demand of the deformed bodies on the time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepDemand {
    /// Critical step of the deformed bodies, s.
    pub critical_time_step: f64,
    /// Largest strain rate of any element, 1/s.
    pub strain_rate: f64,
    /// Largest ratio of an element's strain rate to its strain allowance ([`StepDemand::strain_allowance`]), 1/s: the
    /// inverse of the time until the next bound is due.
    pub allowance_rate: f64,
}

/// Level of a run, and when it is examined again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct StepControl {
    level: u32,
    /// Step number and time (s) of the first instant of this level.
    since: (u64, f64),
    /// Step number and critical step (s) of the last bound.
    last_bound: (u64, f64),
    /// Step number of the next bound.
    next_bound: u64,
    /// Step number of the next rate check.
    next_rate_check: u64,
}

impl StepDemand {
    /// Returns the longest time (s) to the next bound at a strain rate (1/s) and the model's step, s.
    pub fn longest_pause(model_step: f64, strain_rate: f64) -> f64 {
        (STRAIN_BETWEEN_BOUNDS / strain_rate).clamp(model_step, LONGEST_PAUSE * model_step)
    }

    /// Returns the strain that an element may take before the next bound, from the critical steps (s) of its node and
    /// of the bodies: [`STRAIN_BETWEEN_BOUNDS`], and half of the relative reserve of its node, since strain may shorten
    /// a node's step by twice as much, ln(Δt_i/Δt) ≥ 1 − Δt/Δt_i.
    pub fn strain_allowance(of_node: f64, critical: f64) -> f64 {
        STRAIN_BETWEEN_BOUNDS + 0.5 * (1.0 - critical / of_node)
    }
}

impl StepControl {
    /// Starts at first touch (s), with a model's step and critical step (s) and the strain rate that the impact causes,
    /// 1/s.
    pub fn new(first_touch: f64, model_step: f64, critical: f64, strain_rate: f64) -> Self {
        Self {
            level: level_for_strain_rate(model_step, strain_rate, 1.0),
            since: (0, first_touch),
            last_bound: (0, critical),
            next_bound: FIRST_PAUSE,
            next_rate_check: FIRST_PAUSE,
        }
    }

    /// Returns the time step (s) at a model's step, s.
    pub fn time_step(&self, model_step: f64) -> f64 {
        model_step * level_factor(self.level)
    }

    /// Returns the time (s) after a step of this level.
    pub fn time_after(&self, step: u64, model_step: f64) -> f64 {
        let (since_step, since_time) = self.since;
        since_time + step.saturating_sub(since_step) as f64 * self.time_step(model_step)
    }

    /// Returns whether the critical step is to be bounded at this step.
    pub fn is_bound_due(&self, step: u64) -> bool {
        step >= self.next_bound
    }

    /// Returns whether the strain rate is to be checked at this step.
    pub fn is_rate_check_due(&self, step: u64) -> bool {
        step >= self.next_rate_check
    }

    /// Returns the control after a rate check; `None` where elements are strained faster (1/s) than the present steps
    /// can follow, so that a bound is due.
    pub fn after_rate_check(self, step: u64, strain_rate: f64, model_step: f64) -> Option<Self> {
        let is_slow = level_for_strain_rate(model_step, strain_rate, 1.0) <= self.level;
        let pause = pause_of_rate_check(strain_rate * self.time_step(model_step));
        let next_rate_check = self.next_bound.min(step + pause);
        is_slow.then_some(Self { next_rate_check, ..self })
    }

    /// Returns the control from a step and its time (s) on, by what the bodies demand there, at a model's step (s) and
    /// step factor; `None` if no level is short enough.
    pub fn after_bound(
        &self,
        demand: StepDemand,
        (step, time): (u64, f64),
        [model_step, step_factor]: [f64; 2],
    ) -> Option<Self> {
        let StepDemand { critical_time_step: critical, strain_rate, allowance_rate } = demand;
        let allowed = step_factor * critical * ROUNDING_OF_STEP;
        let lowest_level = |margin: f64| {
            let of_strain = level_for_strain_rate(model_step, strain_rate, margin);
            Some(level_within(model_step, allowed, margin)?.max(of_strain))
        };
        let needed = lowest_level(1.0)?;
        let level = if needed > self.level {
            needed
        } else {
            lowest_level(MARGIN_TO_LENGTHEN).unwrap_or(self.level).min(self.level)
        };
        let since = if level == self.level { self.since } else { (step, time) };
        let n_steps = step.saturating_sub(self.last_bound.0).max(1) as f64;
        let ratio = critical / self.last_bound.1;
        let change = ratio.max(ratio.recip()) - 1.0;
        let by_change = CHANGE_BETWEEN_BOUNDS / change * n_steps;
        let time_step = model_step * level_factor(level);
        let by_strain =
            (1.0 / allowance_rate).min(MAX_STRAIN_BETWEEN_BOUNDS / strain_rate) / time_step;
        let pause = by_change.min(by_strain).clamp(1.0, LONGEST_PAUSE);
        let next_bound = step + pause as u64;
        let next_rate_check = next_bound.min(step + pause_of_rate_check(strain_rate * time_step));
        Some(Self { level, since, last_bound: (step, critical), next_bound, next_rate_check })
    }

    /// Returns whether this can be the control of a run at a step.
    pub fn is_valid_at(&self, step: u64) -> bool {
        let critical = self.last_bound.1;
        self.level <= MAX_LEVELS
            && self.since.0 <= step
            && self.last_bound.0 <= step
            && critical > 0.0
            && critical.is_finite()
    }
}

/// Returns all time steps (s) that a run with a model's step (s) may take.
pub(crate) fn step_levels(model_step: f64) -> impl Iterator<Item = f64> {
    (0..=MAX_LEVELS).map(move |level| model_step * level_factor(level))
}

/// Returns the number of steps until the next rate check, from the strain in a step.
fn pause_of_rate_check(strain_per_step: f64) -> u64 {
    (STRAIN_BETWEEN_BOUNDS / strain_per_step).clamp(1.0, LONGEST_PAUSE) as u64
}

/// Returns the lowest level whose step times a margin is within a time, s; `None` if no level is.
fn level_within(model_step: f64, allowed: f64, margin: f64) -> Option<u32> {
    (0..=MAX_LEVELS).find(|&level| model_step * level_factor(level) * margin <= allowed)
}

/// Returns the lowest level whose step times a margin follows a strain rate, 1/s. Elements that are strained faster
/// than the shortest step can follow collapse.
fn level_for_strain_rate(model_step: f64, strain_rate: f64, margin: f64) -> u32 {
    level_within(model_step, STRAIN_PER_STEP / strain_rate, margin).unwrap_or(MAX_LEVELS)
}

/// Returns 2^(−level/16) by roots and products alone, which give the same bits on all machines.
fn level_factor(level: u32) -> f64 {
    let (mut factor, mut root, mut rest) = (1.0, 0.5f64.sqrt().sqrt().sqrt().sqrt(), level);
    while rest > 0 {
        if rest % 2 == 1 {
            factor *= root;
        }
        root *= root;
        rest /= 2;
    }
    factor
}

#[cfg(test)]
mod tests;
