//! The rig of an experiment: what a record does not say by itself.

use fem_material::engineering::number;

use crate::instruments::cradle::{Measured, STANDARD_GRAVITY};
use crate::table::DataError;

use super::free_flight::{AIR, Departure, Flight, FreeFlight};

/// Relative standard uncertainty of the drag coefficient of a smooth sphere at rest in its wake.
const DRAG_UNCERTAINTY: f64 = 0.1;

/// The known values of the rig, each with its standard uncertainty.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rig {
    /// Acceleration of free fall, m/s²; by default the standard one.
    pub gravity: Option<Measured>,
    /// Height from which the ball is dropped, from its lowest point to the plate, m.
    pub drop_height: Option<Measured>,
    /// Diameter of the ball, m. With the density it gives the air drag.
    pub diameter: Option<Measured>,
    /// Density of the ball, kg/m³.
    pub density: Option<Measured>,
    /// Contact time of a bounce, s; by default 0.
    pub contact_time: Option<Measured>,
    /// Standard uncertainty of an instant, s; by default it is estimated from the record.
    pub time_uncertainty: Option<f64>,
    /// Instant at which the ball comes to rest, s.
    pub rest: Option<Measured>,
    /// Mass of the moving body, kg.
    pub mass: Option<Measured>,
    /// Mass between the force sensor and the contact, part of the moving body that carries the sensor, kg.
    pub sensor_mass: Option<Measured>,
    /// Approach speed of the first impact, m/s.
    pub speed: Option<Measured>,
    /// Frames per second of a track whose frames are numbered.
    pub frame_rate: Option<Measured>,
    /// Length of a pixel of a track, m; by default gravity gives it.
    pub scale: Option<Measured>,
    /// Relative standard uncertainty of the calibration of a force.
    pub force_uncertainty: Option<f64>,
}

/// Flights of the ball, with drag and with more drag, whose difference is the uncertainty of drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flights {
    flight: FreeFlight,
    more_drag: Option<FreeFlight>,
}

impl Rig {
    /// Checks that all values are in their range; messages name the record `name`.
    ///
    /// # Errors
    /// A value is not positive, the air drag lacks the diameter or the density, or the ball is not heavier than air.
    pub fn check(&self, name: &str) -> Result<(), DataError> {
        let positive = [
            ("gravity", self.gravity),
            ("height", self.drop_height),
            ("diameter", self.diameter),
            ("density", self.density),
            ("mass", self.mass),
            ("sensor-mass", self.sensor_mass),
            ("speed", self.speed),
            ("frame-rate", self.frame_rate),
            ("scale", self.scale),
        ];
        let exact = |value: f64| Measured::exact(value);
        let at_least_0 = [("contact-time", self.contact_time), ("rest", self.rest)]
            .into_iter()
            .chain([("time-uncertainty", self.time_uncertainty.map(exact))]);
        let is_bad = |value: f64, from_0: bool| !(value > 0.0 || from_0 && value == 0.0);
        let given = positive.map(|it| (it, false)).into_iter();
        for ((option, value), from_0) in given.chain(at_least_0.map(|it| (it, true))) {
            if let Some(Measured { value, uncertainty }) = value
                && (is_bad(value, from_0) || !value.is_finite() || uncertainty.is_nan())
            {
                let allowed = if from_0 { "at least 0" } else { "greater than 0" };
                let message = format!("--{option} is {}", number(value, 5));
                return Err(
                    DataError::new(name, message).with_help(format!("it must be {allowed}"))
                );
            }
        }
        if let (Some(sensor), Some(mass)) = (self.sensor_mass, self.mass)
            && sensor.value >= mass.value
        {
            let message =
                "the mass in front of the sensor is part of the mass of the body, and not less";
            let help = "--mass is that of the whole moving body, --sensor-mass that of its front";
            return Err(DataError::new(name, message).with_help(help));
        }
        if self.diameter.is_some() != self.density.is_some() {
            let message = "air drag needs the diameter and the density of the ball";
            let help = "give both, such as --diameter '10 mm' --density '7800 kg/m^3', or neither";
            return Err(DataError::new(name, message).with_help(help));
        }
        if let Some(density) = self.density.map(|it| it.value).filter(|it| *it <= AIR.density) {
            let message = format!(
                "a ball of {} kg/m³ does not fall in air, which has {} kg/m³",
                number(density, 5),
                AIR.density
            );
            let help = "--density is that of the ball, such as '7800 kg/m^3'";
            return Err(DataError::new(name, message).with_help(help));
        }
        Ok(())
    }

    /// Returns the acceleration of free fall, m/s².
    pub fn gravity(&self) -> Measured {
        self.gravity.unwrap_or(Measured::exact(STANDARD_GRAVITY))
    }

    /// Returns the contact time, s.
    pub(super) fn contact_time(&self) -> Measured {
        self.contact_time.unwrap_or(Measured::exact(0.0))
    }

    /// Returns the flights of the ball.
    pub(super) fn flights(&self) -> Flights {
        let gravity = self.gravity().value;
        match (self.diameter, self.density) {
            (Some(diameter), Some(density)) => {
                let relative = |it: Measured| it.uncertainty / it.value;
                let spread = relative(diameter).hypot(relative(density)).hypot(DRAG_UNCERTAINTY);
                let with = |factor: f64| {
                    FreeFlight::in_air(gravity, diameter.value, density.value, factor)
                };
                Flights { flight: with(1.0), more_drag: Some(with(1.0 + spread)) }
            }
            _ => Flights { flight: FreeFlight::in_vacuum(gravity), more_drag: None },
        }
    }
}

impl Flights {
    /// Returns the acceleration of free fall with buoyancy and added mass, m/s².
    pub fn gravity(&self) -> f64 {
        self.flight.gravity()
    }

    /// Returns the departures from parabolas up to a time from the apex (s) and those with more drag; `None` in vacuum.
    pub fn departures(&self, longest: f64) -> Option<[Departure; 2]> {
        Some([self.flight.departure(longest)?, self.more_drag?.departure(longest)?])
    }

    /// Returns the flight of a time (s), and that with more drag; `None` if the ball lands at nearly its terminal speed.
    pub fn lasting(&self, time: f64) -> Option<[Flight; 2]> {
        let own = self.flight.lasting(time)?;
        let other = match self.more_drag {
            Some(more) => more.lasting(time)?,
            None => own,
        };
        Some([own, other])
    }

    /// Returns the landing speed of a fall from a height (m) and that with more drag; `None` near the terminal speed.
    pub fn landing_after(&self, height: f64) -> Option<[f64; 2]> {
        let own = self.flight.landing_after(height)?;
        let other = match self.more_drag {
            Some(more) => more.landing_after(height)?,
            None => own,
        };
        Some([own, other])
    }
}
