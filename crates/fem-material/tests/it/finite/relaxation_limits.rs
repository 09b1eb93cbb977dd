//! Relaxation at finite strain in its limits: small strain, slow and fast, steps of any length.

use fem_material::finite::{
    AxisymmetricTensor, Hyperelastic, HyperelasticLaw, Viscoelastic, ViscousStrain,
};
use fem_material::{ActsOn, ElasticModuli, RelaxationStep};

use super::relaxation::{MODES, TERMS, laws_and_modes, relaxing};
use super::stiffness::largest_by_powers;
use super::{Random, assert_slopes, components, distance, gradient_of, moduli, solid, tensor};

fn hold(solid: &Viscoelastic, h: &AxisymmetricTensor, time: f64) -> Vec<ViscousStrain> {
    let mut history = vec![ViscousStrain::default(); solid.n_terms()];
    solid.step(time).advance(h, h, &mut history);
    history
}

/// Strain on a path of straight pieces, and its stress by Hooke's law and the exact Maxwell steps of
/// `RelaxationStep`. The steps are the same, up to ten relaxation times, so that the second order
/// of strain is all that differs.
#[test]
fn relaxing_law_differs_from_the_prony_series_at_second_order() {
    let mut random = Random(21);
    let corners: [AxisymmetricTensor; 4] = std::array::from_fn(|_| random.gradient(1.0));
    let steps = [0.01, 0.3, 2.0, 0.1];
    for (law, acts_on) in laws_and_modes() {
        let solid = relaxing(law, 0.3, &TERMS, acts_on);
        let error = |size: f64| {
            let mut history = vec![ViscousStrain::default(); 2];
            let mut effective = [[0.0; 4]; 2];
            let (mut h, mut strain) = (tensor([0.0; 5]), [0.0; 4]);
            for (corner, dt) in corners.iter().zip(steps) {
                let next = tensor(components(corner).map(|x| size * x));
                solid.step(dt).advance(&h, &next, &mut history);
                let next_strain = [next.rr, next.yy, next.tt, next.ry + next.yr];
                for (q, (_, tau)) in effective.iter_mut().zip(TERMS) {
                    let step = RelaxationStep::new(tau, dt);
                    for i in 0..4 {
                        q[i] = step.advance(q[i], next_strain[i] - strain[i]);
                    }
                }
                (h, strain) = (next, next_strain);
            }
            let [rr, yy, tt, ry] = prony_stress(0.3, acts_on, strain, effective);
            let found = components(&solid.first_piola(&h, &history).unwrap());
            distance(found, [rr, ry, ry, yy, tt])
        };
        let order = (error(1e-3) / error(5e-4)).log2();
        assert!((order - 2.0).abs() < 0.02, "{law:?} {acts_on:?}: order {order}");
    }
}

fn prony_stress(nu: f64, acts_on: ActsOn, strain: [f64; 4], effective: [[f64; 4]; 2]) -> [f64; 4] {
    let weighted = |i: usize| {
        0.2 * strain[i] + TERMS.iter().zip(&effective).map(|(term, q)| term.0 * q[i]).sum::<f64>()
    };
    let relaxed = moduli(nu).stress(std::array::from_fn(weighted));
    if acts_on == ActsOn::All {
        return relaxed;
    }
    let trace = |e: [f64; 4]| e[0] + e[1] + e[2];
    let missing =
        moduli(nu).bulk_modulus() * (trace(strain) - trace(std::array::from_fn(weighted)));
    [relaxed[0] + missing, relaxed[1] + missing, relaxed[2] + missing, relaxed[3]]
}

/// In no time the whole law answers; 1e-12 of a relaxation time changes as much.
#[test]
fn relaxing_law_at_time_zero_is_the_instantaneous_law() {
    let mut random = Random(22);
    for (law, acts_on) in laws_and_modes() {
        let (relaxing, elastic) = (relaxing(law, 0.3, &TERMS, acts_on), solid(law, 0.3));
        for _ in 0..20 {
            let h = random.gradient(0.4);
            for history in [vec![ViscousStrain::default(); 2], hold(&relaxing, &h, 2e-13)] {
                let found = components(&relaxing.first_piola(&h, &history).unwrap());
                let expected = components(&elastic.first_piola(&h).unwrap());
                assert!(distance(found, expected) < 1e-10, "{law:?} {acts_on:?}");
                let energy = relaxing.energy(&h, &history).unwrap();
                assert!((energy - elastic.energy(&h).unwrap()).abs() < 1e-10);
                let found = relaxing.cauchy(&h, &history).unwrap();
                let expected = elastic.cauchy(&h).unwrap();
                assert!((found.yy - expected.yy).abs() < 1e-10);
                assert!((found.ry - expected.ry).abs() < 1e-10);
            }
        }
    }
}

/// Held for a million relaxation times in one step it is the law with what is left of the moduli.
/// The branches of neo-Hooke with ln J keep the pressure that goes with G where J is elastic.
#[test]
fn relaxing_law_held_long_is_the_equilibrium_law() {
    let mut random = Random(23);
    for (law, acts_on) in laws_and_modes() {
        let relaxing = relaxing(law, 0.3, &TERMS, acts_on);
        let (k, g) = (moduli(0.3).bulk_modulus(), moduli(0.3).shear_modulus());
        let left_bulk = if acts_on == ActsOn::All { 0.2 } else { 1.0 };
        let left = ElasticModuli::from_bulk_shear(left_bulk * k, 0.2 * g).unwrap();
        let elastic = Hyperelastic::new(law, &left);
        for _ in 0..20 {
            let h = random.gradient(0.4);
            let history = hold(&relaxing, &h, 2e6);
            let found = relaxing.cauchy(&h, &history).unwrap();
            let mut expected = elastic.cauchy(&h).unwrap();
            if law == HyperelasticLaw::NeoHookeLn && acts_on == ActsOn::Shear {
                let j = 1.0 + h.volume_change();
                let rest = 0.8 * g * (j.powf(2.0 / 3.0) - 1.0 - 2.0 / 3.0 * j.ln()) / j;
                expected.rr += rest;
                expected.yy += rest;
                expected.tt += rest;
            }
            for (found, expected) in [
                (found.rr, expected.rr),
                (found.yy, expected.yy),
                (found.tt, expected.tt),
                (found.ry, expected.ry),
            ] {
                // e^{-1e6} is nothing; rounding.
                assert!((found - expected).abs() < 1e-12, "{law:?} {acts_on:?}");
            }
            assert!(relaxing.energy_and_dissipation_rate(&h, &history).1.abs() < 1e-12);
        }
    }
}

/// A fluid, weights that sum to 1: no stress is left but the pressure of an elastic volume.
#[test]
fn relaxed_fluid_keeps_only_elastic_pressure() {
    let h = gradient_of([1.3, 0.4, -0.2, 0.6, 1.1]);
    let j = 1.0 + h.volume_change();
    for acts_on in MODES {
        let fluid = relaxing(HyperelasticLaw::NeoHooke, 0.45, &[(0.4, 0.1), (0.6, 1.0)], acts_on);
        let stress = fluid.cauchy(&h, &hold(&fluid, &h, 1e6)).unwrap();
        let pressure =
            if acts_on == ActsOn::All { 0.0 } else { moduli(0.45).bulk_modulus() * (j - 1.0) };
        for found in [stress.rr, stress.yy, stress.tt] {
            assert!((found - pressure).abs() < 1e-12, "{found} {pressure}");
        }
        assert!(stress.ry.abs() < 1e-12);
    }
}

/// Random walks in steps of 1e-6 to 1e6 relaxation times: no energy comes out of a dashpot, none
/// that is stored is negative, and C_v stays a metric. St Venant-Kirchhoff promises it within its
/// limits of stability, here to strains of a tenth.
#[test]
fn dissipation_is_never_negative_for_steps_of_any_length() {
    let mut random = Random(24);
    for law in HyperelasticLaw::ALL {
        let size = if law == HyperelasticLaw::SaintVenantKirchhoff { 0.05 } else { 0.4 };
        for nu in [0.0, 0.3, 0.45, 0.495] {
            for acts_on in MODES {
                let solid = relaxing(law, nu, &TERMS, acts_on);
                let mut history = vec![ViscousStrain::default(); 2];
                let mut h = tensor([0.0; 5]);
                for _ in 0..500 {
                    let next = random.gradient(size);
                    let step = solid.step(10f64.powf(6.0 * random.next()));
                    step.advance(&h, &next, &mut history);
                    h = next;
                    let power = solid.energy_and_dissipation_rate(&h, &history).1;
                    // Rounding of stresses that have all relaxed.
                    assert!(power > -1e-20, "{law:?} {nu} {acts_on:?}: {power}");
                    assert!(solid.energy(&h, &history).unwrap() > 0.0);
                    for viscous in &history {
                        let (rr, yy) = (1.0 + viscous.rr, 1.0 + viscous.yy);
                        let determinant = rr * yy - viscous.ry * viscous.ry;
                        assert!(rr > 0.0 && determinant > 0.0 && viscous.volume_change > -1.0);
                    }
                }
            }
        }
    }
}

/// A constant rate at small strain is one step or a thousand: strain of 1e-4 leaves 1e-8.
#[test]
fn a_constant_rate_is_exact_in_one_step() {
    let mut random = Random(25);
    let h = tensor(components(&random.gradient(1.0)).map(|x| 1e-4 * x));
    for acts_on in MODES {
        let solid = relaxing(HyperelasticLaw::NeoHooke, 0.3, &TERMS, acts_on);
        let stress = |n: usize| {
            let mut history = vec![ViscousStrain::default(); 2];
            let step = solid.step(3.0 / n as f64);
            let at = |i: usize| tensor(components(&h).map(|x| x * i as f64 / n as f64));
            for i in 0..n {
                step.advance(&at(i), &at(i + 1), &mut history);
            }
            components(&solid.first_piola(&h, &history).unwrap())
        };
        let error = distance(stress(1), stress(1000));
        assert!(error < 3e-8, "{error:e}");
    }
}

/// Differences of the stress at a fixed history err by 1e-8 here. The bound is that of five
/// eigenvalues at once, 5^(1/64); of a body that is hardly strained one is the largest by far.
#[test]
fn the_stiffness_of_all_branches_is_the_slope_of_the_stress() {
    let mut random = Random(26);
    for (law, acts_on) in laws_and_modes() {
        for (size, slack) in [(1e-6, 1e-6), (0.3, 0.0255)] {
            let solid = relaxing(law, 0.3, &TERMS, acts_on);
            let history = hold(&solid, &random.gradient(size), 1.0);
            let h = random.gradient(size);
            let tangent = solid.tangent(&h, &history).unwrap();
            assert_slopes(tangent, &h, 1e-7, |h| solid.first_piola(h, &history).unwrap());
            let found = solid.largest_stiffness(&h, &history).unwrap();
            let excess = found / largest_by_powers(&tangent) - 1.0;
            assert!((-1e-9..slack).contains(&excess), "{law:?} {acts_on:?}: {excess:e}");
        }
    }
}
