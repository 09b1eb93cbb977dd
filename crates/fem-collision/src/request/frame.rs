//! Velocities and energies of the two bodies from their relative motion. The common mass centre has a constant velocity:
//!
//! ```math
//! v_1 = v_1(0) - \frac{m^*}{m_1}\,(v - \dot\delta), \qquad
//! v_2 = v_2(0) + \frac{m^*}{m_2}\,(v - \dot\delta).
//! ```
//!
//! A wall, or a half-space far away, has an infinite mass, keeps its velocity, and takes the momentum
//! m*(v − δ̇). Gravity acts on the upper body, above one that does not move; its potential is −m* g δ.

use crate::request::Approach;

/// The frame of the common mass centre of two bodies along +y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Initial velocities and gap.
    pub approach: Approach,
    /// Masses of the lower and the upper body, kg; a wall or a half-space has none.
    pub masses: [Option<f64>; 2],
    /// Reduced mass m* = m₁m₂/(m₁+m₂), kg.
    pub reduced_mass: f64,
    /// Acceleration of the approach by gravity, m/s², ≥ 0; 0 without gravity.
    pub gravity: f64,
}

impl Frame {
    /// Returns the relative speed of approach v, m/s.
    pub fn speed(&self) -> f64 {
        self.approach.speed()
    }

    /// Returns the momentum m*(v − δ̇), N s, that the first body has transferred to the second at a rate of the
    /// approach, m/s.
    pub fn impulse(&self, rate: f64) -> f64 {
        self.reduced_mass * (self.speed() - rate)
    }

    /// Returns the velocities of both bodies (m/s) at a rate of the approach, m/s.
    #[inline]
    pub fn velocities(&self, rate: f64) -> [f64; 2] {
        let before = self.approach.velocities();
        let change = |side: usize| self.masses[side].map_or(0.0, |m| self.impulse(rate) / m);
        [before[0] - change(0), before[1] + change(1)]
    }

    /// Returns the kinetic energy of the spheres (J) at a rate of the approach, m/s.
    #[inline]
    pub fn kinetic(&self, rate: f64) -> f64 {
        let bodies = self.masses.into_iter().zip(self.velocities(rate));
        bodies.filter_map(|(mass, velocity)| Some(0.5 * mass? * velocity * velocity)).sum()
    }

    /// Returns the kinetic energy of the relative motion at the start, J.
    pub fn initial(&self) -> f64 {
        0.5 * self.reduced_mass * self.speed() * self.speed()
    }

    /// Returns ½m*(δ̇² − v²), J: the change of the kinetic energy without the work of a wall. It avoids the
    /// cancellation that unequal masses would cause.
    pub fn gained(&self, rate: f64) -> f64 {
        0.5 * self.reduced_mass * (rate - self.speed()) * (rate + self.speed())
    }

    /// Returns the weight of the upper body, N; 0 without gravity.
    pub fn weight(&self) -> f64 {
        self.reduced_mass * self.gravity
    }

    /// Returns the potential of that weight (J) at an approach, m, which is 0 at first touch; `None` without gravity.
    pub fn potential(&self, approach: f64) -> Option<f64> {
        (self.gravity > 0.0).then(|| -self.weight() * approach)
    }

    /// Returns the energy (J) to which residuals are relative, at the largest approach so far (m): the initial energy
    /// and the work of the weight. A ball that is laid down has almost no initial energy.
    pub fn energy_scale(&self, closest: f64) -> f64 {
        self.initial() + self.weight() * closest
    }

    /// Returns the work of a moving wall, J.
    pub fn wall_work(&self, rate: f64) -> f64 {
        let velocities = self.approach.velocities();
        let wall = |side: usize| self.masses[side].is_none().then_some(velocities[side]);
        self.impulse(rate) * (wall(0).unwrap_or(0.0) - wall(1).unwrap_or(0.0))
    }

    /// Returns Σ m|v| at the start, N s, or the momentum of the relative motion if a wall strikes a sphere at rest.
    pub fn momentum_scale(&self) -> f64 {
        let bodies = self.masses.into_iter().zip(self.approach.velocities());
        let scale: f64 = bodies.map(|(mass, v)| mass.unwrap_or(0.0) * v.abs()).sum();
        if scale > 0.0 { scale } else { self.reduced_mass * self.speed() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(speed: f64, masses: [Option<f64>; 2], reduced_mass: f64) -> Frame {
        Frame { approach: Approach::at(speed).unwrap(), masses, reduced_mass, gravity: 0.0 }
    }

    /// Two spheres that separate at half the speed, by hand: momentum 2·3 + 1·0 is conserved.
    #[test]
    fn momentum_is_kept_and_the_rate_is_the_difference() {
        let frame = frame(3.0, [Some(2.0), Some(1.0)], 2.0 / 3.0);
        let [lower, upper] = frame.velocities(-1.5);
        assert!((lower - upper + 1.5).abs() < 1e-15);
        assert!((2.0 * lower + upper - 6.0).abs() < 1e-14);
        // By hand: 2 (3 − 1.5) of 2·3.
        assert!((frame.impulse(-1.5) - 3.0).abs() < 1e-15);
        assert!((frame.momentum_scale() - 6.0).abs() < 1e-15);
        assert!((frame.kinetic(-1.5) - frame.kinetic(3.0) - frame.gained(-1.5)).abs() < 1e-14);
    }

    #[test]
    fn the_energy_scale_includes_the_work_of_the_weight() {
        let frame = frame(2.0, [None, Some(3.0)], 3.0);
        // ½ 3 2², and 3 · 10 over a tenth.
        assert_eq!(frame.energy_scale(0.1), 6.0);
        assert_eq!(Frame { gravity: 10.0, ..frame }.energy_scale(0.1), 9.0);
    }

    /// A wall keeps its velocity; what it gives is force times way.
    #[test]
    fn a_wall_that_moves_does_work() {
        let frame = frame(2.0, [None, Some(1.0)], 1.0);
        assert_eq!(frame.velocities(-2.0), [2.0, 4.0]);
        assert_eq!(frame.wall_work(-2.0), 8.0);
        assert_eq!(frame.kinetic(-2.0), 8.0);
    }
}
