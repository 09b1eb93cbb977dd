//! The largest force, contact radius and pressure of a contact, without what only scatters.
//!
//! The largest of all steps is that of the noise: 0.03 % above the pulse of a quiet contact, 1 to 4 % where
//! springs ring or mass is added. So means over a window are compared,
//!
//! ```math
//! \bar F = \frac{J(t + w) - J(t)}{w}, \qquad w = \frac{1.75}{64}\,\frac{J}{\max F},
//! ```
//!
//! J the impulse, exact over all steps: 1.75 J / max F is the duration of Hertz' pulse of this impulse, T
//! for an elastic contact, and a 64th of it takes 0.01 % off a smooth peak. Parabolas and quartics over wider
//! windows scatter as much and cut what is no noise, 3 % of a rubber ball's peak at 10 m/s.
//!
//! When contact begins the flat facet of the first elements strikes: a shock on a small area, whose
//! pressure is the mesh's. Pressure counts from where the contact has a quarter of its largest radius, or two
//! elements if that is less and what strikes is no front. Bodies that relax long before they part press hardest
//! early, so what comes before that quarter is averaged over an eighth of its age where that is shorter.

use fem_mesh::SphereMesh;
use serde::{Deserialize, Serialize};

use crate::run::nan_aware_max_abs;

/// The window over the duration of the pulse.
pub const PEAK_WINDOW: f64 = 1.0 / 64.0;
/// Duration of Hertz' pulse over its impulse at its largest force.
const FULLNESS: f64 = 1.75;
/// Share of the largest radius from which pressure counts.
const RESOLVED: f64 = 0.25;
/// Elements from which a contact resolves a pressure.
pub const RESOLVING_ELEMENTS: f64 = 2.0;
/// Window of a pressure over the time since contact began, at most.
const YOUNG: f64 = 1.0 / 8.0;
/// Instants that are kept; of more every second one is forgotten.
const MOST: usize = 4096;
/// Instants may lie so many windows apart; farther ones tell less than the largest of all steps.
const WIDEST: f64 = 2.0;

/// What is kept of an instant: time (s), impulse so far (N s), radius (m), pressure (Pa).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Beat {
    time: f64,
    impulse: f64,
    radius: f64,
    pressure: f64,
}

/// The course of a contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcePulse {
    beats: Vec<Beat>,
    /// Instants told so far, of which each so many-th is kept.
    told: u64,
    stride: u64,
}

/// Largest means over a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulsePeaks {
    /// N.
    pub force: f64,
    /// m.
    pub radius: f64,
    /// Pa.
    pub pressure: f64,
    /// Radius of the contact when its pressure was largest, m.
    pub pressure_radius: f64,
}

impl Default for ForcePulse {
    fn default() -> Self {
        Self { beats: Vec::with_capacity(MOST), told: 0, stride: 1 }
    }
}

impl ForcePulse {
    /// Takes an instant: its time (s), the impulse so far (N s), contact radius (m) and pressure on the axis, Pa.
    pub fn observe(&mut self, time: f64, impulse: f64, radius: f64, pressure: f64) {
        let is_due = self.told.is_multiple_of(self.stride);
        self.told = self.told.saturating_add(1);
        if !is_due {
            return;
        }
        if self.beats.len() >= MOST {
            let mut k = 0;
            self.beats.retain(|_| {
                k += 1;
                k % 2 == 1
            });
            self.stride = self.stride.saturating_mul(2);
            if !(self.told - 1).is_multiple_of(self.stride) {
                return;
            }
        }
        self.beats.push(Beat { time, impulse, radius, pressure });
    }

    /// The peaks, of a pulse whose largest force at any step is this (N), of meshes whose elements at the contact
    /// are no longer than this, m.
    pub fn peaks(&self, largest_force: f64, element: f64) -> PulsePeaks {
        let highest = |value: fn(&Beat) -> f64| {
            self.beats.iter().fold(0.0, |so_far: f64, beat| nan_aware_max_abs(so_far, value(beat)))
        };
        let largest_radius = highest(|beat| beat.radius);
        let impulse = self.beats.last().map_or(0.0, |beat| beat.impulse);
        let window = PEAK_WINDOW * FULLNESS * impulse / largest_force;
        let resolved = (RESOLVED * largest_radius).min(RESOLVING_ELEMENTS * element);
        let mut peaks = PulsePeaks { force: 0.0, radius: 0.0, pressure: 0.0, pressure_radius: 0.0 };
        let mut sums = Sums::default();
        let mut end = 0;
        for (k, beat) in self.beats.iter().enumerate() {
            while end < self.beats.len()
                && (end <= k || self.beats[end].time - beat.time < (1.0 - 1e-9) * window)
            {
                sums.add(&self.beats[end]);
                end += 1;
            }
            let Some(last) = self.beats.get(end) else { break };
            let lasts = last.time - beat.time;
            if lasts > WIDEST * window {
                sums.remove(beat);
                continue;
            }
            peaks.force = nan_aware_max_abs(peaks.force, (last.impulse - beat.impulse) / lasts);
            let n = (end - k) as f64;
            peaks.radius = nan_aware_max_abs(peaks.radius, sums.radius / n);
            if beat.radius.min(last.radius) >= resolved {
                let is_early = beat.radius < RESOLVED * largest_radius;
                let young = is_early.then(|| self.young(k, window)).flatten();
                let pressure = young.unwrap_or(sums.pressure / n);
                if pressure > peaks.pressure {
                    peaks.pressure_radius = beat.radius;
                }
                peaks.pressure = nan_aware_max_abs(peaks.pressure, pressure);
            }
            sums.remove(beat);
        }
        // Too few instants for a window, or what is no number.
        let or = |peak: f64, largest: f64| match peak > 0.0 && largest.is_finite() {
            true => peak,
            false => largest,
        };
        PulsePeaks {
            force: or(peaks.force, largest_force),
            radius: or(peaks.radius, largest_radius),
            pressure: or(peaks.pressure, highest(|beat| beat.pressure)),
            pressure_radius: or(peaks.pressure_radius, largest_radius),
        }
    }

    /// Mean pressure (Pa) from an instant on, whose age asks for a shorter window than this, s.
    fn young(&self, k: usize, window: f64) -> Option<f64> {
        let later = &self.beats[k..];
        let now = later.first()?.time;
        let window = Some(YOUNG * (now - self.beats[0].time)).filter(|young| *young < window)?;
        let n = later.partition_point(|beat| beat.time - now < window).max(1);
        Some(later[..n].iter().map(|beat| beat.pressure).sum::<f64>() / n as f64)
    }

    /// Whether a run can have left it like this: instants in the order of time, and no more than there can be.
    pub fn is_sound(&self) -> bool {
        self.stride > 0
            && self.beats.len() <= MOST
            && self.beats.is_sorted_by(|one, next| one.time <= next.time)
    }

    /// Time of the last instant that is kept, s.
    pub fn last_time(&self) -> Option<f64> {
        self.beats.last().map(|beat| beat.time)
    }
}

/// Sums over the window.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    radius: f64,
    pressure: f64,
}

impl Sums {
    fn add(&mut self, beat: &Beat) {
        self.radius += beat.radius;
        self.pressure += beat.pressure;
    }

    fn remove(&mut self, beat: &Beat) {
        self.radius -= beat.radius;
        self.pressure -= beat.pressure;
    }
}

/// The longer of the first edges of surfaces, from the axis, m; 0 without any.
pub fn longest_at_pole(meshes: [Option<&SphereMesh>; 2]) -> f64 {
    let first = |mesh: &SphereMesh| Some(mesh.nodes()[*mesh.surface().get(1)? as usize][0]);
    meshes.into_iter().flatten().filter_map(first).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Hertz' pulse, F = sin^{3/2}, of so many steps an instant, with a force put on every second step;
    /// radius ∝ F^{1/3}, and a pressure of the first touch.
    fn pulse(n_steps: usize, per_instant: usize, noise: f64, spike: f64) -> (PulsePeaks, f64) {
        let (mut pulse, mut impulse, mut largest) = (ForcePulse::default(), 0.0, 0.0_f64);
        for k in 0..=n_steps {
            let time = k as f64 / n_steps as f64;
            let smooth = (PI * time).sin().max(0.0).powf(1.5);
            let force = smooth + if k % 2 == 0 { noise } else { -noise };
            largest = largest.max(force);
            let radius = smooth.cbrt();
            let pressure = radius + if radius < 0.2 { spike } else { 0.0 };
            if k % per_instant == 0 {
                pulse.observe(time, impulse, radius, pressure);
            }
            impulse += force / n_steps as f64;
        }
        assert!(pulse.is_sound());
        (pulse.peaks(largest, 1.0), largest)
    }

    /// Means over 1/64 are 1e-4 low: (1.75/1.78 π/64)² 3/2 / 24.
    #[test]
    fn a_smooth_peak_is_kept_to_a_ten_thousandth() {
        for (n_steps, per_instant) in [(12_000, 12), (1_000, 1), (200, 1), (100_000, 1)] {
            let (peaks, _) = pulse(n_steps, per_instant, 0.0, 0.0);
            for peak in [peaks.force, peaks.radius, peaks.pressure] {
                // Over 200 steps the window is four or five of them.
                assert!(peak < 1.0 && peak > 1.0 - 3e-4, "{n_steps}: {peaks:?}");
            }
        }
    }

    #[test]
    fn noise_is_not_the_peak() {
        for (n_steps, per_instant) in [(12_000, 12), (2_000, 1)] {
            let (peaks, largest) = pulse(n_steps, per_instant, 0.03, 0.0);
            assert!((largest - 1.03).abs() < 1e-4);
            // Of the noise an odd step of a window is left, 1/31 at most.
            assert!((peaks.force - 1.0).abs() < 1.2e-3, "{n_steps}: {peaks:?}");
        }
    }

    #[test]
    fn the_pressure_of_first_touch_is_no_peak() {
        let (peaks, _) = pulse(12_000, 12, 0.0, 9.0);
        assert!((peaks.pressure - 1.0).abs() < 3e-4, "{peaks:?}");
    }

    /// A body that flows: pressed hardest, at 1, after a hundredth of the contact, where it has a twentieth of its
    /// largest radius. Elements of an eightieth of that resolve it, longer ones do not.
    #[test]
    fn what_is_pressed_hardest_early_is_seen() {
        let (mut pulse, n) = (ForcePulse::default(), 4000);
        let early = 0.01;
        for k in 0..=n {
            let time = k as f64 / n as f64;
            let age = time / early;
            // t e^{1 − t}, largest at its unit of time.
            let pressure = age * (1.0 - age).exp();
            pulse.observe(time, time, 0.05 * age, pressure);
        }
        // A mean over an eighth of the age: 1/8² / 24.
        let peaks = pulse.peaks(1.0, 0.0125);
        assert!((peaks.pressure - 1.0).abs() < 1e-3);
        // Where it was: over an eighth of its age.
        assert!((peaks.pressure_radius / 0.05 - 1.0).abs() < 0.13, "{peaks:?}");
        assert!(pulse.peaks(1.0, 1.0).pressure < 0.2);
    }

    /// A pulse that is over between two instants has the largest of its steps.
    #[test]
    fn a_pulse_between_instants_keeps_its_largest() {
        let mut short = ForcePulse::default();
        for (time, impulse) in [(0.0, 0.0), (1.0, 0.01), (2.0, 0.01)] {
            short.observe(time, impulse, 0.5, 2.0);
        }
        let peaks = short.peaks(1.0, 1.0);
        let of = |force, radius, pressure| PulsePeaks {
            force,
            radius,
            pressure,
            pressure_radius: radius,
        };
        assert_eq!(peaks, of(1.0, 0.5, 2.0));
        assert_eq!(ForcePulse::default().peaks(0.0, 1.0), of(0.0, 0.0, 0.0));
    }

    #[test]
    fn what_is_no_number_shows() {
        let mut broken = ForcePulse::default();
        for k in 0..100 {
            let value = if k == 50 { f64::NAN } else { 1.0 };
            broken.observe(k as f64, k as f64, value, value);
        }
        let peaks = broken.peaks(f64::NAN, 1.0);
        assert!([peaks.force, peaks.radius, peaks.pressure].iter().all(|peak| peak.is_nan()));
    }

    /// However many instants there are, few are kept and the peaks stay.
    #[test]
    fn many_instants_are_thinned_evenly() {
        let (mut long, n) = (ForcePulse::default(), 50_000);
        let mut impulse = 0.0;
        for k in 0..=n {
            let time = k as f64 / n as f64;
            let force = (PI * time).sin().max(0.0).powf(1.5);
            long.observe(time, impulse, 1.0, 1.0);
            impulse += force / n as f64;
        }
        assert!(long.is_sound() && long.beats.len() > MOST / 2 - 1, "{}", long.beats.len());
        let strides = long.beats.windows(2).map(|two| (two[1].time - two[0].time) * n as f64);
        assert!(strides.into_iter().all(|stride| (stride - long.stride as f64).abs() < 1e-6));
        assert!((long.peaks(1.0, 1.0).force - 1.0).abs() < 3e-4);
    }
}
