//! A body on a partner so large that waves do not return during the contact.
//!
//! The partner then acts as a half-space that does not move as a whole: the body collides with an infinite mass, at the
//! rate δ̇′ of its own centre. The partner's mass centre receives the impulse nevertheless, so that for both mass centres
//!
//! ```math
//! \dot\delta = \dot\delta' - \frac mM\,(v-\dot\delta'), \qquad
//! \delta = \delta' - \frac mM\,(vt-\delta'), \qquad e = e' + \frac mM\,(1+e'),
//! ```
//!
//! and the part ½MV² of the radiated energy, V = (m/M)(v − δ̇′), is the kinetic energy of the partner.

use std::sync::Arc;

use fem_case::{Body, Scene};
use fem_laws::{Impact, ImpactInstant, LawError, Pair, Ting, restitution_of_mass_centres};
use fem_material::Material;

use crate::estimate::Estimate;
use crate::estimate::quasi_static::ting_of;

/// Returns Ting's impact of an estimated scene with radiating bodies, given by their materials; `finish` sets the accuracy.
pub(crate) fn radiating_impact(
    scene: &Scene,
    radiating: &[Option<Material>; 2],
    estimate: &Estimate,
    finite_size: bool,
    finish: impl FnOnce(Ting) -> Result<Ting, LawError>,
) -> Result<Impact, LawError> {
    let (partner, speed) = (Partner::of(scene, radiating), estimate.hertz.approach_speed());
    // The large partner keeps its curvature, is held, and has the compliance of a half-space.
    let [first, second] = [0, 1].map(|side: usize| {
        let body = scene.bodies()[side].partner();
        let is_large = partner.as_ref().is_some_and(|partner| partner.side == side);
        if is_large { body.held() } else { body }
    });
    let pair = Pair::new(first, second)?;
    let half_space = partner.as_ref().map(|partner| scene.with_half_space(partner.side));
    let size =
        finite_size.then(|| half_space.as_ref().unwrap_or(scene).finite_size()).transpose()?;
    let ting = finish(ting_of(scene, &pair, true, size)?)?;
    let ting = ting.with_radiation(radiating.iter().flatten())?;
    let impact = Arc::unwrap_or_clone(estimate.impacts.impact(ting, speed)?);
    Ok(match partner {
        Some(Partner { mass, mass_ratio, .. }) => of_mass_centres(impact, mass, mass_ratio, speed),
        None => impact,
    })
}

/// The only radiating sphere, on which the other body moves alone.
struct Partner {
    /// The lower body (0) or the upper one (1).
    side: usize,
    /// Mass of the other body, kg.
    mass: f64,
    /// Mass of the other body over its own.
    mass_ratio: f64,
}

impl Partner {
    fn of(scene: &Scene, radiating: &[Option<Material>; 2]) -> Option<Self> {
        let [below, above] = scene.bodies().each_ref().map(Body::mass);
        let (side, mass, its) = match radiating {
            [Some(_), None] => (0, above?, below?),
            [None, Some(_)] => (1, below?, above?),
            _ => return None,
        };
        Some(Self { side, mass, mass_ratio: mass / its })
    }
}

/// Converts the collision of a body of mass m (kg) at a speed v (m/s) to the motion of both mass centres; `mass_ratio` is
/// m/M.
fn of_mass_centres(alone: Impact, mass: f64, mass_ratio: f64, speed: f64) -> Impact {
    let instant = |alone: &ImpactInstant| {
        let lost = speed - alone.approach_rate;
        let of_partner = 0.5 * mass * mass_ratio * lost * lost;
        ImpactInstant {
            approach: alone.approach - mass_ratio * (speed * alone.time - alone.approach),
            approach_rate: alone.approach_rate - mass_ratio * lost,
            work: alone.work - of_partner,
            radiated: alone.radiated.map(|radiated| radiated - of_partner),
            ..*alone
        }
    };
    let history: Vec<ImpactInstant> = alone.history.iter().map(instant).collect();
    let approaches = history.iter().map(|instant| instant.approach);
    Impact {
        restitution: match alone.contact_time {
            Some(_) => restitution_of_mass_centres(alone.restitution, mass_ratio),
            None => 0.0,
        },
        max_approach: approaches.fold(0.0, f64::max),
        history,
        ..alone
    }
}
