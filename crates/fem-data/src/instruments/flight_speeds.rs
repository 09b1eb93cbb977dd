//! Speeds of the flights between instants, and the impacts between them, with the changes of each by its causes.
//!
//! Durations are less the contact time, and speeds those of [`FreeFlight`](super::FreeFlight). Errors propagate in first order and are kept by
//! cause, since neighbouring restitutions share instants, and all share contact time and drag.

use crate::table::Measured;

use super::bounce_times::Instants;
use super::impact::Impact;
use super::rig::{Flights, Rig};
use super::series::FlightSpan;

/// Relative difference of the first flights of two drops from the same height.
const SAME_HEIGHT: f64 = 0.1;

/// The speeds of a flight with their uncertainties.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlightSpeeds {
    /// Launch and landing speed, m/s.
    speeds: [f64; 2],
    /// Their derivatives by the duration, m/s².
    slopes: [f64; 2],
    /// Their changes with the uncertainty of drag, m/s.
    drag: [f64; 2],
    /// Indices of the instants at the beginning and the end.
    instants: [usize; 2],
    /// Their uncertainties, s.
    ends: [f64; 2],
    /// Uncertainty of the contact time, s.
    contact: f64,
    /// Relative uncertainty of gravity.
    gravity: f64,
    /// The instant at the end, s.
    pub time: f64,
}

impl FlightSpeeds {
    pub fn landing_speed(&self) -> Measured {
        let of_time = self.ends[0].hypot(self.ends[1]).hypot(self.contact);
        let uncertainty =
            (self.slopes[1] * of_time).hypot(self.drag[1]).hypot(self.gravity * self.speeds[1]);
        Measured { value: self.speeds[1], uncertainty }
    }

    /// Returns the restitution of the bounce between this flight and the next one, with its errors.
    fn restitution(&self, next: &Self) -> (f64, Errors) {
        let (landing, launch) = (self.speeds[1], next.speeds[0]);
        let e = launch / landing;
        // Slopes of e by the durations of the next flight and of this one.
        let [later, earlier] = [next.slopes[0] / landing, e * self.slopes[1] / landing];
        let by_drag = (launch + next.drag[0]) / (landing + self.drag[1]) - e;
        let errors = Errors {
            instants: vec![
                (next.instants[1], later * next.ends[1]),
                (self.instants[1], -(later + earlier) * self.ends[1]),
                (self.instants[0], earlier * self.ends[0]),
            ],
            contact: (earlier - later) * self.contact,
            drag: by_drag,
            drop: 0.0,
        };
        (e, errors)
    }
}

/// Changes of a restitution by the standard uncertainty of each cause.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Errors {
    /// Those by instants, with their indices.
    instants: Vec<(usize, f64)>,
    /// That by the contact time.
    contact: f64,
    /// That by air drag.
    drag: f64,
    /// That by height and gravity of the drop.
    drop: f64,
}

impl Errors {
    /// Returns the instants on which the restitution depends, s.
    pub fn times<'a>(&'a self, instants: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.instants.iter().map(|(k, _)| instants[*k])
    }

    /// Returns the covariance with another restitution of the same record.
    pub fn covariance(&self, other: &Self) -> f64 {
        let shared = self.instants.iter().flat_map(|(k, own)| {
            let same = other.instants.iter().filter(move |(other, _)| other == k);
            same.map(move |(_, its)| own * its)
        });
        shared.sum::<f64>()
            + self.contact * other.contact
            + self.drag * other.drag
            + self.drop * other.drop
    }

    /// Returns a restitution with its standard uncertainty.
    pub fn of(&self, restitution: f64) -> Measured {
        Measured { value: restitution, uncertainty: self.covariance(self).sqrt() }
    }
}

/// The speeds of all flights.
pub(super) struct Speeds {
    /// Those of each single flight.
    pub by_span: Vec<Option<FlightSpeeds>>,
    /// The first flights of drops from the height of the rig, as indices.
    first: Vec<usize>,
    flights: Flights,
}

impl Speeds {
    pub fn of(
        instants: &Instants,
        spans: &[FlightSpan],
        uncertainties: &[f64],
        rig: &Rig,
        warnings: &mut Vec<String>,
    ) -> Self {
        let (flights, contact) = (rig.flights(), rig.contact_time());
        let gravity = rig.gravity();
        let mut of_span = |span: &FlightSpan| {
            let FlightSpan { from, to, n_flights: 1 } = *span else { return None };
            let [start, end] = [from, to].map(|k| instants.values[k]);
            let duration = end - start - contact.value;
            if duration <= 0.0 {
                warnings
                    .push(format!("the flight from {start:.4} s is shorter than the contact time"));
                return None;
            }
            let Some([own, more]) = flights.lasting(duration) else {
                warnings.push(format!(
                    "the flight from {start:.4} s is left out: the ball lands at its terminal speed"
                ));
                return None;
            };
            Some(FlightSpeeds {
                speeds: [own.launch, own.landing],
                slopes: [own.launch_slope, own.landing_slope],
                drag: [more.launch - own.launch, more.landing - own.landing],
                instants: [from, to],
                ends: [from, to].map(|k| uncertainties[k]),
                contact: contact.uncertainty,
                gravity: gravity.uncertainty / gravity.value,
                time: end,
            })
        };
        let by_span: Vec<Option<FlightSpeeds>> = spans.iter().map(&mut of_span).collect();
        let begins = |k: &usize| by_span[*k].is_some() && (*k == 0 || spans[*k - 1].n_flights == 0);
        let launch = |k: usize| by_span[k].map_or(0.0, |flight| flight.speeds[0]);
        let mut first: Vec<usize> = (0..spans.len()).filter(begins).collect();
        // Other drops are from the same height if their first flight is the same.
        let height = first.first().map_or(0.0, |k| launch(*k));
        first.retain(|k| (launch(*k) / height - 1.0).abs() < SAME_HEIGHT);
        Self { by_span, first, flights }
    }

    /// Returns the impacts after drops from the height of the rig.
    pub fn first(&self, instants: &Instants, rig: &Rig) -> impl Iterator<Item = (Impact, Errors)> {
        self.first.iter().filter_map(move |k| self.first_of(self.by_span[*k]?, instants, rig))
    }

    /// Returns the landing speed (m/s) of a drop from the height of the rig, and that with more drag.
    fn fall(&self, rig: &Rig) -> Option<(Measured, f64)> {
        let (height, gravity) = (rig.drop_height?, rig.gravity());
        let [landing, more] = self.flights.landing_after(height.value)?;
        let [of_height, of_gravity] = [height, gravity].map(|it| 0.5 * it.uncertainty / it.value);
        let uncertainty = (landing * of_height.hypot(of_gravity)).hypot(more - landing);
        Some((Measured { value: landing, uncertainty }, more))
    }

    /// Returns the landing speed (m/s) of a drop from the height of the rig, and twice the time (s) in which gravity gives it.
    pub fn drop(&self, rig: &Rig) -> Option<(Measured, Measured)> {
        let (speed, _) = self.fall(rig)?;
        let twice = 2.0 / self.flights.gravity();
        let time = Measured { value: twice * speed.value, uncertainty: twice * speed.uncertainty };
        Some((speed, time))
    }

    /// Returns the impact between a drop from the height of the rig and a flight.
    fn first_of(
        &self,
        flight: FlightSpeeds,
        instants: &Instants,
        rig: &Rig,
    ) -> Option<(Impact, Errors)> {
        let (speed, more) = self.fall(rig)?;
        let height = rig.drop_height?;
        let landing = speed.value;
        let e = flight.speeds[0] / landing;
        let slope = flight.slopes[0] / landing;
        let [of_height, of_gravity] =
            [height.uncertainty / height.value, flight.gravity].map(|relative| 0.5 * relative);
        let errors = Errors {
            instants: vec![
                (flight.instants[0], -slope * flight.ends[0]),
                (flight.instants[1], slope * flight.ends[1]),
            ],
            contact: -slope * flight.contact,
            drag: (flight.speeds[0] + flight.drag[0]) / more - e,
            drop: e * of_height.hypot(of_gravity),
        };
        let time = instants.values[flight.instants[0]];
        let restitution = errors.of(e);
        Some((Impact { time, speed, restitution, contact_time: None }, errors))
    }

    /// Returns the impacts between two single flights.
    pub fn others(&self) -> impl Iterator<Item = (Impact, Errors)> {
        self.pairs().map(|(before, after)| {
            let (e, errors) = before.restitution(after);
            let (time, speed) = (before.time, before.landing_speed());
            (Impact { time, speed, restitution: errors.of(e), contact_time: None }, errors)
        })
    }

    fn pairs(&self) -> impl DoubleEndedIterator<Item = (&FlightSpeeds, &FlightSpeeds)> {
        self.by_span.windows(2).filter_map(|pair| Some((pair[0].as_ref()?, pair[1].as_ref()?)))
    }

    /// Returns the change of the last restitution per second of contact time, 1/s.
    pub fn contact_time_slope(&self) -> f64 {
        let slope = |(before, after): (&FlightSpeeds, &FlightSpeeds)| {
            let (landing, launch) = (before.speeds[1], after.speeds[0]);
            (launch / landing * before.slopes[1] - after.slopes[0]) / landing
        };
        self.pairs().next_back().map_or(0.0, slope)
    }
}
