//! The rebound of a pair over the coefficient of friction and the tangential velocity, on one impact along the axis.
//!
//! The springs of an impact along the axis ([`NormalSprings`]) serve every friction and every tangential velocity, since friction does
//! not alter them. The velocities are those of the ball ([`Scene::ball`]) relative to the other body.

use fem_case::Scene;
use fem_laws::NormalSprings;

use crate::effects::FrictionEffect;
use crate::models::ComputedScene;
use crate::models::method::SharedModels;
use crate::models::oblique::ObliqueBodies;
use crate::rejection::Rejection;

/// The friction of the scene from which the response is made; it changes nothing of the impact along the axis.
const ANY_FRICTION: f64 = 0.1;

/// The tangential response of a pair at one approach speed.
#[derive(Clone, Debug)]
pub struct ObliqueResponse {
    bodies: ObliqueBodies,
    springs: NormalSprings,
    speed: f64,
    /// Restitution along the axis by the model.
    pub restitution: f64,
    /// Model-form error of the restitution; `None` if it is not known.
    pub restitution_error: Option<f64>,
}

/// The rebound of a ball from an oblique impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObliqueRebound {
    /// Direction of the ball against the axis, rad; negative if it goes back.
    pub rebound_angle: f64,
    /// Direction of the contact patch against the axis, rad; negative if it goes back.
    pub contact_patch_rebound: f64,
    /// Tangential velocity of the ball, m/s.
    pub tangential_velocity: f64,
    /// Angular velocity of the ball, rad/s, right-handed about x × y.
    pub spin: f64,
    /// Velocity of the contact patch after over before; NaN if it stands before.
    pub tangential_restitution: f64,
    /// Tangential over normal impulse.
    pub impulse_ratio: f64,
    /// Velocity ψ₁ of the patch before, in units of that at which it slides.
    pub psi: f64,
}

impl ObliqueResponse {
    /// Computes the impact along the axis of a scene's bodies at an approach speed, m/s.
    ///
    /// # Errors
    /// A scene whose friction its model does not compute, or whose bodies stay together.
    pub fn of(scene: &Scene, speed: f64) -> Result<Self, Rejection> {
        let reject = |message: &str, help: &str| {
            Rejection::new("contact.friction", message.to_string()).with_help(help)
        };
        if scene.gravity().is_some() {
            let help = "remove [gravity], and give approach_speed";
            return Err(reject("a rebound with friction is not found under gravity", help));
        }
        let slow = || reject("the approach speed is not positive", "give approach_speed");
        let scene = scene.touching_at(speed).ok_or_else(slow)?.rubbing(ANY_FRICTION, speed);
        let computed = ComputedScene::of(&scene)?;
        let model = computed.model(&SharedModels::default())?;
        let setup = computed.setup_of(model.as_ref())?;
        let bodies = ObliqueBodies::of(&computed.selected.regime.scene)?;
        let (collision, springs) =
            model.collide_on_springs(&setup.approach, &setup.request, &mut ());
        if let Some(stop) = collision.stop() {
            return Err(reject(&stop.to_string(), "compute the case alone to see why"));
        }
        let (Some(bodies), Some(springs), Some(restitution)) =
            (bodies, springs, collision.restitution)
        else {
            let help = "use a higher speed, or model ting";
            return Err(reject("the bodies stay together, and nothing rebounds", help));
        };
        let restitution_error = setup.restitution_error(&scene, |_| true);
        Ok(Self { bodies, springs, speed, restitution, restitution_error })
    }

    /// Returns this response on half as many springs and steps, which takes a quarter of the time.
    #[must_use]
    pub fn coarser(&self) -> Self {
        Self { springs: self.springs.coarser(), ..self.clone() }
    }

    /// Returns the velocity of the contact patch after the impact, m/s, from that before it.
    pub fn patch_after(&self, friction: f64, before: f64) -> f64 {
        self.bodies.contact().clone().with_friction(friction).impact(&self.springs, before).velocity
    }

    /// Returns the tangential modulus before relaxation, Pa; see [`fem_laws::TangentialContact`].
    pub fn modulus(&self) -> f64 {
        self.bodies.contact().modulus()
    }

    /// Returns the effective mass of the motion along the axis over that of the patch, 7/2 for solid spheres.
    pub fn mass_ratio(&self) -> f64 {
        self.bodies.normal_mass() / self.bodies.contact().mass()
    }

    /// Returns the rebound with a coefficient of friction of a ball with a tangential velocity, m/s. A measured `restitution` takes the
    /// place of the computed one.
    pub fn rebound(
        &self,
        friction: f64,
        velocity: f64,
        restitution: Option<f64>,
    ) -> ObliqueRebound {
        let contact = self.bodies.contact().clone().with_friction(friction);
        let impact = contact.impact(&self.springs, self.bodies.patch_velocity(velocity));
        self.after(friction, velocity, restitution, impact.impulse)
    }

    /// Returns the same rebound with the velocity of its patch off by the error by springs, steps, finite size and coupling; `None` if
    /// that is not known.
    pub fn erring(
        &self,
        friction: f64,
        velocity: f64,
        restitution: Option<f64>,
    ) -> Option<ObliqueRebound> {
        let bodies = self.bodies.with_friction(friction);
        let before = bodies.patch_velocity(velocity);
        let impact = bodies.contact().impact(&self.springs, before);
        let errors = bodies.errors(self.speed, &self.springs, &impact, before);
        let change = errors.discretisation? + errors.model?;
        let impulse = impact.impulse - bodies.contact().mass() * change;
        Some(self.after(friction, velocity, restitution, impulse))
    }

    /// Returns the rebound after a tangential impulse at the computed restitution, N s.
    fn after(
        &self,
        friction: f64,
        velocity: f64,
        restitution: Option<f64>,
        impulse: f64,
    ) -> ObliqueRebound {
        let before = self.bodies.patch_velocity(velocity);
        let away = restitution.unwrap_or(self.restitution);
        let impulse = impulse * (1.0 + away) / (1.0 + self.restitution);
        let normal = self.bodies.normal_mass() * (1.0 + away) * self.speed;
        let (tangential_velocity, spin) = self.bodies.ball_after(velocity, impulse);
        let after = before - impulse / self.bodies.contact().mass();
        let sign = |velocity: f64| if velocity < 0.0 { -1.0 } else { 1.0 };
        let angle = |tangential: f64| tangential.atan2(away * self.speed);
        let ratio = FrictionEffect::coupling(self.bodies.scene()).stiffness_ratio;
        ObliqueRebound {
            rebound_angle: angle(sign(velocity) * tangential_velocity),
            contact_patch_rebound: angle(sign(before) * after),
            tangential_velocity,
            spin,
            tangential_restitution: after / before,
            impulse_ratio: sign(before) * impulse / normal,
            psi: ratio * before.abs() / (friction * self.speed),
        }
    }
}
