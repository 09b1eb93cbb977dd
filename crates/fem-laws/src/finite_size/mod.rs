//! Compliance that a sphere's finite size adds to Hertz' half-space.
//!
//! A sphere of radius R is pressed over a contact a ≪ R and held by its own inertia, a uniform
//! body force. Its centre of mass comes nearer to the contact than a half-space's far field, in
//! first order of a/R, by
//!
//! ```math
//! \delta = \delta_{\text{Hertz}} + \sum_i c_i\frac{F}{E_iR_i},
//! ```
//!
//! c of [`crate::finite_size::coefficient`]. Limits: a/R at most [`FiniteSize::MAX_CONTACT_RATIO`].
//!
//! A relaxing sphere has c/E of its moduli in Carson's transform, and F is E*(s) times the
//! pseudo-force K u^(3/2). With E*(s)/E*₀ = g∞ + Σ g_k s/(s+p_k) of [`crate::PairRelaxation`],
//!
//! ```math
//! m(s) = \sum_i\frac{c_i}{E_iR_i}(s)\,\frac{E^*(s)}{E^*_0}
//! = m_\infty + \sum_k \frac{m_k\,s}{s+p_k}, \qquad
//! m_k = g_k \sum_i\frac{c_i}{E_iR_i}(-p_k), \quad m_\infty + \sum_k m_k = m(\infty),
//! ```
//!
//! since the poles of c/E are zeros of E*. So δ − u is m∞ w + Σ m_k ∫ e^(−p_k(t−s)) dw of the
//! pseudo-force w. If both bodies relax alike with constant ν, c/E falls at every p_k to 0: the
//! correction is the instantaneous one. With an elastic bulk modulus ν rises as the shear modulus
//! relaxes, and the correction of glass grows by some per cent of itself.

mod coefficient;
pub(crate) mod correction;
mod sphere_compliance;

use fem_material::Material;

use crate::error::LawError;
use crate::finite_size::coefficient::Coefficient;
use crate::finite_size::correction::{Correction, RelaxingCorrection};
use crate::finite_size::sphere_compliance::{Parts, SphereCompliance};
use crate::numerics::ln;
use crate::pair_relaxation::PairRelaxation;

/// The finite size of up to two spheres.
#[derive(Debug, Clone, PartialEq)]
pub struct FiniteSize {
    spheres: Vec<SphereCompliance>,
    /// Largest a/R that is computed.
    largest_ratio: f64,
}

impl FiniteSize {
    /// Largest a/R of either sphere for which the first order is taken to hold.
    pub const MAX_CONTACT_RATIO: f64 = 0.1;

    /// Creates the correction from the radius, m, and the material of each body; `None` is a body that adds
    /// nothing to Hertz' half-space: the rigid wall, a half-space, a rigid sphere.
    ///
    /// # Errors
    /// A radius that is not positive and finite; relaxation times that leave the range of f64.
    pub fn new(
        first: Option<(f64, &Material)>,
        second: Option<(f64, &Material)>,
    ) -> Result<Self, LawError> {
        Self::of_loads(Coefficient::NORMAL, [first, second])
    }

    /// Creates the correction of a load across the axis, c_t of its own coefficient, as [`FiniteSize::new`] that of
    /// one along it.
    ///
    /// # Errors
    /// Those of [`FiniteSize::new`].
    pub fn tangential(bodies: [Option<(f64, &Material)>; 2]) -> Result<Self, LawError> {
        Self::of_loads(Coefficient::TANGENTIAL, bodies)
    }

    fn of_loads(
        coefficient: Coefficient,
        bodies: [Option<(f64, &Material)>; 2],
    ) -> Result<Self, LawError> {
        let spheres = bodies.into_iter().flatten();
        let spheres = spheres
            .map(|(radius, material)| SphereCompliance::new(coefficient, radius, material))
            .collect::<Result<_, LawError>>()?;
        Ok(Self { spheres, largest_ratio: Self::MAX_CONTACT_RATIO })
    }

    /// Returns the correction for a trial: contacts may be three times as large, where the first order is no result but leads a search
    /// back to its range.
    pub fn of_trial(self) -> Self {
        Self { largest_ratio: 3.0 * Self::MAX_CONTACT_RATIO, ..self }
    }

    /// Returns the approach (m) added to Hertz' at a force, N, and a contact radius, m, before any
    /// relaxation.
    pub fn added_approach(&self, force: f64, contact_radius: f64) -> f64 {
        let instantaneous = SphereCompliance::instantaneous;
        force * self.compliance(contact_radius, instantaneous)
    }

    /// Returns the correction in units of `length`, where the force is `force` u^(3/2), a = `contact_radius` √u, and
    /// the force relaxes as `relaxation`.
    pub(crate) fn correction(
        &self,
        length: f64,
        force: f64,
        contact_radius: f64,
        relaxation: &PairRelaxation,
    ) -> RelaxingCorrection {
        let part = |coefficient: &dyn Fn(&SphereCompliance) -> Parts| Correction {
            alpha: force * self.compliance(contact_radius, coefficient) / length,
            beta: 0.5 * force / length
                * self
                    .spheres
                    .iter()
                    .map(|sphere| sphere.unit() * coefficient(sphere)[1])
                    .sum::<f64>(),
        };
        let terms = relaxation.terms().iter();
        let fading: Vec<_> = terms.map(|term| part(&|sphere| sphere.fading(term))).collect();
        let mut equilibrium = part(&SphereCompliance::instantaneous);
        for fading in &fading {
            equilibrium.add(fading, -1.0);
        }
        RelaxingCorrection { equilibrium, fading }
    }

    /// Returns Σ c/(E R), 1/(Pa m), with the coefficients c at R = a and their slopes.
    fn compliance(
        &self,
        contact_radius: f64,
        coefficient: impl Fn(&SphereCompliance) -> Parts,
    ) -> f64 {
        let of_sphere = |sphere: &SphereCompliance| {
            let [constant, slope] = coefficient(sphere);
            sphere.unit() * (constant + slope * ln(sphere.radius() / contact_radius))
        };
        self.spheres.iter().map(of_sphere).sum()
    }

    /// Returns whether the first order holds for a contact radius, m.
    ///
    /// # Errors
    /// A contact too large.
    pub fn check(&self, contact_radius: f64) -> Result<(), LawError> {
        let smallest =
            self.spheres.iter().map(SphereCompliance::radius).fold(f64::INFINITY, f64::min);
        let value = contact_radius / smallest;
        if value <= self.largest_ratio {
            Ok(())
        } else {
            let (quantity, limit) = ("finite_size contact radius / radius", self.largest_ratio);
            Err(LawError::OutsideValidity { quantity, value, limit })
        }
    }
}
