//! Polynomials through Gauss points, and their fading memory.
//!
//! A quantity is known at the N Gauss–Legendre points of a step, 0 < θ < 1, and taken as the polynomial
//! f(θ) = Σ f_m θ^m through them. The memory of a Maxwell element,
//!
//! ```math
//! \int_0^\theta e^{-z(\theta-\sigma)}f(\sigma)\,\mathrm d\sigma = \sum_m f_m\,\mu_m(\theta, z),
//! \qquad z\,\mu_m = \theta^m - m\,\mu_{m-1},
//! ```
//!
//! is exact for every ratio z of step to relaxation time, from elastic (z → 0) to viscous (z → ∞).

use crate::numerics::exp_m1;

/// Gauss points, and coefficients, a step.
pub(crate) const N: usize = 5;

/// Values at the Gauss points, or coefficients of θ⁰ … θ⁴.
pub(crate) type Vector = [f64; N];

/// The points, 0 < θ < 1.
pub(crate) const POINTS: Vector = [
    0.046_910_077_030_668_0,
    0.230_765_344_947_158_45,
    0.5,
    0.769_234_655_052_841_6,
    0.953_089_922_969_332,
];

/// Leading coefficient of the Legendre polynomial of degree N − 1 on 0 ..= 1.
const LEGENDRE_LEADING: f64 = 70.0;

/// From values at the points to coefficients.
#[derive(Debug, Clone)]
pub(crate) struct Interpolation {
    lagrange: [Vector; N],
}

impl Interpolation {
    pub fn new() -> Self {
        let mut lagrange = [[0.0; N]; N];
        for (j, polynomial) in lagrange.iter_mut().enumerate() {
            polynomial[0] = 1.0;
            for (degree, i) in (0..N).filter(|i| *i != j).enumerate() {
                let scale = (POINTS[j] - POINTS[i]).recip();
                for m in (0..=degree + 1).rev() {
                    let lower = if m == 0 { 0.0 } else { polynomial[m - 1] };
                    polynomial[m] = scale * (lower - POINTS[i] * polynomial[m]);
                }
            }
        }
        Self { lagrange }
    }

    /// Returns the coefficients of the polynomial with these values at the points.
    pub fn coefficients(&self, values: &Vector) -> Vector {
        let mut coefficients = [0.0; N];
        for (value, polynomial) in values.iter().zip(&self.lagrange) {
            for m in 0..N {
                coefficients[m] += value * polynomial[m];
            }
        }
        coefficients
    }

    /// Returns the weights w with Σ_j w_j f(θ_j) = Σ_m `moments`_m f_m.
    pub fn weights(&self, moments: &Vector) -> Vector {
        self.lagrange.map(|polynomial| dot(&polynomial, moments))
    }
}

/// Returns the value f(θ).
pub(crate) fn evaluate(coefficients: &Vector, theta: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * theta + coefficient)
}

/// Returns ∫₀^θ f.
pub(crate) fn integral(coefficients: &Vector, theta: f64) -> f64 {
    dot(coefficients, &integral_moments(theta))
}

/// Returns ∫₀^θ ∫₀^σ f.
pub(crate) fn double_integral(coefficients: &Vector, theta: f64) -> f64 {
    dot(coefficients, &double_integral_moments(theta))
}

/// Returns θ^(m+1)/(m+1) for each m.
pub(crate) fn integral_moments(theta: f64) -> Vector {
    std::array::from_fn(|m| theta.powi(m as i32 + 1) / (m as f64 + 1.0))
}

/// Returns θ^(m+2)/((m+1)(m+2)) for each m.
pub(crate) fn double_integral_moments(theta: f64) -> Vector {
    std::array::from_fn(|m| {
        let m = m as f64;
        theta.powi(m as i32 + 2) / ((m + 1.0) * (m + 2.0))
    })
}

/// Returns the slope f′(θ).
pub(crate) fn derivative(coefficients: &Vector, theta: f64) -> f64 {
    (1..N).rev().fold(0.0, |sum, m| sum * theta + m as f64 * coefficients[m])
}

/// Returns the size of the finest detail that the polynomial resolves: its last Legendre coefficient.
pub(crate) fn finest_detail(coefficients: &Vector) -> f64 {
    (coefficients[N - 1] / LEGENDRE_LEADING).abs()
}

/// Returns μ_m(θ, z) = ∫₀^θ e^(−z(θ−σ)) σ^m dσ for z ≥ 0.
pub(crate) fn fading_moments(theta: f64, z: f64) -> Vector {
    let mut moments = [0.0; N];
    let y = z * theta;
    if y < 1.0 {
        // Σ_j (−y)^j m!/(m+1+j)! for the highest m, then the recurrence downwards.
        let mut term = theta.powi(N as i32) / N as f64;
        let mut sum = term;
        let mut j = N as f64;
        while term.abs() > f64::EPSILON * sum {
            j += 1.0;
            term *= -y / j;
            sum += term;
        }
        moments[N - 1] = sum;
        for m in (1..N).rev() {
            moments[m - 1] = (theta.powi(m as i32) - z * moments[m]) / m as f64;
        }
    } else {
        moments[0] = -exp_m1(-y) / z;
        for m in 1..N {
            moments[m] = (theta.powi(m as i32) - m as f64 * moments[m - 1]) / z;
        }
    }
    moments
}

pub(crate) fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The points are the zeros of the Legendre polynomial 252x⁵−630x⁴+560x³−210x²+30x−1, so the
    /// rule integrates x⁹ exactly.
    #[test]
    fn points_are_those_of_gauss() {
        let weights = Interpolation::new().weights(&integral_moments(1.0));
        for degree in 0..10 {
            let sum: f64 = (0..N).map(|j| weights[j] * POINTS[j].powi(degree)).sum();
            // A dozen roundings of coefficients up to 1e3 in the Lagrange polynomials.
            assert!((sum * f64::from(degree + 1) - 1.0).abs() < 1e-12, "degree {degree}: {sum}");
        }
        let tenth: f64 = (0..N).map(|j| weights[j] * POINTS[j].powi(10)).sum();
        assert!((tenth * 11.0 - 1.0).abs() > 1e-6);
    }

    #[test]
    fn polynomials_are_reproduced() {
        let f = [0.3, -1.0, 2.0, 0.5, -0.7];
        let found = Interpolation::new().coefficients(&POINTS.map(|theta| evaluate(&f, theta)));
        for m in 0..N {
            // As above.
            assert!((found[m] - f[m]).abs() < 1e-12);
        }
        let h = 1e-4;
        let slope = (evaluate(&f, 0.4 + h) - evaluate(&f, 0.4 - h)) / (2.0 * h);
        // h² f‴/6.
        assert!((derivative(&f, 0.4) - slope).abs() < 1e-7);
        assert!((integral(&[0.0, 0.0, 3.0, 0.0, 0.0], 0.5) - 0.125).abs() < 1e-16);
        assert!((double_integral(&[0.0, 6.0, 0.0, 0.0, 0.0], 0.5) - 0.125).abs() < 1e-16);
    }

    /// Against a composite Gauss rule with 400 panels, on both sides of the change of method.
    #[test]
    fn fading_moments_equal_numerical_integrals() {
        let weights = Interpolation::new().weights(&integral_moments(1.0));
        for theta in [1.0, 0.37] {
            for z in [0.0, 1e-9, 0.1, 0.99, 1.01, 2.71, 3.0, 30.0] {
                let moments = fading_moments(theta, z);
                for m in 0..N {
                    let width = theta / 400.0;
                    let integral: f64 = (0..400)
                        .flat_map(|panel| (0..N).map(move |j| (panel, j)))
                        .map(|(panel, j)| {
                            let sigma = width * (f64::from(panel) + POINTS[j]);
                            let fading = (-z * (theta - sigma)).exp();
                            width * weights[j] * fading * sigma.powi(m as i32)
                        })
                        .sum();
                    // Upwards from y = 1 a rounding grows by m!/y^m ≤ 24, relative to a fifth.
                    assert!((moments[m] / integral - 1.0).abs() < 1e-12, "{theta} {z} {m}");
                }
            }
        }
        // Viscous limit: θ^m/z.
        assert!((fading_moments(1.0, 1e12)[3] * 1e12 - 1.0).abs() < 1e-11);
        assert_eq!(fading_moments(1.0, f64::INFINITY), [0.0; N]);
    }
}
