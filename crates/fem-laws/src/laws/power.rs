//! The general law of a non-linear spring parallel to a non-linear dashpot.
//!
//! ```math
//! F = K\xi^\gamma + C\xi^n\dot\xi
//! ```
//!
//! Bordbar & Hyppänen (2007), eqs. 7 and 8 (eq. 8 misprints the damping as C ξ̇ⁿ). ξ is the overlap
//! (the approach of the undeformed surfaces). The dissipated share of the energy scales with the
//! approach speed as v^((2(n+1) − (γ+1))/(γ+1)), for γ = 3/2 as v^((4n−1)/5). Limits: K > 0, γ > 0,
//! C ≥ 0, n ≥ 0; loss of Kelvin's kind, without memory.

use super::elastic_plastic::ElasticPlastic;
use crate::error::{LawError, not_negative, positive};
use crate::numerics::bisection::last_where;
use crate::pair::Pair;

/// Exponent of Hertz' force law.
const HERTZ_EXPONENT: f64 = 1.5;

/// K, γ, C, n of F = K ξ^γ + C ξⁿ ξ̇, SI. A law that dents has no dashpot, and its spring only until it yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    stiffness: f64,
    elastic_exponent: f64,
    damping: f64,
    damping_exponent: f64,
    elastic_plastic: Option<ElasticPlastic>,
}

/// When a contact is over.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum EndRule {
    /// The force falls to zero: the surfaces cannot pull (Schwager & Pöschel 2007).
    #[default]
    ZeroForce,
    /// The overlap falls to zero; until then the dashpot may pull.
    ZeroOverlap,
}

/// Returns the law of K in N/m^γ, γ, C in N s/m^(n+1), n.
///
/// # Errors
/// K or γ not positive and finite; C or n negative or not finite.
pub fn power(
    stiffness: f64,
    elastic_exponent: f64,
    damping: f64,
    damping_exponent: f64,
) -> Result<ContactLaw, LawError> {
    Ok(ContactLaw {
        stiffness: positive("stiffness", stiffness)?,
        elastic_exponent: positive("elastic_exponent", elastic_exponent)?,
        damping: not_negative("damping", damping)?,
        damping_exponent: not_negative("damping_exponent", damping_exponent)?,
        elastic_plastic: None,
    })
}

impl ContactLaw {
    /// Returns the stiffness K, N/m^γ.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Returns the exponent γ of the spring.
    pub fn elastic_exponent(&self) -> f64 {
        self.elastic_exponent
    }

    /// Returns the damping C, N s/m^(n+1).
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// Returns the exponent n of the dashpot.
    pub fn damping_exponent(&self) -> f64 {
        self.damping_exponent
    }

    pub(super) fn with_elastic_plastic(self, law: ElasticPlastic) -> Self {
        Self { elastic_plastic: Some(law), ..self }
    }

    /// Returns how the contact dents; `None` for a spring and a dashpot.
    pub fn elastic_plastic(&self) -> Option<&ElasticPlastic> {
        self.elastic_plastic.as_ref()
    }

    /// Returns whether the law has a contact radius: Hertz', or that of a contact that dents.
    pub fn has_contact_radius(&self) -> bool {
        match &self.elastic_plastic {
            Some(law) => law.has_contact_radius(),
            None => self.elastic_exponent == HERTZ_EXPONENT,
        }
    }

    /// Returns the contact radius of a first loading, m, at an approach, m, if the law has one.
    pub fn contact_radius(&self, pair: &Pair, approach: f64) -> Option<f64> {
        self.has_contact_radius().then(|| match &self.elastic_plastic {
            Some(law) => law.contact_radius(approach),
            None => (pair.effective_radius() * approach).sqrt(),
        })
    }

    /// Returns the approach, m, at which a first loading reaches a force, N, without the dashpot.
    pub fn approach_under(&self, force: f64) -> f64 {
        match self.elastic_plastic {
            Some(_) => last_where(0.0, f64::MAX, |approach| self.loading_force(approach) <= force),
            None => (force / self.stiffness).powf(self.elastic_exponent.recip()),
        }
    }

    /// Returns K ξ^(γ+1)/(γ+1), J: the energy of the spring at an overlap, m.
    pub fn strain_energy(&self, overlap: f64) -> f64 {
        let exponent = self.elastic_exponent + 1.0;
        self.stiffness * overlap.max(0.0).powf(exponent) / exponent
    }

    /// Returns F, N, at an overlap, m, and its rate, m/s; negative (attraction) where damping outweighs
    /// the spring in separation; 0 for an open contact (ξ < 0).
    pub fn force(&self, overlap: f64, rate: f64) -> f64 {
        if overlap < 0.0 {
            return 0.0;
        }
        self.stiffness * overlap.powf(self.elastic_exponent)
            + self.damping * overlap.powf(self.damping_exponent) * rate
    }
}
