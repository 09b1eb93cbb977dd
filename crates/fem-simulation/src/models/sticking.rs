//! The model of bodies that stick: the collision is that of bodies without adhesion, but those slower than the sticking
//! speed ([`Adhesion`]) stay together.
//!
//! They end with the velocity of their mass centre. The energy of their separation without adhesion, ½m*(ev)², moves from
//! [`Account::Kinetic`] to [`Account::Adhesion`]. History and fields are those without adhesion. With gravity each contact is
//! one collision with its own landing speed, so that a ball comes to rest by adhesion.

use fem_case::{Body, Scene};
use fem_collision::{Account, BodyResult, Collision, Ending};
use fem_laws::{Adhesion, NormalSprings};

use crate::effects::AdhesionEffect;
use crate::models::altered::Alteration;

/// The bond of two bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bond {
    adhesion: Adhesion,
    /// Which bodies do not move freely: walls, half-spaces and held spheres.
    is_fixed: [bool; 2],
}

impl Bond {
    /// Returns the bond of a scene's bodies; `None` if the case gives no work of adhesion, or 0.
    pub fn of(scene: &Scene) -> Option<Self> {
        let adhesion = AdhesionEffect::given(scene)?;
        let is_fixed = |body: &Body| body.is_held() || body.mass().is_none();
        let is_fixed = scene.bodies().each_ref().map(is_fixed);
        (adhesion.work_of_adhesion() > 0.0).then_some(Self { adhesion, is_fixed })
    }

    /// Returns the velocity of the bodies as one, m/s.
    fn joint_velocity(&self, collision: &Collision) -> f64 {
        let velocities = collision.approach.velocities();
        match self.is_fixed {
            [true, _] => velocities[0],
            [_, true] => velocities[1],
            _ => {
                let [lower, upper] = collision.bodies.map(|body| body.mass.unwrap_or_default());
                (lower * velocities[0] + upper * velocities[1]) / (lower + upper)
            }
        }
    }
}

impl Alteration for Bond {
    /// Returns a collision as it ends with the bond.
    fn applied(&self, collision: Collision, _: Option<NormalSprings>) -> Collision {
        let speed = collision.approach.speed();
        let restitution = match (&collision.ending, collision.restitution) {
            (Ending::Parted, Some(restitution)) if speed < self.adhesion.sticking_speed() => {
                restitution
            }
            _ => return collision,
        };
        let velocity = self.joint_velocity(&collision);
        let after = |k: usize| collision.bodies[k].velocity_after;
        let mass = self.adhesion.pair().effective_mass();
        let lost = 0.5 * mass * (restitution * speed).powi(2);
        // The work of a wall that moves is the difference between the losses in its frame and in that of the case.
        let free = (0..2).filter(|k| !self.is_fixed[*k] && self.is_fixed.contains(&true));
        let work: f64 = free
            .filter_map(|k| Some(collision.bodies[k].mass? * velocity * (velocity - after(k)?)))
            .sum();
        let mut energies = collision.energies;
        energies.add(Account::Kinetic, work - lost);
        energies.add(Account::Adhesion, lost);
        if work != 0.0 {
            energies.add(Account::WallWork, work);
        }
        let body = |k: usize| BodyResult {
            velocity_after: if self.is_fixed[k] { after(k) } else { after(k).map(|_| velocity) },
            vibration_energy: None,
            ..collision.bodies[k]
        };
        Collision {
            ending: Ending::Together,
            restitution: Some(0.0),
            contact_time: None,
            bodies: [body(0), body(1)],
            energies,
            ..collision
        }
    }
}
