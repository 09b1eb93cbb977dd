//! A body that hardly gives way next to the other one is a rigid one of its own mass and curvature: one
//! degree of freedom in place of its elements. A transformation of the scene.
//!
//! Decided by the body's share s of the contact's compliance, s = k/(k₁+k₂), k = (1 − ν²)/E. Leaving it out
//! makes the contact modulus larger by 1/(1 − s), so that in Hertz' theory
//!
//! ```math
//! \frac{\Delta T}{T} = -\tfrac25\,s, \qquad \frac{\Delta F}{F} = \tfrac25\,s .
//! ```

use fem_case::{Body, EffectsTable, Scene, Switch};

use super::effect::Effect;
use super::left_out::LeftOut;
use super::need::Need;
use crate::estimate::Estimate;

/// Share of the compliance below which a body is rigid: 4e-5 of the contact time.
const RIGID_SHARE: f64 = 1e-4;

/// The stiffer body as a rigid one.
#[derive(Clone, Copy, Debug)]
pub struct RigidPartner;

impl RigidPartner {
    /// Its name in results.
    pub const NAME: &'static str = "rigid partner";
}

impl Effect for RigidPartner {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.rigid_partner
    }

    /// It saves work and changes next to nothing: a scene may allow it, none calls for it.
    fn need(&self, scene: &Scene, _: &Estimate) -> Option<Need> {
        let number = match stiffer(scene) {
            Some((body, share)) => format!("{} has {share:.1e} of the compliance", body.name()),
            None => "the partner is a wall".to_string(),
        };
        Some(Need { number, ..Need::default() })
    }

    fn left_out(&self, scene: &Scene, estimate: &Estimate) -> Option<LeftOut> {
        let Some((_, share)) = stiffer(scene).filter(|(_, share)| *share <= RIGID_SHARE) else {
            return Some(LeftOut::NOTHING);
        };
        Some(LeftOut::shares(estimate, 0.4 * share, 0.4 * share))
    }
}

/// The body that gives way less, and its share of the compliance; none beside a wall.
fn stiffer(scene: &Scene) -> Option<(&Body, f64)> {
    let [lower, upper] = scene.bodies();
    let compliance =
        |body: &Body| Some(body.material()?.instantaneous().plane_strain_modulus().recip());
    let (below, above) = (compliance(lower)?, compliance(upper)?);
    let (stiffer, least) = if below < above { (lower, below) } else { (upper, above) };
    Some((stiffer, least / (below + above)))
}
