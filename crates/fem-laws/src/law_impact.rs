//! A collision with a contact law on a body or on a thin plate.

use crate::contact_motion::ContactMotion;
use crate::dent_impact;
use crate::error::{LawError, not_negative, positive, tolerance as checked_tolerance};
use crate::impact::Impact;
use crate::laws::{ContactLaw, EndRule};
use crate::pair::Pair;

/// A pair with a contact law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawImpact {
    pair: Pair,
    law: ContactLaw,
    end_rule: EndRule,
    tolerance: f64,
    /// Gravity along the approach, m/s².
    gravity: f64,
    /// Mobility of a thin plate in series, m/(N s); 0 without a plate.
    plate_mobility: f64,
}

impl LawImpact {
    /// Accuracy of restitution, time and force that [`LawImpact::new`] asks for.
    pub const DEFAULT_TOLERANCE: f64 = 1e-8;

    /// Creates a model that ends at zero force, with the default tolerance.
    pub fn new(pair: &Pair, law: ContactLaw) -> Self {
        let (end_rule, tolerance) = (EndRule::default(), Self::DEFAULT_TOLERANCE);
        Self { pair: *pair, law, end_rule, tolerance, gravity: 0.0, plate_mobility: 0.0 }
    }

    /// Sets the rule for the end of contact.
    pub fn with_end_rule(self, end_rule: EndRule) -> Self {
        Self { end_rule, ..self }
    }

    /// Sets the tolerance, 1e-10 to 1e-2.
    ///
    /// # Errors
    /// A tolerance outside.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, LawError> {
        Ok(Self { tolerance: checked_tolerance(tolerance)?, ..self })
    }

    /// Adds gravity along the approach (m/s²), on a ball above a body that does not move.
    ///
    /// # Errors
    /// An acceleration that is negative or not finite.
    pub fn with_gravity(self, acceleration: f64) -> Result<Self, LawError> {
        Ok(Self { gravity: not_negative("gravity", acceleration)?, ..self })
    }

    /// Puts a thin plate in series with the contact, given by its mobility, m/(N s); see [`crate::plate_mobility`].
    ///
    /// # Errors
    /// A mobility that is not positive and finite.
    pub fn with_plate(self, mobility: f64) -> Result<Self, LawError> {
        Ok(Self { plate_mobility: positive("plate mobility", mobility)?, ..self })
    }

    /// Returns the collision at an approach speed, m/s.
    ///
    /// # Errors
    /// A speed that is not positive and finite; values so extreme that a result leaves the range
    /// of f64; a creep too long to follow.
    pub fn impact(&self, approach_speed: f64) -> Result<Impact, LawError> {
        let speed = positive("approach_speed", approach_speed)?;
        match self.law.elastic_plastic() {
            Some(dent) if self.plate_mobility == 0.0 => {
                dent_impact::collide(&self.pair, (&self.law, dent), self.gravity, speed)
            }
            _ => {
                let partner = (self.plate_mobility, self.gravity);
                let motion = ContactMotion::new(&self.pair, &self.law, partner, speed)?;
                motion.collide(self.end_rule, self.tolerance)
            }
        }
    }
}
