//! Hertz' stress anywhere below a circle of contact on a half-space.
//!
//! With lengths over the contact radius a, stresses over the peak pressure p₀, z into the body and
//! 2u = r² + z² − 1 + √((r² + z² − 1)² + 4z²) (Huber 1904; Johnson, *Contact Mechanics*, § 3.4):
//!
//! ```math
//! \sigma_{zz} = -\Big(\frac z{\sqrt u}\Big)^3 \frac{u}{u^2+z^2}, \qquad
//! \sigma_{rz} = -\frac{r z^2}{u^2+z^2}\,\frac{\sqrt u}{1+u},
//! ```
//! ```math
//! \sigma_{rr} = \frac{1-2\nu}{3r^2}\Big[1-\Big(\frac z{\sqrt u}\Big)^3\Big] - \sigma_{zz}
//!   + \frac z{\sqrt u}\Big[\frac{(1-\nu)u}{1+u} + (1+\nu)\sqrt u\arctan\frac1{\sqrt u} - 2\Big],
//! ```
//! ```math
//! \sigma_{\theta\theta} = -\frac{1-2\nu}{3r^2}\Big[1-\Big(\frac z{\sqrt u}\Big)^3\Big]
//!   - \frac z{\sqrt u}\Big[2\nu + \frac{(1-\nu)u}{1+u} - (1+\nu)\sqrt u\arctan\frac1{\sqrt u}\Big].
//! ```
//!
//! Tension positive. Limits: a half-space, so distances well below the sphere's size.

use crate::hertz::HertzPressure;

/// Distance from the axis over the distance from the contact below which the terms in 1/r² are
/// taken by their limit: their next term is of the order of the square.
const NEAR_AXIS: f64 = 1e-4;

impl HertzPressure {
    /// Returns σ_rr, σ_zz, σ_θθ and σ_rz, Pa, at a distance r ≥ 0 (m) from the axis and a depth z ≥ 0, m.
    pub fn stress(&self, r: f64, depth: f64, poissons_ratio: f64) -> [f64; 4] {
        if self.contact_radius == 0.0 {
            return [0.0; 4];
        }
        let (r, z) = (r / self.contact_radius, depth / self.contact_radius);
        unit_stress(r, z, poissons_ratio).map(|stress| self.peak_pressure * stress)
    }
}

/// Returns the stress where contact radius and peak pressure are 1.
fn unit_stress(r: f64, z: f64, nu: f64) -> [f64; 4] {
    let (square, excess) = (r * r, r * r + z * z - 1.0);
    // The root of u² − (r² + z² − 1) u − z² = 0, without the difference of two large numbers.
    let wide = 0.5 * (excess.abs() + (excess * excess + 4.0 * z * z).sqrt());
    let u = if excess >= 0.0 { wide } else { z * z / wide };
    let root = u.sqrt();
    // z/√u tends to √(1 − r²) on the surface inside of the contact.
    let cosine = if root > 0.0 { (z / root).min(1.0) } else { (1.0 - square).max(0.0).sqrt() };
    let cube = cosine.powi(3);
    // z²/(u² + z²), which is 0 where the contact ends.
    let steep = cosine * cosine;
    let share = if steep > 0.0 { steep / (u + steep) } else { 0.0 };
    let axial = -cosine * share;
    let shear = -r * share * root / (1.0 + u);
    // (1 − (z/√u)³)/r², and 3/2 of u'/u = 1/(1 + z²) on the axis.
    let near_axis = square < NEAR_AXIS * NEAR_AXIS * (1.0 + z * z);
    let spread = if near_axis { 1.5 / (1.0 + z * z) } else { (1.0 - cube) / square };
    let outward = (1.0 - 2.0 * nu) / 3.0 * spread;
    let arc = (1.0 + nu) * if root > 0.0 { root * root.recip().atan() } else { 0.0 };
    let flat = (1.0 - nu) * u / (1.0 + u);
    let radial = outward - axial + cosine * (flat + arc - 2.0);
    let hoop = -outward - cosine * (2.0 * nu + flat - arc);
    [radial, axial, hoop, shear]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const UNIT: HertzPressure = HertzPressure { contact_radius: 1.0, peak_pressure: 1.0 };

    /// Axis and boundary are those of their own closed forms, units are taken along.
    #[test]
    fn the_field_has_the_axis_and_the_surface_that_are_known() {
        for nu in [-0.5, 0.0, 0.244, 0.5] {
            for z in [0.0, 0.1, 0.48, 1.0, 7.0, 1e3] {
                let axis = UNIT.axis_stress(z, nu);
                for r in [0.0, 1e-6, 2e-4] {
                    let [rr, zz, tt, rz] = UNIT.stress(r, z, nu);
                    // The terms in 1/r² lose the square of NEAR_AXIS or what rounding leaves.
                    assert!((rr - axis.radial).abs() < 1e-7, "{nu} {z} {r}: {rr} {axis:?}");
                    assert!((tt - axis.radial).abs() < 1e-7 && (zz - axis.axial).abs() < 1e-7);
                    assert!(rz.abs() <= r, "{rz}");
                }
            }
            for r in [0.3, 0.9, 0.999, 1.001, 1.7, 30.0] {
                let [rr, zz, tt, rz] = UNIT.stress(r, 0.0, nu);
                assert!((zz + UNIT.pressure(r)).abs() < 1e-12 && rz == 0.0, "{r}: {zz} {rz}");
                // Johnson, eqs. 3.42 and 3.44: outside of the contact pure shear, inside the sum.
                let sum = -(1.0 + 2.0 * nu) * UNIT.pressure(r);
                assert!((rr + tt - sum).abs() < 1e-12, "{r}: {rr} {tt}");
            }
            // Boussinesq's point force has σ_rr = (1−2ν)F/2πr² on the surface, and so has all that is outside of the contact.
            for r in [1.0, 3.0] {
                let point = (1.0 - 2.0 * nu) * UNIT.force() / (2.0 * PI * r * r);
                assert!((UNIT.stress(r, 0.0, nu)[0] - point).abs() < 1e-12);
            }
        }
        let scaled = HertzPressure { contact_radius: 2e-3, peak_pressure: 3e9 };
        let (one, other) = (scaled.stress(1e-3, 0.6e-3, 0.3), UNIT.stress(0.5, 0.3, 0.3));
        assert!(one.iter().zip(other).all(|(a, b)| (a / 3e9 - b).abs() < 1e-14));
    }

    /// Equilibrium along r and z, of central differences.
    #[test]
    fn the_field_is_in_equilibrium() {
        for nu in [-0.9, 0.0, 0.3, 0.5] {
            for (r, z) in [(0.5, 0.3), (1.0, 0.5), (1.4, 0.2), (0.2, 1.5), (3.0, 4.0)] {
                let h = 1e-5;
                let at = |dr: f64, dz: f64| UNIT.stress(r + dr, z + dz, nu);
                let by = |k: usize, of_r: bool| match of_r {
                    true => (at(h, 0.0)[k] - at(-h, 0.0)[k]) / (2.0 * h),
                    false => (at(0.0, h)[k] - at(0.0, -h)[k]) / (2.0 * h),
                };
                let [rr, _, tt, rz] = at(0.0, 0.0);
                let along_r = by(0, true) + by(3, false) + (rr - tt) / r;
                let along_z = by(3, true) + by(1, false) + rz / r;
                assert!(along_r.abs() < 1e-8 && along_z.abs() < 1e-8, "{along_r} {along_z}");
            }
        }
    }

    /// Far away it is Boussinesq's point force, σ_zz = −3F z³/2πρ⁵.
    #[test]
    fn far_stress_equals_boussinesqs_point_force() {
        for (r, z) in [(0.0, 100.0), (60.0, 80.0), (100.0, 1.0)] {
            let [_, zz, _, rz] = UNIT.stress(r, z, 0.3);
            let rho: f64 = 100.0_f64.hypot(if r == 100.0 { 1.0 } else { 0.0 });
            let point = -1.5 * UNIT.force() / PI / rho.powi(5);
            assert!((zz - point * z.powi(3)).abs() < 2e-3 * (point * z.powi(3)).abs() + 1e-12);
            assert!((rz - point * r * z * z).abs() < 2e-3 * (point * r * z * z).abs() + 1e-12);
        }
    }
}
