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
//! before and after. In air the departure of each flight from the parabola with its apex, by [`FreeFlight`](super::FreeFlight), is taken from the
//! heights and added to the slopes. The fitted g is free unless it is given: compared with that of the Earth it checks the scale of the picture and
//! the frame rate, which cancel in the restitution if they are constant. If the flights differ in their own g, or the bounces in their
//! levels, by more than the frames scatter, the scale changes in the picture (perspective, a ball that comes nearer) or the camera moves: the
//! uncertainty then has the differences from bounces with a g for each flight and the velocity of the plate between neighbouring bounces, and from
//! those of a picture without the growth of its scale.
//! Other uncertainties come from the scatter of the frames about the parabolas, with the
//! correlation of neighbouring frames (an autoregressive process of first order), and propagate in first order.

mod fit;
mod flights;
mod frames;
mod parabola;

use serde_json::{Value, json};

use crate::table::DataError;
use crate::table::Measured;

use super::free_flight::Departure;
use super::impact::Impact;
use super::rig::Rig;
use fit::Fit;
use flights::{flights, leave_outliers_out, oriented};

pub use frames::Frames;
pub use parabola::TrackFlight;

/// Fewest frames of a flight.
const FEWEST_FRAMES: usize = 5;
/// Length of a pixel from which the search of the scale begins, m.
const FIRST_PIXEL: f64 = 1e-3;
/// Rounds in which the scale settles; in vacuum the first one has it.
const SCALE_ROUNDS: usize = 3;

/// The restitutions of a tracked ball.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The frames with upward heights, less the drift.
    pub frames: Frames,
    /// The flights that are used.
    pub flights: Vec<TrackFlight>,
    /// Length of a pixel, m, if the heights are in pixels.
    pub pixel: Option<Measured>,
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
    air: Option<Departure>,
}

impl Track {
    /// Returns the restitutions of a ball at the bounces of its track.
    ///
    /// # Errors
    /// The track has no bounce with flights on both sides, its scale is not in metres, or a value of the rig is out of range.
    pub fn of(frames: Frames, rig: &Rig) -> Result<Self, DataError> {
        rig.check(&frames.name)?;
        let relative = |it: Measured| it.uncertainty / it.value;
        let of_rate = rig.frame_rate.map_or(0.0, relative);
        if !frames.in_pixels {
            return Self::of_heights(frames, rig, of_rate);
        }
        let pixel = match rig.scale {
            Some(scale) => scale,
            None => by_gravity(&frames, rig)?,
        };
        let spread = of_rate.hypot(relative(pixel));
        let track = Self::of_heights(frames.scaled(pixel.value), rig, spread)?;
        Ok(Self { pixel: Some(pixel), ..track })
    }

    /// Returns the restitutions of a track in metres; `spread` is the relative uncertainty of its scale.
    fn of_heights(frames: Frames, rig: &Rig, spread: f64) -> Result<Self, DataError> {
        let n_all = frames.times.len();
        let (mut frames, minima, rise) = oriented(frames)?;
        let mut warnings = Vec::new();
        let mut flights = flights(&frames, &minima, rise, rig, &mut warnings);
        let n_out = n_all - frames.times.len() + leave_outliers_out(&frames, &mut flights);
        warnings.extend(match n_out {
            0 => None,
            1 => Some("1 frame far off its parabola is left out".to_string()),
            n => Some(format!("{n} frames far off their parabolas are left out")),
        });
        let mut drift = 0.0;
        let mut fit = Fit::of(&frames, &flights, &minima, rig);
        if fit.leave_wrong_sides_out(&frames, &mut flights) {
            fit = Fit::of(&frames, &flights, &minima, rig);
        }
        if let Some(velocity) = fit.drift() {
            drift = velocity.value;
            frames.take_drift_out(drift);
            for flight in flights.iter_mut().flatten() {
                *flight = TrackFlight::of(&frames, std::mem::take(&mut flight.frames));
            }
            fit = Fit::of(&frames, &flights, &minima, rig);
            fit.drift_uncertainty = velocity.uncertainty;
            warnings.push(format!(
                "the plate moves in the picture by {:.2} mm/s: this drift is taken out",
                1e3 * drift
            ));
        }
        fit.find_distortion(&frames, rig, &mut warnings);
        let scale = fit.check_scale(&frames.name, rig, &mut warnings)?.hypot(spread);
        let mut impacts: Vec<Impact> =
            (0..minima.len()).filter_map(|k| fit.impact(k, scale)).collect();
        warnings.extend(impacts.iter().filter_map(Impact::left_out));
        impacts.retain(|impact| impact.impossible().is_none());
        if impacts.is_empty() {
            let message = "no bounce has a flight before and after it that are parabolas";
            let help = match warnings.is_empty() {
                true => format!("a flight needs {FEWEST_FRAMES} frames: take more per second"),
                false => warnings.join("; "),
            };
            return Err(DataError::new(&frames.name, message).with_help(help));
        }
        let Fit { flights, gravity, has_fitted_gravity, noise, correlation, air, .. } = fit;
        let flights = flights.into_iter().flatten().collect();
        Ok(Self {
            frames,
            flights,
            pixel: None,
            gravity,
            has_fitted_gravity,
            noise,
            correlation,
            drift,
            impacts,
            warnings,
            air,
        })
    }

    /// Returns the acceleration of the parabolas, m/s², if it is fitted.
    fn fitted_gravity(frames: Frames, rig: &Rig) -> Option<Measured> {
        let (frames, minima, rise) = oriented(frames).ok()?;
        let mut flights = flights(&frames, &minima, rise, rig, &mut Vec::new());
        leave_outliers_out(&frames, &mut flights);
        let fit = Fit::of(&frames, &flights, &minima, rig);
        fit.has_fitted_gravity.then_some(fit.gravity)
    }

    /// Returns the height of a flight at a time (s), m.
    pub fn height(&self, flight: &TrackFlight, time: f64) -> f64 {
        let parabola = flight.parabola(self.gravity.value);
        let air = self.air.as_ref().map_or(0.0, |air| air.at(time - parabola.apex())[0]);
        parabola.at(time) + air
    }

    /// Returns the numbers of the record for JSON, SI.
    pub(super) fn numbers(&self) -> Value {
        let ends = |flight: &TrackFlight| {
            let time = |k: Option<&usize>| k.map(|k| self.frames.times[*k]);
            json!([time(flight.frames.first()), time(flight.frames.last())])
        };
        json!({
            "frames": self.frames.times.len(),
            "pixel_m": self.pixel.map(|it| it.value),
            "pixel_uncertainty_m": self.pixel.map(|it| it.uncertainty),
            "flights_s": self.flights.iter().map(ends).collect::<Value>(),
            "fitted_gravity_m_s2": self.has_fitted_gravity.then_some(self.gravity.value),
            "fitted_gravity_uncertainty_m_s2": self.has_fitted_gravity.then_some(self.gravity.uncertainty),
            "noise_m": self.noise,
            "correlation": self.correlation,
            "drift_m_s": self.drift,
            "has_air_drag": self.air.is_some(),
        })
    }
}

/// Returns the length of a pixel, m, at which the ball falls with g: the fit in pixels has g in pixels per s².
fn by_gravity(frames: &Frames, rig: &Rig) -> Result<Measured, DataError> {
    let free = Rig { gravity: None, ..*rig };
    let mut pixel = Measured::exact(FIRST_PIXEL);
    // In air the departure from the parabolas depends on the scale.
    for _ in 0..SCALE_ROUNDS {
        let Some(fitted) = Track::fitted_gravity(frames.scaled(pixel.value), &free) else {
            let message = "the heights are in pixels, and the flights do not show their scale";
            let error = DataError::new(&frames.name, message);
            return Err(error.with_help("give the length of a pixel, such as --scale '0.8 mm'"));
        };
        let spread = (fitted.uncertainty / fitted.value)
            .hypot(rig.gravity().uncertainty / rig.gravity().value);
        pixel.value *= rig.flights().gravity() / fitted.value;
        pixel.uncertainty = spread * pixel.value;
    }
    Ok(pixel)
}
