//! How long the steps of a run are whose bodies change their stiffness as they deform.
//!
//! Steps are shorter than the model's by powers of the sixteenth root of two, which a level counts. The
//! critical step of the deformed bodies is bounded anew after some steps, the sooner the faster it
//! changes and the elements that decide on it are strained; the level follows it down at once, and up where the longer step
//! leaves room; how fast elements are strained is looked at in between. No element is strained by more than [`STRAIN_A_STEP`] in a step: within the critical step
//! leapfrog is stable, but what it keeps is the energy of a body whose stiffness does not change in a step,
//! and it errs by the square of the strain there.
//!
//! Where the step changes from Δt to Δt′ at t_n, velocities of t_n − Δt/2 become those of t_n − Δt′/2,
//!
//! ```math
//! v \leftarrow v + \tfrac12 (\Delta t - \Delta t')\, f_n/m,
//! ```
//!
//! as if the run had always had its new step; what counts impulses to the half step takes the same.
//! Leapfrog's energy changes there by ⅛ (Δt² − Δt′²) f·f/m, of the order of its own error.

use serde::{Deserialize, Serialize};

use crate::model::Model;

/// A thousandth of the model's step: bodies of which that asks have collapsed.
const MOST_LEVELS: u32 = 160;
/// Steps before the first bound, in which the contact has stopped what touches first.
const FIRST_PAUSE: u64 = 4;
/// Most strain of any element in a step. Rubber of ν = 0 on a wall without bulk viscosity loses 1.1e-3 of its
/// energy at a third of the wave speed and 0.07 of strain, is unstable at twice that, and loses 5e-4 and 2e-4
/// with 0.04. Bulk viscosity keeps the rate below by itself up to the wave speed.
const STRAIN_A_STEP: f64 = 0.04;
/// Most steps from one bound to the next.
const LONGEST_PAUSE: f64 = 128.0;
/// Change of the critical step from one bound to the next that is aimed at.
const CHANGE_BETWEEN_BOUNDS: f64 = 0.02;
/// Strain of an element from one bound to the next at the rate of now, which shortens its critical step by
/// about as much: less than the step factor and the bound leave. Elements whose nodes could bear a longer step
/// take so much more.
const STRAIN_BETWEEN_BOUNDS: f64 = 0.05;
/// Most strain of any element from one bound to the next: laws that soften give way all at once.
const MOST_STRAIN_BETWEEN_BOUNDS: f64 = 0.15;
/// By so much a longer step has to be below what is allowed.
const ROOM_ABOVE: f64 = 1.01;
/// The step that was chosen for the undeformed bodies is allowed, whatever rounding says.
const ROUNDING: f64 = 1.0 + 1e-9;

/// What the next steps have to bear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Outlook {
    /// Of the bodies as they are deformed, s.
    pub critical_time_step: f64,
    /// Largest of any element, 1/s.
    pub strain_rate: f64,
    /// Largest over the strain that an element may take until the next bound ([`Outlook::room`]), 1/s.
    pub urgency: f64,
}

/// Level of a run and when it is looked at again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pace {
    level: u32,
    /// Number and time (s) of the first instant of this level.
    since: (u64, f64),
    /// Step and critical step (s) of the last bound.
    last: (u64, f64),
    /// Step of the next bound.
    next: u64,
    /// Step at which the strain rate is looked at again.
    look: u64,
}

impl Outlook {
    /// Time (s) to the next bound at most, by the largest strain rate of any element, 1/s.
    pub fn reaches(model: &Model, strain_rate: f64) -> f64 {
        let longest = model.time_step();
        (STRAIN_BETWEEN_BOUNDS / strain_rate).clamp(longest, LONGEST_PAUSE * longest)
    }

    /// Strain that an element may take until the next bound at a node whose step is this (s), where the critical
    /// one is that, s: what shortens its step to the critical one, ln(Δt_i/Δt) ≥ 1 − Δt/Δt_i, by twice as much
    /// as it is strained, and [`STRAIN_BETWEEN_BOUNDS`].
    pub fn room(of_node: f64, critical: f64) -> f64 {
        STRAIN_BETWEEN_BOUNDS + 0.5 * (1.0 - critical / of_node)
    }
}

impl Pace {
    /// At first touch; `None` of a model whose stiffness is constant.
    pub fn of(model: &Model) -> Option<Self> {
        model.changes_stiffness().then(|| Self {
            level: level_of_strain(model, model.first_strain_rate(), 1.0),
            since: (0, model.approach().first_touch()),
            last: (0, model.time_step() / model.step_factor()),
            next: FIRST_PAUSE,
            look: FIRST_PAUSE,
        })
    }

    /// Time step, s.
    pub fn time_step(&self, model: &Model) -> f64 {
        model.time_step() * share(self.level)
    }

    /// Time after a step of this level, s.
    pub fn time_after(&self, step: u64, model: &Model) -> f64 {
        let (since_step, since_time) = self.since;
        since_time + step.saturating_sub(since_step) as f64 * self.time_step(model)
    }

    /// Whether the critical step is to be bounded at this step.
    pub fn is_due(&self, step: u64) -> bool {
        step >= self.next
    }

    /// Whether the strain rate is to be looked at at this step.
    pub fn is_look_due(&self, step: u64) -> bool {
        step >= self.look
    }

    /// This pace where elements are strained no faster than its steps can follow, by the largest rate now, 1/s;
    /// `None` where they are.
    pub fn looked_at(self, model: &Model, step: u64, strain_rate: f64) -> Option<Self> {
        let is_slow = level_of_strain(model, strain_rate, 1.0) <= self.level;
        let look = self.next.min(step + looks_after(strain_rate * self.time_step(model)));
        is_slow.then_some(Self { look, ..self })
    }

    /// Whether it can be of a run at this step.
    pub fn is_sound_at(&self, step: u64) -> bool {
        let critical = self.last.1;
        self.level <= MOST_LEVELS
            && self.since.0 <= step
            && self.last.0 <= step
            && critical > 0.0
            && critical.is_finite()
    }

    /// The pace from a step and its time (s) on, with this outlook; `None` if no level is short enough.
    pub fn after(&self, model: &Model, (step, time): (u64, f64), outlook: Outlook) -> Option<Self> {
        let Outlook { critical_time_step: critical, strain_rate, urgency } = outlook;
        let allowed = model.step_factor() * critical * ROUNDING;
        let longest = |room: f64| {
            let of_strain = level_of_strain(model, strain_rate, room);
            Some(level_within(model, allowed, room)?.max(of_strain))
        };
        let shortened = longest(1.0)?;
        let level = if shortened > self.level {
            shortened
        } else {
            longest(ROOM_ABOVE).unwrap_or(self.level).min(self.level)
        };
        let since = if level == self.level { self.since } else { (step, time) };
        let n_steps = step.saturating_sub(self.last.0).max(1) as f64;
        let ratio = critical / self.last.1;
        let change = ratio.max(ratio.recip()) - 1.0;
        let as_before = CHANGE_BETWEEN_BOUNDS / change * n_steps;
        let time_step = model.time_step() * share(level);
        let until_strained =
            (1.0 / urgency).min(MOST_STRAIN_BETWEEN_BOUNDS / strain_rate) / time_step;
        let pause = as_before.min(until_strained).clamp(1.0, LONGEST_PAUSE);
        let next = step + pause as u64;
        let look = next.min(step + looks_after(strain_rate * time_step));
        Some(Self { level, since, last: (step, critical), next, look })
    }
}

/// Steps until strain rates are looked at again, of so much strain in a step.
fn looks_after(strain_a_step: f64) -> u64 {
    (STRAIN_BETWEEN_BOUNDS / strain_a_step).clamp(1.0, LONGEST_PAUSE) as u64
}

/// The longest steps that with some room to spare are within a time, s; `None` if no level is.
fn level_within(model: &Model, allowed: f64, room: f64) -> Option<u32> {
    (0..=MOST_LEVELS).find(|&level| model.time_step() * share(level) * room <= allowed)
}

/// The same of a strain rate, 1/s. What is strained faster than the shortest step can follow collapses.
fn level_of_strain(model: &Model, strain_rate: f64, room: f64) -> u32 {
    level_within(model, STRAIN_A_STEP / strain_rate, room).unwrap_or(MOST_LEVELS)
}

/// All time steps (s) of a run whose longest is given.
pub(crate) fn time_steps(longest: f64) -> impl Iterator<Item = f64> {
    (0..=MOST_LEVELS).map(move |level| longest * share(level))
}

/// 2^(−level/16), of roots and products alone, which are the same on all machines.
fn share(level: u32) -> f64 {
    let (mut share, mut root, mut rest) = (1.0, 0.5f64.sqrt().sqrt().sqrt().sqrt(), level);
    while rest > 0 {
        if rest % 2 == 1 {
            share *= root;
        }
        root *= root;
        rest /= 2;
    }
    share
}

#[cfg(test)]
mod tests;
