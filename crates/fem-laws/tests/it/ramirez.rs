//! The series of Ramírez, Pöschel, Brilliantov & Schwager (1999) for Kuwabara and Kono's law.
//!
//! ```math
//! e = 1 - C_1x + \tfrac35C_1^2x^2 \mp \dots, \qquad
//! x = \tfrac32A\left(\frac K{m^*}\right)^{2/5}v^{1/5}, \quad
//! C_1 = \frac{\sqrt\pi\,\Gamma(3/5)}{2^{1/5}5^{2/5}\,\Gamma(21/10)} = 1.15344
//! ```
//!
//! The contact ends at zero overlap.

use std::f64::consts::PI;

use fem_laws::laws::kuwabara_kono;
use fem_laws::{EndRule, LawImpact, Pair, Partner};
use statrs::function::gamma::gamma;

fn restitution(x: f64) -> f64 {
    let sphere = Partner::Sphere { radius: 1e-2, mass: 5e-3, plane_strain_modulus: 7e10 };
    let pair = Pair::new(sphere, sphere).unwrap();
    let speed = 0.3f64;
    let stiffness = kuwabara_kono(&pair, 0.0).unwrap().stiffness();
    let unit = 1.5 * (stiffness / pair.effective_mass()).powf(0.4) * speed.powf(0.2);
    let law = kuwabara_kono(&pair, x / unit).unwrap();
    let model = LawImpact::new(&pair, law).with_end_rule(EndRule::ZeroOverlap);
    model.with_tolerance(1e-10).unwrap().impact(speed).unwrap().restitution
}

#[test]
fn restitution_equals_the_series_to_second_order() {
    let first = PI.sqrt() * gamma(0.6) / (2f64.powf(0.2) * 5f64.powf(0.4) * gamma(2.1));
    assert!((first - 1.15344).abs() < 1e-5, "{first}");
    let remainder = |x: f64| 1.0 - first * x + 0.6 * first * first * x * x - restitution(x);
    for x in [0.005, 0.01, 0.02, 0.04] {
        // What is left is of the third order, so it grows eightfold when x doubles; the fourth
        // order takes 0.7 x of it, and e is good to 1e-10 of 6e-8 or more.
        let ratio = remainder(2.0 * x) / remainder(x);
        assert!((ratio / 8.0 - 1.0).abs() < x + 2e-3, "{x}: {ratio}");
        assert!(remainder(x) < x.powi(3));
    }
}
