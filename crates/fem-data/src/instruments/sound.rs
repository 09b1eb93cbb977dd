//! The instants of bounces from a sound or another trace of amplitude, such as that of an accelerometer.
//!
//! A bounce is an onset: the energy of the signal in a quarter of a millisecond is far above the noise, and above that of the
//! milliseconds before (the ratio of a short and a long average, R. V. Allen, *Bull. Seismol. Soc. Am.* **68** (1978) 1521). Its
//! instant is that of the first sample above a fifth of the burst's peak. The scatter of these instants is part of the
//! uncertainty, since it comes from the scatter of the flights.

use crate::table::{DataError, Table};

use super::bounce_times::{BounceTimes, Instants};
use super::rig::Rig;
use super::roles::{SIGNALS, TIMES};
use crate::estimate::median;

/// Frequency below which the signal is taken out, Hz.
const HIGH_PASS: f64 = 200.0;
/// Length of a frame whose energy is averaged, s.
const FRAME: f64 = 2.5e-4;
/// Fewest samples of a frame: the mean of fewer noisy samples exceeds its usual value by [`OVER_NOISE`] once in a minute.
const FEWEST_SAMPLES: usize = 4;
/// Frames before an onset with which its energy is compared.
const BEFORE: usize = 16;
/// Energy of an onset over the noise.
const OVER_NOISE: f64 = 25.0;
/// Energy of an onset over that of the frames before.
const OVER_BEFORE: f64 = 8.0;
/// Time after an onset in which there is no other, s.
const DEAD_TIME: f64 = 4e-3;
/// Longest time after a bounce in which its echo comes, s: the way to a wall 5 m away and back.
const ECHO_TIME: f64 = 0.03;
/// Largest peak of an echo over that of its bounce. A bounce that is so much quieter than the last one has e < 0.5 and does not follow so soon.
const ECHO_SHARE: f64 = 0.5;
/// Onsets with which another one is compared: more do not fit into the time of echoes.
const MOST_ECHOES: usize = 8;
/// Share of the peak of a burst at its instant.
const SHARE_OF_PEAK: f64 = 0.2;
/// Share of the frames that are noise.
const NOISE_QUANTILE: usize = 3;
/// Lowest sampling rate, 1/s.
const LOWEST_RATE: f64 = 500.0;
/// Largest deviation of a sample from an even spacing, in samples.
const UNEVEN: f64 = 2.0;

/// A sampled signal.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// The name of the record in messages.
    pub name: String,
    /// The time of the first sample, s.
    pub start: f64,
    /// Samples per second.
    pub rate: f64,
    /// The samples, in any unit.
    pub values: Vec<f64>,
}

/// The bounces in a sound.
#[derive(Clone, Debug, PartialEq)]
pub struct Sound {
    /// The recorded signal with all its samples.
    pub signal: Signal,
    /// Root of the mean square of the noise, in the unit of the signal.
    pub noise: f64,
    /// The restitutions by the instants of the onsets.
    pub bounces: BounceTimes,
}

impl Signal {
    /// Reads a trace from a table with a column of times and one of amplitudes.
    ///
    /// # Errors
    /// A column is missing, a cell is no number, or the samples are not evenly spaced.
    pub fn read(columns: &Table) -> Result<Self, DataError> {
        let time = columns.require(TIMES, "time_s")?;
        let signal = columns.require(SIGNALS, "signal")?;
        let times = columns.numbers(time, [0, 0, 1])?.values;
        let values = columns.plain(signal)?.values;
        let fault = |message: String| {
            let help = "a trace has all its samples, evenly spaced, with enough digits of the time";
            Err(DataError::new(columns.name(), message).with_help(help))
        };
        if values.len() < 2 || times.iter().chain(&values).any(|value| !value.is_finite()) {
            return fault("the trace has too few samples, or some without a value".to_string());
        }
        let step = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
        let off = |(k, time): (usize, &f64)| (time - times[0] - k as f64 * step).abs() / step;
        if step <= 0.0 || times.iter().enumerate().map(off).fold(0.0, f64::max) > UNEVEN {
            return fault("the samples are not evenly spaced".to_string());
        }
        let name = columns.name().to_string();
        Ok(Self { name, start: times[0], rate: 1.0 / step, values })
    }

    /// Returns the time of a sample, s.
    pub fn time(&self, k: usize) -> f64 {
        self.start + k as f64 / self.rate
    }

    /// Returns the signal without its slow parts, by three filters of first order one after the other.
    fn without_drift(&self) -> Vec<f64> {
        let cutoff = HIGH_PASS.min(0.05 * self.rate);
        let decay = 1.0 / (1.0 + 2.0 * std::f64::consts::PI * cutoff / self.rate);
        let mut signal = self.values.clone();
        for _ in 0..3 {
            let (mut last, mut high) = (signal.first().copied().unwrap_or(0.0), 0.0);
            for value in &mut signal {
                high = decay * (high + *value - last);
                last = *value;
                *value = high;
            }
        }
        signal
    }

    /// Returns the noise and the instants of the onsets, s.
    fn onsets(&self) -> (f64, Vec<f64>) {
        let signal = self.without_drift();
        let size = ((FRAME * self.rate) as usize).max(FEWEST_SAMPLES);
        let energy = |frame: &[f64]| frame.iter().map(|x| x * x).sum::<f64>() / frame.len() as f64;
        let energies: Vec<f64> = signal.chunks(size).map(energy).collect();
        let mut sorted = energies.clone();
        let quantile = sorted.len() / NOISE_QUANTILE;
        let noise = *sorted.select_nth_unstable_by(quantile, f64::total_cmp).1;
        let largest = energies.iter().copied().fold(0.0, f64::max);
        // Digital silence has no noise.
        let noise = noise.max(1e-10 * largest);
        let n_dead = ((DEAD_TIME * self.rate) as usize / size).max(1);
        let (mut onsets, mut next): (Vec<(f64, f64)>, usize) = (Vec::new(), 1);
        for k in 1..energies.len() {
            let before = &energies[k.saturating_sub(BEFORE + 1)..k.max(2) - 1];
            let mean = before.iter().sum::<f64>() / before.len().max(1) as f64;
            let is_onset = energies[k] > OVER_NOISE * noise && energies[k] > OVER_BEFORE * mean;
            if k < next || !is_onset {
                continue;
            }
            // The peak may come some frames after the onset.
            let (from, to) = ((k - 1) * size, ((k + 8) * size).min(signal.len()));
            let peak = signal[from..to].iter().fold(0.0f64, |most, x| most.max(x.abs()));
            let first = signal[from..to].iter().position(|x| x.abs() >= SHARE_OF_PEAK * peak);
            let instant = self.time(from + first.unwrap_or(0));
            next = k + n_dead;
            let is_echo = |(other, louder): &(f64, f64)| {
                instant - other < ECHO_TIME && peak < ECHO_SHARE * louder
            };
            if !onsets.iter().rev().take(MOST_ECHOES).any(is_echo) {
                onsets.push((instant, peak));
            }
        }
        (noise.sqrt(), onsets.into_iter().map(|(instant, _)| instant).collect())
    }
}

impl Sound {
    /// Returns the restitutions of the bounces in a signal.
    ///
    /// # Errors
    /// The signal has no onsets, too few of them, or what [`BounceTimes::of`] rejects.
    pub fn of(signal: Signal, rig: &Rig) -> Result<Self, DataError> {
        let fault = |message: String, help: &str| {
            Err(DataError::new(&signal.name, message).with_help(help))
        };
        if signal.rate < LOWEST_RATE {
            let message = format!("{:.1} samples per second are too few for onsets", signal.rate);
            return fault(
                message,
                "is the time in seconds? name the column with its unit, such as time_ms",
            );
        }
        let level = if signal.values.is_empty() { 0.0 } else { median(&signal.values) };
        let swing = signal.values.iter().fold(0.0f64, |most, x| most.max((x - level).abs()));
        if swing <= 0.0 {
            return fault(
                "the signal is silent".to_string(),
                "choose the channel of the microphone",
            );
        }
        let (noise, values) = signal.onsets();
        let n_clipped = signal.values.iter().filter(|x| (*x - level).abs() >= swing).count();
        if values.len() < 2 {
            let n = if values.is_empty() { "no" } else { "only one" };
            let message = format!("{n} bounce stands out from the noise");
            let help = "list the instants in a file with a column time_s if you can hear more";
            return fault(message, help);
        }
        let instants = Instants {
            name: signal.name.clone(),
            values,
            resolution: 1.0 / signal.rate,
            ..Instants::default()
        };
        let mut bounces = BounceTimes::of(instants, rig)?;
        if n_clipped > 10 {
            bounces.warnings.push(format!(
                "{n_clipped} samples are at the limit of the signal: instants of clipped bursts are less sharp"
            ));
        }
        Ok(Self { signal, noise, bounces })
    }
}
