//! A thin plate that is struck: its bending waves carry energy away.
//!
//! A force F on an infinite thin plate moves the point under it like a dashpot,
//!
//! ```math
//! \dot w = \beta F, \qquad \beta = \frac1{8\sqrt{D\rho h}}, \qquad D = \frac{Eh^3}{12(1-\nu^2)},
//! ```
//!
//! whatever the course of the force (Zener 1941, *Phys. Rev.* 59, 669). With Hertz' contact of stiffness K in series, in units of
//! the length ℓ = (m/K)^(2/5) v^(4/5) and the time ℓ/v, the impact of a ball depends on one number,
//!
//! ```math
//! \ddot u + \Bigl(1+\lambda\frac{\mathrm d}{\mathrm dt}\Bigr)u^{3/2} = 0, \qquad
//! \lambda = \beta m\,(K/m)^{2/5}v^{1/5},
//! ```
//!
//! and e ≈ exp(−1.719 λ) at small λ.
//!
//! Limits: the plate is thin against the distance that waves travel in the contact time, and no wave returns from its edge
//! within it. Shear and rotary inertia of the plate are left out.

use fem_material::Material;

use crate::hertz::HertzImpact;
use crate::numerics::functions::power;

/// Returns the point mobility β of an infinite thin plate, m/(N s), with the instantaneous moduli; `thickness` is in metres.
pub fn plate_mobility(material: &Material, thickness: f64) -> f64 {
    let stiffness = material.instantaneous().plane_strain_modulus() * thickness.powi(3) / 12.0;
    (8.0 * (stiffness * material.density() * thickness).sqrt()).recip()
}

/// Returns Zener's λ of an impact on a plate of this mobility, m/(N s).
pub fn plate_lambda(hertz: &HertzImpact, mobility: f64) -> f64 {
    let mass = hertz.pair().effective_mass();
    let rate = power(hertz.stiffness() / mass, 0.4) * power(hertz.approach_speed(), 0.2);
    mobility * mass * rate
}
