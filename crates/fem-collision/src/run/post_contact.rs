//! Vibration energy of the bodies after the last contact.

use serde::{Deserialize, Serialize};

/// Mean energy of the vibrations of both bodies since the last contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PostContactVibration {
    /// Sums of the kinetic energies relative to the mass centres, J.
    sums: [f64; 2],
    n: usize,
}

impl PostContactVibration {
    /// Adds an instant after first touch: whether the contact is closed, and the kinetic energy of
    /// each body relative to its mass centre, J.
    pub fn observe(&mut self, is_closed: bool, vibration: [f64; 2]) {
        if is_closed {
            *self = Self::default();
            return;
        }
        self.n = self.n.saturating_add(1);
        for (sum, energy) in self.sums.iter_mut().zip(vibration) {
            *sum += energy;
        }
    }

    /// Returns the vibration energy of both bodies, J: twice the mean kinetic energy, since half of
    /// the energy of a vibration is kinetic. `None` before the bodies have separated.
    pub fn vibration_energy(&self) -> Option<[f64; 2]> {
        (self.n > 0).then(|| self.sums.map(|sum| 2.0 * sum / self.n as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vibration_energy_is_averaged_after_the_last_contact_only() {
        let mut vibration = PostContactVibration::default();
        assert_eq!(vibration.vibration_energy(), None);
        for (is_closed, energy) in [(true, 5.0), (false, 9.0), (true, 5.0)] {
            vibration.observe(is_closed, [energy, 0.0]);
        }
        assert_eq!(vibration.vibration_energy(), None);
        vibration.observe(false, [1.0, 0.5]);
        vibration.observe(false, [2.0, 0.5]);
        assert_eq!(vibration.vibration_energy(), Some([3.0, 1.0]));
    }
}
