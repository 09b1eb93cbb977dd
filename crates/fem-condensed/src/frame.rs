//! Motion of the bodies as a whole, which the contact does not see.

/// Motion of the bodies as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Velocities along +y at the start, lower body first, m/s.
    pub velocities: [f64; 2],
    /// Distance of the surfaces at time 0, m.
    pub gap: f64,
}

impl Frame {
    /// Relative speed of approach, m/s.
    pub fn approach_speed(&self) -> f64 {
        self.velocities[0] - self.velocities[1]
    }

    /// Time of first touch, s.
    pub fn first_touch(&self) -> f64 {
        self.gap / self.approach_speed()
    }

    /// What the two mass centres do along +y (m, or m/s) at an approach since time 0 (m, or its
    /// rate in m/s), the time since then (s, or 1 for the rates), and the masses, kg.
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
