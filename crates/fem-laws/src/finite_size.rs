//! What a sphere's finite size adds to Hertz' half-space.
//!
//! A sphere of radius R is pressed over a contact a ≪ R and held by its own inertia, a uniform
//! body force. Its centre of mass comes nearer to the contact than a half-space's far field, in
//! first order of a/R, by
//!
//! ```math
//! \delta = \delta_{\text{Hertz}} + \sum_i c_i\frac{F}{E_iR_i}, \qquad
//! c = \frac{1+\nu}{4\pi}\left\{S(\nu) - 2(1-2\nu)
//! + 2(1-2\nu)^2\left[\tfrac{19}{12}+\ln2+\ln\tfrac Ra\right]\right\},
//! ```
//! ```math
//! S(\nu) = \sum_{n=0}^\infty\left[(2n+1)s_n - 4(1-\nu) - \frac{2(1-2\nu)^2}{n+\frac12}\right],
//! \quad s_n = \frac{4(1-\nu)n^2+2\nu n-2+4\nu}{2(n-1)\,[n^2+(1+2\nu)n+1+\nu]},
//! \quad 3s_1 = \frac{9(1-2\nu)}{5(1+\nu)}.
//! ```
//!
//! Derived here: 2G u_n/(R σ_n) = s_n is the radial displacement of a sphere under the Legendre
//! component σ_n of a pressure (Lurie, *Three-Dimensional Problems of Elasticity*, ch. 6); n = 1
//! is carried by the body force and measured from the centre of mass. The half-space takes
//! 4(1−ν) of every component, since midpoints n + ½ integrate an even function to all orders. The
//! rest is weighed with Hertz' pressure and, by reciprocity, with a flat punch's: that gives
//! 19/12 − 2 ln 2. Force and displacement along the axis instead of the radius are worth
//! −2(1−2ν): a quarter for the force, three for the displacement. So this is the linear theory
//! that small-strain finite elements with contact along the axis approach; finite rotation of
//! the surface is of the same order in a/R. Limits: a/R at most [`FiniteSize::MAX_CONTACT_RATIO`].
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

use fem_material::Material;

use crate::PairRelaxation;
use crate::error::LawError;
use crate::finite_correction::{Correction, RelaxingCorrection};
use crate::sphere_compliance::{Parts, SphereCompliance};

/// The finite size of up to two spheres.
#[derive(Debug, Clone, PartialEq)]
pub struct FiniteSize {
    spheres: Vec<SphereCompliance>,
}

impl FiniteSize {
    /// Largest a/R of either sphere for which the first order is taken to hold.
    pub const MAX_CONTACT_RATIO: f64 = 0.1;

    /// Of the radius, m, and the material of each body; `None` is the rigid wall.
    ///
    /// # Errors
    /// A radius that is not positive and finite; relaxation times that leave the range of f64.
    pub fn new(
        first: Option<(f64, &Material)>,
        second: Option<(f64, &Material)>,
    ) -> Result<Self, LawError> {
        let spheres = [first, second].into_iter().flatten();
        let spheres = spheres.map(|(radius, material)| SphereCompliance::new(radius, material));
        Ok(Self { spheres: spheres.collect::<Result<_, LawError>>()? })
    }

    /// What is added to Hertz' approach, m, at a force, N, and a contact radius, m, before any
    /// relaxation.
    pub fn added_approach(&self, force: f64, contact_radius: f64) -> f64 {
        let instantaneous = SphereCompliance::instantaneous;
        force * self.compliance(contact_radius, instantaneous)
    }

    /// In units of `length`, where the force is `force` u^(3/2), a = `contact_radius` √u, and
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

    /// Σ c/(E R), 1/(Pa m), with the coefficients c at R = a and their slopes.
    fn compliance(
        &self,
        contact_radius: f64,
        coefficient: impl Fn(&SphereCompliance) -> Parts,
    ) -> f64 {
        let of_sphere = |sphere: &SphereCompliance| {
            let [constant, slope] = coefficient(sphere);
            sphere.unit() * (constant + slope * (sphere.radius() / contact_radius).ln())
        };
        self.spheres.iter().map(of_sphere).sum()
    }

    /// Whether the first order holds for a contact radius, m.
    ///
    /// # Errors
    /// A contact too large.
    pub fn check(&self, contact_radius: f64) -> Result<(), LawError> {
        let smallest =
            self.spheres.iter().map(SphereCompliance::radius).fold(f64::INFINITY, f64::min);
        let value = contact_radius / smallest;
        if value <= Self::MAX_CONTACT_RATIO {
            Ok(())
        } else {
            let (quantity, limit) =
                ("finite_size contact radius / radius", Self::MAX_CONTACT_RATIO);
            Err(LawError::OutsideValidity { quantity, value, limit })
        }
    }
}

/// c at R = a, and its slope in ln(R/a).
pub(crate) fn coefficient(nu: f64) -> (f64, f64) {
    let logarithm = 2.0 * (1.0 - 2.0 * nu).powi(2);
    let scale = (1.0 + nu) / (4.0 * std::f64::consts::PI);
    let weighing = 19.0 / 12.0 + std::f64::consts::LN_2;
    let axial = 2.0 * (1.0 - 2.0 * nu);
    (scale * (series(nu) - axial + logarithm * weighing), scale * logarithm)
}

/// S(ν). The summand falls as 1/n², so that of the sums to N the combination 2 S(2N) − S(N)
/// leaves an error of order 1/N².
fn series(nu: f64) -> f64 {
    const N: usize = 4096;
    let logarithm = 2.0 * (1.0 - 2.0 * nu).powi(2);
    let summand = |index: usize| {
        let n = index as f64;
        let response = if index == 1 {
            1.8 * (1.0 - 2.0 * nu) / (1.0 + nu)
        } else {
            let numerator = 4.0 * (1.0 - nu) * n * n + 2.0 * nu * n - 2.0 + 4.0 * nu;
            let denominator = (n - 1.0) * (n * n + (1.0 + 2.0 * nu) * n + 1.0 + nu);
            (n + 0.5) * numerator / denominator
        };
        response - 4.0 * (1.0 - nu) - logarithm / (n + 0.5)
    };
    let near: f64 = (0..N).map(summand).sum();
    let far: f64 = (N..2 * N).map(summand).sum();
    near + 2.0 * far
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Radial displacement, weighed with Hertz' pressure and a flat punch's, summed over Legendre
    /// components for a finite contact, less the half-space's; the axial term apart.
    #[test]
    fn coefficient_is_the_limit_of_finite_contacts() {
        for nu in [-0.5, 0.0, 0.244, 0.45] {
            for ratio in [0.02f64, 0.005] {
                let axial = 2.0 * (1.0 - 2.0 * nu);
                let sum: f64 = (0..400_000)
                    .map(|index| {
                        let n = index as f64;
                        let response = if index == 1 {
                            1.8 * (1.0 - 2.0 * nu) / (1.0 + nu)
                        } else {
                            (2.0 * n + 1.0)
                                * (4.0 * (1.0 - nu) * n * n + 2.0 * nu * n - 2.0 + 4.0 * nu)
                                / (2.0 * (n - 1.0) * (n * n + (1.0 + 2.0 * nu) * n + 1.0 + nu))
                        };
                        let k = (n + 0.5) * ratio;
                        let (sin, cos) = k.sin_cos();
                        // The cancellation below 0.05 leaves the fourth order.
                        let load = if k < 0.05 {
                            1.0 - k * k * (1.0 / 6.0 + 1.0 / 10.0)
                        } else {
                            3.0 * sin * (sin - k * cos) / k.powi(4)
                        };
                        (response - 4.0 * (1.0 - nu)) * load
                    })
                    .sum();
                let expected = (1.0 + nu) / (4.0 * std::f64::consts::PI) * (sum - axial);
                let (constant, slope) = coefficient(nu);
                let found = constant - slope * ratio.ln();
                // The next order in a/R.
                assert!((found - expected).abs() < 3.0 * ratio, "{nu} {ratio} {found} {expected}");
            }
        }
    }

    /// The project's fit to other calculations: c = −0.511 + 0.0519 ln(R/a) at ν = 0.244.
    #[test]
    fn coefficient_of_glass() {
        let (constant, slope) = coefficient(0.244);
        assert!((slope - 0.0519).abs() < 0.5e-4);
        // Finite elements (tests/ting.rs) side with this value.
        assert!((constant + 0.5402).abs() < 0.5e-4, "{constant}");
    }
}
