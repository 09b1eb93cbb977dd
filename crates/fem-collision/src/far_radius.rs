//! How far the mesh of a half-space has to reach.
//!
//! Its far boundary is held. Until pressure waves, the fastest, reach it the mesh is a half-space without
//! end:
//!
//! ```math
//! R \ge r_c + c_p\,t .
//! ```
//!
//! Half of that would do for the contact, to which they have to come back; twice the reach is a tenth
//! more elements, and leaves what goes out whole and a contact that lasts twice as long undisturbed.
//!
//! At rest the held boundary takes a share of the compliance away. A force F on a small spot moves the
//! plane at a distance R by (1 − ν²) F/(π E R), and what lies on the axis as deep by
//! (3 − 2ν)/(2 − 2ν) ≤ 2 times as much (Boussinesq; Johnson, *Contact Mechanics*, section 3.2); a Hertz
//! contact of radius a gives way by 3 (1 − ν²) F/(4 E a) (section 4.2). So the share lies between
//!
//! ```math
//! \frac{4}{3\pi}\frac aR \quad\text{and}\quad \frac{8}{3\pi}\frac aR .
//! ```

use std::f64::consts::PI;

use fem_material::Material;

use crate::aftermath::FLIGHT_AFTER;

/// Share of the compliance that the held boundary of a half-space at rest may take away.
const COMPLIANCE_LEFT_OUT: f64 = 1e-6;

/// Far radius (m) of a half-space of this material that waves do not reach in a run: over a contact of
/// this duration (s) and the flight after it, from anywhere within the radius in which contact is looked
/// for (m). A contact that relaxation makes twice as long is still one without waves that come back.
pub fn far_radius_of_waves(material: &Material, contact_time: f64, candidate_radius: f64) -> f64 {
    let time = (1.0 + FLIGHT_AFTER) * contact_time;
    // A mesh around a contact of no duration still has its rings.
    (candidate_radius + material.dilatational_wave_speed() * time).max(4.0 * candidate_radius)
}

/// Far radius (m) of a half-space that is always in balance, for a contact of this radius (m): the
/// compliance is right to 1e-6.
pub fn far_radius_at_rest(contact_radius: f64) -> f64 {
    8.0 / (3.0 * PI) * contact_radius / COMPLIANCE_LEFT_OUT
}

#[cfg(test)]
mod tests {
    use fem_material::ElasticModuli;

    use super::*;

    /// By hand: c_p = 2 at λ + 2μ = 4 and ρ = 1; 1.2 contact times of 10 take it 24 far.
    #[test]
    fn waves_do_not_reach_the_end() {
        let moduli = ElasticModuli::from_bulk_shear(8.0 / 3.0, 1.0).unwrap();
        let material = Material::new(1.0, moduli, None).unwrap();
        assert!((far_radius_of_waves(&material, 10.0, 0.5) - 24.5).abs() < 1e-12);
        assert_eq!(far_radius_of_waves(&material, 0.0, 0.5), 2.0);
    }
}
