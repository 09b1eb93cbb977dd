//! Tangential quantities of an oblique impact, and their error bars.
//!
//! The velocity of the rebounding patch has the errors of its own computation ([`fem_collision::TangentialErrors`]) and that of the
//! restitution e, since the tangential impulse of surfaces that slide grows as 1 + e; of surfaces that stick it changes less.

use fem_case::Scene;
use fem_collision::{Collision, TangentialResult};

use super::summary::{Parts, Tangential, TangentialParts};
use crate::effects::FrictionEffect;
use crate::models::patch_velocity;

/// Change of what the rebound of the patch depends on by an uncertain input: of the velocity of the patch before (m/s), and the relative
/// ones of the coefficient of friction, the speed of approach and the tangential stiffness over the normal one.
#[derive(Clone, Copy, Debug)]
pub(super) struct PatchChange(pub [f64; 4]);

impl PatchChange {
    /// Returns the change from a scene to another one.
    pub fn between(own: &Scene, other: &Scene) -> Self {
        let share = |of: fn(&Scene) -> f64| match (of(own), of(other)) {
            (own, other) if own == other => 0.0,
            (own, other) => other / own - 1.0,
        };
        Self([
            patch_velocity(other) - patch_velocity(own),
            share(Scene::friction),
            share(Scene::approach_speed),
            share(|scene| FrictionEffect::coupling(scene).stiffness_ratio),
        ])
    }

    /// Returns the changes of the tangential restitution, the angle of the rebound (degrees) and the impulse ratio. The velocity after
    /// over that before depends on ψ₁ and the stiffness alone, since impacts of any speed are similar.
    fn of_result(&self, result: &TangentialResult, away: f64) -> [f64; 3] {
        let Self([velocity, friction, approach, stiffness]) = *self;
        let [before, after] = result.patch_velocity;
        let [per_velocity, per_stiffness] = result.errors.slopes;
        let unit = friction + approach;
        let change =
            per_velocity * (velocity - before * unit) + after * unit + per_stiffness * stiffness;
        let turned = away * (change - after * approach) / (away * away + after * after);
        let ratio = match before == after {
            true => 0.0,
            false => result.impulse_ratio * ((velocity - change) / (before - after) - approach),
        };
        [(change - after / before * velocity) / before, turned.to_degrees(), ratio]
    }
}

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

/// Returns the error bars of the quantities, from those of the restitution and the contact radius and the changes by uncertain inputs.
pub(super) fn parts(
    collision: &Collision,
    of_restitution: Parts,
    of_radius: Parts,
    inputs: &[PatchChange],
) -> Option<TangentialParts> {
    let result = collision.tangential.as_ref()?;
    let restitution = collision.restitution?;
    let [before, after] = result.patch_velocity;
    let speed = collision.approach.speed();
    let (away, errors) = (restitution * speed, &result.errors);
    let radius = collision.max_contact_radius.unwrap_or(f64::INFINITY);
    // The stiffness grows with the radius: two estimates of the error by the same mesh.
    let by_radius = errors.slopes[1].abs() * of_radius.discretisation.unwrap_or(0.0) / radius;
    let own = errors.discretisation.map(|own| own.max(by_radius));
    // Of the tangential velocity per restitution.
    let slope = (after - before) / (1.0 + restitution);
    let by_inputs: Vec<_> = inputs.iter().map(|input| input.of_result(result, away)).collect();
    let bars = |k: usize, of_velocity: &dyn Fn(f64, f64) -> f64| {
        let bar = |own: Option<f64>, of_restitution: Option<f64>| {
            Some(of_velocity(own?, of_restitution?).abs())
        };
        let squares = by_inputs.iter().map(|changes| changes[k] * changes[k]);
        let by_inputs = squares.sum::<f64>().sqrt();
        Parts {
            discretisation: bar(own, of_restitution.discretisation),
            model: bar(errors.model, of_restitution.model),
            input: bar(Some(0.0), of_restitution.input).map(|of_e| of_e + by_inputs),
            bound: None,
        }
    };
    let whole = |own: f64, of_e: f64| own + (slope * of_e).abs();
    let steepness = (away * away + after * after).recip();
    let per_velocity = (before - after) / result.impulse_ratio;
    Some(TangentialParts {
        tangential_restitution: match before == 0.0 {
            true => Parts::default(),
            false => bars(0, &|own, of_e| whole(own, of_e) / before),
        },
        contact_patch_rebound_deg: bars(1, &|own, of_e| {
            let turned = (away * whole(own, of_e) + (after * speed * of_e).abs()) * steepness;
            turned.to_degrees()
        }),
        impulse_ratio: bars(2, &|own, of_e| match result.impulse_ratio == 0.0 {
            true => 0.0,
            // Both impulses grow alike while the surfaces slide.
            false => own / per_velocity + result.impulse_ratio * of_e / (1.0 + restitution),
        }),
    })
}

/// Returns the direction of the patch before the impact; 1 if it stands.
fn sign(result: &TangentialResult) -> f64 {
    if result.patch_velocity[0] < 0.0 { -1.0 } else { 1.0 }
}
