//! Initial velocities and distance of two bodies.

use fem_material::engineering::{number, show};
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

/// Reasons why two bodies do not collide.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ApproachError {
    /// The relative velocity is not positive and finite.
    #[error(
        "the bodies approach each other at {} m/s; it must be positive and finite",
        number(*.0, 5)
    )]
    NotApproaching(f64),
    /// The gap is negative or not finite.
    #[error("gap is {}; it must be finite and at least 0", show(*.0, "m"))]
    Gap(f64),
}

/// An approach before validation.
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
    /// Creates an approach from the velocities of the lower and the upper body along +y (m/s) and
    /// the distance of their surfaces on the axis at time 0, m.
    ///
    /// # Errors
    /// The bodies do not approach each other, or the gap is negative or not finite.
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

    /// Creates an approach of the lower body at this speed (m/s) to an upper body at rest. They
    /// touch at time 0.
    ///
    /// # Errors
    /// The speed is not positive and finite.
    pub fn at(speed: f64) -> Result<Self, ApproachError> {
        Self::new([speed, 0.0], 0.0)
    }

    /// Returns the velocities of the lower and the upper body along +y, m/s.
    pub fn velocities(&self) -> [f64; 2] {
        self.velocities
    }

    /// Returns the distance of the surfaces on the axis at time 0, m, ≥ 0.
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Returns the relative speed of approach, m/s, > 0.
    pub fn speed(&self) -> f64 {
        self.velocities[0] - self.velocities[1]
    }

    /// Returns the time of first touch, s.
    pub fn first_touch(&self) -> f64 {
        self.gap / self.speed()
    }

    /// Returns this approach in the frame of the common mass centre, touching at time 0, and the
    /// velocity of that frame along +y, m/s. Masses are in kg; that of a wall is infinite, and only
    /// one body may be a wall.
    ///
    /// # Errors
    /// A speed is outside of the range of f64.
    pub fn in_frame_of_centre(&self, masses: [f64; 2]) -> Result<(Self, f64), ApproachError> {
        let [lower, upper] = self.centres(masses, 1.0, 0.0);
        let speed = self.speed();
        let velocity = -upper * self.velocities[0] + lower * self.velocities[1];
        Ok((Self::new([lower * speed, upper * speed], 0.0)?, velocity))
    }

    /// Returns the displacements of the two mass centres along +y (m) for an approach since time 0
    /// (m), the time (s) and the masses (kg; infinite for a wall). With the rate of the approach
    /// (m/s) and a time of 1 it returns their velocities, m/s.
    pub fn centres(&self, masses: [f64; 2], approach: f64, time: f64) -> [f64; 2] {
        let share = |own: f64, other: f64| {
            if own.is_infinite() { 0.0 } else { (1.0 + own / other).recip() }
        };
        let shares = [share(masses[0], masses[1]), share(masses[1], masses[0])];
        // The lighter body moves more; the common mass centre has a constant velocity.
        let common = shares[1] * self.velocities[0] + shares[0] * self.velocities[1];
        [common * time + shares[0] * approach, common * time - shares[1] * approach]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The momentum is that of the start, and the approach is the one asked for. A wall keeps its velocity.
    #[test]
    fn centres_conserve_momentum() {
        let approach = Approach::new([0.5, -0.25], 0.0).unwrap();
        let velocities = approach.centres([1.0, 3.0], 0.125, 1.0);
        assert!((velocities[0] + 3.0 * velocities[1] - (0.5 - 0.75)).abs() < 1e-15);
        assert!((velocities[0] - velocities[1] - 0.125).abs() < 1e-15);
        let wall = approach.centres([1.0, f64::INFINITY], 0.125, 1.0);
        assert_eq!(wall, [-0.125, -0.25]);
    }

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
