//! The parabolas of all flights with one acceleration, and the bounces where they meet.

use crate::instruments::bounce_times::LONGEST_FLIGHT;
use crate::instruments::free_flight::Departure;
use crate::instruments::impact::Impact;
use crate::instruments::rig::Rig;
use crate::instruments::series::widened;
use crate::table::DataError;
use crate::table::Measured;

use super::FEWEST_FRAMES;
use super::frames::Frames;
use super::parabola::{Moments, Parabola, TrackFlight};

/// Largest relative difference of the fitted g from that of the rig; a larger one is another unit.
const WRONG_SCALE: f64 = 0.25;
/// Largest relative uncertainty at which g is fitted.
const VAGUE_GRAVITY: f64 = 0.1;
/// Largest correlation of neighbouring frames that is taken for one.
const MOST_CORRELATION: f64 = 0.9;
/// Smallest drift that is taken out, m/s: a tenth of a millimetre per second changes no restitution.
const LEAST_DRIFT: f64 = 1e-4;

/// Rounds in which apexes and bounces in air settle: each is by the share of drag nearer.
const AIR_ROUNDS: usize = 4;
/// The parabolas of all flights.
pub(super) struct Fit<'a> {
    pub flights: Vec<Option<TrackFlight>>,
    minima: &'a [usize],
    times: Vec<f64>,
    pub gravity: Measured,
    pub has_fitted_gravity: bool,
    /// Contact time, s.
    contact: Measured,
    /// Accelerations of the flights, each by its own curvature, m/s².
    own_gravity: Vec<Option<f64>>,
    /// These over time.
    accelerations: Trend,
    /// Whether the flights or the levels of the bounces show that the scale changes in the picture or that the camera accelerates.
    pub is_distorted: bool,
    /// Uncertainty of the drift that is taken out, m/s.
    pub drift_uncertainty: f64,
    pub noise: f64,
    pub correlation: f64,
    /// Factor from the noise of independent frames to standard uncertainties.
    widening: f64,
    /// Departure of the flights from their parabolas in air.
    pub air: Option<Departure>,
    /// The fit with more drag.
    more: Option<Box<Self>>,
    /// The fit of a distorted picture without the growth of its scale.
    rescaled: Option<Box<Self>>,
}

/// The residuals of parabolas.
struct Residuals {
    /// Their root mean square per degree of freedom, m.
    noise: f64,
    freedom: f64,
    /// Correlation of neighbouring frames, 0 if it is none.
    correlation: f64,
}

impl Residuals {
    /// Returns the residuals of flights with these accelerations, of which `n_free` are fitted.
    fn of(
        frames: &Frames,
        flights: &[&TrackFlight],
        gravity: &dyn Fn(&TrackFlight) -> f64,
        n_free: usize,
    ) -> Self {
        let of_flight = |flight: &&TrackFlight| -> Vec<f64> {
            let parabola = flight.parabola(gravity(flight));
            let off = |k: &usize| {
                (frames.heights[*k] - parabola.at(frames.times[*k])) * frames.weights[*k].sqrt()
            };
            flight.frames.iter().map(off).collect()
        };
        let residuals: Vec<Vec<f64>> = flights.iter().map(of_flight).collect();
        let n_frames: usize = residuals.iter().map(Vec::len).sum();
        let squares: f64 = residuals.iter().flatten().map(|r| r * r).sum();
        let products: f64 =
            residuals.iter().flat_map(|r| r.windows(2).map(|pair| pair[0] * pair[1])).sum();
        let freedom = n_frames as f64 - 2.0 * flights.len() as f64 - n_free as f64;
        let n_pairs: usize = residuals.iter().map(|r| r.len().saturating_sub(1)).sum();
        // Each flight's fit of two or three parameters makes the residuals anticorrelated, by these over the frames.
        let bias = (2.0 * flights.len() as f64 + n_free as f64) / n_frames.max(1) as f64;
        let mean = squares / n_frames.max(1) as f64;
        let rough = if mean > 0.0 { products / n_pairs.max(1) as f64 / mean } else { 0.0 };
        let found = rough + bias;
        let is_clear = found > 2.0 / (n_frames.max(1) as f64).sqrt();
        Self {
            noise: (squares / freedom.max(1.0)).sqrt(),
            freedom,
            correlation: if is_clear { found.min(MOST_CORRELATION) } else { 0.0 },
        }
    }

    /// Returns the factor from the noise of independent frames to standard uncertainties.
    fn widening(&self) -> f64 {
        let Self { freedom, correlation, .. } = *self;
        let effective = freedom * (1.0 - correlation) / (1.0 + correlation);
        ((1.0 + correlation) / (1.0 - correlation)).sqrt() * widened(effective.max(1.0))
    }
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
    /// Fits the flights, in air if the rig has the size and the density of the ball.
    pub fn of(
        frames: &Frames,
        flights: &[Option<TrackFlight>],
        minima: &'a [usize],
        rig: &Rig,
    ) -> Self {
        let fit = Self::of_parabolas(frames, flights, minima, rig);
        let times = |flight: &TrackFlight| {
            let apex = flight.parabola(fit.gravity.value).apex();
            let time = |k: Option<&usize>| k.map_or(0.0, |k| (frames.times[*k] - apex).abs());
            time(flight.frames.first()).max(time(flight.frames.last()))
        };
        let longest = flights.iter().flatten().map(times).fold(0.0, f64::max);
        match rig.flights().departures(longest.min(LONGEST_FLIGHT)) {
            Some([air, more]) => {
                let more = fit.in_air(frames, rig, more);
                Self { more: Some(Box::new(more)), ..fit.in_air(frames, rig, air) }
            }
            None => fit,
        }
    }

    /// Returns the fit of the heights less the departure from the parabolas, which depends on their apexes.
    fn in_air(&self, frames: &Frames, rig: &Rig, air: Departure) -> Self {
        let mut flights = self.flights.clone();
        let mut fit = Self::of_parabolas(frames, &flights, self.minima, rig);
        for _ in 0..AIR_ROUNDS {
            let mut level = frames.clone();
            for flight in flights.iter().flatten() {
                let apex = flight.parabola(fit.gravity.value).apex();
                for k in &flight.frames {
                    level.heights[*k] -= air.at(frames.times[*k] - apex)[0];
                }
            }
            for flight in flights.iter_mut().flatten() {
                *flight = TrackFlight::of(&level, std::mem::take(&mut flight.frames));
            }
            fit = Self::of_parabolas(&level, &flights, self.minima, rig);
        }
        Self { air: Some(air), ..fit }
    }

    fn of_parabolas(
        frames: &Frames,
        flights: &[Option<TrackFlight>],
        minima: &'a [usize],
        rig: &Rig,
    ) -> Self {
        let used: Vec<&TrackFlight> = flights.iter().flatten().collect();
        let (along, across) = used.iter().fold((0.0, 0.0), |sum, flight| {
            let (along, across) = flight.curvature(frames);
            (sum.0 + along, sum.1 + across)
        });
        let mut gravity = Measured { value: rig.flights().gravity(), ..rig.gravity() };
        let common = if across > 0.0 { along / across } else { 0.0 };
        let mut scatter = Residuals::of(frames, &used, &|_| common, 1);
        let fitted = Measured {
            value: along / across,
            uncertainty: scatter.noise * scatter.widening() / across.sqrt(),
        };
        let is_clear = fitted.uncertainty <= VAGUE_GRAVITY * fitted.value.abs();
        let is_free = rig.gravity.is_none() && across > 0.0 && scatter.freedom >= 1.0;
        let has_fitted_gravity = is_free && is_clear;
        if has_fitted_gravity {
            gravity = fitted;
        } else {
            scatter = Residuals::of(frames, &used, &|_| gravity.value, 0);
        }
        let own = |flight: &TrackFlight| {
            let (along, across) = flight.curvature(frames);
            if across > 0.0 { along / across } else { gravity.value }
        };
        let of_own = Residuals::of(frames, &used, &own, used.len());
        let own_noise = of_own.noise * of_own.widening();
        let accelerations: Vec<(f64, Measured)> = used
            .iter()
            .map(|flight| {
                let uncertainty = own_noise / flight.curvature(frames).1.sqrt();
                (flight.centre, Measured { value: own(flight), uncertainty })
            })
            .collect();
        let accelerations = Trend::of(&accelerations);
        Self {
            flights: flights.to_vec(),
            minima,
            times: frames.times.clone(),
            gravity,
            has_fitted_gravity,
            contact: rig.contact_time(),
            own_gravity: flights.iter().map(|flight| flight.as_ref().map(own)).collect(),
            accelerations,
            is_distorted: false,
            drift_uncertainty: 0.0,
            noise: scatter.noise,
            correlation: scatter.correlation,
            widening: scatter.widening(),
            air: None,
            more: None,
            rescaled: None,
        }
    }

    /// Returns the relative uncertainty of the scale of the heights, and warns if the fitted g shows an error of it.
    pub fn check_scale(
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
        let ratio = value / rig.flights().gravity();
        if (ratio - 1.0).abs() > WRONG_SCALE + 3.0 * uncertainty / value.abs() {
            let message = format!("the parabolas fall with {value:.3} m/s², not with 9.81 m/s²");
            let help = "name the columns with their units, such as y_cm and t_ms, calibrate the scale and the \
                        frame rate, or give --gravity";
            return Err(DataError::new(name, message).with_help(help));
        }
        if (ratio - 1.0).abs() > 0.005_f64.max(3.0 * uncertainty / value) {
            let restitutions =
                if self.is_distorted { "" } else { " and cancels in the restitutions" };
            warnings.push(format!(
                "the parabolas fall with {value:.3} ± {uncertainty:.3} m/s²: the scale of the heights is off by {:.1} %, \
                 the frame rate by half of that, or the air drags; it is in the uncertainty of the speeds{restitutions}",
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
        let at = |parabola: &Parabola, time: f64| {
            let air = self.air.as_ref().map(|air| air.at(time - parabola.apex()));
            let [height, velocity] = air.unwrap_or([0.0, 0.0]);
            [parabola.at(time) + height, parabola.velocity_at(time) + velocity]
        };
        let mut time = near;
        // With one g the parabolas differ by a line; in air, and with accelerations of their own, the difference is nearly one.
        let is_line = self.air.is_none() && before.gravity == after.gravity;
        for _ in 0..if is_line { 1 } else { AIR_ROUNDS } {
            let [falling, rising] = [at(&before, time), at(&after, time)];
            time += (falling[0] - rising[0]) / (rising[1] - falling[1]);
        }
        let change = 0.5 * before.gravity * contact;
        let [level, falling] = at(&before, time);
        let [_, rising] = at(&after, time);
        Bounce { time, level, before: -falling - change, after: rising + change }
    }

    /// Removes frames that are on the other side of a bounce than their flight, and returns whether there are any: noise makes the
    /// lowest frame one that is not next to the bounce.
    pub fn leave_wrong_sides_out(
        &self,
        frames: &Frames,
        flights: &mut [Option<TrackFlight>],
    ) -> bool {
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
        if self.is_distorted {
            changed.extend(self.undistorted(k));
        }
        (own.before > 0.0).then_some(Spread { own, changed })
    }

    /// Returns the impact of a bounce; `scale` is the relative uncertainty of speeds.
    pub fn impact(&self, k: usize, scale: f64) -> Option<Impact> {
        let mut spread = self.spread(k)?;
        for other in [&self.more, &self.rescaled].into_iter().flatten() {
            spread.changed.push(other.spread(k)?.own);
        }
        let speed = spread.of(|bounce| bounce.before);
        Some(Impact {
            time: spread.own.time,
            speed: Measured { uncertainty: speed.uncertainty.hypot(scale * speed.value), ..speed },
            restitution: spread.of(|bounce| bounce.after / bounce.before),
            contact_time: None,
        })
    }

    /// Returns a bounce by parabolas with accelerations of their own.
    fn of_own_gravity(&self, k: usize) -> Option<Bounce> {
        let [before, after] = self.sides(k)?;
        let parabolas =
            [before.parabola(self.own_gravity[k]?), after.parabola(self.own_gravity[k + 1]?)];
        Some(self.bounce(parabolas, self.times[self.minima[k]], self.contact.value))
    }

    /// Returns a bounce with its speeds relative to the plate in a picture whose scale changes or that accelerates, for two estimates of
    /// the velocity of the plate: that from the bounce before, and that to the next one. Each flight has its own acceleration.
    fn undistorted(&self, k: usize) -> Vec<Bounce> {
        let Some(own) = self.of_own_gravity(k) else { return Vec::new() };
        let velocity_to = |other: Option<usize>| {
            let other = self.of_own_gravity(other.filter(|other| *other < self.minima.len())?)?;
            Some((other.level - own.level) / (other.time - own.time))
        };
        let [before, after] = [k.checked_sub(1), Some(k + 1)].map(velocity_to);
        let velocities = [before.or(after), after.or(before)].map(Option::unwrap_or_default);
        let bounce = |velocity: f64| Bounce {
            before: own.before + velocity,
            after: own.after - velocity,
            ..own
        };
        velocities.map(bounce).to_vec()
    }

    /// Returns the fit of a picture without the growth of its scale about a level (m): that by which the accelerations change.
    fn rescaled(&self, frames: &Frames, rig: &Rig, level: f64) -> Option<Self> {
        let Trend { time, mean, slope, .. } = self.accelerations;
        let mut still = frames.clone();
        for (y, t) in still.heights.iter_mut().zip(&frames.times) {
            let scale = 1.0 + slope / mean * (t - time);
            if scale.is_nan() || scale <= 0.5 {
                return None;
            }
            *y = level + (*y - level) / scale;
        }
        let again = |flight: &TrackFlight| TrackFlight::of(&still, flight.frames.clone());
        let flights: Vec<_> = self.flights.iter().map(|it| it.as_ref().map(again)).collect();
        Some(Self::of(&still, &flights, self.minima, rig))
    }

    /// Finds whether the picture is distorted, after the drift of the plate is taken out.
    pub fn find_distortion(&mut self, frames: &Frames, rig: &Rig, warnings: &mut Vec<String>) {
        let spreads = (0..self.minima.len()).filter_map(|k| self.spread(k));
        let levels: Vec<(f64, Measured)> =
            spreads.map(|it| (it.own.time, it.of(|bounce| bounce.level))).collect();
        let levels = Trend::of(&levels);
        self.is_distorted = self.accelerations.differ || levels.differ;
        if self.is_distorted {
            self.rescaled = self.rescaled(frames, rig, levels.mean).map(Box::new);
        }
        if self.is_distorted {
            warnings.push(
                "the flights fall with different accelerations, or the plate is at different heights: the scale changes in the \
                 picture or the camera moves, which is in the uncertainty of the restitutions"
                    .to_string(),
            );
        }
    }

    /// Returns the velocity of the plate in the picture, m/s, if the levels of the bounces show one.
    pub fn drift(&self) -> Option<Measured> {
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

/// The straight line through values over time.
#[derive(Clone, Copy, Debug)]
struct Trend {
    time: f64,
    mean: f64,
    slope: f64,
    /// Whether the values differ by more than their uncertainties: by four standard deviations of the sum of squares about their mean, or
    /// by three of their slope.
    differ: bool,
}

impl Trend {
    fn of(values: &[(f64, Measured)]) -> Self {
        let weight = |it: &(f64, Measured)| it.1.uncertainty.max(f64::MIN_POSITIVE).powi(-2);
        let sum = |of: &dyn Fn(&(f64, Measured)) -> f64| {
            values.iter().map(|it| weight(it) * of(it)).sum::<f64>()
        };
        let weights = sum(&|_| 1.0);
        let (time, mean) = (sum(&|it| it.0) / weights, sum(&|it| it.1.value) / weights);
        let freedom = values.len() as f64 - 1.0;
        let squares = sum(&|it| (it.1.value - mean).powi(2));
        let slope = sum(&|it| (it.0 - time) * (it.1.value - mean));
        let of_time = sum(&|it| (it.0 - time).powi(2));
        let is_off = squares > freedom + 4.0 * (2.0 * freedom).sqrt();
        let differ = freedom > 0.0 && (is_off || slope * slope > 9.0 * of_time);
        Self { time, mean, slope: slope / of_time, differ }
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
