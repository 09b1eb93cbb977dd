//! The state of a collision at any time, from the instants that a model has kept.
//!
//! Between two instants the approach is the polynomial of degree 5 with their δ, δ̇ and δ̈ = −F/m*; the
//! rate is its derivative. Work and energies are cubic with their known rates Fδ̇; a law's force and strain
//! energy follow from the motion. For Hertz and Ting, force, a² and p₀² are known at the instants only;
//! they are cubic, with the slopes of parabolas through three instants; so are those of laws on a plate. After the last instant the bodies fly freely.
//! Gravity adds its acceleration to δ̈.

use crate::impact::{Impact, ImpactInstant};
use crate::laws::ContactLaw;
use crate::pair::Pair;

/// A collision between its instants.
#[derive(Debug, Clone, Copy)]
pub struct ImpactPath<'a> {
    history: &'a [ImpactInstant],
    effective_mass: f64,
    effective_radius: f64,
    law: Option<&'a ContactLaw>,
    gravity: f64,
}

impl<'a> ImpactPath<'a> {
    /// Creates the path of a collision of a pair; `law` is given if the collision followed a contact law.
    pub fn new(impact: &'a Impact, pair: &Pair, law: Option<&'a ContactLaw>) -> Self {
        let has_plate = impact.history.first().is_some_and(|instant| instant.plate.is_some());
        Self {
            history: &impact.history,
            effective_mass: pair.effective_mass(),
            effective_radius: pair.effective_radius(),
            law: law.filter(|law| law.elastic_plastic().is_none() && !has_plate),
            gravity: 0.0,
        }
    }

    /// Adds gravity along the approach, m/s².
    pub fn with_gravity(self, acceleration: f64) -> Self {
        Self { gravity: acceleration, ..self }
    }

    /// Returns the state at a time after first touch, s; first touch itself before it. `None` of a
    /// collision without instants.
    pub fn at(&self, time: f64) -> Option<ImpactInstant> {
        let after = self.history.partition_point(|instant| instant.time <= time);
        let last = self.history.last()?;
        match (after, self.history.get(after)) {
            (0, _) => self.history.first().copied(),
            (_, None) if time > last.time => Some(ImpactInstant {
                time,
                approach: last.approach
                    + (last.approach_rate + 0.5 * self.gravity * (time - last.time))
                        * (time - last.time),
                approach_rate: last.approach_rate + self.gravity * (time - last.time),
                force: 0.0,
                contact_radius: 0.0,
                centre_pressure: last.centre_pressure.map(|_| 0.0),
                ..*last
            }),
            (_, None) => Some(*last),
            (_, Some(_)) => Some(self.between(after - 1, time)),
        }
    }

    /// Interpolates between instant `k` and the next.
    fn between(&self, k: usize, time: f64) -> ImpactInstant {
        let (a, b) = (&self.history[k], &self.history[k + 1]);
        let length = b.time - a.time;
        let s = (time - a.time) / length;
        let acceleration = [a, b].map(|instant| self.gravity - instant.force / self.effective_mass);
        let (approach, approach_rate) = quintic(
            s,
            length,
            [a.approach, b.approach],
            [a.approach_rate, b.approach_rate],
            acceleration,
        );
        let from_instants = |value: fn(&ImpactInstant) -> f64| {
            let slopes = [self.slope(k, value), self.slope(k + 1, value)];
            cubic(s, length, [value(a), value(b)], slopes)
        };
        let power = [a, b].map(|instant| instant.force * instant.approach_rate);
        let slopes = |value: fn(&ImpactInstant) -> f64| [k, k + 1].map(|at| self.slope(at, value));
        let leaving = slopes(|instant| instant.radiated.unwrap_or_default());
        let bending = slopes(|instant| instant.plate.unwrap_or_default());
        let lossy = match a.plate {
            Some(_) => slopes(|instant| instant.dissipated.unwrap_or_default()),
            None => [0.0; 2],
        };
        let kept = [0, 1].map(|end| power[end] - leaving[end] - bending[end] - lossy[end]);
        let of_law = self.law.map(|law| {
            let lost = [a, b].map(|instant| {
                let spring = law.force(instant.approach, 0.0);
                (instant.force - spring) * instant.approach_rate
            });
            let dissipated = [a, b].map(|instant| instant.dissipated.unwrap_or_default());
            (
                law.force(approach, approach_rate),
                law.strain_energy(approach),
                cubic(s, length, dissipated, lost),
            )
        });
        let both = |value: fn(&ImpactInstant) -> Option<f64>, slopes: [f64; 2]| {
            Some(cubic(s, length, [value(a)?, value(b)?], slopes))
        };
        let (force, strain_energy, dissipated, work) = match of_law {
            Some((force, strain, lost)) => (force, Some(strain), Some(lost), strain + lost),
            None => (
                from_instants(|instant| instant.force),
                both(|instant| instant.strain_energy, kept),
                both(|instant| instant.dissipated, lossy),
                cubic(s, length, [a.work, b.work], power),
            ),
        };
        let contact_radius = match self.law {
            Some(_) => (self.effective_radius * approach.max(0.0)).sqrt(),
            None => root(from_instants(|instant| instant.contact_radius.powi(2))),
        };
        let has_pressure = a.centre_pressure.is_some();
        let square = |instant: &ImpactInstant| instant.centre_pressure.unwrap_or_default().powi(2);
        ImpactInstant {
            time,
            approach,
            approach_rate,
            force,
            contact_radius,
            centre_pressure: has_pressure.then(|| root(from_instants(square))),
            work,
            strain_energy,
            dissipated,
            radiated: both(|instant| instant.radiated, leaving),
            plate: both(|instant| instant.plate, bending),
        }
    }

    /// Returns the slope at instant `k` of the parabola through it and its neighbours.
    fn slope(&self, k: usize, value: fn(&ImpactInstant) -> f64) -> f64 {
        let last = self.history.len() - 1;
        let middle = k.clamp(1, last.max(2) - 1).min(last);
        let [a, b, c] = [middle.saturating_sub(1), middle, (middle + 1).min(last)];
        let chord = |i: usize, j: usize| {
            let (i, j) = (&self.history[i], &self.history[j]);
            if j.time > i.time { (value(j) - value(i)) / (j.time - i.time) } else { 0.0 }
        };
        let time = |i: usize| self.history[i].time;
        let (left, right) = (chord(a, b), chord(b, c));
        let span = time(c) - time(a);
        if span <= 0.0 || c == b {
            return left;
        }
        // Newton's form: left + (right − left)/span · ((t − t_a) + (t − t_b)).
        left + (right - left) / span * ((time(k) - time(a)) + (time(k) - time(b)))
    }
}

fn root(square: f64) -> f64 {
    square.max(0.0).sqrt()
}

/// Returns the polynomial with these ends and slopes, at s in 0 ..= 1 of a length.
fn cubic(s: f64, length: f64, ends: [f64; 2], slopes: [f64; 2]) -> f64 {
    let t = 1.0 - s;
    // (1 + 2s)t² + (3 − 2s)s² = 1.
    let bump = s * t * length * (t * slopes[0] - s * slopes[1]);
    ends[0] + (ends[1] - ends[0]) * (3.0 - 2.0 * s) * s * s + bump
}

/// Returns the value and derivative of the polynomial with these ends, slopes and curvatures.
fn quintic(s: f64, h: f64, ends: [f64; 2], slopes: [f64; 2], curvatures: [f64; 2]) -> (f64, f64) {
    let rise = ends[1] - ends[0];
    let [v0, v1] = slopes.map(|slope| h * slope);
    let [a0, a1] = curvatures.map(|curvature| 0.5 * h * h * curvature);
    // Coefficients of s³, s⁴, s⁵.
    let c3 = 10.0 * rise - 6.0 * v0 - 4.0 * v1 - 3.0 * a0 + a1;
    let c4 = -15.0 * rise + 8.0 * v0 + 7.0 * v1 + 3.0 * a0 - 2.0 * a1;
    let c5 = 6.0 * rise - 3.0 * (v0 + v1) - a0 + a1;
    let value = ends[0] + s * (v0 + s * (a0 + s * (c3 + s * (c4 + s * c5))));
    let derivative = v0 + s * (2.0 * a0 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)));
    (value, derivative / h)
}
