//! The results of cases that were run.

use std::ops::Deref;
use std::sync::Arc;

use fem_case::Case;
use fem_collision::Collision;
use fem_contact::ContactInterface;
use fem_explicit::ExplicitBodies;
use fem_laws::HertzImpact;

use crate::error::StudyError;

/// A case of any model and its result; the run ended by itself.
#[derive(Clone, Debug)]
pub struct Run {
    /// The case that was run.
    pub case: Case,
    /// Hertz' impact with instantaneous moduli.
    pub hertz: HertzImpact,
    /// Result of the run.
    pub collision: Collision,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Wall time of the run, s.
    pub seconds: f64,
}

/// Quantities that the model does not compute are NaN.
impl Run {
    /// Returns the contact time, s.
    pub fn contact_time(&self) -> f64 {
        known(self.collision.contact_time)
    }

    /// Returns the largest contact force, N.
    pub fn peak_force(&self) -> f64 {
        known(self.collision.peak_force)
    }

    /// Returns the largest approach, m.
    pub fn max_approach(&self) -> f64 {
        known(self.collision.max_approach)
    }

    /// Returns the radius of the smaller sphere, m.
    pub fn smallest_radius(&self) -> f64 {
        let diameters = self.case.scene().bodies().iter().filter_map(|body| body.diameter());
        0.5 * diameters.fold(f64::INFINITY, f64::min)
    }

    /// Returns the largest contact radius, m.
    pub fn max_contact_radius(&self) -> f64 {
        known(self.collision.max_contact_radius)
    }

    /// Returns the largest pressure on the axis, Pa.
    pub fn peak_pressure(&self) -> f64 {
        known(self.collision.peak_pressure)
    }

    /// Returns the largest energy residual over the energy of approach.
    pub fn energy_residual(&self) -> f64 {
        known(self.collision.residual_relative)
    }

    /// Returns the largest drift of momentum over Σ m|v|.
    pub fn momentum_residual(&self) -> f64 {
        known(self.collision.momentum_residual_relative)
    }

    /// Returns the velocities of both bodies after the collision along +y, m/s.
    pub fn velocity_after(&self) -> [f64; 2] {
        self.collision.bodies.each_ref().map(|body| known(body.velocity_after))
    }

    /// Returns the peak pressure over that of Hertz at this run's own peak force, p0 ∝ F^(1/3), which does not depend on
    /// the error of the force.
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
    /// Meshes, bodies and contact at the end of the run.
    pub model: Arc<ExplicitBodies>,
    /// Results that every model has.
    pub run: Run,
}

impl ExplicitRun {
    /// Returns the penalty springs between the bodies.
    pub fn springs(&self) -> Result<&ContactInterface, StudyError> {
        self.model.interface().ok_or_else(no_springs)
    }
}

/// Returns the error for a contact that is not made of penalty springs alone.
pub(crate) fn no_springs() -> StudyError {
    StudyError::parameters(
        "the study needs a contact of penalty springs only; set effects.surface_slip = \"off\" for unlike bodies",
    )
}

impl Deref for ExplicitRun {
    type Target = Run;

    fn deref(&self) -> &Run {
        &self.run
    }
}
