//! Hertz' collision against time.
//!
//! Energy gives δ̇ = v√(1−x^(5/2)) with x = δ/δ_max, so up to the largest approach
//!
//! ```math
//! \frac{2t}{T} = I_s\!\left(\tfrac25,\tfrac12\right), \qquad s = x^{5/2},
//! ```
//!
//! with the regularised incomplete beta function I; the second half mirrors the first. With the
//! phase ψ of x = sin ψ the right-hand side has a slope of 0.608 to 0.680 everywhere, so that
//! ψ ← ψ + (π/2)(2t/T − I) shrinks its error to 0.068 of itself or less each time.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use statrs::function::beta::beta_reg;

use crate::hertz::HertzImpact;
use crate::impact::{Impact, ImpactInstant};

/// State of a collision at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzInstant {
    /// δ, m; negative before first touch and after separation.
    pub approach: f64,
    /// Rate of the approach δ̇, m/s.
    pub approach_rate: f64,
    /// Contact force, N.
    pub force: f64,
}

/// 0.068^14 < 1e-16.
const N_PHASE_ITERATIONS: usize = 14;

impl HertzImpact {
    /// Returns the state at `time`, s, after first touch; the bodies fly freely before it and after T.
    pub fn at(&self, time: f64) -> HertzInstant {
        let (speed, contact_time) = (self.approach_speed(), self.contact_time());
        let flying = |approach, approach_rate| HertzInstant { approach, approach_rate, force: 0.0 };
        if time < 0.0 {
            flying(speed * time, speed)
        } else if time < contact_time {
            let to_nearer_end = time.min(contact_time - time);
            let phase = phase_at(2.0 * to_nearer_end / contact_time);
            let approach = self.max_approach() * phase.sin();
            let sign = if to_nearer_end == time { 1.0 } else { -1.0 };
            HertzInstant {
                approach,
                approach_rate: sign * speed * kinetic_fraction(phase).sqrt(),
                force: self.force(approach),
            }
        } else {
            flying(-speed * (time - contact_time), -speed)
        }
    }
}

/// Phases of [`HertzImpact::impact`] from first touch to the largest approach.
const N_PHASES: usize = 64;

impl HertzImpact {
    /// Returns summary and history in the form of the models that are integrated.
    pub fn impact(&self) -> Impact {
        let phase = |k: usize| FRAC_PI_2 * (k as f64 / N_PHASES as f64);
        let half = 0.5 * self.contact_time();
        let instants = (0..=2 * N_PHASES).map(|k| {
            let is_leaving = k > N_PHASES;
            let phase = phase(if is_leaving { 2 * N_PHASES - k } else { k });
            let time = half * half_time_fraction_at(phase);
            let rate = self.approach_speed() * kinetic_fraction(phase).sqrt();
            let approach = self.max_approach() * phase.sin();
            let pressure = self.pressure(approach);
            let strain_energy = 0.4 * self.force(approach) * approach;
            ImpactInstant {
                time: if is_leaving { 2.0 * half - time } else { time },
                approach,
                approach_rate: if is_leaving { -rate } else { rate },
                force: self.force(approach),
                contact_radius: pressure.contact_radius,
                centre_pressure: Some(pressure.peak_pressure),
                work: strain_energy,
                strain_energy: Some(strain_energy),
                dissipated: Some(0.0),
                radiated: None,
                plate: None,
            }
        });
        Impact {
            restitution: self.restitution(),
            contact_time: Some(self.contact_time()),
            peak_force: self.peak_force(),
            max_approach: self.max_approach(),
            max_contact_radius: self.max_contact_radius(),
            peak_pressure: Some(self.peak_pressure()),
            history: instants.collect(),
        }
    }
}

/// Returns ψ at 2t/T in 0 ..= 1.
fn phase_at(half_time_fraction: f64) -> f64 {
    (0..N_PHASE_ITERATIONS).fold(FRAC_PI_2 * half_time_fraction, |phase, _| {
        let correction = FRAC_PI_2 * (half_time_fraction - half_time_fraction_at(phase));
        (phase + correction).clamp(0.0, FRAC_PI_2)
    })
}

/// Returns 2t/T at ψ; from the end that is nearer, where it has no cancellation.
fn half_time_fraction_at(phase: f64) -> f64 {
    let sin = phase.sin();
    if sin < FRAC_1_SQRT_2 {
        beta_reg(0.4, 0.5, sin.powf(2.5))
    } else {
        1.0 - beta_reg(0.5, 0.4, kinetic_fraction(phase))
    }
}

/// Returns 1 − sin^(5/2) ψ, the kinetic share of the energy, accurate at both ends.
fn kinetic_fraction(phase: f64) -> f64 {
    let (sin, cos) = phase.sin_cos();
    if sin < FRAC_1_SQRT_2 { 1.0 - sin.powf(2.5) } else { -(1.25 * (-cos * cos).ln_1p()).exp_m1() }
}
