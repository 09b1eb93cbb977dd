//! How two bodies meet.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Velocities and distance at time 0, of bodies that approach each other.
///
/// ```
/// use fem_collision::Approach;
///
/// let overtaken = Approach::new([3.0, 1.0], 1e-3)?;
/// assert_eq!((overtaken.speed(), overtaken.first_touch()), (2.0, 0.5e-3));
/// assert!(Approach::new([1.0, 3.0], 1e-3).is_err());
/// # Ok::<(), fem_collision::ApproachError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub struct Approach {
    velocities: [f64; 2],
    gap: f64,
}

/// Why two bodies do not meet.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ApproachError {
    /// They recede, stand still, or move at no speed that can be computed with.
    #[error("the bodies approach each other at {0} m/s; it must be positive and finite")]
    NotApproaching(f64),
    /// They overlap already, or are infinitely far.
    #[error("gap is {0} m; allowed is at least 0, and finite")]
    Gap(f64),
}

/// An approach as it is read.
#[derive(Deserialize)]
struct Unchecked {
    velocities: [f64; 2],
    gap: f64,
}

impl TryFrom<Unchecked> for Approach {
    type Error = ApproachError;

    fn try_from(read: Unchecked) -> Result<Self, ApproachError> {
        Self::new(read.velocities, read.gap)
    }
}

impl Approach {
    /// Bodies with these velocities along +y (m/s), the lower one's first, at this distance of their
    /// surfaces on the axis at time 0, m.
    ///
    /// # Errors
    /// Bodies that do not approach each other; a gap that is negative or not finite.
    pub fn new(velocities: [f64; 2], gap: f64) -> Result<Self, ApproachError> {
        let approach = Self { velocities, gap };
        let speed = approach.speed();
        if !(speed > 0.0 && speed.is_finite()) {
            return Err(ApproachError::NotApproaching(speed));
        }
        if !(gap >= 0.0 && gap.is_finite()) {
            return Err(ApproachError::Gap(gap));
        }
        Ok(approach)
    }

    /// The lower body strikes the upper one at rest at this speed (m/s); they touch at time 0.
    ///
    /// # Errors
    /// A speed that is not positive and finite.
    pub fn at(speed: f64) -> Result<Self, ApproachError> {
        Self::new([speed, 0.0], 0.0)
    }

    /// Velocities of the lower and the upper body along +y, m/s.
    pub fn velocities(&self) -> [f64; 2] {
        self.velocities
    }

    /// Distance of the surfaces on the axis at time 0, m, ≥ 0.
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Relative speed of approach, m/s, > 0.
    pub fn speed(&self) -> f64 {
        self.velocities[0] - self.velocities[1]
    }

    /// Time of first touch, s.
    pub fn first_touch(&self) -> f64 {
        self.gap / self.speed()
    }

    /// The same in the frame of the common mass centre, touching at time 0, and that frame's velocity
    /// along +y, m/s. Masses in kg; infinite for a wall, of which there is one at most.
    ///
    /// # Errors
    /// Speeds that leave the range of f64.
    pub fn in_frame_of_centre(&self, masses: [f64; 2]) -> Result<(Self, f64), ApproachError> {
        let [lower, upper] = self.centres(masses, 1.0, 0.0);
        let speed = self.speed();
        let velocity = -upper * self.velocities[0] + lower * self.velocities[1];
        Ok((Self::new([lower * speed, upper * speed], 0.0)?, velocity))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_bodies_that_meet_have_an_approach() {
        for velocities in [[0.0, 0.0], [-0.5, 0.0], [f64::NAN, 0.0], [f64::INFINITY, 0.0]] {
            let refused = Approach::new(velocities, 0.0).unwrap_err();
            assert!(matches!(refused, ApproachError::NotApproaching(_)), "{refused:?}");
        }
        for gap in [-1e-9, f64::INFINITY, f64::NAN] {
            let refused = Approach::new([1.0, 0.0], gap).unwrap_err();
            assert!(matches!(refused, ApproachError::Gap(_)), "{refused:?}");
        }
    }
}
