//! Whether bodies in contact stay together.
//!
//! Restitution e of bodies that have lost nearly all of their energy of approach ½ m* v² is bounded
//! from above by two numbers, each seen at one instant.
//!
//! **By energy.** Nothing drives the bodies apart but what they still have: the kinetic energy of the
//! relative motion, their vibrations T, and what bodies and springs store, U:
//!
//! ```math
//! e^2 \le \frac{\tfrac12 m^*\dot\delta^2 + T + U}{\tfrac12 m^*v^2} .
//! ```
//!
//! This holds while no one outside does work on the bodies. A wall that moves is at rest in the frame
//! of the relative motion and does none there. Gravity brings its potential −m g δ into U: what is left
//! then must lift the ball to where it first touched, and e is the speed at which it would pass there.
//!
//! It can be far too large where energy stays stored that no longer presses on the contact. A shear
//! modulus that relaxes to nothing beside an elastic bulk modulus leaves none in nature: the body flows
//! until its pressure is gone, and explicit elements end with 1e-9 of the energy of approach. A
//! condensed body keeps 1e-7, and up to 2e-2 where Poisson's ratio is small or negative: the reduced
//! basis of its relaxing shear cannot flow to zero pressure.
//!
//! **By momentum.** What parts them is ∫F dt. A force that stays what it is, for as long as they have
//! touched already, t, makes at most
//!
//! ```math
//! \frac{|\dot\delta| + F t/m^*}{v} .
//! ```
//!
//! A force may last longer, but only of a spring that is slow against what has stopped the bodies. That
//! is a dashpot, F = m* λ δ̇, which has taken λ t ≈ ln 10³ to bring the rate to rest and now slows their
//! parting: the spring k moves them at k δ/(m* λ), which is the estimate over λ t. Bodies that do
//! part are at rest at the largest approach only, where F t/m* is what will part them. A force that
//! vibrations modulate may be small for a moment; so the estimate has to stay small for a twentieth
//! of t.
//!
//! Of a ball with a weight F − m g takes the place of F.
//!
//! Together are bodies in contact whose energy bounds e by 1e-4, or whose momentum bounds it by
//! 1e-3 while their energy bounds it by 0.03, whatever is stored where.

use serde::{Deserialize, Serialize};

use crate::request::Frame;

/// A restitution that energy bounds by this is none.
const NOTHING_LEFT: f64 = 1e-4;
/// So is one that momentum bounds by this. The springs that discrete elements put in place of a liquid
/// part bodies with 1e-4.
const AT_REST: f64 = 1e-3;
/// Bodies that might part with more than this are never said to stay together.
const CERTAIN: f64 = 0.03;
/// A ball that sinks in at less than this share of its largest rate has sunk in.
const CREEPING: f64 = 0.01;
/// One that still sinks after so many times what it took to be sure that it stays flows under its weight.
const SINKING: f64 = 20.0;
/// Rest has to last for this share of the time since first touch.
const LASTING: f64 = 0.05;

/// Two bodies at an instant, as their relative motion sees them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeMotion {
    /// Since first touch, s.
    pub time: f64,
    /// Whether they touch.
    pub is_closed: bool,
    /// Contact force, N.
    pub force: f64,
    /// Of the approach, m/s; positive while the mass centres come closer.
    pub rate: f64,
    /// Kinetic energy of both bodies relative to their mass centres, and what they and the springs
    /// between them store, J; with gravity the potential of the weight, 0 at first touch.
    pub inner_energy: f64,
}

/// Looks for bodies that stay together.
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
/// let mut standstill = RestCriterion::new(&frame);
/// let mut now = RelativeMotion { time: 1e-3, is_closed: true, force: 1e-2, rate: 1.0, inner_energy: 0.0 };
/// assert!(!standstill.observe(&now));
/// // The energy that is left parts them at a ten-thousandth of the speed at most.
/// now.rate = 1e-4;
/// assert!(standstill.observe(&now));
/// # Ok::<(), fem_collision::ApproachError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RestCriterion {
    /// m/s.
    speed: f64,
    /// kg.
    reduced_mass: f64,
    /// Weight that the contact bears, N; 0 without gravity.
    weight: f64,
    /// Since when the bodies are at rest, s after first touch.
    since: Option<f64>,
    /// The largest rate of the approach so far, m/s.
    fastest: f64,
    /// When the energy had first proved that they stay, s after first touch.
    proved: Option<f64>,
}

impl RestCriterion {
    /// Of bodies that are about to touch.
    pub fn new(frame: &Frame) -> Self {
        let weight = frame.weight();
        let (speed, reduced_mass) = (frame.speed(), frame.reduced_mass);
        Self { speed, reduced_mass, weight, since: None, fastest: 0.0, proved: None }
    }

    /// Whether it can be of bodies that meet like this.
    pub fn is_of(&self, frame: &Frame) -> bool {
        let known = [self.since, self.proved];
        Self { since: None, fastest: 0.0, proved: None, ..*self } == Self::new(frame)
            && known.into_iter().flatten().all(|time| time >= 0.0)
            && self.fastest >= 0.0
    }

    /// Takes the next instant; whether the bodies stay together. What is no number never says so.
    pub fn observe(&mut self, now: &RelativeMotion) -> bool {
        let initial = self.reduced_mass * self.speed * self.speed;
        let left = self.reduced_mass * now.rate * now.rate + 2.0 * now.inner_energy;
        let force = if self.weight > 0.0 { (now.force - self.weight).abs() } else { now.force };
        let by_energy = |restitution: f64| left < restitution * restitution * initial;
        let by_momentum = || now.rate.abs() + force * now.time / self.reduced_mass;
        let is_at_rest = by_energy(CERTAIN) && by_momentum() < AT_REST * self.speed;
        self.since = is_at_rest.then(|| self.since.unwrap_or(now.time));
        let lasts = self.since.is_some_and(|since| now.time - since >= LASTING * now.time);
        let is_proved = by_energy(NOTHING_LEFT);
        self.proved = is_proved.then(|| self.proved.unwrap_or(now.time));
        self.fastest = self.fastest.max(now.rate);
        // What a ball has fallen proves early that it stays; it has still to sink in, or does for ever.
        let has_sunk_in = self.weight == 0.0
            || now.rate < CREEPING * self.fastest
            || self.proved.is_some_and(|proved| now.time > SINKING * proved);
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

    /// That mass on a spring (N/m) beside one of 1 N/m with a dashpot of a relaxation time (s) in
    /// series: its restitution when the force falls to zero or someone says that it stays, `None` if
    /// neither has come after so many steps.
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
    fn a_maxwell_body_parts_or_stays_as_its_damping_says() {
        let found = |relaxation_time: f64| {
            let mut standstill = RestCriterion::new(&frame());
            collide(0.0, relaxation_time, |now| standstill.observe(now), 10_000_000)
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

    /// A spring of any weakness holds on after the dashpot has given way: what parts the bodies faster
    /// than is promised is seen.
    #[test]
    fn a_weak_spring_that_parts_them_is_not_overlooked() {
        for spring in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            for time in [0.03, 0.1, 0.3, 1.0, 3.0] {
                let mut standstill = RestCriterion::new(&frame());
                let found = collide(spring, time, |now| standstill.observe(now), 5_000_000);
                let exact = collide(spring, time, |_| false, 5_000_000).unwrap_or_default();
                let found = found.expect("it parts or stays");
                assert!((found - exact).abs() < AT_REST, "{spring} {time}: {found} for {exact}");
            }
        }
    }

    /// Whatever it has seen, it knows whose it is.
    #[test]
    fn another_speed_or_mass_is_of_other_bodies() {
        let frame = frame();
        let mut standstill = RestCriterion::new(&frame);
        let held =
            RelativeMotion { time: 1.0, is_closed: true, force: 0.0, rate: 0.0, inner_energy: 0.0 };
        assert!(standstill.is_of(&frame) && standstill.observe(&held) && standstill.is_of(&frame));
        for other in [
            RestCriterion { speed: 2.0, ..standstill },
            RestCriterion { reduced_mass: 2.0, ..standstill },
            RestCriterion { speed: f64::NAN, ..standstill },
            RestCriterion { since: Some(-1.0), ..standstill },
        ] {
            assert!(!other.is_of(&frame), "{other:?}");
        }
    }

    /// A force that only bears the weight drives nothing; one that is as far above it does.
    #[test]
    fn a_weight_that_is_borne_is_no_force() {
        let frame = Frame { gravity: 2.0, ..frame() };
        let now = |time: f64, force: f64| RelativeMotion {
            time,
            is_closed: true,
            force,
            rate: 1e-6,
            inner_energy: 1e-4 * frame.initial(),
        };
        for (force, stays) in [(2.0, true), (2.0 - 1e-4, true), (4.0, false), (0.0, false)] {
            let mut standstill = RestCriterion::new(&frame);
            assert!(!standstill.observe(&now(1.0, force)));
            assert_eq!(standstill.observe(&now(1.1, force)), stays, "{force}");
        }
    }

    /// Energy that is stored and presses on nothing.
    #[test]
    fn bodies_at_rest_stay_whatever_they_store() {
        let frame = frame();
        let mut standstill = RestCriterion::new(&frame);
        // A restitution of 0.01, were it to press.
        let now = |time: f64| RelativeMotion {
            time,
            is_closed: true,
            force: 1e-2,
            rate: -1e-6,
            inner_energy: 1e-4 * frame.initial(),
        };
        assert!(!standstill.observe(&now(1e-3)));
        assert!(!standstill.observe(&RelativeMotion { rate: f64::NAN, ..now(1.04e-3) }));
        assert!(!standstill.observe(&now(1.05e-3)));
        assert!(!standstill.observe(&now(1.1e-3)));
        assert!(!standstill.observe(&RelativeMotion { is_closed: false, ..now(1.2e-3) }));
        assert!(standstill.observe(&now(1.2e-3)));
        let too_much = RelativeMotion { inner_energy: 1e-3 * frame.initial(), ..now(1.3e-3) };
        assert!(!standstill.observe(&too_much));
    }
}
