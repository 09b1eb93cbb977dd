//! Tangential quantities of an oblique impact, and their error bars.
//!
//! The velocity of the rebounding patch has the errors of its own computation ([`fem_collision::TangentialErrors`]) and that of the
//! restitution e, since the tangential impulse of surfaces that slide grows as 1 + e; of surfaces that stick it changes less.

use fem_case::Scene;
use fem_collision::{Collision, TangentialResult};

use super::summary::{Parts, Tangential, TangentialParts};
use crate::effects::FrictionEffect;

/// Returns the quantities; none of a head-on impact, or of bodies that stay together.
pub(super) fn quantities(scene: &Scene, collision: &Collision) -> Tangential {
    let rebound = collision.tangential.as_ref().zip(collision.restitution);
    let Some((result, restitution)) = rebound else { return Tangential::default() };
    let [before, after] = result.patch_velocity;
    let speed = collision.approach.speed();
    let away = restitution * speed;
    let friction = scene.friction();
    let unit = FrictionEffect::coupling(scene).stiffness_ratio * sign(result) / (friction * speed);
    let psi = |velocity: f64| (friction > 0.0).then_some(unit * velocity);
    Tangential {
        tangential_restitution: (before != 0.0).then(|| after / before),
        contact_patch_rebound_deg: Some((after * sign(result)).atan2(away).to_degrees()),
        impulse_ratio: Some(result.impulse_ratio),
        psi_before: psi(before),
        psi_after: psi(after),
    }
}

/// Returns the error bars of the quantities, from those of the restitution and the contact radius.
pub(super) fn parts(
    collision: &Collision,
    of_restitution: Parts,
    of_radius: Parts,
) -> Option<TangentialParts> {
    let result = collision.tangential.as_ref()?;
    let restitution = collision.restitution?;
    let [before, after] = result.patch_velocity;
    let speed = collision.approach.speed();
    let (away, errors) = (restitution * speed, &result.errors);
    let radius = collision.max_contact_radius.unwrap_or(f64::INFINITY);
    // Of the tangential velocity per restitution.
    let slope = (after - before) / (1.0 + restitution);
    let bars = |of_velocity: &dyn Fn(f64, f64) -> f64| {
        let bar = |own: Option<f64>, of_restitution: Option<f64>| {
            Some(of_velocity(own?, of_restitution?).abs())
        };
        let by_radius = of_radius.discretisation.unwrap_or(0.0) / radius;
        let own = errors.discretisation.map(|own| own + errors.per_stiffness * by_radius);
        let discretisation = bar(own, of_restitution.discretisation);
        let model = bar(errors.model, of_restitution.model);
        let input = match (errors.input, of_restitution.input) {
            (None, None) => None,
            (own, other) => bar(Some(own.unwrap_or(0.0)), Some(other.unwrap_or(0.0))),
        };
        Parts { discretisation, model, input, bound: None }
    };
    let whole = |own: f64, of_e: f64| own + (slope * of_e).abs();
    let steepness = (away * away + after * after).recip();
    let per_velocity = (before - after) / result.impulse_ratio;
    Some(TangentialParts {
        tangential_restitution: match before == 0.0 {
            true => Parts::default(),
            false => bars(&|own, of_e| whole(own, of_e) / before),
        },
        contact_patch_rebound_deg: bars(&|own, of_e| {
            let turned = (away * whole(own, of_e) + (after * speed * of_e).abs()) * steepness;
            turned.to_degrees()
        }),
        impulse_ratio: match result.impulse_ratio == 0.0 {
            true => bars(&|_, _| 0.0),
            false => bars(&|own, of_e| {
                // Both impulses grow alike while the surfaces slide.
                own / per_velocity + result.impulse_ratio * of_e / (1.0 + restitution)
            }),
        },
    })
}

/// Returns the direction of the patch before the impact; 1 if it stands.
fn sign(result: &TangentialResult) -> f64 {
    if result.patch_velocity[0] < 0.0 { -1.0 } else { 1.0 }
}
