//! Cases that were run.

use std::ops::Deref;
use std::sync::Arc;

use fem_case::Case;
use fem_collision::Collision;
use fem_contact::ContactInterface;
use fem_explicit::Model;
use fem_laws::HertzImpact;

use crate::error::StudyError;

/// A case of any model and what came out of it; the run ended by itself.
#[derive(Clone, Debug)]
pub struct Run {
    /// The case that was run.
    pub case: Case,
    /// Hertz with instantaneous moduli.
    pub hertz: HertzImpact,
    /// Result of the run.
    pub collision: Collision,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Wall time of the run, s.
    pub seconds: f64,
}

/// Numbers that a model may not know are NaN where it does not.
impl Run {
    /// First to last contact, s.
    pub fn contact_time(&self) -> f64 {
        known(self.collision.contact_time)
    }

    /// Largest contact force, N.
    pub fn peak_force(&self) -> f64 {
        known(self.collision.peak_force)
    }

    /// Largest approach, m.
    pub fn max_approach(&self) -> f64 {
        known(self.collision.max_approach)
    }

    /// Returns the radius of the smaller sphere, m.
    pub fn smallest_radius(&self) -> f64 {
        let diameters = self.case.scene().bodies().iter().filter_map(|body| body.diameter());
        0.5 * diameters.fold(f64::INFINITY, f64::min)
    }

    /// Largest contact radius, m.
    pub fn max_contact_radius(&self) -> f64 {
        known(self.collision.max_contact_radius)
    }

    /// Largest pressure on the axis, Pa.
    pub fn peak_pressure(&self) -> f64 {
        known(self.collision.peak_pressure)
    }

    /// Worst imbalance of energy over the energy of approach.
    pub fn energy_residual(&self) -> f64 {
        known(self.collision.residual_relative)
    }

    /// Worst drift of momentum over Σ m|v|.
    pub fn momentum_residual(&self) -> f64 {
        known(self.collision.momentum_residual_relative)
    }

    /// Returns the velocities of both bodies after the collision along +y, m/s.
    pub fn velocity_after(&self) -> [f64; 2] {
        self.collision.bodies.each_ref().map(|body| known(body.velocity_after))
    }

    /// Centre pressure over that of Hertz at this run's own peak force, p0 ∝ F^(1/3): free of the
    /// error in force.
    pub fn pressure_over_hertz_at_force(&self) -> f64 {
        let over = self.peak_force() / self.hertz.peak_force();
        self.peak_pressure() / (self.hertz.peak_pressure() * over.cbrt())
    }
}

fn known(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

/// A run of the explicit model, with its meshes and contact.
#[derive(Debug)]
pub struct ExplicitRun {
    /// Meshes, bodies and contact, as they were in the end.
    pub model: Arc<Model>,
    /// Results that every model has.
    pub run: Run,
}

impl ExplicitRun {
    /// The penalty springs between the bodies.
    ///
    /// # Errors
    /// The contact is not made of penalty springs alone, for example with surface slip.
    pub fn springs(&self) -> Result<&ContactInterface, StudyError> {
        self.model.interface().ok_or_else(no_springs)
    }
}

/// Returns the error for a contact that is not made of penalty springs alone.
pub(crate) fn no_springs() -> StudyError {
    StudyError::parameters(
        "the study is of penalty springs alone, which this contact has not; unlike bodies have them with \
         effects.surface_slip = \"off\"",
    )
}

impl Deref for ExplicitRun {
    type Target = Run;

    fn deref(&self) -> &Run {
        &self.run
    }
}
