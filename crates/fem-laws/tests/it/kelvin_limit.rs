//! Kelvin's solid as the slow limit of a relaxing one, and its dissipation time.

use fem_laws::laws::{corrected_dissipation_time, kuwabara_kono, tsuji, zhang_whiten_coefficient};
use fem_laws::{HertzImpact, LawImpact, Pair, PairRelaxation, Partner, Ting};
use fem_material::{ActsOn, ElasticModuli, Material};

use crate::common::{GLASS, assert_close, glass, moduli, pair_of, relaxation_of, relaxing};

/// The larger glass sphere on a wall.
fn on_wall() -> Pair {
    Pair::new(Partner::solid_sphere(22.2e-3, &glass()), Partner::Wall).unwrap()
}

/// η = Σ G_k τ_k of the series put into the closed form of the viscosities, at relaxed moduli,
/// is the first moment of the pair's relaxation function.
#[test]
fn the_closed_form_of_viscosities_is_the_slow_limit_of_a_series() {
    let terms = [(0.3, 1e-6), (0.2, 4e-6)];
    let moment: f64 = terms.iter().map(|(weight, time)| weight * time).sum();
    for nu in [-0.5, 0.0, 0.244, 0.4] {
        let instantaneous = moduli(63e9, nu);
        let (shear, bulk) = (instantaneous.shear_modulus(), instantaneous.bulk_modulus());
        for acts_on in [ActsOn::All, ActsOn::Shear] {
            let body = relaxing([63e9, nu, 2390.0], acts_on, &terms);
            let (left_of_bulk, bulk_viscosity) = match acts_on {
                ActsOn::All => (0.5 * bulk, bulk * moment),
                ActsOn::Shear => (bulk, 0.0),
            };
            let relaxed = ElasticModuli::from_bulk_shear(left_of_bulk, 0.5 * shear).unwrap();
            let expected = corrected_dissipation_time(
                [Some(&relaxed), Some(&relaxed)],
                shear * moment,
                bulk_viscosity,
            );
            let of = |relaxation: PairRelaxation| relaxation.dissipation_time().unwrap();
            let found = of(relaxation_of([&body; 2]));
            assert_close(found, expected.unwrap(), 1e-12);
            // A rigid wall adds nothing, an elastic body dilutes.
            let on_wall = PairRelaxation::new(None, Some(&body)).unwrap();
            assert_close(of(on_wall), found, 1e-12);
            let elastic = Material::new(2390.0, relaxed, None).unwrap();
            assert_close(of(relaxation_of([&elastic, &body])), 0.5 * found, 1e-12);
        }
    }
}

#[test]
fn the_corrected_form_keeps_its_loss_where_nothing_is_compressed() {
    // A = η₁/G at ν → 1/2, whatever the bulk viscosity.
    let rubber = moduli(1e6, 0.5 - 1e-9);
    let time = corrected_dissipation_time([Some(&rubber), None], 10.0, 77.0).unwrap();
    assert_close(time, 10.0 / rubber.shear_modulus(), 1e-8);
    // η₁/η₂ = G/K: the whole modulus is late by the one time.
    let glass = moduli(63e9, 0.244);
    let times = corrected_dissipation_time(
        [None, Some(&glass)],
        glass.shear_modulus(),
        glass.bulk_modulus(),
    );
    assert_close(times.unwrap(), 1.0, 1e-12);
    assert!(corrected_dissipation_time([None, None], 1.0, 1.0).is_err());
    assert!(corrected_dissipation_time([Some(&glass), None], -1.0, 1.0).is_err());
}

/// The slower the contact next to τ, the nearer Kelvin's law is to the quasi-static impact: the
/// loss, of first order in τ/T, has an error of second order.
#[test]
fn kelvins_law_is_the_slow_limit_of_ting() {
    let loss_ratio = |time: f64| {
        let body = relaxing(GLASS, ActsOn::All, &[(0.5, time)]);
        let (pair, relaxation) = (pair_of(&body), relaxation_of([&body; 2]));
        let slow = pair.with_modulus_share(relaxation.equilibrium_weight()).unwrap();
        let law = kuwabara_kono(&slow, relaxation.dissipation_time().unwrap()).unwrap();
        let kelvin = LawImpact::new(&slow, law).impact(0.5).unwrap();
        let ting = Ting::new(&pair, relaxation).impact(0.5).unwrap();
        (1.0 - kelvin.restitution) / (1.0 - ting.restitution) - 1.0
    };
    let contact_time = HertzImpact::new(&on_wall(), 0.5).unwrap().contact_time();
    let (coarse, fine) = (loss_ratio(4e-3 * contact_time), loss_ratio(1e-3 * contact_time));
    assert!(fine.abs() < 0.02, "{fine}");
    assert!(fine.abs() < 0.6 * coarse.abs(), "{coarse} {fine}");
}

#[test]
fn zhang_and_whiten_give_the_restitution_asked_for_at_zero_force() {
    let pair = on_wall();
    for e in [1.0, 0.92, 0.5, 0.1] {
        for speed in [1e-3, 10.0] {
            let law = tsuji(&pair, zhang_whiten_coefficient(e).unwrap()).unwrap();
            let found = LawImpact::new(&pair, law).impact(speed).unwrap();
            assert_close(found.restitution, e, 1e-7);
        }
    }
    assert_eq!(zhang_whiten_coefficient(1.0), Ok(0.0));
}
