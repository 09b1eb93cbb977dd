//! Weight of the bodies.
//!
//! Within a contact it is small where the weight is small beside the contact force and the ball falls
//! slowly over the approach: two numbers decide,
//!
//! ```math
//! \frac{m g}{F_{\max}}, \qquad \frac{\sqrt{g\,\delta_{\max}}}{v},
//! ```
//!
//! with Hertz' largest force and approach. Whatever they are, it is on where the case has it: it brings
//! the ball back.

use fem_case::Scene;

use super::effect::Effect;
use super::need::Need;
use crate::estimate::Estimate;

/// Both numbers below this: the contact is as without gravity, to rounding of what is printed.
const NEGLIGIBLE: f64 = 1e-6;

/// Weight of the bodies.
#[derive(Clone, Copy, Debug)]
pub struct Gravity;

impl Gravity {
    /// Its name in results.
    pub const NAME: &'static str = "gravity";
}

impl Effect for Gravity {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn need(&self, scene: &Scene, estimate: &Estimate) -> Option<Need> {
        let Some(gravity) = scene.gravity() else {
            return Some(Need { number: "the case has none".to_string(), ..Need::default() });
        };
        let hertz = &estimate.hertz;
        let weight = gravity.acceleration * hertz.pair().effective_mass() / hertz.peak_force();
        let fall = (gravity.acceleration * hertz.max_approach()).sqrt() / hertz.approach_speed();
        let mut number = format!("weight / peak force = {weight:.1e}, √(g δ)/v = {fall:.1e}");
        if weight.max(fall * fall) < NEGLIGIBLE {
            number += "; in the contact it changes nothing, the flight needs it";
        }
        Some(Need { is_called_for: true, number, ..Need::default() })
    }
}
