//! Rest criterion: decides whether bodies in contact stay together.
//!
//! The restitution e of bodies that have lost almost all of their energy of approach ½ m* v² has two upper bounds, each
//! from one instant.
//!
//! **By energy.** Only the remaining energy can separate the bodies: the kinetic energy of the relative motion, the
//! vibrations T, and the stored energy U of bodies and springs:
//!
//! ```math
//! e^2 \le \frac{\tfrac12 m^*\dot\delta^2 + T + U}{\tfrac12 m^*v^2} .
//! ```
//!
//! This holds without external work. A moving wall is at rest in the frame of the relative motion and does no work there.
//! Gravity adds its potential −m g δ to U: the remaining energy must lift the ball to the position of first touch, and e
//! belongs to its speed there.
//!
//! The bound can be far too large if stored energy no longer acts on the contact. If the shear modulus relaxes to zero and
//! the bulk modulus is elastic, a real body flows until its pressure is zero. Explicit elements end with 1e-9 of the energy
//! of approach. A condensed body keeps 1e-7, and up to 2e-2 if Poisson's ratio is small or negative, since the reduced
//! basis of its relaxing shear cannot flow to zero pressure.
//!
//! **By momentum.** The impulse ∫F dt separates the bodies. If the present force acts for another t, the time since first
//! touch, the bound is
//!
//! ```math
//! \frac{|\dot\delta| + F t/m^*}{v} .
//! ```
//!
//! A force can only last longer if its spring is slow compared with the mechanism that stopped the bodies. That is a
//! dashpot, F = m* λ δ̇, which took λ t ≈ ln 10³ to stop them and now slows their separation: the spring k moves them at
//! k δ/(m* λ), which is the bound over λ t. Bodies that separate are at rest only at the largest approach, where F t/m* is
//! their later velocity. Vibrations may make the force small for a moment, so the bound must stay small for t/20.
//!
//! For a ball with a weight, F − m g replaces F.
//!
//! Bodies in contact stay together if the energy bounds e by [`MIN_RESTITUTION`], or if the momentum bounds it by that and the energy
//! by 0.03.

use fem_laws::MIN_RESTITUTION;
use serde::{Deserialize, Serialize};

use crate::request::Frame;

/// Largest bound by energy for bodies that are at rest by their momentum.
const MAX_BOUND_BY_ENERGY: f64 = 0.03;
/// A ball is at its static approach if its rate is below this fraction of the largest one.
const CREEPING_RATE: f64 = 0.01;
/// A ball flows under its weight if it still sinks after this many times the time at which its energy bounded e.
const SINKING_TIME_FACTOR: f64 = 20.0;
/// Duration of rest, as a fraction of the time since first touch.
const REST_DURATION_SHARE: f64 = 0.05;

/// The relative motion of two bodies at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeMotion {
    /// Time since first touch, s.
    pub time: f64,
    /// Whether the bodies are in contact.
    pub is_closed: bool,
    /// Contact force, N.
    pub force: f64,
    /// Rate of the approach, m/s; positive in compression.
    pub rate: f64,
    /// Kinetic energy of both bodies relative to their mass centres plus the energy stored in bodies and springs, J; with
    /// gravity also the potential of the weight, which is 0 at first touch.
    pub inner_energy: f64,
}

/// Decides whether bodies stay together.
///
/// ```
/// use fem_collision::{Approach, Frame, RelativeMotion, RestCriterion};
///
/// let frame = Frame {
///     approach: Approach::at(2.0)?,
///     masses: [Some(1.0), None],
///     reduced_mass: 1.0,
///     gravity: 0.0,
/// };
/// let mut rest = RestCriterion::new(&frame);
/// let mut now = RelativeMotion { time: 1e-3, is_closed: true, force: 1e-2, rate: 1.0, inner_energy: 0.0 };
/// assert!(!rest.observe(&now));
/// // The remaining energy can separate them with less than 1e-3 of the speed.
/// now.rate = 1e-3;
/// assert!(rest.observe(&now));
/// # Ok::<(), fem_collision::ApproachError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestCriterion {
    /// Speed of approach, m/s.
    speed: f64,
    /// Reduced mass, kg.
    reduced_mass: f64,
    /// Weight on the contact, N; 0 without gravity.
    weight: f64,
    /// Time from which the bodies are at rest, s after first touch.
    since: Option<f64>,
    /// Largest rate of the approach so far, m/s.
    fastest: f64,
    /// Time from which the energy bounds e by [`MIN_RESTITUTION`], s after first touch.
    proved: Option<f64>,
}

impl RestCriterion {
    /// Creates the criterion of bodies that are about to touch.
    pub fn new(frame: &Frame) -> Self {
        let weight = frame.weight();
        let (speed, reduced_mass) = (frame.speed(), frame.reduced_mass);
        Self { speed, reduced_mass, weight, since: None, fastest: 0.0, proved: None }
    }

    /// Returns whether a restart state belongs to bodies with this relative motion.
    pub fn is_of(&self, frame: &Frame) -> bool {
        let known = [self.since, self.proved];
        Self { since: None, fastest: 0.0, proved: None, ..*self } == Self::new(frame)
            && known.into_iter().flatten().all(|time| time >= 0.0)
            && self.fastest >= 0.0
    }

    /// Takes the next instant and returns whether the bodies stay together; never true if a value is NaN.
    pub fn observe(&mut self, now: &RelativeMotion) -> bool {
        let initial = self.reduced_mass * self.speed * self.speed;
        let left = self.reduced_mass * now.rate * now.rate + 2.0 * now.inner_energy;
        let force = if self.weight > 0.0 { (now.force - self.weight).abs() } else { now.force };
        let by_energy = |restitution: f64| left < restitution * restitution * initial;
        let by_momentum = || now.rate.abs() + force * now.time / self.reduced_mass;
        let is_at_rest =
            by_energy(MAX_BOUND_BY_ENERGY) && by_momentum() < MIN_RESTITUTION * self.speed;
        self.since = is_at_rest.then(|| self.since.unwrap_or(now.time));
        let lasts =
            self.since.is_some_and(|since| now.time - since >= REST_DURATION_SHARE * now.time);
        let is_proved = by_energy(MIN_RESTITUTION);
        self.proved = is_proved.then(|| self.proved.unwrap_or(now.time));
        self.fastest = self.fastest.max(now.rate);
        // The energy of a falling ball is lost early, but the ball still has to sink to its static approach.
        let has_sunk_in = self.weight == 0.0
            || now.rate < CREEPING_RATE * self.fastest
            || self.proved.is_some_and(|proved| now.time > SINKING_TIME_FACTOR * proved);
        now.is_closed && (lasts || is_proved && has_sunk_in)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::request::Approach;

    /// The frame of a mass of 1 kg that meets a wall at 1 m/s.
    fn frame() -> Frame {
        let approach = Approach::at(1.0).unwrap();
        Frame { approach, masses: [Some(1.0), None], reduced_mass: 1.0, gravity: 0.0 }
    }

    /// It is closed and still.
    const HELD: RelativeMotion =
        RelativeMotion { time: 1.0, is_closed: true, force: 0.0, rate: 0.0, inner_energy: 0.0 };

    /// That mass on a spring (N/m) in parallel with a Maxwell element of 1 N/m and a relaxation time (s). Returns the
    /// restitution when the force falls to zero or `stays` is true; `None` if neither happens within `n_steps`.
    fn collide(
        spring: f64,
        relaxation_time: f64,
        mut stays: impl FnMut(&RelativeMotion) -> bool,
        n_steps: usize,
    ) -> Option<f64> {
        let step = 0.02 * relaxation_time.min(1.0);
        let rates = |[x, v, q]: [f64; 3]| [v, -spring * x - q, v - q / relaxation_time];
        let moved = |from: [f64; 3], by: [f64; 3], time: f64| {
            [0, 1, 2].map(|k: usize| from[k] + time * by[k])
        };
        let mut state = [0.0, 1.0, 0.0];
        for k in 1..=n_steps {
            // The midpoint rule: 1e-4 of each term.
            let middle = moved(state, rates(state), 0.5 * step);
            state = moved(state, rates(middle), step);
            let [x, v, q] = state;
            let now = RelativeMotion {
                time: k as f64 * step,
                is_closed: true,
                force: spring * x + q,
                rate: v,
                inner_energy: 0.5 * (spring * x * x + q * q),
            };
            if now.force <= 0.0 {
                return Some(-v);
            }
            if stays(&now) {
                return Some(0.0);
            }
        }
        None
    }

    /// A Maxwell body creeps if it relaxes faster than half of its own clock, and bounces if slower:
    /// e = exp(−π ζ/√(1 − ζ²)) with ζ = 1/(2 ω τ), from F̈ + Ḟ/τ + ω² F = 0.
    #[test]
    fn maxwell_body_separates_or_rests_by_its_damping_ratio() {
        let found = |relaxation_time: f64| {
            let mut rest = RestCriterion::new(&frame());
            collide(0.0, relaxation_time, |now| rest.observe(now), 10_000_000)
        };
        for relaxation_time in [0.02, 0.1, 0.3, 0.45] {
            assert_eq!(found(relaxation_time), Some(0.0), "{relaxation_time}");
        }
        // The last one parts with 1.5e-3.
        for damping in [0.01_f64, 0.1, 0.5, 0.8, 0.9] {
            let root = (1.0 - damping * damping).sqrt();
            let expected = (-std::f64::consts::PI * damping / root).exp();
            let found = found(0.5 / damping).unwrap();
            assert!((found - expected).abs() < 1e-3 * expected + 1e-5, "{damping}: {found}");
        }
    }

    /// A weak spring still acts after the dashpot has relaxed: a larger restitution than the bound is detected.
    #[test]
    fn rest_criterion_detects_separation_by_a_weak_spring() {
        for spring in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            for time in [0.03, 0.1, 0.3, 1.0, 3.0] {
                let mut rest = RestCriterion::new(&frame());
                let found = collide(spring, time, |now| rest.observe(now), 5_000_000);
                let exact = collide(spring, time, |_| false, 5_000_000).unwrap_or_default();
                let found = found.expect("it parts or stays");
                assert!(
                    (found - exact).abs() < MIN_RESTITUTION,
                    "{spring} {time}: {found} for {exact}"
                );
            }
        }
    }

    /// A restart state of other bodies is recognised.
    #[test]
    fn rest_criterion_rejects_the_state_of_other_bodies() {
        let frame = frame();
        let mut rest = RestCriterion::new(&frame);
        assert!(rest.is_of(&frame) && rest.observe(&HELD) && rest.is_of(&frame));
        for other in [
            RestCriterion { speed: 2.0, ..rest },
            RestCriterion { reduced_mass: 2.0, ..rest },
            RestCriterion { speed: f64::NAN, ..rest },
            RestCriterion { since: Some(-1.0), ..rest },
        ] {
            assert!(!other.is_of(&frame), "{other:?}");
        }
    }

    /// A force equal to the weight does not separate the bodies; one that is far above it does.
    #[test]
    fn a_force_equal_to_the_weight_does_not_separate() {
        let frame = Frame { gravity: 2.0, ..frame() };
        let inner_energy = 1e-4 * frame.initial();
        let now = |time, force| RelativeMotion { time, force, rate: 1e-6, inner_energy, ..HELD };
        for (force, stays) in [(2.0, true), (2.0 - 1e-4, true), (4.0, false), (0.0, false)] {
            let mut rest = RestCriterion::new(&frame);
            assert!(!rest.observe(&now(1.0, force)));
            assert_eq!(rest.observe(&now(1.1, force)), stays, "{force}");
        }
    }

    /// Stored energy without a force on the contact does not separate the bodies.
    #[test]
    fn bodies_at_rest_stay_with_any_stored_energy() {
        let frame = frame();
        let mut rest = RestCriterion::new(&frame);
        // The energy alone would allow a restitution of 0.01.
        let inner_energy = 1e-4 * frame.initial();
        let now = |time| RelativeMotion { time, force: 1e-2, rate: -1e-6, inner_energy, ..HELD };
        assert!(!rest.observe(&now(1e-3)));
        assert!(!rest.observe(&RelativeMotion { rate: f64::NAN, ..now(1.04e-3) }));
        assert!(!rest.observe(&now(1.05e-3)));
        assert!(!rest.observe(&now(1.1e-3)));
        assert!(!rest.observe(&RelativeMotion { is_closed: false, ..now(1.2e-3) }));
        assert!(rest.observe(&now(1.2e-3)));
        let too_much = RelativeMotion { inner_energy: 1e-3 * frame.initial(), ..now(1.3e-3) };
        assert!(!rest.observe(&too_much));
    }
}
