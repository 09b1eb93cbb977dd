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

use crate::error::{LawError, not_negative, positive};

/// K, γ, C, n of F = K ξ^γ + C ξⁿ ξ̇, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    stiffness: f64,
    elastic_exponent: f64,
    damping: f64,
    damping_exponent: f64,
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
