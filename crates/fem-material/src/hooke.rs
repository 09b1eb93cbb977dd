//! Isotropic linear elasticity in axial symmetry: energy and stress of a small strain.
//!
//! The energy per volume splits into a change of volume and a change of shape,
//!
//! ```math
//! W = \tfrac12 K e_v^2 + G\, e':e', \qquad e_v = \mathrm{tr}\, e, \quad e' = e - \tfrac13 e_v I,
//! ```
//!
//! and the stress is its derivative, σ = K e_v I + 2G e′ (Hooke's law; Cauchy stress, tension
//! positive). Components are ordered rr, yy, θθ, ry; the shear strain is the engineering one,
//! γ_ry = 2 e_ry. Limits: small strain.

use crate::elastic::ElasticModuli;

impl ElasticModuli {
    /// Returns the stress `[rr, yy, tt, ry]`, Pa, of the strain `[e_rr, e_yy, e_tt, γ_ry]`.
    pub fn stress(&self, strain: [f64; 4]) -> [f64; 4] {
        let (volumetric, [rr, yy, tt]) = split(strain);
        let mean = self.bulk_modulus() * volumetric;
        let two_g = 2.0 * self.shear_modulus();
        let shear = self.shear_modulus() * strain[3];
        [mean + two_g * rr, mean + two_g * yy, mean + two_g * tt, shear]
    }

    /// Returns the energy per volume, J/m³, of the strain `[e_rr, e_yy, e_tt, γ_ry]`.
    pub fn strain_energy_density(&self, strain: [f64; 4]) -> f64 {
        let (volumetric, [rr, yy, tt]) = split(strain);
        let shape = rr * rr + yy * yy + tt * tt + 0.5 * strain[3] * strain[3];
        0.5 * self.bulk_modulus() * volumetric * volumetric + self.shear_modulus() * shape
    }
}

/// Returns the volumetric strain and the normal components of the deviator.
fn split([rr, yy, tt, _]: [f64; 4]) -> (f64, [f64; 3]) {
    let volumetric = rr + yy + tt;
    let mean = volumetric / 3.0;
    (volumetric, [rr - mean, yy - mean, tt - mean])
}
