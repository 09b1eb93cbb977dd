//! The coefficient c(ν, R/a) of what a sphere's finite size adds to Hertz' half-space: c F/(E R) of
//! [`crate::FiniteSize`].
//!
//! ```math
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
//! the surface is of the same order in a/R.
//!
//! A load across the axis, with the displacement along it relative to the mean motion of the body, has the same form
//! ([`Coefficient::TANGENTIAL`]):
//!
//! ```math
//! c_t = \frac{1+\nu}{4\pi}\left\{S_t(\nu) - (1-2\nu)
//! + (3-2\nu+4\nu^2)\left[\tfrac{19}{12}+\ln2+\ln\tfrac Ra\right]\right\},
//! ```
//!
//! with 2(2−ν) of the half-space. Its spherical harmonics are of order 1; with a direction of its own instead of the surface's force and
//! displacement are worth −(1−2ν) together.

/// One kind of load: along the axis or across it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coefficient {
    /// Displacement of the half-space under every component, the coefficient of ln(R/a), and what a force and a displacement are
    /// worth along one direction instead of the surface's own, for Poisson's ratio.
    parts: fn(f64) -> [f64; 3],
    /// Displacement under a component of a Legendre degree.
    response: fn(f64, f64) -> f64,
}

impl Coefficient {
    /// The coefficient c of a pressure.
    pub const NORMAL: Self = Self {
        parts: |nu| {
            let softness = 1.0 - 2.0 * nu;
            [4.0 * (1.0 - nu), 2.0 * softness * softness, -2.0 * softness]
        },
        response: |nu, n| {
            if n == 1.0 {
                return 1.8 * (1.0 - 2.0 * nu) / (1.0 + nu);
            }
            let numerator = 4.0 * (1.0 - nu) * n * n + 2.0 * nu * n - 2.0 + 4.0 * nu;
            let denominator = (n - 1.0) * (n * n + (1.0 + 2.0 * nu) * n + 1.0 + nu);
            (n + 0.5) * numerator / denominator
        },
    };

    /// The coefficient of a load across the axis.
    pub const TANGENTIAL: Self = Self {
        parts: |nu| [2.0 * (2.0 - nu), 3.0 - 2.0 * nu + 4.0 * nu * nu, 2.0 * nu - 1.0],
        response: |nu, n| (2.0 * n + 1.0) * across(nu, n),
    };

    /// Returns c at R = a, and its slope in ln(R/a).
    pub fn of(self, nu: f64) -> (f64, f64) {
        let [_, logarithm, axial] = (self.parts)(nu);
        let scale = (1.0 + nu) / (4.0 * std::f64::consts::PI);
        let weighing = 19.0 / 12.0 + std::f64::consts::LN_2;
        (scale * (self.series(nu) + axial + logarithm * weighing), scale * logarithm)
    }

    /// Returns the summand of S(ν).
    fn summand(self, nu: f64) -> impl Fn(usize) -> f64 + Copy {
        let [half_space, logarithm, _] = (self.parts)(nu);
        move |index| {
            let n = index as f64;
            (self.response)(nu, n) - half_space - logarithm / (n + 0.5)
        }
    }

    /// Returns S(ν). The summand falls as 1/n², so that sums to N lack a series in 1/N. Richardson's combinations of the
    /// sums to some N, each twice the one before, take its first terms away and leave N⁻⁴/64.
    fn series(self, nu: f64) -> f64 {
        const N: usize = 128;
        const SUMS: usize = 4;
        let summand = self.summand(nu);
        let mut sum = (0..N).map(summand).sum::<f64>();
        let mut sums = [sum; SUMS];
        for (k, to) in sums.iter_mut().enumerate().skip(1) {
            sum += (N << (k - 1)..N << k).map(summand).sum::<f64>();
            *to = sum;
        }
        for order in 1..SUMS {
            let gain = (1 << order) as f64;
            for k in (order..SUMS).rev() {
                sums[k] = (gain * sums[k] - sums[k - 1]) / (gain - 1.0);
            }
        }
        sums[SUMS - 1]
    }
}

/// Returns G u/(R b) of a sphere under the surface load b ∇Y + b r̂ × ∇Y′ of a degree n and the order 1, at the pole.
///
/// Spheroidal solutions are r^(n−1)(n Y r̂ + ∇Y) and r^(n+1)((n+α) Y r̂ + ∇Y) (Love, *A Treatise on the Mathematical Theory of
/// Elasticity*, § 172), of which no stress is left along r; the toroidal one takes 1/(n−1). For n = 1 body forces carry force and torque;
/// displacements are measured from the mean motion.
fn across(nu: f64, n: f64) -> f64 {
    if n == 0.0 {
        return 0.0;
    }
    if n == 1.0 {
        return (0.6 - 0.2 * nu) / (1.0 + nu) + 1.0 / 7.0;
    }
    let denominator = n + 5.0 - 4.0 * nu;
    let alpha = -2.0 * (3.0 * n + 1.0 - (4.0 * n + 2.0) * nu) / denominator;
    let expansion = -4.0 * nu * (2.0 * n + 3.0) * (n + 1.0) / denominator;
    let radial = expansion + 2.0 * (n + 1.0) * (n + alpha);
    let spheroidal = (1.0 - radial / (2.0 * n * (n - 1.0))) / (2.0 * n + alpha - radial / n);
    spheroidal + 1.0 / (n - 1.0)
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
                let (constant, slope) = Coefficient::NORMAL.of(nu);
                let found = constant - slope * ratio.ln();
                // The next order in a/R.
                assert!((found - expected).abs() < 3.0 * ratio, "{nu} {ratio} {found} {expected}");
            }
        }
    }

    /// The sum to a million terms, whose rest is the integral of its leading term to 1/N²; rounding of it.
    #[test]
    fn truncated_series_equals_a_million_terms() {
        const N: usize = 1_000_000;
        for nu in [-0.5, 0.0, 0.244, 0.45, 0.4999] {
            let sum = |end: usize| (0..end).map(Coefficient::NORMAL.summand(nu)).sum::<f64>();
            let expected = 2.0 * sum(N) - sum(N / 2);
            assert!((Coefficient::NORMAL.series(nu) - expected).abs() < 2e-9, "{nu}");
        }
    }

    /// The project's fit to other calculations: c = −0.511 + 0.0519 ln(R/a) at ν = 0.244.
    #[test]
    fn coefficient_of_glass() {
        let (constant, slope) = Coefficient::NORMAL.of(0.244);
        assert!((slope - 0.0519).abs() < 0.5e-4);
        // Finite elements (tests/it/ting.rs) side with this value.
        assert!((constant + 0.5402).abs() < 0.5e-4, "{constant}");
    }
}
