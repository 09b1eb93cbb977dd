//! Effective radius, mass and modulus.

use fem_laws::{
    LawError, Pair, Partner, compliance_shares, restitution_of_mass_centres, sphere_mass,
};

use crate::common::{elastic, glass, glass_pair};

fn sphere(radius: f64, mass: f64, plane_strain_modulus: f64) -> Partner {
    Partner::Sphere { radius, mass, plane_strain_modulus }
}

/// Reference numbers of the glass pair, to their printed digits.
#[test]
fn effective_values_of_the_glass_pair() {
    let pair = glass_pair();
    assert!((pair.effective_mass() - 3.6787e-3).abs() < 0.5e-7);
    assert!((pair.effective_radius() - 4.6323e-3).abs() < 0.5e-7);
    assert!((pair.contact_modulus() - 33.494e9).abs() < 0.5e6);
    let [small, large] = [15.9e-3, 22.2e-3].map(|d| Partner::solid_sphere(d, &glass()));
    assert_eq!(Pair::new(small, large).unwrap(), pair);
}

/// A body's share is E*/E′; binary fractions again, but for 1/5.
#[test]
fn shares_of_the_compliance_are_moduli_over_each_other() {
    let moduli = [20.0, 5.0];
    let pair = Pair::new(sphere(1.0, 6.0, moduli[0]), sphere(3.0, 3.0, moduli[1])).unwrap();
    let shares = compliance_shares(moduli.map(f64::recip));
    for (share, modulus) in shares.into_iter().zip(moduli) {
        assert!((share - pair.contact_modulus() / modulus).abs() < 1e-15, "{share}");
    }
    assert_eq!(compliance_shares([f64::INFINITY.recip(), 0.2]), [0.0, 1.0]);
}

#[test]
fn mass_of_a_sphere() {
    // Archimedes: two thirds of the cylinder π/4 D² × D.
    let cylinder = std::f64::consts::FRAC_PI_4 * 27.0 * 2.0;
    assert!((sphere_mass(3.0, 2.0) - 2.0 / 3.0 * cylinder).abs() < 1e-14);
}

#[test]
fn impossible_partners_are_refused_by_name() {
    let (wall, block) = (Partner::Wall, Partner::HalfSpace { plane_strain_modulus: 20.0 });
    let (rigid, held) = (sphere(1.0, 1.0, f64::INFINITY), sphere(1.0, f64::INFINITY, 1.0));
    for (one, other, expected) in [
        (wall, wall, LawError::TwoWalls),
        (block, block, LawError::NoSphere),
        (wall, block, LawError::NoSphere),
        (rigid, rigid, LawError::TwoRigidBodies),
        (rigid, wall, LawError::TwoRigidBodies),
        (held, held, LawError::NothingMoves),
        (held, wall, LawError::NothingMoves),
    ] {
        assert_eq!(Pair::new(one, other), Err(expected), "{one:?} {other:?}");
    }
    for bad in [0.0, -1.0, f64::INFINITY] {
        for (partner, quantity) in [
            (sphere(bad, 1.0, 1.0), "radius"),
            (Partner::HalfSpace { plane_strain_modulus: bad }, "plane_strain_modulus"),
        ] {
            let expected = LawError::NotPositive { quantity, value: bad };
            assert_eq!(Pair::new(partner, Partner::Wall), Err(expected.clone()));
            assert_eq!(Pair::new(sphere(1.0, 1.0, 1.0), partner), Err(expected));
        }
    }
    for bad in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        for partner in [sphere(bad, 1.0, 1.0), sphere(1.0, bad, 1.0), sphere(1.0, 1.0, bad)] {
            for other in [wall, sphere(1.0, 1.0, 1.0)] {
                assert!(Pair::new(partner, other).is_err() && Pair::new(other, partner).is_err());
            }
        }
    }
}

/// A half-space drops out of radius and mass, a rigid sphere out of the modulus; binary fractions are exact.
#[test]
fn unlike_bodies_add_their_reciprocals() {
    let block = Partner::HalfSpace { plane_strain_modulus: 20.0 };
    let (large, small) = (sphere(3.0, 3.0, 5.0), sphere(1.0, 6.0, 20.0));
    let held = sphere(3.0, f64::INFINITY, 5.0);
    let rigid = sphere(3.0, 3.0, f64::INFINITY);
    for (a, b, values) in [
        (small, large, [0.75, 2.0, 4.0]),
        (small, Partner::Wall, [1.0, 6.0, 20.0]),
        (large, block, [3.0, 3.0, 4.0]),
        (small, held, [0.75, 6.0, 4.0]),
        (small, rigid, [0.75, 2.0, 20.0]),
        (rigid, block, [3.0, 3.0, 20.0]),
    ] {
        let pair = Pair::new(a, b).unwrap();
        let found = [pair.effective_radius(), pair.effective_mass(), pair.contact_modulus()];
        assert_eq!(found, values, "{a:?} {b:?}");
        assert_eq!(Pair::new(b, a).unwrap(), pair);
    }
}

#[test]
fn half_space_of_a_material_has_its_modulus() {
    // E/(1 − ν²) = 63/0.75 at ν = 1/2; the nearest that is stable is 1e-9 off.
    let glass = elastic([63e9, 0.499_999_999, 2390.0]);
    let Partner::HalfSpace { plane_strain_modulus } = Partner::half_space(&glass) else { panic!() };
    assert!((plane_strain_modulus / 84e9 - 1.0).abs() < 1e-8);
}

/// Momentum: a ball of 1 kg comes at 4 m/s and leaves at 2; the block of 8 kg has 6 kg m/s.
#[test]
fn restitution_of_mass_centres_follows_from_momentum() {
    assert_eq!(restitution_of_mass_centres(0.5, 0.125), (2.0 + 6.0 / 8.0) / 4.0);
}
