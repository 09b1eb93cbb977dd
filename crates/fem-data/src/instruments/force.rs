//! Restitutions from the force of an impact over time, measured by a plate under the ball or by a sensor in the striking body.
//!
//! The impulse of a pulse changes the momentum of the body: with the weight mg over the contact time τ,
//!
//! ```math
//! J = \int F\,dt, \qquad m (v + e v) = J - m g \tau, \qquad e = \frac{J - m g \tau}{m v} - 1
//! ```
//!
//! The approach speed v is given, or follows from the height of the drop, or from the flight since the pulse before. A baseline that
//! drifts is taken out by a line through the unloaded samples beside each pulse. If a body of mass m carries the sensor and the part
//! between sensor and contact has the mass m_s, the contact force is the measured one times m/(m − m_s).
//! Uncertainties come from the noise of the unloaded samples, the baseline, the sampling, the calibration, mass and speed, in first
//! order. A mass that is 1 % off changes e by 0.01 (1 + e). A sum over n samples of a pulse that begins and ends as Hertz' force, in
//! proportion to time^1.5, misses the impulse by the share [`SAMPLING`] n^(−5/2) in the root mean square over the phase of the
//! sampling, as the Euler–Maclaurin formula for such ends has it.

use fem_material::engineering::show;
use serde::Serialize;
use serde_json::{Value, json};

use crate::table::Measured;
use crate::table::{DataError, Table};

use super::impact::Impact;
use super::rig::Rig;
use super::roles::{FORCES, TIMES};
use crate::estimate::{deviation_by_median, median};

/// Height of a pulse over the noise.
const PULSE_OVER_NOISE: f64 = 8.0;
/// Height of a pulse over the largest one.
const PULSE_OVER_LARGEST: f64 = 0.01;
/// Height of the edges of a pulse over the noise.
const EDGE_OVER_NOISE: f64 = 4.0;
/// Fewest samples of a pulse above its edges.
const FEWEST_SAMPLES: usize = 4;
/// Unloaded samples on either side of a pulse over its length.
const UNLOADED: usize = 2;
/// Fewest unloaded samples on either side of a pulse.
const FEWEST_UNLOADED: usize = 10;
/// Largest part of a record in which pulses may lie, as a divisor of its ends.
const ENDS: usize = 20;
/// Shares of the peak at which the contact time is measured.
const LEVELS: [f64; 2] = [0.1, 0.01];
/// Noise over peak up to which a level of the pulse is clear of the noise, as a share of the level.
const CLEAR_LEVEL: f64 = 0.3;
/// A flight that is this share off the one by the impulse is of another drop.
const OTHER_DROP: f64 = 0.25;
/// Equal samples at the top of a pulse over those of a rounded top.
const FLAT: f64 = 2.0;
/// Relative error of the impulse of sin^1.5 by its samples, times their number to the power 5/2.
const SAMPLING: f64 = 0.28;
/// Range over the noise in which the samples of a flat top lie.
const TOP_OVER_NOISE: f64 = 5.0;
/// Most pulses of a record.
const MOST_PULSES: usize = 1000;

/// The samples of a force.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// The name of the record in messages.
    pub name: String,
    /// Increasing times, s.
    pub times: Vec<f64>,
    /// Force of each sample, N.
    pub forces: Vec<f64>,
}

/// A pulse of a force.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pulse {
    /// The first time above the edge of the pulse, s.
    pub time_s: f64,
    /// Largest force, N.
    pub peak_force_n: f64,
    /// Impulse of the pulse, N·s.
    pub impulse_n_s: f64,
    /// Its standard uncertainty, N·s.
    pub impulse_uncertainty_n_s: f64,
    /// Time above a tenth of the peak, s.
    pub contact_time_10_percent_s: Option<f64>,
    /// Time above a hundredth of the peak, s; `None` if that is in the noise.
    pub contact_time_1_percent_s: Option<f64>,
    /// Whether the force is cut off at its largest value.
    pub is_clipped: bool,
    /// Indices of its first and its last sample.
    #[serde(skip)]
    pub samples: [usize; 2],
    /// Baseline, N, at the first sample and its change to the last one.
    #[serde(skip)]
    pub baseline: [f64; 2],
}

/// The pulses of a record and their restitutions.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceRecord {
    /// The samples, positive in compression.
    pub samples: Samples,
    /// Noise of a sample, N.
    pub noise: f64,
    /// The pulses in the order of the record.
    pub pulses: Vec<Pulse>,
    /// The impacts in the order of the record.
    pub impacts: Vec<Impact>,
    /// Pulses without a restitution, and other warnings.
    pub warnings: Vec<String>,
}

impl Samples {
    /// Reads the samples of a table.
    ///
    /// # Errors
    /// A column is missing, a cell is no number, or the times do not increase.
    pub fn read(columns: &Table) -> Result<Self, DataError> {
        let time = columns.require(TIMES, "time_s or time_ms")?;
        let force = columns.require(FORCES, "force_n or force_kn")?;
        let times = columns.numbers(time, [0, 0, 1])?.values;
        let forces = columns.numbers(force, [1, 1, -2])?.values;
        let both = times.into_iter().zip(forces).enumerate();
        let known = both.filter(|(_, (time, force))| time.is_finite() && force.is_finite());
        let mut samples =
            Self { name: columns.name().to_string(), times: Vec::new(), forces: Vec::new() };
        for (k, (time, force)) in known {
            let help = "the samples of one record are in order; an oscilloscope must write all digits of the time";
            columns.check_increase(k, samples.times.last(), time, help)?;
            samples.times.push(time);
            samples.forces.push(force);
        }
        Ok(samples)
    }

    /// Returns the line through the unloaded ends and the noise about it: value at time 0, slope, standard deviation.
    fn baseline(&self) -> [f64; 3] {
        let n = self.times.len();
        let n_ends = (n / ENDS).max(FEWEST_UNLOADED.min(n / 2));
        let middle = |range: std::ops::Range<usize>| {
            [median(&self.times[range.clone()]), median(&self.forces[range])]
        };
        let [[t0, f0], [t1, f1]] = [middle(0..n_ends), middle(n - n_ends..n)];
        let slope = (f1 - f0) / (t1 - t0);
        let off = |k: usize| (self.forces[k] - f0 - slope * (self.times[k] - t0)).abs();
        let ends: Vec<f64> = (0..n_ends).chain(n - n_ends..n).map(off).collect();
        [f0 - slope * t0, slope, deviation_by_median(&ends)]
    }
}

impl ForceRecord {
    /// Returns the pulses of a force, and the restitutions that they and the rig give.
    ///
    /// # Errors
    /// The record has no pulse, no pulse gives a restitution, or a value of the rig is out of range.
    pub fn of(mut samples: Samples, rig: &Rig) -> Result<Self, DataError> {
        rig.check(&samples.name)?;
        let n = samples.times.len();
        if n < 4 * FEWEST_UNLOADED {
            let message =
                format!("{n} samples are too few for a pulse and the unloaded time beside it");
            let help = "record the force for some contact times before and after the pulse";
            return Err(DataError::new(&samples.name, message).with_help(help));
        }
        let (sum, noise) = pulses_and_noise(&mut samples);
        let mut record =
            Self { samples, noise, pulses: sum, impacts: Vec::new(), warnings: Vec::new() };
        if record.pulses.is_empty() || record.pulses.len() > MOST_PULSES {
            let found = match record.pulses.len() {
                0 => format!("there is no pulse above the noise of {}", show(noise, "N")),
                n => format!("{n} pulses are no impacts"),
            };
            let help =
                "is the column the force, and is the sensor unloaded before and after each pulse?";
            return Err(DataError::new(&record.samples.name, found).with_help(help));
        }
        record.impacts = record.find_impacts(rig);
        if record.impacts.is_empty() {
            let help = if record.warnings.is_empty() {
                "give --mass and --speed of the body, or --height of its drop".to_string()
            } else {
                record.warnings.join("; ")
            };
            let message = format!("the {} pulses give no restitution", record.pulses.len());
            let message =
                if record.pulses.len() == 1 { "the pulse gives no restitution" } else { &message };
            return Err(DataError::new(&record.samples.name, message).with_help(help));
        }
        Ok(record)
    }

    fn find_impacts(&mut self, rig: &Rig) -> Vec<Impact> {
        let Some(mass) = rig.mass else {
            self.warnings
                .push("the impulse gives a restitution with --mass of the moving body".to_string());
            return Vec::new();
        };
        let gravity = rig.gravity();
        let factor = rig.sensor_mass.map_or(1.0, |sensor| mass.value / (mass.value - sensor.value));
        let of_calibration = rig.force_uncertainty.unwrap_or(0.0);
        let first = first_speed(rig);
        let step = self.samples.step();
        let mut impacts = Vec::new();
        // End of the pulse before, and the speed that its impulse gives the body.
        let mut before: Option<(f64, Option<f64>)> = None;
        for (k, pulse) in self.pulses.iter().enumerate() {
            let at = format!("the pulse at {:.4} s", pulse.time_s);
            let contact = pulse.contact_time().unwrap_or(0.0);
            let flight = before
                .and_then(|(end, left)| speed_after_flight(rig, pulse.time_s - end, left, step));
            let speed = if k == 0 { first } else { flight.or(first) };
            before = Some((pulse.time_s + contact, None));
            if pulse.is_clipped {
                self.warnings.push(format!(
                    "{at} is clipped at {:.4} N: its impulse is too small and gives no restitution",
                    pulse.peak_force_n
                ));
                continue;
            }
            let impulse = factor * pulse.impulse_n_s - mass.value * gravity.value * contact;
            let Some(speed) = speed else {
                self.warnings.push(format!(
                    "{at} gives no restitution: --speed or --height gives the speed before the first pulse"
                ));
                continue;
            };
            let e = impulse / (mass.value * speed.value) - 1.0;
            let relative = (factor * pulse.impulse_uncertainty_n_s / impulse)
                .hypot(of_calibration)
                .hypot(mass.uncertainty / mass.value)
                .hypot(speed.uncertainty / speed.value);
            let restitution = Measured { value: e, uncertainty: (1.0 + e) * relative };
            let impact = Impact {
                time: pulse.time_s,
                speed,
                restitution,
                contact_time: pulse.contact_time(),
            };
            match impact.impossible() {
                Some(reason) => self.warnings.push(format!(
                    "{at} is left out: {reason}; are the mass and the units of the force right?"
                )),
                None => {
                    before = Some((pulse.time_s + contact, Some(e * speed.value)));
                    impacts.push(impact);
                }
            }
        }
        impacts
    }

    /// Returns the numbers of the record for JSON, SI.
    pub(super) fn numbers(&self) -> Value {
        json!({
            "samples": self.samples.times.len(),
            "noise_n": self.noise,
            "pulses": self.pulses,
        })
    }
}

/// Returns the speed before the first pulse: the given one, or that of the drop.
fn first_speed(rig: &Rig) -> Option<Measured> {
    if rig.speed.is_some() {
        return rig.speed;
    }
    let (height, gravity) = (rig.drop_height?, rig.gravity());
    let [own, more] = rig.flights().landing_after(height.value)?;
    let uncertainty = (0.5 * own * height.uncertainty / height.value)
        .hypot(0.5 * own * gravity.uncertainty / gravity.value)
        .hypot(more - own);
    Some(Measured { value: own, uncertainty })
}

/// Returns the speed after a flight that lasts a time (s) between samples of a step (s). One whose launch does not fit the speed that the
/// last impulse has `left` begins another drop.
fn speed_after_flight(rig: &Rig, lasts: f64, left: Option<f64>, step: f64) -> Option<Measured> {
    let gravity = rig.gravity();
    let [own, more] = rig.flights().lasting(lasts)?;
    let fits = left.is_none_or(|left| (own.launch / left - 1.0).abs() < OTHER_DROP);
    let uncertainty = (gravity.uncertainty / gravity.value * own.landing)
        .hypot(more.landing - own.landing)
        .hypot(own.landing_slope * step);
    fits.then_some(Measured { value: own.landing, uncertainty })
}

impl Samples {
    /// Returns the usual time between samples, s.
    fn step(&self) -> f64 {
        let n = self.times.len();
        (self.times[n - 1] - self.times[0]) / (n - 1) as f64
    }
}

impl Pulse {
    /// Returns the contact time at the lowest level that the noise allows, s.
    pub fn contact_time(&self) -> Option<f64> {
        self.contact_time_1_percent_s.or(self.contact_time_10_percent_s)
    }
}

/// Makes the force positive in compression, and returns its pulses and its noise.
fn pulses_and_noise(samples: &mut Samples) -> (Vec<Pulse>, f64) {
    let [mut offset, mut slope, noise] = samples.baseline();
    let off = |samples: &Samples, k: usize, line: [f64; 2]| {
        samples.forces[k] - line[0] - line[1] * samples.times[k]
    };
    let n = samples.times.len();
    let extremes = (0..n).fold([0.0f64; 2], |[low, high], k| {
        let value = off(samples, k, [offset, slope]);
        [low.min(value), high.max(value)]
    });
    if -extremes[0] > extremes[1] {
        samples.forces.iter_mut().for_each(|force| *force = -*force);
        (offset, slope) = (-offset, -slope);
    }
    let largest = extremes[1].max(-extremes[0]);
    // Without noise the last digit is one.
    let noise = noise.max(1e-9 * largest);
    let threshold = (PULSE_OVER_NOISE * noise).max(PULSE_OVER_LARGEST * largest);
    let edge = EDGE_OVER_NOISE * noise;
    let value = |k: usize| off(samples, k, [offset, slope]);
    let mut spans: Vec<[usize; 2]> = Vec::new();
    let mut k = 0;
    while k < n {
        if value(k) < threshold {
            k += 1;
            continue;
        }
        let lowest = spans.last().map_or(0, |span| span[1] + 1);
        let mut from = k;
        while from > lowest && value(from - 1) > edge {
            from -= 1;
        }
        let mut to = k;
        while to + 1 < n && value(to + 1) > edge {
            to += 1;
        }
        // The ringing of the sensor after a pulse belongs to it.
        match spans.last_mut() {
            Some(last) if from - last[1] < (last[1] - last[0]) / 4 => last[1] = to,
            _ => spans.push([from, to]),
        }
        k = to + 1;
    }
    spans.retain(|[from, to]| to - from + 1 >= FEWEST_SAMPLES);
    let pulses = (0..spans.len()).map(|k| pulse(samples, &spans, k, noise)).collect();
    (pulses, noise)
}

/// Measures one pulse above its own baseline.
fn pulse(samples: &Samples, spans: &[[usize; 2]], k: usize, noise: f64) -> Pulse {
    let (t, f) = (&samples.times, &samples.forces);
    let [from, to] = spans[k];
    let length = to - from + 1;
    let n_unloaded = (UNLOADED * length).max(FEWEST_UNLOADED);
    let lowest = if k > 0 { spans[k - 1][1] + 1 } else { 0 };
    let highest = spans.get(k + 1).map_or(t.len(), |next| next[0]);
    // The samples next to the edges may belong to the pulse.
    let gap = (length / 10).max(1);
    let [start, end] = [from.saturating_sub(gap).max(lowest), (to + 1 + gap).min(highest)];
    let unloaded: Vec<usize> = (start.saturating_sub(n_unloaded).max(lowest)..start)
        .chain(end..(end + n_unloaded).min(highest))
        .collect();
    let n = unloaded.len().max(1) as f64;
    let origin = t[from];
    let mean = |get: &dyn Fn(usize) -> f64| unloaded.iter().map(|k| get(*k)).sum::<f64>() / n;
    let (time, level) = (mean(&|k| t[k] - origin), mean(&|k| f[k]));
    let square = mean(&|k| (t[k] - origin - time).powi(2));
    let slope = mean(&|k| (t[k] - origin - time) * (f[k] - level)) / square.max(f64::MIN_POSITIVE);
    let slope = if square > 0.0 { slope } else { 0.0 };
    let line = |k: usize| level + slope * (t[k] - origin - time);
    let value = |k: usize| f[k] - line(k);
    let top = (from..=to).max_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap_or(from);
    let peak = value(top);
    let (mut impulse, mut variance) = (0.0, 0.0);
    let last = end.min(t.len() - 1);
    for k in start..last {
        let step = t[k + 1] - t[k];
        impulse += 0.5 * step * (value(k) + value(k + 1));
        variance += (noise * step).powi(2);
    }
    let whole = t[last] - t[start];
    let centre = 0.5 * (t[last] + t[start]) - origin;
    let of_baseline =
        noise * whole * (1.0 / n + (centre - time).powi(2) / (n * square.max(1e-300))).sqrt();
    let of_sampling = SAMPLING * (length as f64).powf(-2.5) * impulse;
    let crossing = |level: f64, inside: usize, outside: usize| {
        let share = (value(inside) - level) / (value(inside) - value(outside));
        t[inside] + share.clamp(0.0, 1.0) * (t[outside] - t[inside])
    };
    let lasts = |share: f64| {
        let level = share * peak;
        let is_clear = noise <= CLEAR_LEVEL * level;
        let first = (start..=top).find(|k| value(*k) >= level)?;
        let last = (top..last).rev().find(|k| value(*k) >= level)?;
        let first_time = if first > 0 { crossing(level, first, first - 1) } else { t[first] };
        is_clear.then(|| crossing(level, last, last + 1) - first_time)
    };
    Pulse {
        time_s: t[from],
        peak_force_n: peak,
        impulse_n_s: impulse,
        impulse_uncertainty_n_s: variance.sqrt().hypot(of_baseline).hypot(of_sampling),
        contact_time_10_percent_s: lasts(LEVELS[0]),
        contact_time_1_percent_s: lasts(LEVELS[1]),
        is_clipped: is_clipped(&f[from..=to], peak, noise),
        samples: [start, last],
        baseline: [line(start), line(last) - line(start)],
    }
}

/// Whether the samples at the top of a pulse are more than those of a rounded top: equal ones, which lie within one step of the
/// converter, or those of an amplifier that saturates, which differ by the noise.
fn is_clipped(forces: &[f64], peak: f64, noise: f64) -> bool {
    let top = forces.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let step = forces.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let step = step.filter(|step| *step > 0.0).fold(f64::INFINITY, f64::min);
    let is_flat = |n: usize, within: f64| {
        // The part of a half sine within the share q of its top is 2/π √(2q).
        let rounded = 0.9 * (within.min(peak) / peak).sqrt() * forces.len() as f64;
        n >= 3 && n as f64 > FLAT * rounded + 2.0
    };
    let n_within = |width: f64| forces.iter().filter(|force| top - **force <= width).count();
    let width = TOP_OVER_NOISE * noise;
    is_flat(n_within(0.0), step) || is_flat(n_within(width), width)
}
