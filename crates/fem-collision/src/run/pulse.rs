//! The largest force, contact radius and pressure of a contact, without noise.
//!
//! The largest value of a single step contains noise: 0.03 % of the peak of a smooth contact, and 1 to 4 % with oscillating
//! springs or mass scaling. The peaks are therefore those of means over a window,
//!
//! ```math
//! \bar F = \frac{J(t + w) - J(t)}{w}, \qquad w = \frac{1.75}{64}\,\frac{J}{\max F},
//! ```
//!
//! with the impulse J, which is exact over all steps. 1.75 J / max F is the duration of a Hertz pulse with this impulse
//! (the contact time T of an elastic contact), and a window of 1/64 of it lowers a smooth peak by 0.01 %. Fits of
//! parabolas and quartics over wider windows scatter as much and lower the peak of a rubber ball at 10 m/s by 3 %.
//!
//! At first touch the flat facet of the first elements strikes a small area, and its pressure depends on the mesh. The
//! pressure therefore counts from a quarter of the largest contact radius, or from two elements if that is less. In bodies
//! that relax long before they separate, the pressure is largest early; before that quarter it is averaged over an eighth
//! of the time since first touch if that is shorter than the window.

use fem_mesh::SphereMesh;
use serde::{Deserialize, Serialize};

use crate::run::nan_aware_max_abs;

/// Width of the window over the duration of the pulse.
pub const PEAK_WINDOW: f64 = 1.0 / 64.0;
/// Duration of a Hertz pulse times its largest force over its impulse.
const HERTZ_FULLNESS: f64 = 1.75;
/// Fraction of the largest contact radius from which the pressure counts.
const RESOLVED_RADIUS_SHARE: f64 = 0.25;
/// Number of elements in the contact radius that resolve a pressure.
pub const RESOLVING_ELEMENTS: f64 = 2.0;
/// Largest window of an early pressure over the time since first touch.
const WINDOW_OVER_TIME_SINCE_TOUCH: f64 = 1.0 / 8.0;
/// Width of the window of a flowing contact's pressure over the duration of the pulse.
const STEADY_WINDOW: f64 = 1.0 / 8.0;
/// Fraction of the largest contact radius from which that pressure counts.
const STEADY_RADIUS_SHARE: f64 = 0.7;
/// Largest number of samples; beyond it every second one is dropped.
const MAX_SAMPLES: usize = 4096;
/// Largest distance of two samples in windows; beyond it a mean is worse than the largest value of a step.
const WIDEST_GAP_IN_WINDOWS: f64 = 2.0;

/// A sample: time (s), impulse so far (N s), contact radius (m) and pressure (Pa).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Sample {
    time: f64,
    impulse: f64,
    radius: f64,
    pressure: f64,
}

/// Samples of a contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ForcePulse {
    samples: Vec<Sample>,
    /// Number of observed instants, of which one per stride is kept.
    n_observed: u64,
    stride: u64,
}

/// Largest means over a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulsePeaks {
    /// Contact force, N.
    pub force: f64,
    /// Contact radius, m.
    pub radius: f64,
    /// Pressure on the axis, Pa.
    pub pressure: f64,
    /// Contact radius at the largest pressure, m.
    pub pressure_radius: f64,
}

impl Default for ForcePulse {
    fn default() -> Self {
        Self { samples: Vec::with_capacity(MAX_SAMPLES), n_observed: 0, stride: 1 }
    }
}

impl ForcePulse {
    /// Adds an instant: its time (s), the impulse so far (N s), the contact radius (m) and the pressure on the axis (Pa).
    pub fn observe(&mut self, time: f64, impulse: f64, radius: f64, pressure: f64) {
        let is_due = self.n_observed.is_multiple_of(self.stride);
        self.n_observed = self.n_observed.saturating_add(1);
        if !is_due {
            return;
        }
        if self.samples.len() >= MAX_SAMPLES {
            let mut k = 0;
            self.samples.retain(|_| {
                k += 1;
                k % 2 == 1
            });
            self.stride = self.stride.saturating_mul(2);
            if !(self.n_observed - 1).is_multiple_of(self.stride) {
                return;
            }
        }
        self.samples.push(Sample { time, impulse, radius, pressure });
    }

    /// Returns the peaks of a pulse with this largest force of a step (N) and this largest element size at the contact (m).
    pub fn peaks(&self, largest_force: f64, element: f64) -> PulsePeaks {
        let highest = |value: fn(&Sample) -> f64| {
            self.samples
                .iter()
                .fold(0.0, |so_far: f64, sample| nan_aware_max_abs(so_far, value(sample)))
        };
        let largest_radius = highest(|sample| sample.radius);
        let impulse = self.samples.last().map_or(0.0, |sample| sample.impulse);
        let window = PEAK_WINDOW * HERTZ_FULLNESS * impulse / largest_force;
        let resolved = (RESOLVED_RADIUS_SHARE * largest_radius).min(RESOLVING_ELEMENTS * element);
        let mut peaks = PulsePeaks { force: 0.0, radius: 0.0, pressure: 0.0, pressure_radius: 0.0 };
        let mut sums = Sums::default();
        let mut end = 0;
        for (k, sample) in self.samples.iter().enumerate() {
            while end < self.samples.len()
                && (end <= k || self.samples[end].time - sample.time < (1.0 - 1e-9) * window)
            {
                sums.add(&self.samples[end]);
                end += 1;
            }
            let Some(last) = self.samples.get(end) else { break };
            let lasts = last.time - sample.time;
            if lasts > WIDEST_GAP_IN_WINDOWS * window {
                sums.remove(sample);
                continue;
            }
            peaks.force = nan_aware_max_abs(peaks.force, (last.impulse - sample.impulse) / lasts);
            let n = (end - k) as f64;
            peaks.radius = nan_aware_max_abs(peaks.radius, sums.radius / n);
            if sample.radius.min(last.radius) >= resolved {
                let is_early = sample.radius < RESOLVED_RADIUS_SHARE * largest_radius;
                let young = is_early.then(|| self.young(k, window)).flatten();
                let pressure = young.unwrap_or(sums.pressure / n);
                if pressure > peaks.pressure {
                    peaks.pressure_radius = sample.radius;
                }
                peaks.pressure = nan_aware_max_abs(peaks.pressure, pressure);
            }
            sums.remove(sample);
        }
        // There are too few instants for a window, or a value is NaN.
        let or = |peak: f64, largest: f64| match peak > 0.0 && largest.is_finite() {
            true => peak,
            false => largest,
        };
        PulsePeaks {
            force: or(peaks.force, largest_force),
            radius: or(peaks.radius, largest_radius),
            pressure: or(peaks.pressure, highest(|sample| sample.pressure)),
            pressure_radius: or(peaks.pressure_radius, largest_radius),
        }
    }

    /// Returns the largest pressure (Pa) of bodies that flow plastically, for this largest force of a step (N); `None` if no
    /// window fits into the contact.
    ///
    /// The pressure of a contact that flows hardly changes in time, while its reading on the axis swings by a fifth as nodes
    /// join one by one. The window is therefore an eighth of the contact, which lowers an elastic peak by 0.3 %, while the
    /// radius is at least 0.7 of its largest: below that few elements are in contact.
    pub fn steady_pressure(&self, largest_force: f64) -> Option<f64> {
        let largest_radius = self.samples.iter().map(|sample| sample.radius).fold(0.0, f64::max);
        let impulse = self.samples.last()?.impulse;
        let window = STEADY_WINDOW * HERTZ_FULLNESS * impulse / largest_force;
        let is_wide = |sample: &Sample| sample.radius >= STEADY_RADIUS_SHARE * largest_radius;
        let means = self.samples.iter().enumerate().filter_map(|(k, first)| {
            let later = &self.samples[k..];
            let n = later.partition_point(|sample| sample.time - first.time < window);
            let last = later.get(n)?;
            let mean = later[..n].iter().map(|sample| sample.pressure).sum::<f64>() / n as f64;
            (n > 0 && is_wide(first) && is_wide(last)).then_some(mean)
        });
        means.max_by(f64::total_cmp)
    }

    /// Returns the mean pressure (Pa) from an early instant on, if its window is shorter than this one (s).
    fn young(&self, k: usize, window: f64) -> Option<f64> {
        let later = &self.samples[k..];
        let now = later.first()?.time;
        let window = Some(WINDOW_OVER_TIME_SINCE_TOUCH * (now - self.samples[0].time))
            .filter(|young| *young < window)?;
        let n = later.partition_point(|sample| sample.time - now < window).max(1);
        Some(later[..n].iter().map(|sample| sample.pressure).sum::<f64>() / n as f64)
    }

    /// Returns whether a restart state is consistent.
    pub fn is_consistent(&self) -> bool {
        self.stride > 0
            && self.samples.len() <= MAX_SAMPLES
            && self.samples.is_sorted_by(|one, next| one.time <= next.time)
    }

    /// Returns the time of the last sample, s.
    pub fn last_time(&self) -> Option<f64> {
        self.samples.last().map(|sample| sample.time)
    }
}

/// Sums over a window.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    radius: f64,
    pressure: f64,
}

impl Sums {
    fn add(&mut self, sample: &Sample) {
        self.radius += sample.radius;
        self.pressure += sample.pressure;
    }

    fn remove(&mut self, sample: &Sample) {
        self.radius -= sample.radius;
        self.pressure -= sample.pressure;
    }
}

/// Returns the longest surface edge at the axis, m; 0 without meshes.
pub fn longest_at_pole(meshes: [Option<&SphereMesh>; 2]) -> f64 {
    let first = |mesh: &SphereMesh| Some(mesh.nodes()[*mesh.surface().get(1)? as usize][0]);
    meshes.into_iter().flatten().filter_map(first).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// A Hertz pulse, F = sin^{3/2}, with noise of alternating sign, radius ∝ F^{1/3}, and a spike of the pressure at first
    /// touch; `per_instant` is the number of steps per sample.
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
        assert!(pulse.is_consistent());
        (pulse.peaks(largest, 1.0), largest)
    }

    /// Means over 1/64 are too low by 1e-4: (1.75/1.78 π/64)² 3/2 / 24.
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
    fn averaged_peak_force_is_insensitive_to_noise() {
        for (n_steps, per_instant) in [(12_000, 12), (2_000, 1)] {
            let (peaks, largest) = pulse(n_steps, per_instant, 0.03, 0.0);
            assert!((largest - 1.03).abs() < 1e-4);
            // An odd number of steps in the window leaves 1/31 of the noise at most.
            assert!((peaks.force - 1.0).abs() < 1.2e-3, "{n_steps}: {peaks:?}");
        }
    }

    #[test]
    fn the_pressure_of_first_touch_does_not_count() {
        let (peaks, _) = pulse(12_000, 12, 0.0, 9.0);
        assert!((peaks.pressure - 1.0).abs() < 3e-4, "{peaks:?}");
    }

    /// A pressure that flows at 1 while its reading swings by a fifth, 20 times during the contact, is read as 1; an elastic
    /// one loses 0.3 % of its peak.
    #[test]
    fn steady_pressure_leaves_out_the_swings_of_a_flowing_contact() {
        let (mut swinging, mut smooth) = (ForcePulse::default(), ForcePulse::default());
        let mut impulse = 0.0;
        for k in 0..=2000 {
            let time = f64::from(k) / 2000.0;
            let force = (PI * time).sin();
            let reading = 1.0 + 0.2 * (20.0 * 2.0 * PI * time).sin();
            swinging.observe(time, impulse, force.sqrt(), reading);
            smooth.observe(time, impulse, force.sqrt(), force.sqrt());
            impulse += force / 2000.0;
        }
        let [swinging, smooth] = [swinging, smooth].map(|it| it.steady_pressure(1.0).unwrap());
        // A window of 2.8 swings leaves a fifth of 0.2 / 2.8π.
        assert!((swinging - 1.0).abs() < 0.03, "{swinging}");
        assert!((0.995..1.0).contains(&smooth), "{smooth}");
        assert_eq!(ForcePulse::default().steady_pressure(1.0), None);
    }

    /// A viscous body: the pressure is largest, 1, at a hundredth of the contact time and a twentieth of the largest
    /// radius. Elements of an eightieth of the radius resolve it, larger ones do not.
    #[test]
    fn an_early_peak_of_the_pressure_is_found() {
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

    /// A pulse between two instants keeps the largest values of its steps.
    #[test]
    fn pulse_shorter_than_an_interval_keeps_its_peaks() {
        let mut short = ForcePulse::default();
        for (time, impulse) in [(0.0, 0.0), (1.0, 0.01), (2.0, 0.01)] {
            short.observe(time, impulse, 0.5, 2.0);
        }
        let peaks = short.peaks(1.0, 1.0);
        let of = [peaks.force, peaks.radius, peaks.pressure, peaks.pressure_radius];
        assert_eq!(of, [1.0, 0.5, 2.0, 0.5]);
        let none = ForcePulse::default().peaks(0.0, 1.0);
        assert_eq!([none.force, none.radius, none.pressure, none.pressure_radius], [0.0; 4]);
    }

    #[test]
    fn nan_is_propagated() {
        let mut broken = ForcePulse::default();
        for k in 0..100 {
            let value = if k == 50 { f64::NAN } else { 1.0 };
            broken.observe(k as f64, k as f64, value, value);
        }
        let peaks = broken.peaks(f64::NAN, 1.0);
        assert!([peaks.force, peaks.radius, peaks.pressure].iter().all(|peak| peak.is_nan()));
    }

    /// Any number of instants is reduced to a few samples with the same peaks.
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
        let n_samples = long.samples.len();
        assert!(long.is_consistent() && n_samples > MAX_SAMPLES / 2 - 1, "{n_samples}");
        let strides = long.samples.windows(2).map(|two| (two[1].time - two[0].time) * n as f64);
        assert!(strides.into_iter().all(|stride| (stride - long.stride as f64).abs() < 1e-6));
        assert!((long.peaks(1.0, 1.0).force - 1.0).abs() < 3e-4);
    }
}
