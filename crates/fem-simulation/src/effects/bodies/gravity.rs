//! Weight of the bodies.
//!
//! Within a contact the weight matters little if it is small compared with the contact force and a fall through the
//! approach is slow compared with the impact:
//!
//! ```math
//! \frac{m g}{F_{\max}}, \qquad \frac{\sqrt{g\,\delta_{\max}}}{v},
//! ```
//!
//! with Hertz' largest force and approach. Gravity is on if the case has it, since it brings the ball back. To first order
//! in the square x of the second number, contact time grows by the share 0.375 x (integral of the motion) and peak force by
//! 1.2 x (energy at the largest approach).

use fem_case::Scene;
use fem_case::engineering::number;

use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::{Effect, Gravity};
use crate::estimate::Estimate;

/// ∂ ln T and ∂ ln F over g δ/v² in Hertz' contact.
const TIME_AND_FORCE: [f64; 2] = [0.375, 1.2];
/// Largest first number and square of the second at which gravity does not change the printed results of the contact.
const NEGLIGIBLE_GRAVITY: f64 = 1e-6;

impl Effect for Gravity {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let Some(gravity) = scene.gravity() else {
            return Some(Relevance {
                number: "the case has none".to_string(),
                ..Relevance::default()
            });
        };
        let hertz = &estimate.hertz;
        let weight = gravity.acceleration * hertz.pair().effective_mass() / hertz.peak_force();
        let fall = (gravity.acceleration * hertz.max_approach()).sqrt() / hertz.approach_speed();
        let ratios = [weight, fall].map(|ratio| number(ratio, 2));
        let mut number = format!(
            "weight / peak force = {}; speed of a fall through the approach / approach speed = {}",
            ratios[0], ratios[1]
        );
        if weight.max(fall * fall) < NEGLIGIBLE_GRAVITY {
            number += "; it acts in flight and does not change the contact";
        }
        Some(Relevance { is_needed: true, number, ..Relevance::default() })
    }

    /// Applies to the first contact; without gravity there is no other.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let acceleration = scene.gravity().map_or(0.0, |gravity| gravity.acceleration);
        let hertz = &estimate.hertz;
        let share = acceleration * hertz.max_approach() / hertz.approach_speed().powi(2);
        let [time, force] = TIME_AND_FORCE.map(|of| of * share);
        Some(NeglectError::shares(estimate, time, force))
    }
}
