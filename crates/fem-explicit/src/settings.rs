//! Numerical settings of a model.

use crate::error::ModelError;

/// Numerical settings of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Penalty factor times the pair's contact modulus E*, Pa.
    pub contact_stiffness: f64,
    /// Radius of the candidate region, in which contact is searched for, m.
    pub candidate_radius: f64,
    /// Time step over critical time step, in (0, 1].
    pub step_factor: f64,
    /// Largest mass that mass scaling moves within a body, in [0, 1): as a fraction of its own mass, or of `mass_times`
    /// times the mass of the lighter body if that is less.
    pub mass_scaling: f64,
    /// Factors on the mass of the lighter body in [`Settings::mass_scaling`], for the lower and the upper body. 1 suits a
    /// large body that follows a small one at the contact; a stiff body that hardly moves may have more.
    pub mass_times: [f64; 2],
}

impl Settings {
    /// Checks the ranges of step factor and mass scaling.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        let &Self { step_factor, mass_scaling, mass_times, .. } = self;
        check_step_factor(step_factor)?;
        let (name, allowed) = ("mass scaling", "at least 0 and below 1");
        if !(0.0..1.0).contains(&mass_scaling) {
            return Err(ModelError::Setting { name, value: mass_scaling, allowed });
        }
        let (name, allowed) = ("times of the lighter mass", "positive and finite");
        match mass_times.into_iter().find(|times| !(*times > 0.0 && times.is_finite())) {
            Some(value) => Err(ModelError::Setting { name, value, allowed }),
            None => Ok(()),
        }
    }
}

/// Checks the range of a step factor.
pub(crate) fn check_step_factor(value: f64) -> Result<(), ModelError> {
    if value > 0.0 && value <= 1.0 {
        return Ok(());
    }
    Err(ModelError::Setting { name: "step factor", value, allowed: "above 0 and at most 1" })
}
