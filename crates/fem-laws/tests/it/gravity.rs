//! Contacts of a ball with a weight: closed forms and an integration of its own.

use crate::direct::direct;
use fem_laws::laws::{hertz, linear};
use fem_laws::{EndRule, HertzImpact, ImpactPath, LawImpact, Pair, PairRelaxation, Partner, Ting};
use fem_material::{ActsOn, Material};

use crate::common::relaxing;

const G: f64 = 9.81;

fn rubber(terms: &[(f64, f64)]) -> Material {
    relaxing([2e6, 0.4, 1100.0], ActsOn::All, terms)
}

fn pair_of(material: &Material) -> Pair {
    Pair::new(Partner::Wall, Partner::solid_sphere(0.02, material)).unwrap()
}

fn ting(material: &Material) -> Ting {
    let relaxation = PairRelaxation::new(None, Some(material)).unwrap();
    Ting::new(&pair_of(material), relaxation).with_gravity(G).unwrap()
}

/// √(g δ) of the static approach: the speed of a fall for which the weight is as large as the impact.
fn slow(pair: &Pair) -> f64 {
    let stiffness = HertzImpact::new(pair, 1.0).unwrap().stiffness();
    (G * (pair.effective_mass() * G / stiffness).powf(2.0 / 3.0)).sqrt()
}

/// ½ m v² + m g δ = 2/5 K δ^(5/2), and ∫dδ/δ̇ twice.
#[test]
fn elastic_ball_under_gravity_has_the_approach_of_its_energy() {
    let pair = pair_of(&rubber(&[]));
    let (mass, stiffness) =
        (pair.effective_mass(), HertzImpact::new(&pair, 1.0).unwrap().stiffness());
    for speed in [0.2 * slow(&pair), slow(&pair), 10.0 * slow(&pair)] {
        let left =
            |d: f64| 0.5 * mass * speed * speed + mass * G * d - 0.4 * stiffness * d * d * d.sqrt();
        // From above, where the energy falls with the depth and Newton's method does not turn.
        let mut deepest =
            10.0 * HertzImpact::new(&pair, speed + slow(&pair)).unwrap().max_approach();
        for _ in 0..100 {
            deepest -= left(deepest) / (mass * G - stiffness * deepest * deepest.sqrt());
        }
        // δ = δ_max sin² φ takes the end's root away; the midpoint rule is then of high order.
        let n = 4000;
        let half: f64 = (0..n)
            .map(|k| std::f64::consts::FRAC_PI_2 * (k as f64 + 0.5) / n as f64)
            .map(|phi| {
                let depth = deepest * phi.sin().powi(2);
                let rate = (2.0 * left(depth) / mass).sqrt();
                2.0 * deepest * phi.sin() * phi.cos() / rate
            })
            .sum::<f64>()
            * std::f64::consts::FRAC_PI_2
            / n as f64;
        let law = LawImpact::new(&pair, hertz(&pair).unwrap()).with_gravity(G).unwrap();
        for found in [ting(&rubber(&[])).impact(speed), law.impact(speed)] {
            let found = found.unwrap();
            // Their tolerance.
            assert!((found.restitution - 1.0).abs() < 1e-7, "{}", found.restitution);
            assert!((found.max_approach / deepest - 1.0).abs() < 1e-7, "{}", found.max_approach);
            // The midpoint rule beside it, 1e-6.
            let time = found.contact_time.unwrap();
            assert!((time / (2.0 * half) - 1.0).abs() < 3e-6, "{time} {}", 2.0 * half);
        }
    }
}

/// The same integrals without series, recursion or polynomials.
#[test]
fn relaxing_ball_under_gravity_equals_direct_integration() {
    let material = rubber(&[(0.5, 10e-3)]);
    let pair = pair_of(&material);
    let relaxation = PairRelaxation::new(None, Some(&material)).unwrap();
    for speed in [2.0 * slow(&pair), 6.0 * slow(&pair)] {
        let [fine, coarse] =
            [4000, 2000].map(|n_steps| direct(&pair, &relaxation, None, speed, n_steps, G));
        let found = ting(&material).impact(speed).unwrap();
        let time = found.contact_time.unwrap();
        for (k, found) in [found.restitution, time, found.peak_force].into_iter().enumerate() {
            // Halving its step leaves half of its error or less; its time is a whole number of steps.
            let step = [1e-6, 2.5e-4, 1e-6][k];
            let error = 2.0 * (fine[k] - coarse[k]).abs() + step * fine[k];
            assert!((found - fine[k]).abs() < error, "{k}: {found} {} {error}", fine[k]);
        }
        assert!((found.max_approach / fine[4] - 1.0).abs() < 1e-3);
    }
}

/// Spring, dashpot and weight: x = g/ω² + e^(−βt) (A cos + B sin), until the overlap is zero.
#[test]
fn a_linear_law_with_a_weight_is_a_closed_form() {
    let pair = pair_of(&rubber(&[]));
    let mass = pair.effective_mass();
    let (stiffness, damping, speed) = (200.0, 0.15, 0.1);
    let squared = stiffness / mass;
    let (beta, depth) = (0.5 * damping / mass, G / squared);
    let omega = (squared - beta * beta).sqrt();
    let (a, b) = (-depth, (speed - beta * depth) / omega);
    let overlap =
        |t: f64| depth + (-beta * t).exp() * (a * (omega * t).cos() + b * (omega * t).sin());
    let (mut low, mut high) =
        (std::f64::consts::FRAC_PI_2 / omega, 2.0 * std::f64::consts::PI / omega);
    // It comes out between a quarter and a whole period.
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if overlap(middle) > 0.0 { low = middle } else { high = middle }
    }
    let h = 1e-7 * low;
    let rate = (overlap(low + h) - overlap(low - h)) / (2.0 * h);
    let law = linear(stiffness, damping).unwrap();
    let law = LawImpact::new(&pair, law).with_end_rule(EndRule::ZeroOverlap);
    let law = law.with_gravity(G).unwrap();
    let found = law.impact(speed).unwrap();
    assert!((found.contact_time.unwrap() / low - 1.0).abs() < 1e-7, "{found:?} {low}");
    // The difference quotient's own error.
    assert!((found.restitution / (-rate / speed) - 1.0).abs() < 1e-6, "{rate}");
    // A slower ball does not come out any more: what is left at the turn does not lift it.
    let slow = law.impact(0.2 * speed).unwrap();
    assert_eq!((slow.restitution, slow.contact_time), (0.0, None));
    // Nor does one that a strong dashpot lets down to where it rests, without a turn.
    let creeping = LawImpact::new(&pair, linear(stiffness, 20.0).unwrap()).with_gravity(G).unwrap();
    let creeping = creeping.impact(speed).unwrap();
    assert_eq!((creeping.restitution, creeping.contact_time), (0.0, None));
}

#[test]
fn slow_relaxing_ball_under_gravity_stays_in_contact() {
    // Fast relaxation, to a half and to nothing.
    for (weight, time) in [(0.5, 10e-3), (1.0, 1e-3), (0.9, 2e-3)] {
        let material = rubber(&[(weight, time)]);
        let slow = 0.3 * slow(&pair_of(&material));
        let found = ting(&material).impact(slow).unwrap();
        assert_eq!((found.restitution, found.contact_time), (0.0, None), "{weight} {time}");
    }
    for wrong in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(Ting::with_gravity(ting(&rubber(&[])), wrong).is_err());
    }
}

/// The path between the instants satisfies m δ̈ = m g − F, and flies on in a parabola.
#[test]
fn impact_path_with_gravity_obeys_the_equation_of_motion() {
    let material = rubber(&[]);
    let pair = pair_of(&material);
    let impact = ting(&material).impact(slow(&pair)).unwrap();
    let path = ImpactPath::new(&impact, &pair, None).with_gravity(G);
    let end = impact.contact_time.unwrap();
    let at = |time: f64| path.at(time).unwrap();
    let after = at(1.5 * end);
    let (last, flight) = (at(end), 0.5 * end);
    let expected = last.approach + last.approach_rate * flight + 0.5 * G * flight * flight;
    assert!((after.approach - expected).abs() < 1e-15 && after.force == 0.0);
    assert!((after.approach_rate - last.approach_rate - G * flight).abs() < 1e-15);
    let h = 1e-3 * end;
    for k in 1..10 {
        let time = 0.1 * k as f64 * end;
        let acceleration = (at(time + h).approach_rate - at(time - h).approach_rate) / (2.0 * h);
        let expected = G - at(time).force / pair.effective_mass();
        // Second order in h.
        assert!((acceleration - expected).abs() < 1e-3 * G, "{k}: {acceleration} {expected}");
    }
}
