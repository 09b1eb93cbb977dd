//! How two bodies meet.

use serde::{Deserialize, Serialize};

/// Velocities and distance at time 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Approach {
    /// Velocities of the lower and the upper body along +y, m/s.
    pub velocities: [f64; 2],
    /// Distance of the surfaces on the axis, m, ≥ 0.
    pub gap: f64,
}

impl Approach {
    /// The lower body strikes the upper one at rest at this speed (m/s); they touch at time 0.
    pub fn at(speed: f64) -> Self {
        Self { velocities: [speed, 0.0], gap: 0.0 }
    }

    /// Relative speed of approach, m/s.
    pub fn speed(&self) -> f64 {
        self.velocities[0] - self.velocities[1]
    }

    /// Time of first touch, s.
    pub fn first_touch(&self) -> f64 {
        self.gap / self.speed()
    }

    /// What the two mass centres do along +y (m, or m/s) at an approach since time 0 (m, or its
    /// rate in m/s), the time since then (s, or 1 for the rates), and the masses, kg; infinite for a
    /// wall.
    pub fn centres(&self, masses: [f64; 2], approach: f64, time: f64) -> [f64; 2] {
        let share = |own: f64, other: f64| {
            if own.is_infinite() { 0.0 } else { (1.0 + own / other).recip() }
        };
        let shares = [share(masses[0], masses[1]), share(masses[1], masses[0])];
        // The lighter body does more of the approach; the common mass centre moves on.
        let common = shares[1] * self.velocities[0] + shares[0] * self.velocities[1];
        [common * time + shares[0] * approach, common * time - shares[1] * approach]
    }
}
