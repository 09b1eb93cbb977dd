//! Hertz' pressure on a circle, and the stress it makes below the surface of a half-space.
//!
//! ```math
//! p(r) = p_0\sqrt{1-r^2/a^2}, \qquad F = \tfrac23\pi a^2 p_0
//! ```
//!
//! On the axis at the depth z, with ζ = z/a (Johnson, *Contact Mechanics*, eq. 3.45):
//!
//! ```math
//! \sigma_{yy} = -\frac{p_0}{1+\zeta^2}, \qquad \sigma_{rr} = \sigma_{\theta\theta} =
//! -p_0\left[(1+\nu)(1-\zeta\arctan\tfrac1\zeta) - \frac1{2(1+\zeta^2)}\right]
//! ```
//!
//! Tension positive. Limits: a half-space, so depths and radii well below the sphere's.

use std::f64::consts::PI;

/// A pressure distribution; both numbers are 0 for an open contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzPressure {
    /// Contact radius a, m.
    pub contact_radius: f64,
    /// Pressure on the axis p₀, Pa.
    pub peak_pressure: f64,
}

/// Principal stresses on the axis, Pa, tension positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisStress {
    /// Axial stress σ_yy.
    pub axial: f64,
    /// Radial and hoop stress σ_rr = σ_θθ.
    pub radial: f64,
}

impl AxisStress {
    /// Returns the largest shear stress, on planes at 45° to the axis.
    pub fn max_shear(&self) -> f64 {
        0.5 * (self.radial - self.axial).abs()
    }
}

impl HertzPressure {
    /// Returns p, Pa, at the distance r, m, from the axis; 0 outside the contact.
    pub fn pressure(&self, r: f64) -> f64 {
        if r.abs() < self.contact_radius {
            let ratio = r / self.contact_radius;
            self.peak_pressure * ((1.0 - ratio) * (1.0 + ratio)).sqrt()
        } else {
            0.0
        }
    }

    /// Returns the contact force F, N.
    pub fn force(&self) -> f64 {
        2.0 / 3.0 * PI * self.contact_radius * self.contact_radius * self.peak_pressure
    }

    /// Returns the stress on the axis at a depth ≥ 0, m, accurate to rounding of p₀.
    pub fn axis_stress(&self, depth: f64, poissons_ratio: f64) -> AxisStress {
        if self.contact_radius == 0.0 {
            return AxisStress { axial: 0.0, radial: 0.0 };
        }
        let zeta = depth / self.contact_radius;
        let axial = 1.0 / (1.0 + zeta * zeta);
        let spread = 1.0 - zeta * zeta.recip().atan();
        AxisStress {
            axial: -self.peak_pressure * axial,
            radial: -self.peak_pressure * ((1.0 + poissons_ratio) * spread - 0.5 * axial),
        }
    }
}
