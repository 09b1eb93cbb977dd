//! Oblique impacts of spheres with friction, against closed forms and an independent discretisation.

use std::f64::consts::PI;

use fem_laws::{FiniteSize, NormalSprings, Pair, PairRelaxation, Partner, TangentialContact, Ting};
use fem_material::{ActsOn, ElasticModuli, Material, PronySeries, PronyTerm};

const FRICTION: f64 = 0.1;

fn material(nu: f64, terms: &[(f64, f64)], acts_on: ActsOn) -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(70e9, nu).unwrap();
    let term = |&(weight, relaxation_time)| PronyTerm { weight, relaxation_time };
    let series = PronySeries::new(terms.iter().map(term).collect(), acts_on);
    let series = (!terms.is_empty()).then(|| series.unwrap());
    Material::new(2500.0, moduli, series).unwrap()
}

fn elastic(nu: f64) -> Material {
    material(nu, &[], ActsOn::All)
}

/// Like spheres at 1 m/s with the friction 0.1.
struct Like {
    contact: TangentialContact,
    normal: NormalSprings,
    contact_time: f64,
    restitution: f64,
    /// k_t/k_n and χ.
    ratio: f64,
    chi: f64,
}

impl Like {
    /// χ is that of spheres, or another by a mass of the patch other than theirs.
    fn new(material: &Material, n_steps: usize, chi: Option<f64>) -> Self {
        let sphere = Partner::solid_sphere(0.01, material);
        let pair = Pair::new(sphere, sphere).unwrap();
        let relaxation = PairRelaxation::new(Some(material), Some(material)).unwrap();
        let ting = Ting::new(&pair, relaxation.clone()).with_tolerance(1e-10).unwrap();
        let impact = ting.impact(1.0).unwrap();
        let normal =
            NormalSprings::of_impact(&impact, &pair, &relaxation, None, 0.0, n_steps).unwrap();
        let bodies = [Some(material); 2];
        let modulus = PairRelaxation::tangential(bodies[0], bodies[1]).unwrap().0;
        let ratio = modulus / pair.contact_modulus();
        let chi = chi.unwrap_or(1.75 * ratio);
        let mass = 0.5 * pair.effective_mass() * ratio / chi;
        Self {
            contact: TangentialContact::new(bodies, mass, FRICTION).unwrap(),
            normal,
            contact_time: impact.contact_time.unwrap(),
            restitution: impact.restitution,
            ratio,
            chi,
        }
    }

    /// ψ₂ of ψ₁. The energies close to rounding.
    fn rebound(&self, psi: f64) -> f64 {
        let unit = FRICTION / self.ratio;
        let impact = self.contact.impact(&self.normal, psi * unit);
        let energy = 0.5 * self.contact.mass() * (psi * unit).powi(2);
        assert!(impact.residual < 1e-11 * energy, "{psi} {}", impact.residual / energy);
        assert!(impact.friction_work >= 0.0);
        impact.velocity / unit
    }
}

/// k_t/k_n = 2(1−ν)/(2−ν) of like bodies (Johnson, Contact Mechanics, 1985, § 7.3).
#[test]
fn stiffness_ratio_is_mindlins() {
    for nu in [-0.3, 0.0, 0.3, 0.4999] {
        let like = Like::new(&elastic(nu), 8, None);
        assert!((like.ratio - 2.0 * (1.0 - nu) / (2.0 - nu)).abs() < 1e-12, "{nu}");
    }
}

/// ψ₂ = ψ₁ − 2χ(1+e) where surfaces slide throughout: elastic ones from ψ₁ = 4χ − 1 on, just below which they do not.
#[test]
fn sliding_impacts_lose_the_whole_impulse_of_friction() {
    for nu in [0.0, 0.3, 0.45] {
        let like = Like::new(&elastic(nu), 400, None);
        let onset = 4.0 * like.chi - 1.0;
        let lost = |psi: f64| psi - like.rebound(psi) - 4.0 * like.chi;
        // Near the onset the last steps of the contact stick.
        for psi in [onset + 0.25, onset + 0.5, 9.0] {
            assert!(lost(psi).abs() < 1e-9, "{nu} {psi} {}", lost(psi));
        }
        assert!(lost(onset - 0.1) < -1e-4, "{nu} {}", lost(onset - 0.1));
    }
}

/// Without slip the velocity at the largest compression is ₂F₁(a, b; 3/5; 1) of that before, with a + b = 1/10 and ab = −3χ/5: the values
/// are Γ(0.6)Γ(0.5)/(Γ(0.6−a)Γ(0.6−b)). The error falls with the 1.7th power of the step.
#[test]
fn sticking_contact_moves_as_the_hypergeometric_function_says() {
    for (chi, expected) in [(1.0, -0.5589865), (1.4412, -0.7847582), (1.75, -0.8327618)] {
        let at_largest = |n_steps: usize| {
            let like = Like::new(&elastic(0.3), n_steps, Some(chi));
            let sticking = like.contact.clone().with_friction(1e9);
            let history = sticking.impact(&like.normal, 1.0).history;
            let half = history.partition_point(|it| it.time < 0.5 * like.contact_time);
            let (a, b) = (&history[half - 1], &history[half]);
            let share = (0.5 * like.contact_time - a.time) / (b.time - a.time);
            a.velocity + share * (b.velocity - a.velocity)
        };
        let [coarse, fine] = [at_largest(800), at_largest(1600)];
        let limit = fine + (fine - coarse) / (2f64.powf(1.7) - 1.0);
        assert!((limit - expected).abs() < 1e-5, "{chi} {limit}");
    }
}

/// Without friction's limit but with the release in unloading, as ψ₁ → 0.
#[test]
fn impacts_near_normal_incidence_give_back_what_is_released() {
    for (chi, expected) in [(1.0, -0.375), (1.4412, 0.232), (1.75, 0.387)] {
        let like = Like::new(&elastic(0.3), 400, Some(chi));
        let found = like.rebound(1e-3) / 1e-3;
        // Three digits are known.
        assert!((found - expected).abs() < 1.5e-3, "{chi} {found}");
    }
}

/// ψ₂ of ψ₁ at χ = 1.4412 as computed by others with springs of their own, of which the last digit is rounded, as χ is.
#[test]
fn rebound_of_the_patch_is_that_of_the_table() {
    const AT_THREE_TENTHS: [(f64, f64); 16] = [
        (0.1, 0.0206),
        (0.25, 0.0416),
        (0.5, 0.0478),
        (0.75, 0.0142),
        (1.0, -0.0597),
        (1.25, -0.2188),
        (1.5, -0.4280),
        (2.0, -0.8372),
        (2.5, -1.1623),
        (3.0, -1.3797),
        (3.5, -1.4773),
        (4.0, -1.4365),
        (4.5, -1.2177),
        (5.0, -0.7648),
        (5.5, -0.2648),
        (6.0, 0.2352),
    ];
    let like = Like::new(&elastic(0.3), 400, None);
    for (psi, expected) in AT_THREE_TENTHS {
        assert!((like.rebound(psi) - expected).abs() < 2e-4, "{psi} {}", like.rebound(psi));
    }
}

/// Rings of constant traction in place of springs, whose influence on each other is full, at seven χ from 1.75 (ν = 0) to 1.1667 (ν → 1/2)
/// and 1; the error of 96 is at most 8e-4.
#[test]
fn rings_of_traction_agree_with_springs() {
    for (nu, chi) in [
        (0.0, None),
        (0.1, None),
        (0.2, None),
        (0.3, None),
        (0.4, None),
        (0.4999, None),
        (0.3, Some(1.0)),
    ] {
        let like = Like::new(&elastic(nu), 400, chi);
        for psi in [1.0, 2.5, 4.0] {
            let found = rings(96, like.chi, psi) - like.rebound(psi);
            assert!(found.abs() < 1e-3, "{nu} {chi:?} {psi} {found}");
        }
    }
}

/// Returns ψ₂ by `n` rings, in units of E* = R* = m* = v = 1, G* = k_t/k_n of E* and a friction of that ratio: then ψ is v_t.
fn rings(n: usize, chi: f64, psi: f64) -> f64 {
    const STEPS: usize = 600;
    let mass = 0.5 / chi;
    let largest = (15f64 / 16.0).powf(0.4);
    let edge = |k: usize| largest.sqrt() * k as f64 / n as f64;
    let middle = |k: usize| 0.5 * (edge(k) + edge(k + 1));
    // Displacement at r by a unit of traction on a disc of radius b (Johnson, Contact Mechanics, 1985, § 3.4), per 1/G*.
    let disc = |r: f64, b: f64| {
        let (k, e) = elliptic(if r < b { r / b } else { b / r });
        let q = if b > 0.0 { b / r } else { 0.0 };
        4.0 / PI * if r < b { b * e } else { r * (e - (1.0 - q * q) * k) }
    };
    let influence: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| disc(middle(i), edge(j + 1)) - disc(middle(i), edge(j))).collect())
        .collect();
    let area = |k: usize| PI * (edge(k + 1).powi(2) - edge(k).powi(2));
    let step = 2.9432 * largest / STEPS as f64;
    let (mut approach, mut rate, mut velocity) = (0.0f64, 1.0, psi);
    let (mut traction, mut force) = (vec![0.0; n], 0.0);
    for _ in 0..STEPS + 20 {
        let pull = |approach: f64| 4.0 / 3.0 * approach.max(0.0).powf(1.5);
        let before = pull(approach);
        approach += step * rate - 0.5 * step * step * before;
        rate -= 0.5 * step * (before + pull(approach));
        let moved = step * velocity - 0.5 * step * step * force / mass;
        let radius = approach.max(0.0).sqrt();
        let limit = |k: usize| 2.0 / PI * (radius * radius - middle(k).powi(2)).max(0.0).sqrt();
        traction = slid(&influence, &traction, moved, &limit);
        let now: f64 = traction.iter().enumerate().map(|(k, q)| q * area(k)).sum();
        velocity -= 0.5 * step * (force + now) / mass;
        force = now;
    }
    velocity
}

/// Returns the tractions after the rings have moved, those at their limit slid.
fn slid(
    influence: &[Vec<f64>],
    before: &[f64],
    moved: f64,
    limit: &dyn Fn(usize) -> f64,
) -> Vec<f64> {
    let n = before.len();
    let mut after: Vec<f64> = (0..n).map(|k| before[k].clamp(-limit(k), limit(k))).collect();
    let mut sticks: Vec<bool> = (0..n).map(|k| limit(k) > 0.0).collect();
    loop {
        let free: Vec<usize> = (0..n).filter(|k| sticks[*k]).collect();
        let fixed = |i: usize| -> f64 {
            (0..n).filter(|k| !sticks[*k]).map(|k| influence[i][k] * (after[k] - before[k])).sum()
        };
        let matrix = free.iter().map(|i| free.iter().map(|j| influence[*i][*j]).collect());
        let right = free.iter().map(|i| moved - fixed(*i)).collect();
        let changes = solved(matrix.collect(), right);
        let mut is_done = true;
        for (k, change) in free.iter().zip(changes) {
            after[*k] = before[*k] + change;
            if after[*k].abs() > limit(*k) {
                after[*k] = limit(*k).copysign(after[*k]);
                sticks[*k] = false;
                is_done = false;
            }
        }
        if is_done {
            return after;
        }
    }
}

/// Solves a linear system of a positive definite matrix.
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for k in 0..n {
        for i in k + 1..n {
            let factor = matrix[i][k] / matrix[k][k];
            for j in k..n {
                matrix[i][j] -= factor * matrix[k][j];
            }
            right[i] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right
}

/// Returns the complete elliptic integrals K and E of a modulus, by the arithmetic–geometric mean.
fn elliptic(modulus: f64) -> (f64, f64) {
    let (mut a, mut b, mut weight) = (1.0, (1.0 - modulus * modulus).sqrt(), 0.5);
    let mut sum = weight * modulus * modulus;
    for _ in 0..30 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        weight *= 2.0;
        sum += weight * c * c;
    }
    let k = PI / (2.0 * a);
    (k, k * (1.0 - sum))
}

/// A relaxation far faster or slower than the contact is none, with the moduli that it leaves.
#[test]
fn fast_and_slow_relaxation_are_elastic() {
    for acts_on in [ActsOn::All, ActsOn::Shear] {
        let slow = Like::new(&material(0.3, &[(0.3, 1e6)], acts_on), 400, None);
        let fast = Like::new(&material(0.3, &[(0.3, 1e-13)], acts_on), 400, None);
        // Poisson's ratio of the relaxed moduli.
        let nu = match acts_on {
            ActsOn::All => 0.3,
            ActsOn::Shear => {
                let (bulk, shear) = (1.3 / (1.5 * 0.4), 0.7);
                (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
            }
        };
        let (instantaneous, relaxed) = (elastic(0.3), elastic(nu));
        let [instantaneous, relaxed] =
            [instantaneous, relaxed].map(|material| Like::new(&material, 400, None));
        for psi in [0.5, 2.0, 4.0] {
            let slow = slow.rebound(psi) - instantaneous.rebound(psi);
            assert!(slow.abs() < 1e-5, "{acts_on:?} {psi} {slow}");
            // ψ in units of the relaxed stiffness.
            let units = fast.ratio / relaxed.ratio;
            let fast = fast.rebound(psi * units) / units - relaxed.rebound(psi);
            assert!(fast.abs() < 1e-5, "{acts_on:?} {psi} {fast}");
        }
    }
}

/// The springs carry the force of the run: a sum over places against Ting's integral. Sliding impacts of relaxing bodies lose what
/// friction takes of the impulse.
#[test]
fn springs_of_relaxing_bodies_carry_the_force_of_the_run() {
    for (terms, acts_on) in [
        (vec![(0.4, 5e-6)], ActsOn::Shear),
        (vec![(0.3, 1e-6), (0.3, 2e-5), (0.4, 1e-3)], ActsOn::All),
    ] {
        let like = Like::new(&material(0.3, &terms, acts_on), 400, None);
        assert!(like.restitution < 0.95);
        let psi = 7.0;
        let lost = psi - like.rebound(psi) - 2.0 * like.chi * (1.0 + like.restitution);
        assert!(lost.abs() < 1e-9, "{lost}");
    }
}

/// Finite size makes the patch softer across the axis by its c_t, which a pair of scalars can be held against: at ν = 0.3 c_t is 1.37,
/// 1.01 and 0.53 at a/R of 0.005, 0.02 and 0.1, from a series of spherical harmonics without the limit of small contacts.
#[test]
fn finite_size_across_the_axis_is_that_of_the_series() {
    let material = elastic(0.3);
    let size = FiniteSize::tangential([Some((1.0, &material)), None]).unwrap();
    for (ratio, expected) in [(0.005, 1.37), (0.02, 1.01), (0.1, 0.53)] {
        // c_t F/(E R) of a unit force.
        let found = size.added_approach(70e9, ratio);
        assert!((found - expected).abs() < 0.03, "{ratio} {found}");
    }
}

/// 10,000 random impacts: friction takes energy and gives none, and nothing gains any.
#[test]
fn friction_never_adds_energy() {
    let mut state = 20_261_128_u64;
    let mut random = |from: f64, to: f64| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
    };
    for k in 0..40 {
        let nu = random(-0.2, 0.49);
        let terms: Vec<(f64, f64)> =
            (0..k % 4).map(|_| (random(0.05, 0.3), 10f64.powf(random(-8.0, -3.0)))).collect();
        let acts_on = if k % 2 == 0 { ActsOn::All } else { ActsOn::Shear };
        let like = Like::new(&material(nu, &terms, acts_on), 60, Some(random(0.8, 2.0)));
        for _ in 0..250 {
            let (friction, psi) = (10f64.powf(random(-3.0, 0.5)), random(-12.0, 12.0));
            let contact = like.contact.clone().with_friction(friction);
            let before = psi * friction / like.ratio;
            let impact = contact.impact(&like.normal, before);
            let energy = |velocity: f64| 0.5 * contact.mass() * velocity * velocity;
            let rounding = 1e-12 * energy(before);
            assert!(impact.friction_work >= -rounding, "{k} {psi} {friction}");
            assert!(impact.relaxation_loss >= -rounding, "{k} {psi} {friction}");
            assert!(energy(impact.velocity) <= energy(before) + rounding, "{k} {psi} {friction}");
            assert!(
                impact.residual <= rounding,
                "{k} {psi} {} of {}",
                impact.residual,
                energy(before)
            );
        }
    }
}
