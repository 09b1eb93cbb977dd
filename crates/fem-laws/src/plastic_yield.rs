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
//! The same laws give their contact time, force and approach: Thornton's sphere loads with F = F_Y + πp_YR*(δ − δ_Y) and unloads
//! from the largest force F as Hertz' of the radius R_p with R_pF = R*F_e, where F_e is Hertz' force at the same approach
//! (Thornton and Ning 1998, *Powder Technology* 99, 154, eqs. 19 and 20); Johnson's loads for a quarter of the period of a
//! spring 2πR*p_d.
//!
//! Finite elements of elastic–perfectly plastic spheres lie between the two from ten times the speed of
//! first yield on: the first is a fifth to a third low, the second a quarter to two fifths high.

use std::f64::consts::PI;

use crate::hertz::{HertzImpact, HertzPressure, contact_time_coefficient};
use crate::impact::ImpactQuantities;
use crate::numerics::midpoint_sum;

/// Dynamic hardness over yield strength.
pub(crate) const HARDNESS: f64 = 3.0;
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

    /// Returns Thornton's and Johnson's impacts, between whose restitutions elastic–perfectly plastic bodies lie. Both are
    /// Hertz' impact if the body does not yield, and the second one is where its restitution would be above 1.
    pub fn impacts(&self) -> [ImpactQuantities; 2] {
        let elastic = ImpactQuantities::from(&self.hertz);
        if self.ratio() <= 1.0 {
            return [elastic; 2];
        }
        let johnson = self.johnson();
        [self.thornton(), if johnson.restitution < 1.0 { johnson } else { elastic }]
    }

    /// Returns the changes from Hertz' impact, in the order of [`ImpactQuantities::in_order`]: the absolute one of the
    /// restitution to the middle of both impacts, and the larger relative one of every other quantity.
    pub fn change(&self) -> [f64; 6] {
        let elastic = ImpactQuantities::from(&self.hertz);
        let [one, other] = self.impacts().map(|impact| impact.change_from(&elastic));
        std::array::from_fn(|k| match k {
            0 => 0.5 * (one[0] + other[0]),
            _ if one[k].abs() > other[k].abs() => one[k],
            _ => other[k],
        })
    }

    /// The pressure stays at that of first yield, and unloading is Hertz' of a flattened sphere.
    fn thornton(&self) -> ImpactQuantities {
        let (pair, speed) = (self.hertz.pair(), self.hertz.approach_speed());
        let (radius, modulus, mass) =
            (pair.effective_radius(), pair.contact_modulus(), pair.effective_mass());
        let energy = 0.5 * mass * speed * speed;
        let yields_at = radius * (0.5 * PI * self.pressure / modulus).powi(2);
        let yield_force = self.hertz.force(yields_at);
        let elastic_energy = 0.4 * yield_force * yields_at;
        // Beyond, F = F_y + k (δ − δ_y).
        let stiffness = PI * self.pressure * radius;
        let root = yield_force.hypot((2.0 * stiffness * (energy - elastic_energy)).sqrt());
        let max_approach = yields_at + (root - yield_force) / stiffness;
        // δ = δ_y (1 − x²) removes the root of the speed where first yield stops the bodies.
        let elastic_share = elastic_energy / energy;
        let until_yield = yields_at / speed
            * midpoint_sum(|x| 2.0 * x / (1.0 - elastic_share * (1.0 - x * x).powf(2.5)).sqrt());
        let frequency = (stiffness / mass).sqrt();
        let speed_at_yield = speed * (1.0 - elastic_share).sqrt();
        let plastic = (speed_at_yield * frequency * mass / yield_force).atan() / frequency;
        // The radius of the flattened sphere, by which it unloads from the same contact radius.
        let crown = radius * self.hertz.force(max_approach) / root;
        let unloaded = (0.75 * root / (modulus * crown.sqrt())).powf(2.0 / 3.0);
        let restitution = (0.4 * root * unloaded / energy).sqrt();
        ImpactQuantities {
            restitution,
            contact_time: until_yield + plastic + rebound_time(unloaded, restitution * speed),
            peak_force: root,
            max_approach,
            max_contact_radius: (radius * max_approach).sqrt(),
            peak_pressure: self.pressure,
        }
    }

    /// The pressure is the hardness throughout, F = πa²p_d with a² = 2R*δ.
    fn johnson(&self) -> ImpactQuantities {
        let (pair, speed) = (self.hertz.pair(), self.hertz.approach_speed());
        let (radius, modulus, mass) =
            (pair.effective_radius(), pair.contact_modulus(), pair.effective_mass());
        let hardness = HARDNESS * self.yield_strength;
        let energy = 0.5 * mass * speed * speed;
        let contact_radius = (4.0 * radius * energy / (PI * hardness)).powf(0.25);
        let peak_force = PI * contact_radius * contact_radius * hardness;
        let returned = 0.3 * peak_force * peak_force / (contact_radius * modulus);
        let restitution = (returned / energy).sqrt();
        let loading = 0.5 * PI * (mass / (2.0 * PI * radius * hardness)).sqrt();
        let unloaded = 2.5 * returned / peak_force;
        ImpactQuantities {
            restitution,
            contact_time: loading + rebound_time(unloaded, restitution * speed),
            peak_force,
            max_approach: 0.5 * contact_radius * contact_radius / radius,
            max_contact_radius: contact_radius,
            peak_pressure: hardness,
        }
    }
}

/// Returns half of Hertz' contact time, s, of a rebound over an approach (m) to a speed (m/s).
fn rebound_time(approach: f64, speed: f64) -> f64 {
    0.5 * contact_time_coefficient() * approach / speed
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

    /// Like steel spheres with a modulus of 210 GPa, of a diameter (m), at a speed (m/s), with a yield strength, Pa.
    fn steel(diameter: f64, speed: f64, yield_strength: f64) -> FirstYield {
        let radius = 0.5 * diameter;
        let mass = crate::pair::sphere_mass(diameter, 7850.0);
        let sphere = || Partner::Sphere { radius, mass, plane_strain_modulus: 210e9 / 0.91 };
        let pair = Pair::new(sphere(), sphere()).unwrap();
        FirstYield::new(&HertzImpact::new(&pair, speed).unwrap(), yield_strength, 0.3)
    }

    /// Thornton's closed restitution (1997, eq. 39) and its limits: 1 at first yield, 1.185 (v_Y/v)^(1/4) far beyond.
    #[test]
    fn thornton_restitution_is_the_published_one() {
        let closed = |x: f64| {
            let unloading = x / (x + 2.0 * (1.2 - 0.2 * x * x).sqrt());
            (1.2 * 3f64.sqrt() * (1.0 - x * x / 6.0)).sqrt() * unloading.powf(0.25)
        };
        let speed_of_yield = steel(10e-3, 1.0, 235e6).speed;
        for x in [0.999, 0.5, 0.1, 1e-4, 1e-6] {
            let [thornton, _] = steel(10e-3, speed_of_yield / x, 235e6).impacts();
            assert!((thornton.restitution / closed(x) - 1.0).abs() < 1e-9, "{x}");
            let far = thornton.restitution / (1.185 * x.powf(0.25));
            assert!(x > 1e-3 || (far - 1.0).abs() < 2e-3, "{x}: {far}");
        }
    }

    /// Thornton's force law and Johnson's constant pressure, integrated in a script of its own: balls of 10 mm of S235 at
    /// 5 m/s.
    #[test]
    fn impacts_of_steel_agree_with_an_integration() {
        let first = steel(10e-3, 5.0, 235e6);
        let [thornton, johnson] = first.impacts().map(|impact| impact.in_order());
        let expected = [
            [0.1643, 49.22e-6, 391.1, 131.4e-6, 573.1e-6, 0.379e9],
            [0.3141, 29.27e-6, 754.3, 68.11e-6, 583.6e-6, 0.705e9],
        ];
        for (found, expected) in thornton.iter().chain(&johnson).zip(expected.as_flattened()) {
            assert!((found / expected - 1.0).abs() < 1e-3, "{found:e} {expected:e}");
        }
    }

    /// At first yield both are Hertz' impact, from either side, and they depart from it the more the faster the impact.
    #[test]
    fn impacts_depart_from_first_yield_on() {
        let speed_of_yield = steel(10e-3, 1.0, 235e6).speed;
        let change = |times: f64| steel(10e-3, times * speed_of_yield, 235e6).change();
        assert_eq!(change(0.999), [0.0; 6]);
        assert!(change(1.0001).iter().all(|change| change.abs() < 1e-3), "{:?}", change(1.0001));
        let mut last = [0.0; 6];
        for times in [1.5, 3.0, 10.0, 30.0, 100.0, 1000.0] {
            let now = change(times);
            for k in 0..6 {
                assert!(now[k].abs() > last[k], "{times}: {now:?} {last:?}");
            }
            last = now.map(f64::abs);
        }
    }

    fn energy_at(speed: f64, pair: &Pair) -> f64 {
        0.5 * pair.effective_mass() * speed * speed
    }

    /// Two steel spheres of 5 mm at 5 m/s, as in Johnson, section 11.5: yield at some cm/s.
    #[test]
    fn steel_spheres_yield_at_the_published_speed() {
        let first = steel(5e-3, 5.0, 1e9);
        let pair = *first.hertz.pair();
        // p₀ at first yield, in both of two ways.
        let at_yield = HertzImpact::new(&pair, first.speed).unwrap();
        assert!((at_yield.peak_pressure() / first.pressure - 1.0).abs() < 1e-12);
        // Johnson, eq. 11.36: ½mv² = 53 R³Y⁵/E*⁴, with p₀ = 1.60 Y for 1.61 Y, a ratio of 1.04 to the
        // fifth power, and a rounded 53.
        let energy = energy_at(first.speed, &pair);
        let johnson = 53.0 * pair.effective_radius().powi(3) * 1e9f64.powi(5)
            / pair.contact_modulus().powi(4);
        assert!((energy / johnson - 1.0).abs() < 0.06, "{}", energy / johnson);
        let [low, high] = first.impacts().map(|impact| impact.restitution);
        assert!(low < high && low > 0.1, "{low} {high}");
        // Johnson's own rounded 3.8 (Y/E*)^(1/2) (½mv²/YR³)^(-1/8).
        let over_strength = energy_at(5.0, &pair) / (1e9 * pair.effective_radius().powi(3));
        let johnson = 3.8 * (1e9 / pair.contact_modulus()).sqrt() * over_strength.powf(-0.125);
        assert!((high / johnson - 1.0).abs() < 0.02, "{high} {johnson}");
        // Slower than first yield nothing is lost.
        assert_eq!(
            steel(5e-3, 0.5 * first.speed, 1e9).impacts().map(|it| it.restitution),
            [1.0; 2]
        );
    }
}
