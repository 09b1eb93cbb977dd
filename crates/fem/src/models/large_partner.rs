//! A body beside a partner so large that waves do not come back within the contact.
//!
//! Until they do, the partner is a half-space to the contact and moves nowhere as a whole: the body's
//! collision is that with an infinite mass, at the rate δ̇′ of its own centre. The partner's mass centre has
//! the impulse all the same, so that of both mass centres
//!
//! ```math
//! \dot\delta = \dot\delta' - \frac mM\,(v-\dot\delta'), \qquad
//! \delta = \delta' - \frac mM\,(vt-\delta'), \qquad e = e' + \frac mM\,(1+e'),
//! ```
//!
//! and ½MV² of what has left as waves, V = (m/M)(v − δ̇′), is the motion of the partner.

use fem_laws::{Impact, ImpactInstant, restitution_of_mass_centres};

/// A collision of a body of the mass m (kg) alone, at a speed v (m/s), as one of both mass centres;
/// `mass_ratio` is m/M.
pub(super) fn of_mass_centres(alone: Impact, mass: f64, mass_ratio: f64, speed: f64) -> Impact {
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
