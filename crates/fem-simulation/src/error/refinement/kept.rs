//! Why a mesh stays as it is, and settings of which a finer one is no cure.

use fem_case::CaseError;
use fem_collision::Collision;

use super::miss::Miss;
use crate::error::uncertainty::of_noise;
use crate::error::{far_mesh_errors, far_mesh_key, of_moved_mass};
use crate::simulation::Simulation;

/// Why a mesh stays as it is.
pub(super) enum Kept {
    Given,
    FromFile,
    Gravity,
    /// What else the case gives is off by more than it allows.
    Setting(Cause),
    /// More than is allowed is told of every mesh.
    Scatter(f64),
    Dear {
        updates: Option<u64>,
    },
    Refused(CaseError),
    Stopped(String),
}

/// A setting that a case gives, of which a finer mesh is no cure.
#[derive(Clone, Copy)]
pub(super) enum Cause {
    MovedMass,
    SoftSprings,
    RingingSprings,
    /// The key that gives it.
    FarMesh(&'static str),
}

impl Cause {
    /// What numbers are off by.
    pub(super) fn in_words(self) -> &'static str {
        match self {
            Self::MovedMass => "the mass that is moved",
            Self::SoftSprings => "springs that give way",
            Self::RingingSprings => "springs that ring",
            Self::FarMesh(_) => "the mesh away from the contact",
        }
    }

    /// What helps without it.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::MovedMass => "time.mass_scaling",
            Self::SoftSprings | Self::RingingSprings => "contact.penalty_factor",
            Self::FarMesh(key) => key,
        }
    }
}

impl Simulation {
    /// The setting of the case that is off by more than is allowed, whatever the mesh; of a collision or before one.
    pub(super) fn other_cause(&self, miss: &Miss, met: Option<&Collision>) -> Option<Cause> {
        let (scene, elements) = (self.case().scene(), self.setup().elements.as_ref()?);
        if miss.is_of_springs(elements) {
            return Some(Cause::SoftSprings);
        }
        let of_mass = of_moved_mass(elements.added_share, miss.headline);
        if scene.mass_scaling().is_some() && of_mass > miss.tolerance {
            return Some(Cause::MovedMass);
        }
        if let Some(key) = far_mesh_key(self) {
            let of_far_mesh = far_mesh_errors(self).and_then(|of| of[miss.headline as usize]);
            if of_far_mesh.is_some_and(|of| of > miss.tolerance) {
                return Some(Cause::FarMesh(key));
            }
        }
        let collision = met?;
        if is_of_noise(miss, collision) {
            return Some(Cause::RingingSprings);
        }
        // On average springs overlap by half as much, and the contact lasts longer as the approach grows.
        let overlap = collision.deepest.map_or(0.0, |deepest| deepest.overlap);
        let of_springs = 0.5 * overlap / collision.max_approach?;
        let is_soft = scene.penalty_factor().is_some_and(|factor| factor < 1.0);
        (is_soft && of_springs > miss.tolerance).then_some(Cause::SoftSprings)
    }
}

/// Whether what is missed is what noise is off by.
pub(super) fn is_of_noise(miss: &Miss, collision: &Collision) -> bool {
    of_noise(collision, miss.headline) > miss.tolerance
}
