//! Relaxation at finite strain: against an ordinary differential equation in principal stretches,
//! the ledger of energy, and rotations.

use fem_material::finite::{AxisymmetricTensor, HyperelasticLaw, Viscoelastic, ViscousStrain};
use fem_material::{ActsOn, PronySeries, PronyTerm};

use super::{
    Random, cauchy_of, components, deformation, gradient_of, moduli, product, rotation, solid,
    tensor,
};

pub const MODES: [ActsOn; 2] = [ActsOn::All, ActsOn::Shear];

/// Every law, with every way to relax.
pub fn laws_and_modes() -> impl Iterator<Item = (HyperelasticLaw, ActsOn)> {
    HyperelasticLaw::ALL.into_iter().flat_map(|law| MODES.map(|acts_on| (law, acts_on)))
}

/// Creates a series from weights and relaxation times.
pub fn relaxing(
    law: HyperelasticLaw,
    nu: f64,
    terms: &[(f64, f64)],
    acts_on: ActsOn,
) -> Viscoelastic {
    let terms = terms
        .iter()
        .map(|&(weight, relaxation_time)| PronyTerm { weight, relaxation_time })
        .collect();
    Viscoelastic::new(&solid(law, nu), &PronySeries::new(terms, acts_on).unwrap())
}

pub const TERMS: [(f64, f64); 2] = [(0.3, 0.2), (0.5, 2.0)];

/// Stress and history after `n` equal steps along a path, which starts undeformed.
fn march(
    solid: &Viscoelastic,
    end: f64,
    n: usize,
    path: impl Fn(f64) -> AxisymmetricTensor,
) -> ([f64; 5], Vec<ViscousStrain>) {
    let mut history = vec![ViscousStrain::default(); solid.n_terms()];
    let step = solid.step(end / n as f64);
    let at = |i: usize| path(end * i as f64 / n as f64);
    for i in 0..n {
        step.advance(&at(i), &at(i + 1), &mut history);
    }
    (components(&solid.first_piola(&at(n), &history).unwrap()), history)
}

/// Principal stretches r, y, θ: a ramp to a compression by half and a hold, bulging less than a
/// solid that keeps its volume.
fn principal_path(t: f64) -> [f64; 3] {
    let ramp = if t < 1.0 { t * t * (3.0 - 2.0 * t) } else { 1.0 };
    [1.0 + 0.3 * ramp, 1.0 - 0.5 * ramp, 1.0 + 0.3 * ramp]
}

/// Kirchhoff's neo-Hooke stress less its mean, in principal axes, of an elastic stretch.
fn neo_hooke_shape(g: f64, stretches: [f64; 3]) -> [f64; 3] {
    let unimodular = stretches.iter().product::<f64>().powf(-2.0 / 3.0);
    let squares = stretches.map(|x| x * x * unimodular);
    let mean = squares.iter().sum::<f64>() / 3.0;
    squares.map(|x| g * (x - mean))
}

/// The evolution in principal axes, ε_v = ln λ_v: dε_v/dt = dev τ/2η_D + (J_e − 1)/3τ, written for
/// neo-Hooke and integrated by Runge and Kutta's fourth order with steps that leave 1e-10.
fn principal_stress(k: f64, g: f64, acts_on: ActsOn, end: f64) -> [f64; 3] {
    let all = acts_on == ActsOn::All;
    let elastic = |t: f64, viscous: [f64; 3]| {
        let whole = principal_path(t);
        std::array::from_fn(|i| whole[i] / viscous[i].exp())
    };
    let rate = |t: f64, viscous: [f64; 3], tau: f64| {
        let stretches: [f64; 3] = elastic(t, viscous);
        let shape = neo_hooke_shape(g, stretches);
        let volume = if all { (stretches.iter().product::<f64>() - 1.0) / 3.0 } else { 0.0 };
        shape.map(|stress| stress / (2.0 * g * tau) + volume / tau)
    };
    let n = 20_000;
    let dt = end / n as f64;
    let left = 1.0 - TERMS.iter().map(|term| term.0).sum::<f64>();
    let whole = principal_path(end);
    let j: f64 = whole.iter().product();
    let pressure = |j: f64| k * j * (j - 1.0);
    let mut stress = neo_hooke_shape(left * g, whole)
        .map(|shape| shape + if all { left } else { 1.0 } * pressure(j));
    for (weight, tau) in TERMS {
        let mut viscous = [0.0; 3];
        for i in 0..n {
            let t = dt * i as f64;
            let moved = |by: [f64; 3], f: f64| std::array::from_fn(|i| viscous[i] + f * dt * by[i]);
            let k_1 = rate(t, viscous, tau);
            let k_2 = rate(t + 0.5 * dt, moved(k_1, 0.5), tau);
            let k_3 = rate(t + 0.5 * dt, moved(k_2, 0.5), tau);
            let k_4 = rate(t + dt, moved(k_3, 1.0), tau);
            for i in 0..3 {
                viscous[i] += dt / 6.0 * (k_1[i] + 2.0 * (k_2[i] + k_3[i]) + k_4[i]);
            }
        }
        let stretches = elastic(end, viscous);
        let volume = if all { weight * pressure(stretches.iter().product()) } else { 0.0 };
        for (sum, shape) in stress.iter_mut().zip(neo_hooke_shape(weight * g, stretches)) {
            *sum += shape + volume;
        }
    }
    std::array::from_fn(|i| stress[i] / whole[i])
}

/// During the ramp and in the hold; the step is of second order.
#[test]
fn a_compression_by_half_relaxes_as_its_differential_equation() {
    for nu in [0.3, 0.45] {
        let (k, g) = (moduli(nu).bulk_modulus(), moduli(nu).shear_modulus());
        for acts_on in MODES {
            for end in [0.7, 1.5] {
                let [rr, yy, tt] = principal_stress(k, g, acts_on, end);
                let solid = relaxing(HyperelasticLaw::NeoHooke, nu, &TERMS, acts_on);
                let error = |n| {
                    let path = |t| {
                        let [r, y, theta] = principal_path(t);
                        gradient_of([r, 0.0, 0.0, y, theta])
                    };
                    let (found, _) = march(&solid, end, n, path);
                    let error = [found[0] - rr, found[3] - yy, found[4] - tt];
                    assert_eq!((found[1], found[2]), (0.0, 0.0));
                    error.iter().fold(0.0, |worst: f64, x| worst.max(x.abs()))
                };
                let order = (error(200) / error(400)).log2();
                assert!((order - 2.0).abs() < 0.05, "{nu} {acts_on:?} {end}: order {order}");
                // (Δt/τ)² of the faster term, 4e-4, times a tenth of its share of the curvature.
                assert!(error(400) < 2e-6, "{nu} {acts_on:?} {end}: {:e}", error(400));
            }
        }
    }
}

/// Stretch, shear and rotation at once.
fn path(direction: &AxisymmetricTensor, t: f64) -> AxisymmetricTensor {
    let f = deformation(&tensor(components(direction).map(|x| x * (2.0 * t).sin())));
    gradient_of(product(rotation(1.5 * t * t), f))
}

/// Work of the stress less what is stored and dissipated, both at the ends of `n` steps, and the
/// work; by the trapezoidal rule.
fn imbalance(solid: &Viscoelastic, direction: &AxisymmetricTensor, n: usize) -> (f64, f64) {
    let dt = 1.0 / n as f64;
    let step = solid.step(dt);
    let mut history = vec![ViscousStrain::default(); solid.n_terms()];
    let mut h = path(direction, 0.0);
    let (mut work, mut dissipated) = (0.0, 0.0);
    let (mut stress, mut power) = ([0.0; 5], 0.0);
    for i in 1..=n {
        let next = path(direction, dt * i as f64);
        step.advance(&h, &next, &mut history);
        let new_stress = components(&solid.first_piola(&next, &history).unwrap());
        let new_power = solid.energy_and_dissipation_rate(&next, &history).1;
        let moved = components(&next).into_iter().zip(components(&h)).map(|(a, b)| a - b);
        let mean = stress.iter().zip(new_stress).map(|(a, b)| 0.5 * (a + b));
        work += moved.zip(mean).map(|(u, p)| u * p).sum::<f64>();
        dissipated += 0.5 * dt * (power + new_power);
        (h, stress, power) = (next, new_stress, new_power);
    }
    // Else the balance would say nothing of it.
    assert!(dissipated > 0.01 * work, "{dissipated} {work}");
    (work - dissipated - solid.energy(&h, &history).unwrap(), work)
}

/// It closes at second order for every law, so that D is what the flow takes, and P the slope of W.
#[test]
fn work_equals_stored_plus_dissipated_energy() {
    let mut random = Random(11);
    for law in HyperelasticLaw::ALL {
        for nu in [0.244, 0.45] {
            for acts_on in MODES {
                let solid = relaxing(law, nu, &TERMS, acts_on);
                let direction = random.gradient(0.3);
                let ((coarse, _), (fine, work)) =
                    (imbalance(&solid, &direction, 200), imbalance(&solid, &direction, 400));
                let order = (coarse / fine).abs().log2();
                assert!((order - 2.0).abs() < 0.05, "{law:?} {nu} {acts_on:?}: order {order}");
                assert!(fine.abs() < 1e-4 * work, "{law:?} {nu} {acts_on:?}: {fine} of {work}");
            }
        }
    }
}

/// A body that turns while it deforms remembers the same, and its stress turns with it.
#[test]
fn a_rotation_leaves_the_history_and_turns_the_stress() {
    let mut random = Random(12);
    for (law, acts_on) in laws_and_modes() {
        let solid = relaxing(law, 0.3, &TERMS, acts_on);
        let direction = random.gradient(0.3);
        let still = |t: f64| tensor(components(&direction).map(|x| x * t));
        let turning = |t: f64| gradient_of(product(rotation(2.0 * t), deformation(&still(t))));
        let (stress, history) = march(&solid, 1.0, 20, still);
        let (turned, turned_history) = march(&solid, 1.0, 20, turning);
        for (found, expected) in turned.iter().zip(product(rotation(2.0), stress)) {
            // Rounding, 1e-16, over 20 steps.
            assert!((found - expected).abs() < 1e-13, "{law:?} {acts_on:?}");
        }
        for (a, b) in turned_history.iter().zip(&history) {
            let errors = [a.rr - b.rr, a.yy - b.yy, a.ry - b.ry];
            assert!(errors.iter().all(|x| x.abs() < 1e-14), "{law:?} {acts_on:?}");
            assert!((a.volume_change - b.volume_change).abs() < 1e-14);
        }
    }
}

/// The first Piola-Kirchhoff stress of neo-Hooke, all branches at once, is the sum that Cauchy's is.
#[test]
fn stress_of_all_branches_is_their_sum() {
    let mut random = Random(13);
    for (law, acts_on) in laws_and_modes() {
        let solid = relaxing(law, 0.45, &TERMS, acts_on);
        let direction = random.gradient(0.3);
        let (piola, history) = march(&solid, 1.0, 10, |t| path(&direction, t));
        let h = path(&direction, 1.0);
        let s = solid.cauchy(&h, &history).unwrap();
        let found = [s.rr, s.ry, s.ry, s.yy, s.tt].into_iter();
        for (found, expected) in found.zip(cauchy_of(piola, &h)) {
            // Rounding of stresses about 1.
            assert!((found - expected).abs() < 1e-13, "{law:?} {acts_on:?}");
        }
    }
}
