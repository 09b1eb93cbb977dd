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

use fem_material::Material;

use crate::error::{LawError, positive};

/// The finite size of up to two spheres, at their instantaneous moduli.
#[derive(Debug, Clone, PartialEq)]
pub struct FiniteSize {
    spheres: Vec<SphereCompliance>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct SphereCompliance {
    radius: f64,
    /// 1/(E R), 1/(Pa m).
    unit: f64,
    /// c at R = a.
    constant: f64,
    /// dc/d ln(R/a).
    slope: f64,
}

/// δ = u + u^(3/2)(α − β ln u): the approach of Hertz u and the whole one, in units of a length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Correction {
    alpha: f64,
    beta: f64,
}

impl FiniteSize {
    /// Largest a/R of either sphere for which the first order is taken to hold.
    pub const MAX_CONTACT_RATIO: f64 = 0.1;

    /// Of the radius, m, and the material of each body; `None` is the rigid wall.
    ///
    /// # Errors
    /// A radius that is not positive and finite.
    pub fn new(
        first: Option<(f64, &Material)>,
        second: Option<(f64, &Material)>,
    ) -> Result<Self, LawError> {
        let spheres = [first, second].into_iter().flatten().map(|(radius, material)| {
            let radius = positive("radius", radius)?;
            let moduli = material.instantaneous();
            let (constant, slope) = coefficient(moduli.poissons_ratio());
            let unit = (moduli.youngs_modulus() * radius).recip();
            Ok(SphereCompliance { radius, unit, constant, slope })
        });
        Ok(Self { spheres: spheres.collect::<Result<_, LawError>>()? })
    }

    /// What is added to Hertz' approach, m, at a force, N, and a contact radius, m.
    pub fn added_approach(&self, force: f64, contact_radius: f64) -> f64 {
        let coefficient = |sphere: &SphereCompliance| {
            sphere.unit * (sphere.constant + sphere.slope * (sphere.radius / contact_radius).ln())
        };
        force * self.spheres.iter().map(coefficient).sum::<f64>()
    }

    /// In units of `length`, where the force is `force` u^(3/2) and a = `contact_radius` √u.
    pub(crate) fn correction(&self, length: f64, force: f64, contact_radius: f64) -> Correction {
        Correction {
            alpha: self.added_approach(force, contact_radius) / length,
            beta: 0.5 * force / length
                * self.spheres.iter().map(|sphere| sphere.unit * sphere.slope).sum::<f64>(),
        }
    }

    /// Whether the first order holds for a contact radius, m.
    ///
    /// # Errors
    /// A contact too large.
    pub fn check(&self, contact_radius: f64) -> Result<(), LawError> {
        let smallest =
            self.spheres.iter().map(|sphere| sphere.radius).fold(f64::INFINITY, f64::min);
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

impl Correction {
    /// Of half-spaces.
    pub const NONE: Self = Self { alpha: 0.0, beta: 0.0 };

    /// ∫F dδ of an elastic contact up to Hertz' u: with w = u^(3/2) the second part is ∫w dδ₂.
    pub fn strain_energy(&self, hertz: f64) -> f64 {
        let half_space = 0.4 * hertz * hertz * hertz.sqrt();
        if *self == Self::NONE || hertz == 0.0 {
            return half_space;
        }
        let cube = hertz * hertz * hertz;
        half_space + cube * (0.5 * (self.alpha - self.beta * hertz.ln()) - self.beta / 6.0)
    }

    /// u, and du/dδ there, at δ ≥ 0.
    pub fn hertz_approach(&self, approach: f64) -> (f64, f64) {
        if *self == Self::NONE || approach == 0.0 {
            return (approach, 1.0);
        }
        let mut hertz = approach;
        let mut slope = 1.0;
        // Newton's method from an error of 1e-2: 1e-4, 1e-8, 1e-16.
        for _ in 0..4 {
            let (root, log) = (hertz.sqrt(), hertz.ln());
            let factor = self.alpha - self.beta * log;
            slope = (1.0 + root * (1.5 * factor - self.beta)).recip();
            hertz -= (hertz + hertz * root * factor - approach) * slope;
        }
        (hertz, slope)
    }
}

/// c at R = a, and its slope in ln(R/a).
fn coefficient(nu: f64) -> (f64, f64) {
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

    /// δ(u) and du/dδ, put back.
    #[test]
    fn correction_is_inverted() {
        let correction = Correction { alpha: -0.03, beta: 0.002 };
        let whole = |u: f64| u + u * u.sqrt() * (correction.alpha - correction.beta * u.ln());
        for approach in [1e-30, 1e-9, 0.3, 1.0, 3.0] {
            let (hertz, slope) = correction.hertz_approach(approach);
            assert!((whole(hertz) / approach - 1.0).abs() < 1e-15);
            let h = 1e-6 * hertz;
            let secant = 2.0 * h / (whole(hertz + h) - whole(hertz - h));
            // Rounding over the width of the secant.
            assert!((slope - secant).abs() < 1e-9);
        }
        assert_eq!(Correction::NONE.hertz_approach(0.7), (0.7, 1.0));
    }
}
