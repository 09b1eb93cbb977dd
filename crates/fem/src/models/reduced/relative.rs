//! From the relative motion to the two bodies: the mass centre moves on, and
//!
//! ```math
//! v_1 = v_1(0) - \frac{m^*}{m_1}\,(v - \dot\delta), \qquad
//! v_2 = v_2(0) + \frac{m^*}{m_2}\,(v - \dot\delta).
//! ```
//!
//! A wall has an infinite mass, keeps its velocity, and takes the momentum m*(v − δ̇).

use crate::outcome::mass_of;
use crate::scene::Scene;

/// Two bodies along +y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative {
    masses: [Option<f64>; 2],
    velocities: [f64; 2],
    effective_mass: f64,
}

impl Relative {
    pub fn of(scene: &Scene, effective_mass: f64) -> Self {
        Self {
            masses: scene.bodies.each_ref().map(mass_of),
            velocities: scene.bodies.each_ref().map(|body| body.velocity),
            effective_mass,
        }
    }

    /// v, m/s.
    pub fn speed(&self) -> f64 {
        self.velocities[0] - self.velocities[1]
    }

    pub fn masses(&self) -> [Option<f64>; 2] {
        self.masses
    }

    /// m*(v − δ̇), N s, that the first body has given to the second.
    fn impulse(&self, rate: f64) -> f64 {
        self.effective_mass * (self.speed() - rate)
    }

    /// Of both bodies at a relative rate.
    pub fn velocities(&self, rate: f64) -> [f64; 2] {
        let change = |side: usize| self.masses[side].map_or(0.0, |m| self.impulse(rate) / m);
        [self.velocities[0] - change(0), self.velocities[1] + change(1)]
    }

    /// Of the spheres, J.
    pub fn kinetic(&self, rate: f64) -> f64 {
        let bodies = self.masses.into_iter().zip(self.velocities(rate));
        bodies.filter_map(|(mass, velocity)| Some(0.5 * mass? * velocity * velocity)).sum()
    }

    /// Of the relative motion at the start, J.
    pub fn initial(&self) -> f64 {
        0.5 * self.effective_mass * self.speed() * self.speed()
    }

    /// ½m*(δ̇² − v²), J: the change of the kinetic energy less a wall's work, without the
    /// cancellation that unequal masses would bring.
    pub fn gained(&self, rate: f64) -> f64 {
        0.5 * self.effective_mass * (rate - self.speed()) * (rate + self.speed())
    }

    /// That a moving wall has done, J.
    pub fn wall_work(&self, rate: f64) -> f64 {
        let wall = |side: usize| self.masses[side].is_none().then_some(self.velocities[side]);
        self.impulse(rate) * (wall(0).unwrap_or(0.0) - wall(1).unwrap_or(0.0))
    }

    /// Drift of the momentum, a wall's share counted, over Σ m|v| at the start.
    pub fn momentum_drift(&self, rate: f64) -> f64 {
        let after = self.velocities(rate);
        let gained = |side: usize, sign: f64| match self.masses[side] {
            Some(mass) => mass * (after[side] - self.velocities[side]),
            None => sign * self.impulse(rate),
        };
        let bodies = self.masses.into_iter().zip(self.velocities);
        let scale: f64 = bodies.map(|(mass, v)| mass.unwrap_or(0.0) * v.abs()).sum();
        // A sphere at rest that a wall strikes has no momentum at the start.
        let scale = if scale > 0.0 { scale } else { self.effective_mass * self.speed() };
        ((gained(0, -1.0) + gained(1, 1.0)) / scale).abs()
    }
}
