//! Viscoelastic impact: published references, an independent integration, limits, robustness.

use crate::direct::direct;
use fem_laws::{
    HertzImpact, Impact, LawError, Pair, PairRelaxation, Partner, SlipSurface, SurfaceSlip, Ting,
};
use fem_material::{ActsOn, Material};

use crate::common::{
    GLASS, assert_close, assert_history, assert_values, decaying, pair_of, relaxation_of,
};

fn glass(acts_on: ActsOn, terms: &[(f64, f64)]) -> Material {
    decaying(GLASS, acts_on, terms)
}

fn ting(material: &Material) -> Ting {
    Ting::new(&pair_of(material), relaxation_of([material; 2]))
}

fn impact(acts_on: ActsOn, rate: f64) -> Impact {
    ting(&glass(acts_on, &[(1.0, rate)])).impact(0.5).unwrap()
}

/// Restitutions computed independently for the project, to their printed digits.
#[test]
fn reference_restitutions() {
    use ActsOn::{All, Shear};
    for (acts_on, rate, restitution, half_digit) in [
        (All, 2708.0, 0.92705, 0.5e-5),
        (Shear, 2708.0, 0.94713, 0.5e-5),
        (All, 5966.6, 0.8470, 0.5e-4),
        (Shear, 5966.6, 0.8881, 0.5e-4),
        // The rates are printed to 1 of 2982, which is 2e-5 of e.
        (All, 2982.0, 0.92, 2e-5),
        (Shear, 4173.0, 0.92, 2e-5),
    ] {
        let found = impact(acts_on, rate).restitution;
        assert!((found - restitution).abs() <= half_digit, "{acts_on:?} {rate}: {found}");
    }
    // For the elastic bulk modulus the references print 62.98 µs and 104.4 N. The present numbers, 62.968 µs and
    // 104.476 N, are confirmed by `ting_equals_direct_integration`; the printed ones are one unit of the last digit off.
    for (acts_on, time, force, [half_digit, of_force]) in
        [(All, 62.86, 103.5, [0.005, 0.05]), (Shear, 62.98, 104.4, [0.015, 0.1])]
    {
        let found = impact(acts_on, 2708.0);
        assert!((found.contact_time.unwrap() * 1e6 - time).abs() <= half_digit, "{acts_on:?}");
        assert!((found.peak_force - force).abs() <= of_force, "{acts_on:?}");
    }
}

/// The direct sums converge to the collocation solution.
#[test]
fn ting_equals_direct_integration() {
    let materials = [
        glass(ActsOn::All, &[(1.0, 2708.0)]),
        glass(ActsOn::Shear, &[(1.0, 2708.0)]),
        glass(ActsOn::Shear, &[(0.3, 1e3), (0.2, 2e4), (0.3, 1e5)]),
        glass(ActsOn::All, &[(0.5, 3e4), (0.5, 1e5)]),
    ];
    for material in &materials {
        let pair = pair_of(material);
        let relaxation = relaxation_of([material; 2]);
        let found = Ting::new(&pair, relaxation.clone()).impact(0.5).unwrap();
        let values = [
            found.restitution,
            found.contact_time.unwrap(),
            found.peak_force,
            found.peak_pressure.unwrap(),
            found.max_approach,
        ];
        let fine = direct(&pair, &relaxation, None, 0.5, 4000, 0.0);
        // Second order, but √ at first touch: (1/4000)^1.5 = 4e-6. The time ends on a step.
        let tolerances = [1e-5, 3e-4, 1e-5, 1e-4, 1e-5];
        for i in 0..5 {
            assert_close(values[i], fine[i], tolerances[i]);
        }
    }
}

#[test]
fn elastic_limits_are_hertz() {
    let instant = glass(ActsOn::Shear, &[(0.6, 1e-6)]);
    let relaxed = glass(ActsOn::All, &[(0.6, 1e13)]);
    // K∞ = 0.4 K₀ in Hertz' powers.
    for (material, factor) in [(&instant, 1.0f64), (&relaxed, 0.4)] {
        let found = ting(material).impact(0.5).unwrap();
        let hertz = HertzImpact::new(&pair_of(material), 0.5).unwrap();
        // βT is 6e-11, or its inverse 1e-9: what is left is the integration.
        let [time, force, approach] =
            [hertz.contact_time(), hertz.peak_force(), hertz.max_approach()];
        let (slower, softer) = (factor.powf(-0.4), factor.powf(0.4));
        assert_values(&found, &[1.0, time * slower, force * softer, approach * slower], 1e-8);
        assert_close(found.peak_pressure.unwrap(), hertz.peak_pressure() * factor.powf(0.8), 1e-6);
    }
}

/// A fast Maxwell fluid only brakes: m* v = K δ^(3/2)/β, for ever.
#[test]
fn fast_maxwell_fluid_stops_at_the_viscous_approach() {
    let material = glass(ActsOn::All, &[(1.0, 1e10)]);
    let found = ting(&material).impact(0.5).unwrap();
    let pair = pair_of(&material);
    let stiffness = HertzImpact::new(&pair, 0.5).unwrap().stiffness();
    let stop = (pair.effective_mass() * 0.5 * 1e10 / stiffness).powf(2.0 / 3.0);
    // Elasticity is worth 1/(βt)^…, here 1e-8; the rate at the end 1e-8.
    assert_close(found.max_approach, stop, 1e-6);
    assert_eq!((found.restitution, found.contact_time), (0.0, None));
}

/// From elastic to viscous over 18 decades of the rate: always an answer, always possible.
#[test]
fn ting_returns_a_valid_result_at_all_rates() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for weight in [1e-9, 0.1, 0.9, 1.0 - 1e-6, 1.0] {
            for exponent in -2..=10 {
                let rate = 1.6 * 10f64.powi(exponent);
                let found = ting(&glass(acts_on, &[(weight, rate)])).impact(0.5);
                let found = found.unwrap_or_else(|error| panic!("{weight} {rate:e} {error}"));
                assert!((0.0..=1.0 + 1e-9).contains(&found.restitution), "{weight} {rate:e}");
                assert_eq!(found.contact_time.is_none(), found.restitution == 0.0);
                assert!(found.history.is_sorted_by(|a, b| a.time < b.time));
            }
        }
    }
}

/// Bodies of which nothing lasts come to rest at whatever rate: no rounding of the force keeps them going.
/// One in twelve of these did not before that was seen.
#[test]
fn bodies_that_flow_come_to_rest() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for k in 0..60 {
            // β T from 19 to 1e7: bodies whose shear alone flows part below 13.
            let rate = 3e5 * 1.25f64.powi(k);
            let found = ting(&glass(acts_on, &[(1.0, rate)])).impact(0.5).unwrap();
            assert_eq!((found.restitution, found.contact_time), (0.0, None), "{acts_on:?} {rate}");
        }
    }
}

/// Many terms over twelve decades, against speed and mass in other units: similarity in βT.
#[test]
fn ting_is_independent_of_units() {
    let terms: Vec<(f64, f64)> =
        (0..25).map(|k| (0.036, 10f64.powf(-2.0 + 0.5 * f64::from(k)))).collect();
    let reference = ting(&glass(ActsOn::All, &terms)).impact(0.5).unwrap();
    let time = reference.contact_time.unwrap();
    for (mass, speed) in [(1e-12, 1e-9), (1e6, 1e3), (1.0, 1e-3)] {
        let plane_strain_modulus = 67e9;
        let sphere = Partner::Sphere { radius: 0.1, mass, plane_strain_modulus };
        let pair = Pair::new(sphere, Partner::Wall).unwrap();
        let glass_time = HertzImpact::new(&pair_of(&glass(ActsOn::All, &terms)), 0.5).unwrap();
        let scale =
            HertzImpact::new(&pair, speed).unwrap().contact_time() / glass_time.contact_time();
        let scaled: Vec<(f64, f64)> = terms.iter().map(|(w, rate)| (*w, rate / scale)).collect();
        let relaxation = PairRelaxation::new(Some(&glass(ActsOn::All, &scaled)), None).unwrap();
        let found = Ting::new(&pair, relaxation).impact(speed).unwrap();
        // Rounding of powers makes steps differ: the error of the integration shows.
        assert_close(found.restitution, reference.restitution, 1e-8);
        assert_close(found.contact_time.unwrap(), time * scale, 1e-8);
    }
}

#[test]
fn ting_history_agrees_with_the_impact_result() {
    let material = glass(ActsOn::Shear, &[(1.0, 1e4)]);
    let (found, pair) = (ting(&material).impact(0.5).unwrap(), pair_of(&material));
    // Some hundred steps.
    assert_history(&found, [0.5, pair.effective_mass()], [1e-9, 1e-12], 1e-3);
    let last = found.history.last().unwrap();
    assert_eq!((last.force, last.contact_radius), (0.0, 0.0));
    assert!(last.approach > 0.0);
    let steps = found.history.windows(2);
    let work: f64 = steps
        .map(|two| 0.5 * (two[0].force + two[1].force) * (two[1].approach - two[0].approach))
        .sum();
    let lost = 1.0 - found.restitution.powi(2);
    assert_close(work, 0.5 * pair.effective_mass() * 0.25 * lost, 1e-2);
    for instant in &found.history {
        let grown = (pair.effective_radius() * instant.approach).sqrt();
        // Geometry in loading; a smaller contact than the geometric one in unloading.
        assert!(instant.contact_radius <= grown * (1.0 + 1e-5));
        if instant.approach_rate > 0.0 {
            assert_close(instant.contact_radius, grown, 1e-4);
        }
    }
}

#[test]
fn ting_rejects_impossible_speeds() {
    let material = glass(ActsOn::All, &[(1.0, 2708.0)]);
    for value in [0.0, -1.0, f64::INFINITY] {
        let refused = LawError::NotPositive { quantity: "approach_speed", value };
        assert_eq!(ting(&material).impact(value), Err(refused));
    }
}

/// A step that shrinks to none ends at once, and not after all the steps that a collision may take: where
/// surfaces slip by more than the contact has, nothing is solved.
#[test]
fn vanishing_time_step_returns_not_finished_at_once() {
    let glass = glass(ActsOn::Shear, &[(0.15, 2708.0)]);
    let face = |material| SlipSurface::new(1.0 / 7.95e-3, material);
    let ting = ting(&glass).with_surface_slip(SurfaceSlip::new([face(Some(&glass)), face(None)]));
    for speed in [1e12, 1e15, 1e18] {
        match ting.impact(speed) {
            Err(LawError::NotFinished { n_steps, .. }) => assert!(n_steps < 2_000, "{n_steps}"),
            other => panic!("{speed}: {other:?}"),
        }
    }
}
