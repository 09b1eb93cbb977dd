//! Weight, and how often a ball falls again.

use serde::{Deserialize, Serialize};

/// The weight of the upper body of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gravity {
    /// Along −y, m/s², > 0.
    pub acceleration: f64,
    /// After so many contacts the run ends, ≥ 1; rest ends it before.
    pub bounces: usize,
}

/// √(v² + 2 g h), m/s, of a body with the velocity v (m/s) at the height h, m.
pub fn impact_speed(velocity: f64, acceleration: f64, height: f64) -> f64 {
    if height == 0.0 {
        return velocity.abs();
    }
    velocity.hypot((2.0 * acceleration).sqrt() * height.sqrt())
}
