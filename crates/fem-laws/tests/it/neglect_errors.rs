//! Errors by neglected effects, against the collision with and without, and published spreads.

use fem_laws::{HertzImpact, Pair, Partner, RelativeError, rigid_partner};

use crate::common::{elastic, steel};

const RUBBER: [f64; 3] = [5e6, 0.49, 1100.0];

/// Rubber ball of 22 mm on steel: the two collisions themselves.
#[test]
fn a_rigid_partner_is_a_wall_or_a_rigid_sphere() {
    let ball = Partner::solid_sphere(22e-3, &elastic(RUBBER));
    for stiff in [elastic([50e6, 0.4, 1100.0]), steel()] {
        let sphere = Partner::solid_sphere(30e-3, &stiff);
        let Partner::Sphere { radius, mass, .. } = sphere else { panic!("a sphere") };
        let rigid = Partner::Sphere { radius, mass, plane_strain_modulus: f64::INFINITY };
        for (partner, instead) in [(sphere, rigid), (Partner::half_space(&stiff), Partner::Wall)] {
            let pair = Pair::new(ball, partner).unwrap();
            let found = rigid_partner(&pair, &partner).unwrap();
            let [with, without] = [pair, Pair::new(ball, instead).unwrap()]
                .map(|pair| HertzImpact::new(&pair, 1.0).unwrap());
            let time = without.contact_time() / with.contact_time() - 1.0;
            let force = without.peak_force() / with.peak_force() - 1.0;
            // Rounding of 1 + 1e-5.
            assert!((found.contact_time - time).abs() < 1e-14 + 1e-12 * time.abs());
            assert!((found.peak_force - force).abs() < 1e-14 + 1e-12 * force.abs());
            assert_eq!(found.restitution, 0.0);
            assert!(found.contact_time < 0.0 && found.peak_force > 0.0);
        }
    }
}

#[test]
fn the_only_body_that_deforms_cannot_be_rigid() {
    let ball = Partner::solid_sphere(22e-3, &elastic(RUBBER));
    let pair = Pair::new(ball, Partner::Wall).unwrap();
    assert_eq!(rigid_partner(&pair, &ball), None);
    assert_eq!(rigid_partner(&pair, &Partner::Wall), Some(RelativeError::default()));
}

#[test]
fn tolerances_bound_the_size_of_each_error() {
    let tolerance = RelativeError { restitution: 1e-4, contact_time: 2e-4, peak_force: 3e-4 };
    assert!(tolerance.is_within(&tolerance));
    for error in [
        RelativeError { restitution: -1.1e-4, ..RelativeError::default() },
        RelativeError { contact_time: -2.1e-4, ..RelativeError::default() },
        RelativeError { peak_force: 3.1e-4, ..RelativeError::default() },
        RelativeError { peak_force: f64::NAN, ..RelativeError::default() },
    ] {
        assert!(!error.is_within(&tolerance));
    }
}
