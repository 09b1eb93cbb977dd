//! Impact on a half-space that takes waves away: Hunter's loss, an independent integration, energy.

use fem_laws::{
    FiniteSize, HertzImpact, Impact, ImpactPath, LawError, Pair, PairRelaxation, Partner, Ting,
    radiated_share, radiation_damping, restitution_of_mass_centres, sphere_mass,
};
use fem_material::{ActsOn, Material};

use crate::common::{assert_values, decaying, relaxation_of, values};

const RADIUS: f64 = 5e-3;

fn material(terms: &[(f64, f64)], acts_on: ActsOn) -> Material {
    decaying([63e9, 0.25, 2390.0], acts_on, terms)
}

fn elastic() -> Material {
    material(&[], ActsOn::All)
}

/// Speed √(E/ρ) of the material, m/s.
fn bar_wave_speed(material: &Material) -> f64 {
    (material.instantaneous().youngs_modulus() / material.density()).sqrt()
}

fn on_block(ball: &Material, block: &Material) -> (Pair, Ting) {
    let sphere = Partner::solid_sphere(2.0 * RADIUS, ball);
    let pair = Pair::new(sphere, Partner::half_space(block)).unwrap();
    (pair, Ting::new(&pair, relaxation_of([ball, block])))
}

fn radiating(ball: &Material, block: &Material, speed: f64) -> Impact {
    on_block(ball, block).1.with_radiation([block]).unwrap().impact(speed).unwrap()
}

fn loss(impact: &Impact) -> f64 {
    1.0 - impact.restitution.powi(2)
}

/// Hunter (1957), 1.04 (v/c₀)^(3/5) at ν = 1/4 of a half-sine; with Hertz' pulse instead of it 1.1115, by
/// hand with the beta function of the pulse.
#[test]
fn small_radiation_losses_equal_hunters() {
    let material = elastic();
    for ratio in [1e-7, 1e-6, 1e-5, 1e-4, 1e-3] {
        let speed = ratio * bar_wave_speed(&material);
        let found = radiating(&material, &material, speed);
        let expected = 1.1115 * ratio.powf(0.6);
        let hertz = HertzImpact::new(&on_block(&material, &material).0, speed).unwrap();
        let share = radiated_share(&hertz, &material) / expected;
        assert!((share - 1.0).abs() < 9e-4, "{share}");
        // The passive form takes 4e-4 of it, the weaker pulse something of the order of the loss.
        let tolerance = 5e-4 + expected;
        assert!((loss(&found) / expected - 1.0).abs() < tolerance, "{ratio:e} {}", loss(&found));
    }
}

/// Next to the fine waves, as the docs of the forecast say: a loss of 0.6 % of the restitution.
#[test]
fn coarse_waves_estimate_the_loss_of_fine_waves() {
    let material = elastic();
    let speed = 5e-4 * bar_wave_speed(&material);
    let (_, plain) = on_block(&material, &material);
    let waves = plain.clone().with_radiation([&material]).unwrap();
    let [coarse, fine, plain] =
        [waves.clone().with_coarse_waves(), waves, plain].map(|ting| ting.impact(speed).unwrap());
    let changes = |impact: &Impact| {
        [
            plain.restitution - impact.restitution,
            plain.peak_force - impact.peak_force,
            impact.contact_time.unwrap() - plain.contact_time.unwrap(),
        ]
    };
    let (coarse, fine) = (changes(&coarse), changes(&fine));
    for (k, least) in [0.99, 0.93, 0.6].into_iter().enumerate() {
        let share = coarse[k] / fine[k];
        assert!((least..1.0).contains(&share), "{k}: {share}");
    }
}

/// A share that overflows is none that is small.
#[test]
fn radiation_share_that_overflows_is_outside_validity() {
    let material = elastic();
    let waves = on_block(&material, &material).1.with_radiation([&material]).unwrap();
    for speed in [1e100, 1e150, 1e200] {
        let found = waves.impact(speed);
        assert!(matches!(found, Err(LawError::OutsideValidity { .. })), "{speed}: {found:?}");
    }
}

/// Explicit finite elements of a ball of 10 mm on spheres so large that no wave comes back within the
/// contact (T c_s/D = 0.3 to 0.9).
#[test]
fn large_spheres_meet_finite_elements() {
    let glass = elastic();
    let ball = Partner::solid_sphere(2.0 * RADIUS, &glass);
    for (diameter, speed, lost, tolerance) in [
        // The elements are good to 1 %, and the next order of a/(c_s T) is some per cent.
        (0.3f64, 3.0, 6.584e-3, 0.05),
        (0.3, 0.3, 1.578e-3, 0.05),
        (0.15, 3.0, 5.997e-3, 0.05),
        // The difference of two numbers of which each is off by 5 %; the first waves near the return.
        (0.1, 3.0, 4.839e-3, 0.15),
    ] {
        let radius = 0.5 * diameter;
        let modulus = glass.instantaneous().plane_strain_modulus();
        let block = Partner::Sphere { radius, mass: f64::INFINITY, plane_strain_modulus: modulus };
        let pair = Pair::new(ball, block).unwrap();
        let size = FiniteSize::new(Some((RADIUS, &glass)), None).unwrap();
        let ting = Ting::new(&pair, relaxation_of([&glass; 2])).with_finite_size(size);
        let found = ting.with_radiation([&glass]).unwrap().impact(speed).unwrap();
        let mass_ratio = mass(&glass) / sphere_mass(diameter, glass.density());
        let found = 1.0 - restitution_of_mass_centres(found.restitution, mass_ratio);
        assert!((found / lost - 1.0).abs() < tolerance, "{diameter} {speed}: {found}");
    }
}

/// The restitution of m δ̈ = −K δ^(3/2) − γ (9/4) K² δ δ̇: δ = u − γ Ḟ with u and Ḟ put in once more, of
/// order γ (as Landau and Lifshitz treat the force of radiation). Runge and Kutta, 4000 steps.
fn reduced_order(hertz: &HertzImpact, damping: f64) -> f64 {
    let (mass, stiffness) = (hertz.pair().effective_mass(), hertz.stiffness());
    let dashpot = 2.25 * damping * stiffness * stiffness;
    let force = |[approach, rate]: [f64; 2]| {
        let closed = approach.max(0.0);
        stiffness * closed * closed.sqrt() + dashpot * closed * rate
    };
    let dt = hertz.contact_time() / 4000.0;
    let slope = |state: [f64; 2]| [state[1], -force(state) / mass];
    let moved =
        |state: [f64; 2], slope: [f64; 2], dt: f64| [0, 1].map(|i| state[i] + dt * slope[i]);
    let mut state = [0.0, hertz.approach_speed()];
    while state[1] > 0.0 || force(state) > 0.0 {
        let first = slope(state);
        let second = slope(moved(state, first, 0.5 * dt));
        let third = slope(moved(state, second, 0.5 * dt));
        let fourth = slope(moved(state, third, dt));
        let mean = [0, 1].map(|i| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0);
        state = moved(state, mean, dt);
    }
    -state[1] / hertz.approach_speed()
}

#[test]
fn ting_with_radiation_equals_reduced_order_integration() {
    let material = elastic();
    for ratio in [1e-4, 1e-3, 3e-3, 1e-2] {
        let speed = ratio * bar_wave_speed(&material);
        let hertz = HertzImpact::new(&on_block(&material, &material).0, speed).unwrap();
        let (share, damping) = (radiated_share(&hertz, &material), radiation_damping(&material));
        let expected = 1.0 - reduced_order(&hertz, damping).powi(2);
        let found = radiating(&material, &material, speed);
        // Both drop the square of γ: 0.4 %, 1.1 %, 2.2 % and 4.4 % of the loss, of which they share
        // most; the passive form takes 4e-4.
        let tolerance = 5e-4 + 0.2 * share;
        assert!((loss(&found) / expected - 1.0).abs() < tolerance, "{ratio:e}: {}", loss(&found));
    }
}

#[test]
fn initial_energy_equals_stored_plus_radiated() {
    let glass = elastic();
    let (pair, ting) = on_block(&glass, &glass);
    let size = FiniteSize::new(Some((RADIUS, &glass)), None).unwrap();
    for (ting, speed) in
        [(ting.clone(), 50.0), (ting.clone(), 0.5), (ting.with_finite_size(size), 3.0)]
    {
        let found = ting.with_radiation([&glass]).unwrap().impact(speed).unwrap();
        let kinetic = |rate: f64| 0.5 * pair.effective_mass() * rate * rate;
        let initial = kinetic(speed);
        for instant in &found.history {
            let held = kinetic(instant.approach_rate) + instant.strain_energy.unwrap();
            let lost = instant.dissipated.unwrap() + instant.radiated.unwrap();
            // The integration, 1e-8.
            assert!(((held + lost) / initial - 1.0).abs() < 1e-8, "{instant:?}");
            assert!(instant.strain_energy.unwrap() > -1e-12 * initial);
        }
        assert!(found.history.is_sorted_by(|a, b| a.radiated <= b.radiated));
        assert!((found.radiated().unwrap() / initial / loss(&found) - 1.0).abs() < 1e-6);
        let path = ImpactPath::new(&found, &pair, None);
        for k in 0..100 {
            let at = path.at(found.contact_time.unwrap() * f64::from(k) / 100.0).unwrap();
            let accounted = at.strain_energy.unwrap() + at.radiated.unwrap();
            // Cubics between some hundred instants.
            assert!((accounted - at.work).abs() < 1e-5 * initial, "{k}");
        }
    }
}

/// The losses by relaxation and by waves add up while both are small.
#[test]
fn small_relaxation_and_radiation_losses_add() {
    let elastic = elastic();
    let alone = loss(&radiating(&elastic, &elastic, 0.5));
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for terms in [&[(1.0, 20.0)][..], &[(3e-3, 2e5)]] {
            let relaxing = material(terms, acts_on);
            let viscous = loss(&on_block(&relaxing, &elastic).1.impact(0.5).unwrap());
            let both = radiating(&relaxing, &elastic, 0.5);
            assert!(viscous > 1e-4 && viscous < 3e-3, "{acts_on:?} {viscous}");
            let product = 1.0 - (1.0 - alone) * (1.0 - viscous);
            // The pulse that radiates has lost of the order of the viscous loss, and of the modulus.
            let relaxed = if terms.len() > 1 { 3e-3 } else { 3.0 * viscous };
            assert!((loss(&both) - product).abs() < 1.5 * alone * relaxed.max(6e-3), "{acts_on:?}");
            // The radiated energy is that of the elastic ball.
            let energy = both.history[0].approach_rate.powi(2) * 0.5 * mass(&relaxing);
            let radiated = both.radiated().unwrap() / energy;
            assert!((radiated / alone - 1.0).abs() < 1.5 * relaxed.max(6e-3), "{radiated}");
        }
    }
}

fn mass(material: &Material) -> f64 {
    sphere_mass(2.0 * RADIUS, material.density())
}

/// A ball of the same stuff that also radiates, and a rigid one of the same mass that does not.
#[test]
fn losses_of_two_radiating_bodies_add() {
    let glass = elastic();
    let (_, ting) = on_block(&glass, &glass);
    let once = loss(&radiating(&glass, &glass, 0.01));
    let twice = loss(&ting.clone().with_radiation([&glass; 2]).unwrap().impact(0.01).unwrap());
    // The loss itself, 5e-4, and the passive form.
    assert!((twice / once - 2.0).abs() < 4e-3, "{twice} {once}");

    let modulus = f64::INFINITY;
    let rigid =
        Partner::Sphere { radius: RADIUS, mass: mass(&glass), plane_strain_modulus: modulus };
    let pair = Pair::new(rigid, Partner::half_space(&glass)).unwrap();
    let ting = Ting::new(&pair, PairRelaxation::new(None, Some(&glass)).unwrap());
    let found = loss(&ting.with_radiation([&glass]).unwrap().impact(0.01).unwrap());
    // ∫Ḟ² ∝ F²/T at a given momentum ∝ E*^(6/5), and E* is twice as large.
    assert!((found / once / 2f64.powf(1.2) - 1.0).abs() < 4e-3, "{found} {once}");
}

#[test]
fn ting_without_radiating_bodies_is_unchanged() {
    let glass = material(&[(0.5, 1e4)], ActsOn::Shear);
    let (_, ting) = on_block(&glass, &glass);
    let found = ting.clone().with_radiation([]).unwrap().impact(0.5).unwrap();
    assert_eq!(found, ting.impact(0.5).unwrap());
    assert_eq!(found.radiated(), None);
}

/// The size of the steps does not matter, nor the share of the slow force: a looser tolerance.
#[test]
fn ting_with_radiation_is_accurate_to_its_tolerance() {
    let relaxing = material(&[(0.3, 2e4), (0.3, 2e5)], ActsOn::Shear);
    let (_, ting) = on_block(&relaxing, &elastic());
    let ting = ting.with_radiation([&elastic()]).unwrap();
    let fine = ting.clone().with_tolerance(1e-10).unwrap().impact(5.0).unwrap();
    for tolerance in [1e-8, 1e-6, 1e-4] {
        let found = ting.clone().with_tolerance(tolerance).unwrap().impact(5.0).unwrap();
        assert_values(&found, &values(&fine)[..4], tolerance);
        let radiated = found.radiated().unwrap() / fine.radiated().unwrap();
        assert!((radiated - 1.0).abs() < 10.0 * tolerance, "{tolerance:e} {radiated}");
    }
}

/// From elastic to viscous: an answer, and hardly more energy than without.
#[test]
fn ting_with_radiation_returns_a_valid_result_at_all_rates() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        for weight in [0.5, 1.0] {
            for exponent in [-2, 1, 3, 4, 5, 6, 7, 9] {
                let relaxing = material(&[(weight, 1.6 * 10f64.powi(exponent))], acts_on);
                let found = radiating(&relaxing, &relaxing, 0.5);
                let without = on_block(&relaxing, &relaxing).1.impact(0.5).unwrap();
                let place = (acts_on, weight, exponent);
                // A pulse that waves have softened may lose a little less in a fluid: 1e-5 of the energy.
                assert!(loss(&found) > loss(&without) - 1e-5, "{place:?}");
                assert!(without.restitution - found.restitution < 0.01, "{place:?}");
                assert_eq!(found.contact_time.is_none(), without.contact_time.is_none());
                assert!(found.history.is_sorted_by(|a, b| a.time < b.time));
                assert!(found.history.is_sorted_by(|a, b| a.radiated <= b.radiated));
            }
        }
    }
}

#[test]
fn large_losses_are_refused() {
    let glass = elastic();
    let ting = on_block(&glass, &glass).1.with_radiation([&glass]).unwrap();
    // 1.11 (v/c₀)^(3/5) = 1/5 at v/c₀ = 0.0574.
    let limit = 0.0574 * bar_wave_speed(&glass);
    assert!(ting.impact(0.99 * limit).is_ok());
    let refused = ting.impact(1.01 * limit);
    assert!(matches!(refused, Err(LawError::OutsideValidity { limit: 0.2, .. })), "{refused:?}");
}
