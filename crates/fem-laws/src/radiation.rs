//! Energy that a contact sends into a large body as waves that do not come back within the contact.
//!
//! A normal force F(t) on a small spot of an elastic half-space, slow against the time that waves take
//! across the spot, radiates
//!
//! ```math
//! W = \frac{C(\nu)}{\mu c_s}\int \dot F^2\,dt, \qquad
//! C = \frac1{2\pi}\,\mathrm{Im}\int_0^\infty
//! \frac{\xi\sqrt{\xi^2-\gamma^2}}{(2\xi^2-1)^2-4\xi^2\sqrt{\xi^2-\gamma^2}\sqrt{\xi^2-1}}\,d\xi,
//! \qquad \gamma = c_s/c_p,
//! ```
//!
//! the part of the receptance of a half-space (Lamb 1904; Miller & Pursey 1955) that is out of phase:
//! pressure waves from ξ < γ, shear waves up to 1, and the residue at Rayleigh's wave number, which has
//! most of it. With Hertz' pulse, ∫Ḟ²dt = (9/5) B(4/5, 3/2) F² v/δ, and a ball on a half-space of its own
//! material at ν = 1/4 loses 1.11 (v/c₀)^(3/5) of its energy (Hunter 1957, who rounds a simpler pulse to
//! 1.04), c₀² = E/ρ.
//!
//! Limits: the loss is small; the body is larger than what waves cross and recross in the contact time.

use std::f64::consts::PI;

use fem_material::Material;
use statrs::function::beta::beta;

use crate::hertz::HertzImpact;
use crate::numerics::sin_cos;

/// Points of the midpoint rule over each stretch; the integrands are smooth and periodic in the angle
/// that takes their place, so that it converges faster than any power.
const POINTS: u32 = 200;

/// Returns C(ν) of the radiated energy W = C/(μ c_s) ∫Ḟ² dt of a half-space.
pub fn radiation_coefficient(poissons_ratio: f64) -> f64 {
    let squared_ratio = (1.0 - 2.0 * poissons_ratio) / (2.0 * (1.0 - poissons_ratio));
    let gamma = squared_ratio.sqrt();
    let alpha = |x: f64| (x * x - squared_ratio).abs().sqrt();
    let beta = |x: f64| (x * x - 1.0).abs().sqrt();
    let (square, product) =
        (|x: f64| (2.0 * x * x - 1.0).powi(2), |x: f64| 4.0 * x * x * alpha(x) * beta(x));
    let pressure = integral(0.0, gamma, |x| x * alpha(x) / (square(x) + product(x)));
    let shear = integral(gamma, 1.0, |x| {
        x * alpha(x) * product(x) / (square(x).powi(2) + product(x).powi(2))
    });
    let rayleigh = rayleigh_wave_number(|x| square(x) - product(x));
    (pressure + shear + PI * rayleigh * alpha(rayleigh) / slope(rayleigh, squared_ratio))
        / (2.0 * PI)
}

/// Returns the speed of Rayleigh's surface wave, m/s, with the instantaneous moduli.
pub fn rayleigh_wave_speed(material: &Material) -> f64 {
    let nu = material.instantaneous().poissons_ratio();
    let squared_ratio = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu));
    let number = rayleigh_wave_number(|x| {
        let inner = (x * x - squared_ratio).abs().sqrt() * (x * x - 1.0).abs().sqrt();
        (2.0 * x * x - 1.0).powi(2) - 4.0 * x * x * inner
    });
    material.shear_wave_speed() / number
}

/// Returns c_s over the speed of Rayleigh's wave, where `function` falls through zero beyond 1.
fn rayleigh_wave_number(function: impl Fn(f64) -> f64) -> f64 {
    // Rayleigh's wave is never slower than 0.69 c_s, at ν = −1.
    let (mut low, mut high) = (1.0, 1.5);
    while high - low > f64::EPSILON {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        if function(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Returns −R' of R = (2x² − 1)² − 4x² αβ at x > 1.
fn slope(x: f64, squared_ratio: f64) -> f64 {
    let (a, b) = ((x * x - squared_ratio).sqrt(), (x * x - 1.0).sqrt());
    let rise = 8.0 * x * (2.0 * x * x - 1.0);
    let fall = 8.0 * x * a * b + 4.0 * x * x * (x * b / a + x * a / b);
    fall - rise
}

/// Returns ∫ f over a stretch with x = a + (b − a) sin²θ, which removes the square roots at its ends.
fn integral(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let step = 0.5 * PI / f64::from(POINTS);
    let point = |k: u32| {
        let (sin, cos) = sin_cos(step * (f64::from(k) + 0.5));
        2.0 * (b - a) * sin * cos * f(a + (b - a) * sin * sin)
    };
    step * (0..POINTS).map(point).sum::<f64>()
}

/// Returns γ of a half-space of this material, m s/N, in the radiated energy W = γ ∫Ḟ² dt and in the displacement
/// −γ Ḟ, which adds to the quasi-static one:
///
/// ```math
/// \gamma = \frac{C(\nu)}{\mu c_s},
/// ```
///
/// with the instantaneous moduli. A material that relaxes within the contact radiates more: by up to
/// (G₀/G∞)^(3/2) at a given force, where all of it is over long before the contact ends. Moduli
/// without such terms are [`crate::FastSlowLimits`].
pub fn radiation_damping(material: &Material) -> f64 {
    let moduli = material.instantaneous();
    let impedance = moduli.shear_modulus() * material.shear_wave_speed();
    radiation_coefficient(moduli.poissons_ratio()) / impedance
}

/// Returns the share of the energy of approach that an elastic impact radiates into a body of this material, as if
/// it never ended.
pub fn radiated_share(hertz: &HertzImpact, material: &Material) -> f64 {
    let sizes = [hertz.peak_force(), hertz.max_approach()];
    share_of_damping(hertz, sizes, radiation_damping(material))
}

/// Returns the share of the energy of approach that a body with this γ (m s/N) radiates. The pulse has Hertz' form, but
/// the peak force (N) and the largest approach (m) to which relaxation changes those of `hertz`.
pub(crate) fn share_of_damping(
    hertz: &HertzImpact,
    [force, approach]: [f64; 2],
    damping: f64,
) -> f64 {
    let speed = hertz.approach_speed();
    let squared_rates = 1.8 * beta(0.8, 1.5) * force * force * speed / approach;
    let energy = 0.5 * hertz.pair().effective_mass() * speed * speed;
    damping * squared_rates / energy
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speeds of Rayleigh's wave over c_s: 0.8741, 0.9194, 0.9553 at ν = 0, 1/4, 1/2 (Rayleigh 1885;
    /// Achenbach, *Wave Propagation in Elastic Solids*, table 5.1).
    #[test]
    fn rayleigh_wave_has_the_published_speed() {
        for (nu, speed) in [(0.0, 0.8741), (0.25, 0.9194), (0.5, 0.9553)] {
            let squared_ratio = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu));
            let function = |x: f64| {
                let (a, b) = ((x * x - squared_ratio).sqrt(), (x * x - 1.0).sqrt());
                (2.0 * x * x - 1.0).powi(2) - 4.0 * x * x * a * b
            };
            let x = rayleigh_wave_number(function);
            assert!((1.0 / x - speed).abs() < 2e-4, "{nu}: {}", 1.0 / x);
            let h = 1e-5;
            let difference = (function(x - h) - function(x + h)) / (2.0 * h);
            assert!((slope(x, squared_ratio) / difference - 1.0).abs() < 1e-6);
        }
    }

    /// Miller & Pursey (1955) for ν = 1/4: of the energy that a spot radiates 67.4 % goes into
    /// Rayleigh's wave, 25.8 % into shear and 6.9 % into pressure waves.
    #[test]
    fn radiated_shares_equal_those_of_miller_and_pursey() {
        // Shear waves of ξ < γ run beside pressure waves there: the two are told apart only in their
        // sum, 32.6 %.
        let squared_ratio: f64 = 1.0 / 3.0;
        let gamma = squared_ratio.sqrt();
        let alpha = |x: f64| (x * x - squared_ratio).abs().sqrt();
        let product = |x: f64| 4.0 * x * x * alpha(x) * (x * x - 1.0).abs().sqrt();
        let square = |x: f64| (2.0 * x * x - 1.0).powi(2);
        let body = integral(0.0, gamma, |x| x * alpha(x) / (square(x) + product(x)))
            + integral(gamma, 1.0, |x| {
                x * alpha(x) * product(x) / (square(x).powi(2) + product(x).powi(2))
            });
        let share = body / (2.0 * PI) / radiation_coefficient(0.25);
        assert!((share - 0.326).abs() < 2e-3, "{share}");
    }

    #[test]
    fn radiation_coefficient_is_finite_for_any_poissons_ratio() {
        for nu in [-0.99, -0.5, 0.0, 0.3, 0.49, 0.4999, 0.499999] {
            let found = radiation_coefficient(nu);
            assert!(found > 0.05 && found < 5.0, "{nu}: {found}");
        }
        // Smooth toward 1/2.
        let [a, b] = [0.4999, 0.499999].map(radiation_coefficient);
        assert!((a / b - 1.0).abs() < 1e-2, "{a} {b}");
    }
}
