//! Elastic moduli, Hooke's law and the wave speeds.

use fem_material::{ElasticModuli, Material, MaterialError, ModuliInput};

/// A few roundings of 1.1e-16 each; every formula here is free of cancellation.
const ROUNDING: f64 = 2e-15;

fn assert_close(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance * expected.abs(),
        "found {found:e}, expected {expected:e}"
    );
}

fn input(e: Option<f64>, g: Option<f64>, k: Option<f64>, nu: Option<f64>) -> ModuliInput {
    ModuliInput { youngs_modulus: e, shear_modulus: g, bulk_modulus: k, poissons_ratio: nu }
}

/// Textbook identities in E and ν, whereas the code stores K and G.
#[test]
fn identities_hold_for_any_poissons_ratio() {
    for nu in [-0.95, -0.5, -0.1, 0.0, 0.1, 0.244, 0.3, 0.45, 0.49] {
        let e = 63e9;
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(e, nu).unwrap();
        // 1 − 2ν and 1 + ν, rounded at 1.1e-16, are at least 0.02 here: 1e-14 relative.
        let tolerance = 1e-14;
        assert_close(moduli.youngs_modulus(), e, tolerance);
        assert!((moduli.poissons_ratio() - nu).abs() < 1e-15);
        assert_close(moduli.shear_modulus(), e / (2.0 * (1.0 + nu)), tolerance);
        assert_close(moduli.bulk_modulus(), e / (3.0 * (1.0 - 2.0 * nu)), tolerance);
        let lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        // λ is a difference of moduli of the size of M.
        let p_wave = e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        assert!((moduli.lame_lambda() - lambda).abs() < tolerance * p_wave);
        assert_close(moduli.p_wave_modulus(), p_wave, tolerance);
        assert_close(moduli.plane_strain_modulus(), e / (1.0 - nu * nu), tolerance);
    }
}

#[test]
fn any_two_constants_give_the_same_solid() {
    for nu in [-0.9, -0.3, 0.0, 0.244, 0.45] {
        let expected = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, nu).unwrap();
        let (e, g, k) = (Some(63e9), Some(expected.shear_modulus()), Some(expected.bulk_modulus()));
        let nu = Some(nu);
        for two in [
            input(e, g, None, None),
            input(e, None, k, None),
            input(e, None, None, nu),
            input(None, g, k, None),
            input(None, g, None, nu),
            input(None, None, k, nu),
        ] {
            let moduli = ElasticModuli::from_two(two).unwrap();
            // 3G − E and 9K − E cancel to a tenth at worst.
            assert_close(moduli.shear_modulus(), expected.shear_modulus(), 2e-14);
            assert_close(moduli.bulk_modulus(), expected.bulk_modulus(), 2e-14);
        }
    }
}

/// ε is a power of two, so that ν is exact and the expected moduli are known to the last digit.
#[test]
fn accurate_up_to_the_limits_of_poissons_ratio() {
    let epsilon = 2f64.powi(-40);
    let g = 1e9;

    // ν = 1/2 − ε: K = 2G(3/2 − ε)/6ε, E = 2G(3/2 − ε).
    let soft = ElasticModuli::from_two(input(None, Some(g), None, Some(0.5 - epsilon))).unwrap();
    assert_close(soft.bulk_modulus(), g * (1.5 - epsilon) / (3.0 * epsilon), ROUNDING);
    assert_close(soft.youngs_modulus(), 2.0 * g * (1.5 - epsilon), ROUNDING);
    assert_close(soft.plane_strain_modulus(), 2.0 * g / (0.5 + epsilon), ROUNDING);
    let from_e = ElasticModuli::from_two(input(Some(3e9), None, None, Some(0.5 - epsilon)));
    assert_close(from_e.unwrap().bulk_modulus(), 3e9 / (6.0 * epsilon), ROUNDING);
    let from_k = ElasticModuli::from_two(input(None, None, Some(1e9), Some(0.5 - epsilon)));
    assert_close(from_k.unwrap().shear_modulus(), 3e9 * epsilon / (1.5 - epsilon), ROUNDING);

    // ν = −1 + ε: E = 2Gε, K = 2Gε/3(3 − 2ε), E/(1−ν²) = 2G/(2 − ε).
    let auxetic =
        ElasticModuli::from_two(input(None, Some(g), None, Some(-1.0 + epsilon))).unwrap();
    assert_close(auxetic.youngs_modulus(), 2.0 * g * epsilon, ROUNDING);
    assert_close(
        auxetic.bulk_modulus(),
        2.0 * g * epsilon / (3.0 * (3.0 - 2.0 * epsilon)),
        ROUNDING,
    );
    assert_close(auxetic.plane_strain_modulus(), 2.0 * g / (2.0 - epsilon), ROUNDING);
    let from_e_and_g = ElasticModuli::from_two(input(Some(2.0 * g * epsilon), Some(g), None, None));
    assert_close(from_e_and_g.unwrap().bulk_modulus(), auxetic.bulk_modulus(), ROUNDING);
}

#[test]
fn impossible_moduli_are_refused_by_name() {
    let bad_positive = |quantity, value| MaterialError::NotPositive { quantity, value };
    let count = |given: &[&'static str]| MaterialError::ModuliCount { given: given.to_vec() };
    let implied = |youngs_modulus, other, implied, limit| MaterialError::ImpliedPoissonsRatio {
        youngs_modulus,
        other,
        other_value: 1.0,
        implied,
        limit,
    };
    let infinity = f64::INFINITY;
    let cases = [
        (input(None, None, None, None), count(&[])),
        (input(Some(1.0), None, None, None), count(&["youngs_modulus"])),
        (
            input(Some(1.0), Some(1.0), None, Some(0.3)),
            count(&["youngs_modulus", "shear_modulus", "poissons_ratio"]),
        ),
        (input(Some(0.0), None, None, Some(0.3)), bad_positive("youngs_modulus", 0.0)),
        (input(None, Some(-1.0), None, Some(0.3)), bad_positive("shear_modulus", -1.0)),
        (input(None, Some(1.0), Some(infinity), None), bad_positive("bulk_modulus", infinity)),
        (input(Some(1.0), None, None, Some(0.5)), MaterialError::PoissonsRatio { value: 0.5 }),
        (input(None, Some(1.0), None, Some(-1.0)), MaterialError::PoissonsRatio { value: -1.0 }),
        (input(Some(4.0), Some(1.0), None, None), implied(4.0, "shear_modulus", 1.0, 3.0)),
        (input(Some(9.0), None, Some(1.0), None), implied(9.0, "bulk_modulus", -1.0, 9.0)),
    ];
    for (two, expected) in cases {
        assert_eq!(ElasticModuli::from_two(two), Err(expected));
    }
    for position in 0..4 {
        let mut values = [None; 4];
        values[position] = Some(f64::NAN);
        values[(position + 1) % 4] = Some(0.3);
        let [e, g, k, nu] = values;
        assert!(ElasticModuli::from_two(input(e, g, k, nu)).is_err(), "NaN at {position}");
    }
    // A bulk modulus beyond the range of f64.
    assert!(ElasticModuli::from_youngs_modulus_poissons_ratio(1e308, 0.499).is_err());
}

#[test]
fn messages_name_what_was_found_and_what_is_allowed() {
    let message = |two| ElasticModuli::from_two(two).unwrap_err().to_string();
    assert_eq!(
        message(input(None, None, None, None)),
        "exactly two of youngs_modulus, shear_modulus, bulk_modulus, poissons_ratio are needed, \
         found none"
    );
    assert_eq!(
        message(input(Some(3.5), Some(1.0), None, None)),
        "youngs_modulus 3.5 with shear_modulus 1.0 implies poissons_ratio 0.75; -1 < \
         poissons_ratio < 0.5 needs youngs_modulus < 3.0"
    );
}

#[test]
fn linear_stress_is_the_derivative_of_the_energy() {
    for nu in [-0.5, 0.0, 0.244, 0.49] {
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(1.0, nu).unwrap();
        let strain = [0.3, -0.7, 0.2, 0.5];
        let stress = moduli.stress(strain);
        let largest = stress.iter().fold(0.0f64, |max, s| max.max(s.abs()));
        for i in 0..4 {
            let energy = |step: f64| {
                let mut moved = strain;
                moved[i] += step;
                moduli.strain_energy_density(moved)
            };
            // The energy is quadratic: a central difference of any width is exact.
            let slope = (energy(0.5) - energy(-0.5)) / 1.0;
            assert!((stress[i] - slope).abs() < 1e-14 * (1.0 + largest), "component {i}");
        }
    }
}

/// The four tests that define the moduli.
#[test]
fn stress_of_the_defining_strains() {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    let tolerance = 1e-14 * moduli.p_wave_modulus();
    let assert_stress = |strain: [f64; 4], expected: [f64; 4]| {
        let stress = moduli.stress(strain);
        for i in 0..4 {
            assert!((stress[i] - expected[i]).abs() < tolerance, "{stress:?} {expected:?}");
        }
    };
    let pressure = 3.0 * moduli.bulk_modulus();
    assert_stress([1.0, 1.0, 1.0, 0.0], [pressure, pressure, pressure, 0.0]);
    assert_stress([0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, moduli.shear_modulus()]);
    assert_stress([-0.244, 1.0, -0.244, 0.0], [0.0, 63e9, 0.0, 0.0]);
    let (lambda, p_wave) = (moduli.lame_lambda(), moduli.p_wave_modulus());
    assert_stress([1.0, 0.0, 0.0, 0.0], [p_wave, lambda, lambda, 0.0]);
}

/// Reference numbers for glass, printed to 0.1 m/s.
#[test]
fn wave_speeds_of_glass() {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    let glass = Material::new(2390.0, moduli, None).unwrap();
    assert!((glass.dilatational_wave_speed() - 5593.5).abs() < 0.05);
    assert!((glass.shear_wave_speed() - 3255.0).abs() < 0.05);
}
