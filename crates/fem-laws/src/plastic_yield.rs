//! When a Hertz contact first yields, and what closed forms say of impacts beyond: for a warning of
//! elastic models, not for a computation of plastic flow.
//!
//! The largest von Mises stress of a Hertz contact lies on the axis below the surface (Johnson,
//! *Contact Mechanics*, eq. 3.45),
//!
//! ```math
//! \frac{\sigma_M}{p_0} = \max_\zeta\left|\frac{3}{2(1+\zeta^2)} - (1+\nu)(1-\zeta\arctan\tfrac1\zeta)\right|,
//! ```
//!
//! 0.62 at ν = 0.3, so the contact first yields at p₀ = 1.6 Y, and p₀ ∝ v^(2/5) gives the speed. Beyond
//! it, elastic–perfectly plastic spheres rebound with (Thornton 1997, *J. Appl. Mech.* 64, 383, eq. 39)
//!
//! ```math
//! e = \left(\tfrac{6\sqrt3}5\right)^{1/2}\left[1-\tfrac16 x^2\right]^{1/2}
//! \left[\frac{x}{x+2\sqrt{\tfrac65-\tfrac15 x^2}}\right]^{1/4}, \qquad x = v_Y/v,
//! ```
//!
//! and fully plastic ones, which compress at a constant pressure p_d = 3Y and spring back from it as
//! half-spaces do, W = πa⁴p_d/4R, W' = 3F²/(10 aE*), with (Johnson, section 11.5)
//!
//! ```math
//! e^2 = \frac{W'}W = \frac{3\pi^{5/4}4^{3/4}}{10}\,\frac{p_d}{E^*}
//! \left(\frac{m^* v^2/2}{p_d R^{*3}}\right)^{-1/4}.
//! ```
//!
//! Finite elements of elastic–perfectly plastic spheres lie between the two from ten times the speed of
//! first yield on: the first is a fifth to a third low, the second a quarter to two fifths high.

use std::f64::consts::PI;

use crate::hertz::HertzImpact;
use crate::hertz::HertzPressure;

/// Dynamic hardness over yield strength.
const HARDNESS: f64 = 3.0;
/// Depths over the contact radius between which the largest stress lies, for any ν.
const DEPTHS: (f64, f64) = (0.0, 1.5);

/// First yield of one of two bodies in a Hertz impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstYield {
    /// Pressure on the axis at which the body yields, Pa.
    pub pressure: f64,
    /// Approach speed from which on the impact reaches it, m/s.
    pub speed: f64,
    yield_strength: f64,
    hertz: HertzImpact,
}

/// Returns σ_M/p₀, the largest von Mises stress on the axis of a Hertz contact over the peak pressure, at a
/// Poisson's ratio.
pub fn largest_von_mises(poissons_ratio: f64) -> f64 {
    let unit = HertzPressure { contact_radius: 1.0, peak_pressure: 1.0 };
    let stress = |depth: f64| 2.0 * unit.axis_stress(depth, poissons_ratio).max_shear();
    // The stress has one maximum there: thirds of the range that cannot hold it are left out.
    let (mut low, mut high) = DEPTHS;
    for _ in 0..100 {
        let [left, right] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if stress(left) < stress(right) { low = left } else { high = right }
    }
    stress(0.5 * (low + high))
}

impl FirstYield {
    /// Returns the first yield of a body with a yield strength (Pa) and Poisson's ratio in an impact.
    pub fn new(hertz: &HertzImpact, yield_strength: f64, poissons_ratio: f64) -> Self {
        let pressure = yield_strength / largest_von_mises(poissons_ratio);
        let speed = hertz.approach_speed() * (pressure / hertz.peak_pressure()).powf(2.5);
        Self { pressure, speed, yield_strength, hertz: *hertz }
    }

    /// Returns the peak pressure of the impact over that of first yield.
    pub fn ratio(&self) -> f64 {
        self.hertz.peak_pressure() / self.pressure
    }

    /// Restitutions of Thornton and of Johnson, between which elastic–perfectly plastic bodies lie;
    /// 1 of an impact that does not yield, and where Johnson's fully plastic impact gives more.
    pub fn restitutions(&self) -> (f64, f64) {
        if self.ratio() <= 1.0 {
            return (1.0, 1.0);
        }
        (thornton(self.speed / self.hertz.approach_speed()), self.johnson().min(1.0))
    }

    fn johnson(&self) -> f64 {
        let (pair, speed) = (self.hertz.pair(), self.hertz.approach_speed());
        let hardness = HARDNESS * self.yield_strength;
        let energy = 0.5 * pair.effective_mass() * speed * speed;
        let over_hardness = energy / (hardness * pair.effective_radius().powi(3));
        let factor = 0.3 * PI.powf(1.25) * 4f64.powf(0.75);
        (factor * hardness / pair.contact_modulus() * over_hardness.powf(-0.25)).sqrt()
    }
}

/// Returns Thornton's restitution at the speed of first yield over the impact's.
fn thornton(x: f64) -> f64 {
    let loading = 1.0 - x * x / 6.0;
    let unloading = x / (x + 2.0 * (1.2 - 0.2 * x * x).sqrt());
    (1.2 * 3f64.sqrt() * loading).sqrt() * unloading.powf(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::{Pair, Partner};

    /// Davies (1949), Johnson, section 4.2: 0.31 p₀ of shear at ν = 0.3, so yield at 1.60 Y by von
    /// Mises; Green (2005) fits Y C(ν) with C = 1.295 exp(0.736 ν) within 1 %.
    #[test]
    fn first_yield_by_von_mises() {
        assert!((largest_von_mises(0.3) / 2.0 - 0.310).abs() < 5e-4);
        assert!((1.0 / largest_von_mises(0.3) - 1.61).abs() < 0.01);
        for nu in [0.0, 0.1, 0.2, 0.3, 0.4, 0.5] {
            let fit = 1.295 * f64::exp(0.736 * nu);
            assert!((1.0 / largest_von_mises(nu) / fit - 1.0).abs() < 0.01, "{nu}");
        }
        // It has a maximum for every material that there is.
        for nu in [-0.999, -0.5] {
            let found = largest_von_mises(nu);
            assert!(found > 0.5 && found < 1.6, "{nu}: {found}");
        }
    }

    /// Thornton's own limits: 1 at first yield, 1.185 (v_Y/v)^(1/4) far beyond.
    #[test]
    fn thornton_restitution_has_its_published_limits() {
        assert!((thornton(1.0) - 1.0).abs() < 1e-12, "{}", thornton(1.0));
        for x in [1e-4, 1e-6] {
            assert!((thornton(x) / (1.185 * f64::powf(x, 0.25)) - 1.0).abs() < 2e-3, "{x}");
        }
    }

    fn energy_at(speed: f64, pair: &Pair) -> f64 {
        0.5 * pair.effective_mass() * speed * speed
    }

    /// Two steel spheres of 5 mm at 5 m/s, as in Johnson, section 11.5: yield at some cm/s.
    #[test]
    fn steel_spheres_yield_at_the_published_speed() {
        let (modulus, nu, density) = (210e9, 0.3, 7850.0);
        let radius: f64 = 2.5e-3;
        let mass = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3) * density;
        let plane_strain_modulus = modulus / (1.0 - nu * nu);
        let sphere = || Partner::Sphere { radius, mass, plane_strain_modulus };
        let pair = Pair::new(sphere(), sphere()).unwrap();
        let hertz = HertzImpact::new(&pair, 5.0).unwrap();
        let first = FirstYield::new(&hertz, 1e9, nu);
        // p₀ at first yield, in both of two ways.
        let at_yield = HertzImpact::new(&pair, first.speed).unwrap();
        assert!((at_yield.peak_pressure() / first.pressure - 1.0).abs() < 1e-12);
        // Johnson, eq. 11.36: ½mv² = 53 R³Y⁵/E*⁴, with p₀ = 1.60 Y for 1.61 Y, a ratio of 1.04 to the
        // fifth power, and a rounded 53.
        let energy = energy_at(first.speed, &pair);
        let johnson = 53.0 * pair.effective_radius().powi(3) * 1e9f64.powi(5)
            / pair.contact_modulus().powi(4);
        assert!((energy / johnson - 1.0).abs() < 0.06, "{}", energy / johnson);
        let (low, high) = first.restitutions();
        assert!(low < high && low > 0.1, "{low} {high}");
        // Johnson's own rounded 3.8 (Y/E*)^(1/2) (½mv²/YR³)^(-1/8).
        let over_strength = energy_at(5.0, &pair) / (1e9 * pair.effective_radius().powi(3));
        let johnson = 3.8 * (1e9 / pair.contact_modulus()).sqrt() * over_strength.powf(-0.125);
        assert!((high / johnson - 1.0).abs() < 0.02, "{high} {johnson}");
        // Slower than first yield nothing is lost.
        let slow = HertzImpact::new(&pair, 0.5 * first.speed).unwrap();
        assert_eq!(FirstYield::new(&slow, 1e9, nu).restitutions(), (1.0, 1.0));
    }
}
