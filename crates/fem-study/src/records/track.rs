//! Restitutions from the track of a ball: its height over time, frame by frame, as video programs export it.
//!
//! Between two bounces the heights follow a parabola. All flights are fitted together by weighted least squares, with a height
//! and a speed for each and one acceleration g for all:
//!
//! ```math
//! y_j(t) = a_j + b_j (t - t_j) - \tfrac12 g (t - t_j)^2
//! ```
//!
//! Two successive parabolas intersect at the bounce; their slopes there, corrected by gτ/2 for a contact time τ, are the speeds
//! before and after. The fitted g is free unless it is given: compared with that of the Earth it checks the scale of the picture and
//! the frame rate, which cancel in the restitution. Uncertainties come from the scatter of the frames about the parabolas, with the
//! correlation of neighbouring frames (an autoregressive process of first order), and propagate in first order.

use fem_material::engineering::show;
use serde_json::{Value, json};

use crate::fit::cradle::Measured;
use crate::measured::{DataError, NumberColumns};

use super::impact::Impact;
use super::rig::Rig;
use super::roles::{HEIGHT_UNCERTAINTIES, HEIGHTS, TIMES};
use super::series::{median, widened};

/// Fewest frames of a flight.
const FEWEST_FRAMES: usize = 5;
/// Rise beside a bounce over the noise of a frame.
const RISE_OVER_NOISE: f64 = 8.0;
/// Smallest rise beside a bounce over the range of all heights.
const RISE_OVER_RANGE: f64 = 4e-3;
/// A frame this many times the noise and the usual curvature above its neighbours is wrong.
const SPIKE: f64 = 10.0;
/// A frame this many times the usual deviation off its parabola is left out.
const OUTLIER: f64 = 5.0;
/// A flight whose deviations are this many times the usual ones is no parabola.
const MISFIT: f64 = 3.0;
/// Relative difference of a flight's own g from the usual one that air drag and noise do not make.
const OTHER_GRAVITY: f64 = 0.1;
/// Largest relative difference of the fitted g from that of the rig; a larger one is another unit.
const WRONG_SCALE: f64 = 0.25;
/// Largest relative uncertainty at which g is fitted.
const VAGUE_GRAVITY: f64 = 0.1;
/// Largest correlation of neighbouring frames that is taken for one.
const MOST_CORRELATION: f64 = 0.9;
/// Smallest drift that is taken out, m/s: a tenth of a millimetre per second changes no restitution.
const LEAST_DRIFT: f64 = 1e-4;
/// Most frames of a record.
const MOST_FRAMES: usize = 1_000_000;

/// A flight in a track.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackFlight {
    /// Indices of its frames.
    pub frames: Vec<usize>,
    /// Weighted mean of the times, s.
    centre: f64,
    /// Weighted means of y, τ², τ³ and of τ·y over that of τ², with τ = t − centre.
    moments: Moments,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Moments {
    weight: f64,
    height: f64,
    slope: f64,
    square: f64,
    cube: f64,
}

/// A parabola: height and velocity at a time.
#[derive(Clone, Copy, Debug)]
struct Parabola {
    height: f64,
    velocity: f64,
    centre: f64,
    gravity: f64,
}

impl Parabola {
    fn at(&self, time: f64) -> f64 {
        let tau = time - self.centre;
        self.height + (self.velocity - 0.5 * self.gravity * tau) * tau
    }

    fn velocity_at(&self, time: f64) -> f64 {
        self.velocity - self.gravity * (time - self.centre)
    }
}

/// Frames of a ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames {
    /// The name of the record in messages.
    pub name: String,
    /// Increasing times, s.
    pub times: Vec<f64>,
    /// Heights, m, upwards.
    pub heights: Vec<f64>,
    /// Weights of the frames, the inverse squares of relative uncertainties.
    weights: Vec<f64>,
}

/// The restitutions of a tracked ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The frames with upward heights, less the drift.
    pub frames: Frames,
    /// The flights that are used.
    pub flights: Vec<TrackFlight>,
    /// Acceleration of free fall of the parabolas, m/s².
    pub gravity: Measured,
    /// Whether it is fitted.
    pub has_fitted_gravity: bool,
    /// Scatter of a frame of mean weight about its parabola, m.
    pub noise: f64,
    /// Correlation of the deviations of neighbouring frames.
    pub correlation: f64,
    /// Velocity of the plate in the picture that is taken out, m/s.
    pub drift: f64,
    /// The impacts in the order of the record.
    pub impacts: Vec<Impact>,
    /// Numbers of flights and frames that are left out, and other warnings.
    pub warnings: Vec<String>,
}

impl Frames {
    /// Reads the frames of a table. Frames without a time or a height are skipped.
    ///
    /// # Errors
    /// A column is missing, a cell is no number, or the times do not increase.
    pub fn read(columns: &NumberColumns<'_>) -> Result<Self, DataError> {
        let require = |names: &[&str], help| columns.require(names, names[0], help);
        let time = require(&TIMES, "name a column time_s, or write --columns time=COLUMN")?;
        let height =
            require(&HEIGHTS, "name a column y_m or y_cm, or write --columns height=COLUMN")?;
        let [times, heights] =
            [columns.numbers(time, [0, 0, 1])?.values, columns.numbers(height, [1, 0, 0])?.values];
        let uncertainties = match columns.find(&HEIGHT_UNCERTAINTIES)? {
            Some(column) => columns.numbers(column, [1, 0, 0])?.values,
            None => vec![1.0; times.len()],
        };
        let lines = columns.lines();
        let mut frames = Self {
            name: columns.name().to_string(),
            times: Vec::new(),
            heights: Vec::new(),
            weights: Vec::new(),
        };
        for (k, (time, height)) in times.into_iter().zip(heights).enumerate() {
            let uncertainty = uncertainties[k];
            if !time.is_finite() || !height.is_finite() || !uncertainty.is_finite() {
                continue;
            }
            let fault = |message: String| DataError::new(&frames.name, message).in_line(lines[k]);
            if frames.times.last().is_some_and(|last| time <= *last) {
                let help =
                    "the frames of one track are in order; keep each track in a file of its own";
                return Err(fault(format!("the time {time} s does not increase")).with_help(help));
            }
            if uncertainty <= 0.0 {
                let help = "it must be greater than 0, or the column is left out";
                return Err(fault("the uncertainty of the height".to_string()).with_help(help));
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
    fn noise(&self) -> f64 {
        let (t, y) = (&self.times, &self.heights);
        let is_even = |k: &usize| {
            let gaps = [t[k + 1] - t[*k], t[k + 2] - t[k + 1], t[k + 3] - t[k + 2]];
            gaps.iter().all(|gap| (gap / gaps[0] - 1.0).abs() < 0.05)
        };
        let third = |k: usize| (y[k + 3] - 3.0 * y[k + 2] + 3.0 * y[k + 1] - y[k]).abs();
        let all: Vec<f64> = (0..y.len().saturating_sub(3)).filter(is_even).map(third).collect();
        // The median of a normal distribution's absolute value is 0.6745 σ; the variances add up to 20 σ².
        if all.is_empty() { 0.0 } else { median(&all) / (0.6745 * 20f64.sqrt()) }
    }

    /// Returns the lowest frames between rises of at least `rise`.
    fn minima(&self, rise: f64) -> Vec<usize> {
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

    /// Returns the root of the mean squared deviation of frames from a parabola of their own, m.
    fn own_misfit(&self, frames: &[usize]) -> f64 {
        let flight = TrackFlight::of(self, frames.to_vec());
        let (along, across) = flight.curvature(self);
        let gravity = if across > 0.0 { along / across } else { 0.0 };
        let parabola = flight.parabola(gravity);
        let squares = frames
            .iter()
            .map(|k| self.weights[*k] * (self.heights[*k] - parabola.at(self.times[*k])).powi(2));
        (squares.sum::<f64>() / (frames.len() - 3).max(1) as f64).sqrt()
    }

    /// Returns the frames without single ones that are far above the line between their neighbours, as no flight is.
    fn without_spikes(&self, noise: f64) -> Self {
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
            weights: kept(&self.weights),
        }
    }

    fn upside_down(&self) -> Self {
        let heights = self.heights.iter().map(|y| -y).collect();
        Self { heights, ..self.clone() }
    }
}

impl TrackFlight {
    fn of(all: &Frames, frames: Vec<usize>) -> Self {
        let weight: f64 = frames.iter().map(|k| all.weights[*k]).sum();
        let mean = |value: &dyn Fn(usize) -> f64| {
            frames.iter().map(|k| all.weights[*k] * value(*k)).sum::<f64>() / weight
        };
        let centre = mean(&|k| all.times[k]);
        let tau = |k: usize| all.times[k] - centre;
        let height = mean(&|k| all.heights[k]);
        let square = mean(&|k| tau(k).powi(2));
        let cube = mean(&|k| tau(k).powi(3));
        let slope = mean(&|k| tau(k) * (all.heights[k] - height)) / square;
        Self { frames, centre, moments: Moments { weight, height, slope, square, cube } }
    }

    /// Returns the parabola of least squares with this gravity.
    fn parabola(&self, gravity: f64) -> Parabola {
        let Moments { height, slope, square, cube, .. } = self.moments;
        Parabola {
            height: height + 0.5 * gravity * square,
            velocity: slope + 0.5 * gravity * cube / square,
            centre: self.centre,
            gravity,
        }
    }

    /// Returns the products of −τ²/2, less its regression on 1 and τ, with the heights and with itself.
    fn curvature(&self, all: &Frames) -> (f64, f64) {
        let Moments { height, slope, square, cube, .. } = self.moments;
        let products = self.frames.iter().map(|k| {
            let tau = all.times[*k] - self.centre;
            let q = -0.5 * (tau * tau - square - cube / square * tau);
            let weight = all.weights[*k];
            (weight * q * (all.heights[*k] - height - slope * tau), weight * q * q)
        });
        products.fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    }
}

impl Track {
    /// Returns the restitutions of a ball at the bounces of its track.
    ///
    /// # Errors
    /// The track has no bounce with flights on both sides, its scale is not in metres, or a value of the rig is out of range.
    pub fn of(frames: Frames, rig: &Rig) -> Result<Self, DataError> {
        rig.check(&frames.name)?;
        let n_all = frames.times.len();
        let (mut frames, minima, rise) = oriented(frames)?;
        let mut warnings = Vec::new();
        let mut flights = flights(&frames, &minima, rise, rig, &mut warnings);
        let n_out = n_all - frames.times.len() + leave_outliers_out(&frames, &mut flights);
        match n_out {
            0 => {}
            1 => warnings.push("1 frame far off its parabola is left out".to_string()),
            n => warnings.push(format!("{n} frames far off their parabolas are left out")),
        }
        let mut drift = 0.0;
        let mut fit = Fit::of(&frames, &flights, &minima, rig)?;
        if fit.leave_wrong_sides_out(&frames, &mut flights) {
            fit = Fit::of(&frames, &flights, &minima, rig)?;
        }
        if let Some(velocity) = fit.drift() {
            drift = velocity.value;
            let start = frames.times[0];
            for (y, t) in frames.heights.iter_mut().zip(&frames.times) {
                *y -= drift * (t - start);
            }
            for flight in flights.iter_mut().flatten() {
                *flight = TrackFlight::of(&frames, std::mem::take(&mut flight.frames));
            }
            fit = Fit::of(&frames, &flights, &minima, rig)?;
            fit.drift_uncertainty = velocity.uncertainty;
            warnings.push(format!(
                "the plate moves in the picture by {:.2} mm/s: this drift is taken out",
                1e3 * drift
            ));
        }
        let scale = fit.check_scale(&frames.name, rig, &mut warnings)?;
        let mut impacts: Vec<Impact> =
            (0..minima.len()).filter_map(|k| fit.impact(k, scale)).collect();
        impacts.retain(|impact| match impact.impossible() {
            Some(reason) => {
                warnings.push(format!("the impact at {:.4} s is left out: {reason}", impact.time));
                false
            }
            None => true,
        });
        if impacts.is_empty() {
            let message = "no bounce has a flight before and after it that are parabolas";
            let mut help = warnings.join("; ");
            if help.is_empty() {
                help =
                    format!("a flight needs {FEWEST_FRAMES} frames: take more frames per second");
            }
            return Err(DataError::new(&frames.name, message).with_help(help));
        }
        let Fit { gravity, has_fitted_gravity, noise, correlation, .. } = fit;
        let flights = flights.into_iter().flatten().collect();
        Ok(Self {
            frames,
            flights,
            gravity,
            has_fitted_gravity,
            noise,
            correlation,
            drift,
            impacts,
            warnings,
        })
    }

    /// Returns the height of a flight at a time (s), m.
    pub fn height(&self, flight: &TrackFlight, time: f64) -> f64 {
        flight.parabola(self.gravity.value).at(time)
    }

    /// Returns the numbers of the record for JSON, SI.
    pub(super) fn numbers(&self) -> Value {
        let ends = |flight: &TrackFlight| {
            let time = |k: Option<&usize>| k.map(|k| self.frames.times[*k]);
            json!([time(flight.frames.first()), time(flight.frames.last())])
        };
        json!({
            "frames": self.frames.times.len(),
            "flights_s": self.flights.iter().map(ends).collect::<Value>(),
            "fitted_gravity_m_s2": self.has_fitted_gravity.then_some(self.gravity.value),
            "fitted_gravity_uncertainty_m_s2": self.has_fitted_gravity.then_some(self.gravity.uncertainty),
            "noise_m": self.noise,
            "correlation": self.correlation,
            "drift_m_s": self.drift,
        })
    }
}

/// Returns the frames with upward heights, the lowest frame of each bounce, and the least rise beside it (m).
fn oriented(frames: Frames) -> Result<(Frames, Vec<usize>, f64), DataError> {
    let n = frames.times.len();
    if n < 2 * FEWEST_FRAMES {
        let message = format!("{n} frames are too few for a bounce");
        let help = format!("a bounce needs at least {FEWEST_FRAMES} frames before and after it");
        return Err(DataError::new(&frames.name, message).with_help(help));
    }
    let (low, high) = frames
        .heights
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |range, y| (range.0.min(*y), range.1.max(*y)));
    let noise = frames.noise();
    let rise = (RISE_OVER_NOISE * noise).max(RISE_OVER_RANGE * (high - low));
    let scored = |frames: Frames| {
        let frames = frames.without_spikes(noise);
        let minima = frames.minima(rise);
        let n = frames.times.len();
        let ends = std::iter::once(0).chain(minima.iter().copied()).chain([n]);
        let ends: Vec<usize> = ends.collect();
        let spans: Vec<Vec<usize>> =
            ends.windows(2).map(|ends| (ends[0] + 1..ends[1]).collect()).collect();
        // The span before the first bounce may have a hand in it, the last one a ball at rest.
        let inner = if spans.len() > 2 { &spans[1..spans.len() - 1] } else { &spans[..] };
        let long = inner.iter().filter(|span| span.len() >= FEWEST_FRAMES);
        let misfits: Vec<f64> = long.map(|span| frames.own_misfit(span)).collect();
        let score = match minima.is_empty() || misfits.is_empty() {
            true => f64::INFINITY,
            false => median(&misfits),
        };
        (score, frames, minima)
    };
    let upright = scored(frames.clone());
    let upside_down = scored(frames.upside_down());
    let best = if upside_down.0 < upright.0 { upside_down } else { upright };
    if best.2.is_empty() || best.0 == f64::INFINITY {
        let message = format!(
            "there is no bounce: the heights, from {low:.4} to {high:.4} m with a noise of {}, have no minimum \
             between two rises of {}",
            show(noise, "m"),
            show(rise, "m")
        );
        let help =
            "a bounce needs frames before and after it; is the column the height of the ball?";
        return Err(DataError::new(&frames.name, message).with_help(help));
    }
    Ok((best.1, best.2, rise))
}

/// Returns the flight before, between and after the lowest frames; `None` for one that is no parabola or too short.
fn flights(
    frames: &Frames,
    minima: &[usize],
    rise: f64,
    rig: &Rig,
    warnings: &mut Vec<String>,
) -> Vec<Option<TrackFlight>> {
    let n = frames.times.len();
    let contact = rig.contact_time().value;
    let starts = std::iter::once(None).chain(minima.iter().copied().map(Some));
    let ends = minima.iter().copied().map(Some).chain([None]);
    let spans = starts.zip(ends).map(|(start, end)| {
        let is_free = |k: &usize| {
            let away = |bounce: Option<usize>| {
                bounce.is_none_or(|bounce| {
                    *k != bounce && (frames.times[*k] - frames.times[bounce]).abs() >= contact
                })
            };
            away(start) && away(end)
        };
        (start.unwrap_or(0)..end.map_or(n, |end| end + 1)).filter(is_free).collect()
    });
    let mut spans: Vec<Vec<usize>> = spans.collect();
    // After the last bounce that is clear, another one may follow near the plate.
    if let (Some(span), Some(bounce)) = (spans.last_mut(), minima.last()) {
        let is_near = |k: &usize| frames.heights[*k] < frames.heights[*bounce] + rise;
        while span.last().is_some_and(is_near) {
            span.pop();
        }
    }
    let is_long = |span: &Vec<usize>| span.len() >= FEWEST_FRAMES;
    let inner: Vec<f64> = match spans.len() {
        0..=2 => Vec::new(),
        n => spans[1..n - 1]
            .iter()
            .filter(|span| is_long(span))
            .map(|span| frames.own_misfit(span))
            .collect(),
    };
    let usual = if inner.is_empty() { frames.noise() } else { median(&inner) };
    let allowed = MISFIT * usual + 1e-9 * frames.heights.iter().fold(0.0f64, |m, y| m.max(y.abs()));
    let last = spans.len() - 1;
    let flight = |(k, mut span): (usize, Vec<usize>)| {
        // Before the first bounce a hand may hold the ball, and after the last one it may be at rest.
        while (k == 0 || k == last) && is_long(&span) && frames.own_misfit(&span) > allowed {
            let n_less = (span.len() / 20).max(1);
            if k == 0 {
                span.drain(..n_less)
            } else {
                span.drain(span.len() - n_less..)
            };
        }
        // Frames in contact are off the parabola.
        for _ in 0..4 {
            if !is_long(&span) || frames.own_misfit(&span) <= allowed {
                break;
            }
            if k > 0 {
                span.remove(0);
            }
            if k < last {
                span.pop();
            }
        }
        let is_parabola = is_long(&span) && frames.own_misfit(&span) <= allowed;
        if !is_parabola && k > 0 && k < last {
            let [from, to] = [minima[k - 1], minima[k]].map(|k| frames.times[k]);
            let why = if is_long(&span) { "is no parabola" } else { "has too few frames" };
            warnings
                .push(format!("the flight from {from:.4} s to {to:.4} s {why} and is left out"));
        }
        is_parabola.then(|| TrackFlight::of(frames, span))
    };
    let mut flights: Vec<Option<TrackFlight>> = spans.into_iter().enumerate().map(flight).collect();
    // A ball at rest or in a hand is a parabola with another g.
    let mut own: Vec<(f64, f64)> =
        flights.iter().flatten().map(|one| one.curvature(frames)).collect();
    own.sort_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
    let half = 0.5 * own.iter().map(|it| it.1).sum::<f64>();
    let mut sum = 0.0;
    let middle = own.iter().find(|it| {
        sum += it.1;
        sum >= half
    });
    let Some(gravity) = middle.map(|it| it.0 / it.1) else { return flights };
    for (k, slot) in flights.iter_mut().enumerate() {
        let Some((along, across)) = slot.as_ref().map(|one| one.curvature(frames)) else {
            continue;
        };
        let off = (along / across - gravity).abs();
        if off > OUTLIER * usual / across.sqrt() + OTHER_GRAVITY * gravity.abs() {
            if k > 0 && k < last {
                let [from, to] = [minima[k - 1], minima[k]].map(|k| frames.times[k]);
                warnings.push(format!(
                    "the flight from {from:.4} s to {to:.4} s falls with another g and is left out"
                ));
            }
            *slot = None;
        }
    }
    flights
}

/// Removes frames that are far off their parabola, and returns their number.
fn leave_outliers_out(frames: &Frames, flights: &mut [Option<TrackFlight>]) -> usize {
    let mut n_out = 0;
    let scatter = frames.noise();
    for flight in flights.iter_mut().flatten() {
        let (along, across) = flight.curvature(frames);
        let parabola = flight.parabola(if across > 0.0 { along / across } else { 0.0 });
        let off = |k: usize| {
            (frames.heights[k] - parabola.at(frames.times[k])).abs() * frames.weights[k].sqrt()
        };
        let all: Vec<f64> = flight.frames.iter().map(|k| off(*k)).collect();
        let limit = OUTLIER * (median(&all) / 0.6745).max(scatter);
        let kept: Vec<usize> = flight.frames.iter().copied().filter(|k| off(*k) <= limit).collect();
        if kept.len() >= FEWEST_FRAMES && kept.len() < flight.frames.len() {
            n_out += flight.frames.len() - kept.len();
            *flight = TrackFlight::of(frames, kept);
        }
    }
    n_out
}

/// The parabolas of all flights.
struct Fit<'a> {
    flights: Vec<Option<TrackFlight>>,
    minima: &'a [usize],
    times: Vec<f64>,
    gravity: Measured,
    has_fitted_gravity: bool,
    /// Contact time, s.
    contact: Measured,
    /// Uncertainty of the drift that is taken out, m/s.
    drift_uncertainty: f64,
    noise: f64,
    correlation: f64,
    /// Factor from the noise of independent frames to standard uncertainties.
    widening: f64,
}

/// Instant and speeds of a bounce.
#[derive(Clone, Copy, Debug)]
struct Bounce {
    time: f64,
    level: f64,
    before: f64,
    after: f64,
}

impl<'a> Fit<'a> {
    fn of(
        frames: &Frames,
        flights: &[Option<TrackFlight>],
        minima: &'a [usize],
        rig: &Rig,
    ) -> Result<Self, DataError> {
        let used: Vec<&TrackFlight> = flights.iter().flatten().collect();
        let n_frames: usize = used.iter().map(|flight| flight.frames.len()).sum();
        let (along, across) = used.iter().fold((0.0, 0.0), |sum, flight| {
            let (along, across) = flight.curvature(frames);
            (sum.0 + along, sum.1 + across)
        });
        let residuals = |gravity: f64| -> Vec<Vec<f64>> {
            let of_flight = |flight: &&TrackFlight| {
                let parabola = flight.parabola(gravity);
                let off = |k: &usize| {
                    (frames.heights[*k] - parabola.at(frames.times[*k])) * frames.weights[*k].sqrt()
                };
                flight.frames.iter().map(off).collect()
            };
            used.iter().map(of_flight).collect()
        };
        let summary = |gravity: f64, n_free: usize| {
            let residuals = residuals(gravity);
            let squares: f64 = residuals.iter().flatten().map(|r| r * r).sum();
            let products: f64 =
                residuals.iter().flat_map(|r| r.windows(2).map(|pair| pair[0] * pair[1])).sum();
            let freedom = n_frames as f64 - 2.0 * used.len() as f64 - n_free as f64;
            let n_pairs: usize = residuals.iter().map(|r| r.len().saturating_sub(1)).sum();
            // Each flight's fit of two or three parameters makes the residuals anticorrelated, by these over the frames.
            let bias = (2.0 * used.len() as f64 + n_free as f64) / n_frames.max(1) as f64;
            let mean = squares / n_frames.max(1) as f64;
            let rough = if mean > 0.0 { products / n_pairs.max(1) as f64 / mean } else { 0.0 };
            ((squares / freedom.max(1.0)).sqrt(), freedom, rough + bias)
        };
        let given = rig.gravity;
        let mut gravity = rig.gravity();
        let (noise, freedom, correlation) =
            summary(if across > 0.0 { along / across } else { 0.0 }, 1);
        let correlation_of = |found: f64| {
            if found > 2.0 / (n_frames.max(1) as f64).sqrt() {
                found.min(MOST_CORRELATION)
            } else {
                0.0
            }
        };
        let factor = |correlation: f64, freedom: f64| {
            let effective = freedom * (1.0 - correlation) / (1.0 + correlation);
            ((1.0 + correlation) / (1.0 - correlation)).sqrt() * widened(effective.max(1.0))
        };
        let fitted = Measured {
            value: along / across,
            uncertainty: noise * factor(correlation_of(correlation), freedom) / across.sqrt(),
        };
        let is_clear = fitted.uncertainty <= VAGUE_GRAVITY * fitted.value.abs();
        let has_fitted_gravity = given.is_none() && across > 0.0 && freedom >= 1.0 && is_clear;
        let (noise, freedom, correlation) = match has_fitted_gravity {
            true => {
                gravity = fitted;
                (noise, freedom, correlation)
            }
            false => summary(gravity.value, 0),
        };
        let correlation = correlation_of(correlation);
        Ok(Self {
            flights: flights.to_vec(),
            minima,
            times: frames.times.clone(),
            gravity,
            has_fitted_gravity,
            contact: rig.contact_time(),
            drift_uncertainty: 0.0,
            noise,
            correlation,
            widening: factor(correlation, freedom),
        })
    }

    /// Returns the relative uncertainty of the scale of the heights, and warns if the fitted g shows an error of it.
    fn check_scale(
        &self,
        name: &str,
        rig: &Rig,
        warnings: &mut Vec<String>,
    ) -> Result<f64, DataError> {
        if !self.has_fitted_gravity {
            if rig.gravity.is_none() {
                warnings
                    .push("the frames do not show g, which is taken as 9.80665 m/s²".to_string());
            }
            return Ok(0.0);
        }
        let Measured { value, uncertainty } = self.gravity;
        let ratio = value / rig.gravity().value;
        if (ratio - 1.0).abs() > WRONG_SCALE + 3.0 * uncertainty / value.abs() {
            let message = format!("the parabolas fall with {value:.3} m/s², not with 9.81 m/s²");
            let help = "name the columns with their units, such as y_cm and t_ms, calibrate the scale and the \
                        frame rate, or give --gravity";
            return Err(DataError::new(name, message).with_help(help));
        }
        if (ratio - 1.0).abs() > 0.005_f64.max(3.0 * uncertainty / value) {
            warnings.push(format!(
                "the parabolas fall with {value:.3} ± {uncertainty:.3} m/s²: the scale of the heights is off by {:.1} %, \
                 the frame rate by half of that, or the air drags; it is in the uncertainty of the speeds and cancels in the restitutions",
                100.0 * (ratio - 1.0)
            ));
        }
        Ok((ratio - 1.0).abs())
    }

    /// Returns the flights before and after a bounce.
    fn sides(&self, k: usize) -> Option<[&TrackFlight; 2]> {
        Some([self.flights[k].as_ref()?, self.flights[k + 1].as_ref()?])
    }

    /// Returns the bounce of two parabolas, near a time.
    fn bounce(&self, [before, after]: [Parabola; 2], near: f64, contact: f64) -> Bounce {
        // With one g the parabolas differ by a line.
        let difference = before.at(near) - after.at(near);
        let closing = after.velocity_at(near) - before.velocity_at(near);
        let time = near + difference / closing;
        let change = 0.5 * before.gravity * contact;
        Bounce {
            time,
            level: before.at(time),
            before: -before.velocity_at(time) - change,
            after: after.velocity_at(time) + change,
        }
    }

    /// Removes frames that are on the other side of a bounce than their flight, and returns whether there are any: noise makes the
    /// lowest frame one that is not next to the bounce.
    fn leave_wrong_sides_out(&self, frames: &Frames, flights: &mut [Option<TrackFlight>]) -> bool {
        let times: Vec<Option<f64>> =
            (0..self.minima.len()).map(|k| Some(self.spread(k)?.own.time)).collect();
        let mut has_changed = false;
        for (k, slot) in flights.iter_mut().enumerate() {
            let Some(flight) = slot else { continue };
            let start =
                k.checked_sub(1).and_then(|before| times[before]).unwrap_or(f64::NEG_INFINITY);
            let end = times.get(k).copied().flatten().unwrap_or(f64::INFINITY);
            let half = 0.5 * self.contact.value;
            let is_own = |k: &usize| (start + half..=end - half).contains(&frames.times[*k]);
            let kept: Vec<usize> = flight.frames.iter().copied().filter(is_own).collect();
            if kept.len() < flight.frames.len() {
                has_changed = true;
                *slot = (kept.len() >= FEWEST_FRAMES).then(|| TrackFlight::of(frames, kept));
            }
        }
        has_changed
    }

    /// Returns a bounce and its changes by one standard uncertainty of each input.
    fn spread(&self, k: usize) -> Option<Spread> {
        let near = self.times[self.minima[k]];
        let sides = self.sides(k)?;
        let parabolas = sides.map(|flight| flight.parabola(self.gravity.value));
        let contact = self.contact.value;
        let own = self.bounce(parabolas, near, contact);
        let mut changed = Vec::new();
        for (side, flight) in sides.iter().enumerate() {
            let Moments { weight, square, .. } = flight.moments;
            let of_height = self.widening * self.noise / weight.sqrt();
            let mut one = parabolas;
            one[side].height += of_height;
            changed.push(self.bounce(one, near, contact));
            one = parabolas;
            one[side].velocity += of_height / square.sqrt();
            changed.push(self.bounce(one, near, contact));
        }
        let gravity = self.gravity.value + self.gravity.uncertainty;
        let steeper = sides.map(|flight| flight.parabola(gravity));
        changed.push(self.bounce(steeper, near, contact));
        changed.push(self.bounce(parabolas, near, contact + self.contact.uncertainty));
        let [before, after] =
            [own.before + self.drift_uncertainty, own.after - self.drift_uncertainty];
        changed.push(Bounce { before, after, ..own });
        (own.before > 0.0).then_some(Spread { own, changed })
    }

    /// Returns the impact of a bounce; `scale` is the relative uncertainty of speeds.
    fn impact(&self, k: usize, scale: f64) -> Option<Impact> {
        let spread = self.spread(k)?;
        let speed = spread.of(|bounce| bounce.before);
        Some(Impact {
            time: spread.own.time,
            speed: Measured { uncertainty: speed.uncertainty.hypot(scale * speed.value), ..speed },
            restitution: spread.of(|bounce| bounce.after / bounce.before),
            contact_time: None,
        })
    }

    /// Returns the velocity of the plate in the picture, m/s, if the levels of the bounces show one.
    fn drift(&self) -> Option<Measured> {
        let bounces: Vec<Spread> = (0..self.minima.len()).filter_map(|k| self.spread(k)).collect();
        if bounces.len() < 2 {
            return None;
        }
        let levels: Vec<(f64, Measured)> =
            bounces.iter().map(|it| (it.own.time, it.of(|bounce| bounce.level))).collect();
        let weight = |it: &(f64, Measured)| it.1.uncertainty.max(f64::MIN_POSITIVE).powi(-2);
        let weights: f64 = levels.iter().map(weight).sum();
        let mean = |get: &dyn Fn(&(f64, Measured)) -> f64| {
            levels.iter().map(|it| weight(it) * get(it)).sum::<f64>() / weights
        };
        let (time, level) = (mean(&|it| it.0), mean(&|it| it.1.value));
        let square = mean(&|it| (it.0 - time).powi(2));
        let slope = mean(&|it| (it.0 - time) * (it.1.value - level)) / square;
        let off = mean(&|it| (it.1.value - level - slope * (it.0 - time)).powi(2)) * weights;
        // Levels that scatter more than the parabolas say widen the bar.
        let freedom = levels.len() as f64 - 2.0;
        let scatter = if freedom > 0.0 { (off / freedom).sqrt().max(1.0) } else { 1.0 };
        let uncertainty = scatter / (weights * square).sqrt();
        let is_clear = slope.abs() > 3.0 * uncertainty && slope.abs() > LEAST_DRIFT;
        is_clear.then_some(Measured { value: slope, uncertainty })
    }
}

/// A bounce, and its changes by one standard uncertainty of each input.
struct Spread {
    own: Bounce,
    changed: Vec<Bounce>,
}

impl Spread {
    /// Returns a quantity of the bounce with its standard uncertainty.
    fn of(&self, get: impl Fn(&Bounce) -> f64) -> Measured {
        let value = get(&self.own);
        let squares = self.changed.iter().map(|other| (get(other) - value).powi(2));
        Measured { value, uncertainty: squares.sum::<f64>().sqrt() }
    }
}
