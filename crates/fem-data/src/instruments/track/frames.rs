//! The frames of a track, and what they show without a fit: their noise, wrong ones among them, and the lowest ones.

use crate::estimate::{deviation_by_median, median};
use crate::instruments::rig::Rig;
use crate::instruments::roles::{FRAMES, HEIGHT_UNCERTAINTIES, HEIGHTS, TIMES};
use crate::table::{DataError, Measured, Table};

/// A frame this many times the noise and the usual curvature above its neighbours is wrong.
const SPIKE: f64 = 10.0;
/// Most frames of a record.
const MOST_FRAMES: usize = 1_000_000;

/// Frames of a ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames {
    /// The name of the record in messages.
    pub name: String,
    /// Increasing times, s.
    pub times: Vec<f64>,
    /// Heights, m or pixels, upwards.
    pub heights: Vec<f64>,
    /// Whether heights are in pixels.
    pub in_pixels: bool,
    /// Weights of the frames, the inverse squares of relative uncertainties.
    pub(super) weights: Vec<f64>,
}

impl Frames {
    /// Takes a velocity (m/s) with which the plate moves in the picture out of the heights.
    pub(super) fn take_drift_out(&mut self, drift: f64) {
        let start = self.times[0];
        for (y, t) in self.heights.iter_mut().zip(&self.times) {
            *y -= drift * (t - start);
        }
    }

    /// Reads the frames of a table. Frames without a time or a height are skipped.
    ///
    /// # Errors
    /// A column is missing, a cell is no number, or the times do not increase.
    pub fn read(columns: &Table, rig: &Rig) -> Result<Self, DataError> {
        let times = match (columns.find(TIMES)?, columns.find(FRAMES)?, rig.frame_rate) {
            (None, Some(column), Some(Measured { value: rate, .. })) => {
                columns.plain(column)?.values.into_iter().map(|frame| frame / rate).collect()
            }
            (None, Some(column), None) => {
                let name = &columns.header()[column];
                let error =
                    columns.header_fault(format!("{name} counts frames, whose rate is not given"));
                return Err(error.with_help("give --frame-rate, such as --frame-rate '240 Hz'"));
            }
            _ => columns.numbers(columns.require(TIMES, "time_s")?, [0, 0, 1])?.values,
        };
        let height = columns.require(HEIGHTS, "y_m or y_cm")?;
        let in_pixels = columns.is_in_pixels(height);
        let lengths = |column: usize| match in_pixels {
            true => columns.plain(column),
            false => columns.numbers(column, [1, 0, 0]),
        };
        let heights = lengths(height)?.values;
        let uncertainties = match columns.find(HEIGHT_UNCERTAINTIES)? {
            Some(column) => lengths(column)?.values,
            None => vec![1.0; times.len()],
        };
        let mut frames = Self {
            name: columns.name().to_string(),
            times: Vec::new(),
            heights: Vec::new(),
            in_pixels,
            weights: Vec::new(),
        };
        for (k, (time, height)) in times.into_iter().zip(heights).enumerate() {
            let uncertainty = uncertainties[k];
            if !time.is_finite() || !height.is_finite() || !uncertainty.is_finite() {
                continue;
            }
            let help = "the frames of one track are in order; keep each track in a file of its own";
            columns.check_increase(k, frames.times.last(), time, help)?;
            if uncertainty <= 0.0 {
                let help = "it must be greater than 0, or the column is left out";
                return Err(columns.fault(k, "the uncertainty of the height").with_help(help));
            }
            frames.times.push(time);
            frames.heights.push(height);
            frames.weights.push(1.0 / (uncertainty * uncertainty));
        }
        if frames.times.len() > MOST_FRAMES {
            let message = format!("{} frames are more than {MOST_FRAMES}", frames.times.len());
            return Err(
                DataError::new(&frames.name, message).with_help("keep the frames of one drop")
            );
        }
        let mean = frames.weights.iter().sum::<f64>() / frames.weights.len().max(1) as f64;
        frames.weights.iter_mut().for_each(|weight| *weight /= mean);
        Ok(frames)
    }

    /// Returns the noise of a frame by third differences, to which a parabola does not contribute, m.
    pub(super) fn noise(&self) -> f64 {
        let (t, y) = (&self.times, &self.heights);
        let is_even = |k: &usize| {
            let gaps = [t[k + 1] - t[*k], t[k + 2] - t[k + 1], t[k + 3] - t[k + 2]];
            gaps.iter().all(|gap| (gap / gaps[0] - 1.0).abs() < 0.05)
        };
        let third = |k: usize| (y[k + 3] - 3.0 * y[k + 2] + 3.0 * y[k + 1] - y[k]).abs();
        let all: Vec<f64> = (0..y.len().saturating_sub(3)).filter(is_even).map(third).collect();
        // The variances add up to 20 σ².
        deviation_by_median(&all) / 20f64.sqrt()
    }

    /// Returns the lowest frames between rises of at least `rise`.
    pub(super) fn minima(&self, rise: f64) -> Vec<usize> {
        let y = &self.heights;
        let (mut minima, mut low, mut high) = (Vec::new(), 0, 0);
        let mut is_falling = false;
        for k in 1..y.len() {
            if is_falling {
                if y[k] < y[low] {
                    low = k;
                } else if y[k] > y[low] + rise {
                    minima.push(low);
                    (is_falling, high) = (false, k);
                }
            } else if y[k] > y[high] {
                high = k;
            } else if y[k] < y[high] - rise {
                (is_falling, low) = (true, k);
            }
        }
        minima
    }

    /// Returns the frames without single ones that are far above the line between their neighbours, as no flight is.
    pub(super) fn without_spikes(&self, noise: f64) -> Self {
        let (t, y) = (&self.times, &self.heights);
        let above = |k: usize| {
            let share = (t[k] - t[k - 1]) / (t[k + 1] - t[k - 1]);
            y[k] - y[k - 1] - share * (y[k + 1] - y[k - 1])
        };
        let n = t.len();
        let all: Vec<f64> = (1..n - 1).map(|k| above(k).abs()).collect();
        let limit = SPIKE * (noise + median(&all));
        let is_kept: Vec<bool> =
            (0..n).map(|k| k == 0 || k == n - 1 || above(k) <= limit).collect();
        let kept = |values: &[f64]| -> Vec<f64> {
            let all = values.iter().zip(&is_kept).filter(|(_, kept)| **kept);
            all.map(|(value, _)| *value).collect()
        };
        Self {
            name: self.name.clone(),
            times: kept(t),
            heights: kept(y),
            in_pixels: self.in_pixels,
            weights: kept(&self.weights),
        }
    }

    /// Returns the frames with heights in metres by the length of a pixel, m.
    pub(super) fn scaled(&self, pixel: f64) -> Self {
        let heights = self.heights.iter().map(|y| pixel * y).collect();
        Self { heights, in_pixels: false, ..self.clone() }
    }

    pub(super) fn upside_down(&self) -> Self {
        let heights = self.heights.iter().map(|y| -y).collect();
        Self { heights, ..self.clone() }
    }
}
