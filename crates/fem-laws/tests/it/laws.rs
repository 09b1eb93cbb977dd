//! Contact laws: closed forms, scaling, similarity, published forms, extremes, refusals.

use std::f64::consts::PI;

use fem_laws::laws::{
    ContactLaw, bordbar_hyppanen, dissipation_time, falcon, hertz, hertz_dashpot, hunt_crossley,
    kuwabara_kono, linear, linear_damping, linear_from_restitution, mishra_murty,
    morgado_oppenheim, power, schwager_poeschel, tsuji, tsuji_coefficient,
};
use fem_laws::{
    EndRule, HertzImpact, Impact, ImpactQuantities, LawError, LawImpact, Pair, Partner,
};

use crate::common::{assert_close, assert_history, assert_values, glass, glass_pair, moduli};

fn impact(law: ContactLaw, speed: f64) -> Impact {
    LawImpact::new(&glass_pair(), law).impact(speed).unwrap()
}

fn impact_to_zero_overlap(law: ContactLaw, speed: f64) -> Impact {
    let model = LawImpact::new(&glass_pair(), law).with_end_rule(EndRule::ZeroOverlap);
    model.impact(speed).unwrap()
}

/// `DEFAULT_TOLERANCE` is 1e-8; without a dashpot the method does a tenth of it.
const ELASTIC: f64 = 1e-9;

/// Ten times the default tolerance: what is asked of a damped collision.
const DAMPED: f64 = 1e-7;

#[test]
fn hertz_law_is_the_closed_form() {
    let pair = glass_pair();
    for speed in [1e-9, 1e-3, 0.5, 1e3] {
        for end_rule in [EndRule::ZeroForce, EndRule::ZeroOverlap] {
            let model = LawImpact::new(&pair, hertz(&pair).unwrap()).with_end_rule(end_rule);
            let found = model.impact(speed).unwrap();
            let exact = HertzImpact::new(&pair, speed).unwrap();
            assert_values(&found, &ImpactQuantities::from(&exact).in_order(), ELASTIC);
            for instant in &found.history {
                let expected = exact.at(instant.time);
                assert!((instant.approach - expected.approach).abs() < 1e-8 * exact.max_approach());
                assert!((instant.force - expected.force).abs() < 1e-8 * exact.peak_force());
            }
        }
    }
}

/// ½mv² = Kδ^(γ+1)/(γ+1) and T = (2δ/v) ∫ dx/√(1−x^(γ+1)) = 2√π Γ(1+p)/Γ(½+p) δ/v, p = 1/(γ+1).
#[test]
fn elastic_power_laws_are_their_closed_forms() {
    use statrs::function::gamma::gamma;
    let mass = glass_pair().effective_mass();
    for exponent in [0.5f64, 1.0, 1.5, 1.6, 3.0] {
        let found = impact(power(1e7, exponent, 0.0, 0.5).unwrap(), 0.5);
        let p = 1.0 / (exponent + 1.0);
        let approach = ((exponent + 1.0) * mass * 0.125 / 1e7).powf(p);
        let time = 2.0 * PI.sqrt() * gamma(1.0 + p) / gamma(0.5 + p) * approach / 0.5;
        assert_close(found.restitution, 1.0, ELASTIC);
        assert_close(found.max_approach, approach, ELASTIC);
        assert_close(found.contact_time.unwrap(), time, ELASTIC);
    }
}

/// ζ of a linear law and both closed forms, under- and over-damped.
#[test]
fn linear_law_is_its_closed_form() {
    let mass = glass_pair().effective_mass();
    let frequency = (1e7 / mass).sqrt();
    for ratio in [1e-6f64, 0.01, 0.1, 0.5, 0.9] {
        let law = linear(1e7, 2.0 * ratio * mass * frequency).unwrap();
        let root = (1.0 - ratio * ratio).sqrt();
        let overlap = impact_to_zero_overlap(law, 0.5);
        // The absolute error of the rate counts: e falls to 1.5e-3.
        assert!((overlap.restitution - (-PI * ratio / root).exp()).abs() < 1e-8);
        assert_close(overlap.contact_time.unwrap(), PI / (frequency * root), DAMPED);
        let phase = 2.0 * ratio.acos() / root;
        let force = impact(law, 0.5);
        assert_close(force.restitution, (-ratio * phase).exp(), DAMPED);
        assert_close(force.contact_time.unwrap(), phase / frequency, DAMPED);
        // The force is C v at first touch and the largest there from ζ = 1/2 on; before, it is
        // m v ω₀ e^(−ζω₀t) at ωt = 3φ − π.
        if ratio >= 0.5 {
            assert_close(force.peak_force, law.damping() * 0.5, 1e-12);
        } else {
            let decay = (-ratio / root * (3.0 * ratio.acos() - PI)).exp();
            assert_close(force.peak_force, mass * 0.5 * frequency * decay, DAMPED);
        }
    }
    for ratio in [2.0f64, 14.0, 30.0] {
        let law = linear(1e7, 2.0 * ratio * mass * frequency).unwrap();
        let phase = 2.0 * ratio.acosh() / (ratio * ratio - 1.0).sqrt();
        let force = impact(law, 0.5);
        // The absolute error of the rate counts: e is 5e-3 and 1.3e-3, and 3e-4 counts as nothing.
        let e = if ratio < 30.0 { (-ratio * phase).exp() } else { 0.0 };
        assert!((force.restitution - e).abs() < 1e-8);
        let model = LawImpact::new(&glass_pair(), law).with_end_rule(EndRule::ZeroOverlap);
        match model.impact(0.5) {
            Ok(creeping) => {
                assert_eq!((creeping.restitution, creeping.contact_time), (0.0, None));
            }
            // The creep is ζ² times as long as the braking.
            Err(error) => {
                assert!(ratio == 30.0 && matches!(error, LawError::NotFinished { .. }));
            }
        }
    }
}

#[test]
fn linear_law_gives_the_restitution_and_time_asked_for() {
    let pair = glass_pair();
    for end_rule in [EndRule::ZeroForce, EndRule::ZeroOverlap] {
        for restitution in [1.0, 0.99, 0.5, 0.1] {
            let law = linear_from_restitution(&pair, restitution, 64e-6, end_rule).unwrap();
            let model = LawImpact::new(&pair, law).with_end_rule(end_rule);
            let found = model.impact(2.0).unwrap();
            assert_close(found.restitution, restitution, DAMPED);
            assert_close(found.contact_time.unwrap(), 64e-6, DAMPED);
            // The stiffness and the restitution give the damping of that law.
            let damping = linear_damping(&pair, law.stiffness(), restitution, end_rule).unwrap();
            assert!((damping - law.damping()).abs() <= 1e-12 * law.damping());
        }
    }
    let [e, k, m] = [0.5f64, 5e4, pair.effective_mass()];
    let published = -2.0 * e.ln() * (m * k).sqrt() / (PI * PI + e.ln() * e.ln()).sqrt();
    let damping = linear_damping(&pair, k, e, EndRule::ZeroOverlap).unwrap();
    assert_close(damping, published, 1e-14);
    assert_close(impact_to_zero_overlap(linear(k, damping).unwrap(), 2.0).restitution, e, DAMPED);
}

/// The Padé form of Müller & Pöschel (2011), good to 1e-4 for e > 0.84, at zero force.
#[test]
fn kuwabara_kono_is_the_published_pade_form() {
    let pair = glass_pair();
    let mut n_checked = 0;
    for time in [1e-9, 1e-8, 1e-7, 3e-7, 1e-6, 2e-6] {
        for speed in [0.01f64, 0.5, 5.0] {
            let law = kuwabara_kono(&pair, time).unwrap();
            let beta = 1.5 * time * (law.stiffness() / pair.effective_mass()).powf(0.4);
            let w = beta.sqrt() * speed.powf(0.1);
            let above = 1.0 + 0.501086 * w;
            let below = above + 1.15345 * w.powi(2) + 0.577977 * w.powi(3) + 0.532178 * w.powi(4);
            if above / below > 0.84 {
                n_checked += 1;
                let found = impact(law, speed).restitution;
                // The form is printed as good to 1e-4 for e > 0.84; this collision, converged to
                // 1e-11, leaves it at 0.86 and is off by 1.38e-4 at 0.8427.
                let tolerance = if found > 0.86 { 1e-4 } else { 1.5e-4 };
                assert!((found - above / below).abs() < tolerance, "{found} {}", above / below);
            }
        }
    }
    assert!(n_checked >= 10, "{n_checked}");
}

/// 1 − e of C ξⁿ ξ̇ grows as v^((4n−1)/5), and n = 1/4 is independent of speed.
#[test]
fn loss_grows_with_the_power_of_the_damping_exponent() {
    let pair = glass_pair();
    for n in [0.25, 0.4, 0.5, 0.65, 0.8, 1.0, 1.5] {
        let loss = |speed: f64| {
            // The same loss, 1e-4, at 1 m/s for every n.
            let unit = impact(bordbar_hyppanen(&pair, 1e-9, n).unwrap(), 1.0);
            let time = 1e-13 / (1.0 - unit.restitution);
            1.0 - impact(bordbar_hyppanen(&pair, time, n).unwrap(), speed).restitution
        };
        let exponent = (loss(2.0) / loss(0.5)).log(4.0);
        // 1 − e has second-order terms of 1e-4 of itself, and errors of 1e-8/1e-4.
        assert!((exponent - (4.0 * n - 1.0) / 5.0).abs() < 1e-3, "n {n}: {exponent}");
    }
    // A constant dashpot has n = 0.
    let rise = |speed| 1.0 - impact(hertz_dashpot(&pair, 1e-2).unwrap(), speed).restitution;
    assert!(((rise(2.0) / rise(0.5)).log(4.0) + 0.2).abs() < 1e-3, "{}", rise(2.0));
    let law = falcon(&pair, 500.0).unwrap();
    let slow = impact(law, 1e-6).restitution;
    assert!(slow < 0.95);
    assert_close(impact(law, 10.0).restitution, slow, DAMPED);
}

/// First order of the loss: the work of the dashpot along the elastic motion, by quadrature.
#[test]
fn small_loss_is_the_work_of_the_dashpot() {
    let pair = glass_pair();
    let elastic = HertzImpact::new(&pair, 0.5).unwrap();
    for n in [0.0, 0.25, 0.5, 1.0, 1.5] {
        // 1 − e = 2 C ∫ ξⁿ ξ̇ dξ/(m v²), with ξ = δ u², ξ̇ = v √(1−u⁵).
        let steps = 20_000;
        let integral: f64 = (0..steps)
            .map(|i| (f64::from(i) + 0.5) / f64::from(steps))
            .map(|u| u.powf(2.0 * n + 1.0) * (1.0 - u.powi(5)).sqrt())
            .sum::<f64>()
            * 2.0
            / f64::from(steps);
        let work = elastic.max_approach().powf(n + 1.0) * 0.5 * integral;
        let damping = 1e-5 * pair.effective_mass() * 0.25 / (2.0 * work);
        let found = impact(power(elastic.stiffness(), 1.5, damping, n).unwrap(), 0.5);
        // Second order: 1e-5; rounding of the integration 1e-9/1e-5; midpoint rule 1e-5.
        assert_close(1.0 - found.restitution, 1e-5, 1e-3);
    }
}

#[test]
fn tsuji_gives_the_restitution_asked_for_at_any_speed() {
    let pair = glass_pair();
    for restitution in [1.0, 0.95, 0.5, 0.1] {
        let law = tsuji(&pair, tsuji_coefficient(restitution).unwrap()).unwrap();
        for speed in [1e-3, 10.0] {
            assert_close(impact_to_zero_overlap(law, speed).restitution, restitution, DAMPED);
            // Zero force comes first, and pulling is left out.
            assert!(impact(law, speed).restitution >= restitution - 1e-9);
        }
    }
    let alpha = tsuji(&pair, 0.1).unwrap();
    let c = 0.1 * (pair.effective_mass() * alpha.stiffness()).sqrt();
    assert_close(alpha.damping(), c, 1e-15);
    assert_eq!(alpha, falcon(&pair, alpha.damping()).unwrap());
}

#[test]
fn hunt_crossley_is_right_to_first_order() {
    let pair = glass_pair();
    let error = |loss: f64| {
        let law = hunt_crossley(&pair, 1.0 - loss, 0.5).unwrap();
        let found = impact(law, 0.5);
        // The force never attracts: both rules end at the same instant.
        let overlap = impact_to_zero_overlap(law, 0.5);
        assert_close(overlap.restitution, found.restitution, 1e-12);
        (1.0 - found.restitution) / loss - 1.0
    };
    // The share of the error is of the order of the loss: a tenth at a tenth.
    let ratio = error(1e-2) / error(1e-3);
    assert!((9.0..11.0).contains(&ratio), "ratio {ratio}");
    assert!(error(1e-3).abs() < 1e-2);
}

/// One law under several names.
#[test]
fn equivalent_named_laws_have_the_same_coefficients() {
    let (pair, glass) = (glass_pair(), glass());
    let a = 3e-7;
    let reference = kuwabara_kono(&pair, a).unwrap();
    let same = |law: ContactLaw| {
        // Products in another order.
        assert_close(law.stiffness(), reference.stiffness(), 1e-14);
        assert_close(law.damping(), reference.damping(), 1e-14);
        assert_eq!((law.elastic_exponent(), law.damping_exponent()), (1.5, 0.5));
    };
    same(schwager_poeschel(&pair, a).unwrap());
    same(bordbar_hyppanen(&pair, a, 0.5).unwrap());
    // Without damping it is Hertz'.
    assert_eq!(bordbar_hyppanen(&pair, 0.0, 0.65).unwrap().damping(), 0.0);
    assert_close(reference.stiffness(), hertz(&pair).unwrap().stiffness(), 1e-14);
    // C has K's form: with η₁ = (3/2) A E and η₂ = ν it is Kelvin's law.
    same(morgado_oppenheim(&pair, 1.5 * a * 63e9, 0.244).unwrap());
    // Eq. 14 for equal materials: C_n E/(1−ν²) √R.
    let expected = a * glass.instantaneous().plane_strain_modulus();
    assert_close(reference.damping(), expected * pair.effective_radius().sqrt(), 1e-14);
    let mishra = mishra_murty(2.0, 3.0).unwrap();
    assert_eq!((mishra.elastic_exponent(), mishra.damping_exponent()), (1.6, 0.8));
    assert_close(mishra.force(0.3, 0.7), 2.0 * 0.3f64.powf(1.6) + 2.1 * 0.3f64.powf(0.8), 1e-15);
    assert_eq!(mishra.force(-1e-9, 0.7), 0.0);
}

/// A of Brilliantov et al. for ν = 1/4, η₂ = 2η₁: (25/24) (15/2) η₁/E.
#[test]
fn dissipation_time_of_viscosities() {
    let expected = 25.0 / 24.0 * 7.5 * 1e3 / 1e9;
    assert_close(dissipation_time(&moduli(1e9, 0.25), 1e3, 2e3).unwrap(), expected, 1e-14);
    let cork = moduli(1e9, 0.0);
    assert!(dissipation_time(&cork, 1e3, 2e3).is_err());
}

/// Dimensions leave one number, so extreme collisions are a moderate one in other units.
#[test]
fn extreme_masses_and_speeds_give_the_similar_restitution() {
    let moderate = impact(kuwabara_kono(&glass_pair(), 1e-6).unwrap(), 0.5).restitution;
    for mass in [1e-12, 1.0, 1e6] {
        for speed in [1e-9, 1.0, 1e3] {
            let plane_strain_modulus = 7e10;
            let sphere = Partner::Sphere { radius: 1e-2, mass, plane_strain_modulus };
            let pair = Pair::new(sphere, Partner::Wall).unwrap();
            // A in the same relation to the contact time.
            let time = HertzImpact::new(&pair, speed).unwrap().contact_time();
            let unit = HertzImpact::new(&glass_pair(), 0.5).unwrap().contact_time();
            let law = kuwabara_kono(&pair, 1e-6 * time / unit).unwrap();
            let found = LawImpact::new(&pair, law).impact(speed).unwrap();
            assert_close(found.restitution, moderate, DAMPED);
        }
    }
}

/// However strong the damping, the answer is right or a refusal.
#[test]
fn heavy_damping_gives_the_limit_or_an_error() {
    let pair = glass_pair();
    let mut last = 1.0;
    for time in [1e-6, 1e-5, 1e-4, 1e-3, 1e-1, 1e3] {
        let found = impact(kuwabara_kono(&pair, time).unwrap(), 0.5);
        assert!(found.restitution < last || (found.restitution, last) == (0.0, 0.0), "{time}");
        last = found.restitution;
        // The dashpot alone: m dξ̇ = −C √ξ dξ stops at C ξ^(3/2) = (3/2) m v.
        if time >= 1e-1 {
            let law = kuwabara_kono(&pair, time).unwrap();
            let stop = (0.75 * pair.effective_mass() / law.damping()).powf(2.0 / 3.0);
            // The spring takes a share of order 1/c² or less.
            assert_close(found.max_approach, stop, 1e-3);
        }
        let model = LawImpact::new(&pair, kuwabara_kono(&pair, time).unwrap());
        match model.with_end_rule(EndRule::ZeroOverlap).impact(0.5) {
            Ok(found) => assert!((0.0..1.0).contains(&found.restitution)),
            Err(LawError::NotFinished { .. }) => assert!(time >= 1e-3, "{time}"),
            Err(other) => panic!("{other}"),
        }
    }
}

/// Error against a run at the finest tolerance, over three orders of the tolerance.
#[test]
fn law_impact_error_is_below_its_tolerance() {
    let pair = glass_pair();
    for n in [0.0, 0.25, 0.5, 0.65, 1.5] {
        let law = bordbar_hyppanen(&pair, 1e-6, n).unwrap();
        let run = |tolerance: f64| {
            let model = LawImpact::new(&pair, law).with_tolerance(tolerance).unwrap();
            model.impact(0.5).unwrap().restitution
        };
        for tolerance in [1e-4, 1e-6, 1e-8] {
            assert!((run(tolerance) - run(1e-10)).abs() < tolerance, "{n} {tolerance}");
        }
    }
}

#[test]
fn law_history_agrees_with_the_impact_result() {
    let pair = glass_pair();
    let found = impact(kuwabara_kono(&pair, 1e-6).unwrap(), 0.5);
    // Steps of 0.2 T at most.
    assert_history(&found, [0.5, pair.effective_mass()], [0.0; 2], 2e-2);
    assert!(found.history.iter().all(|now| now.contact_radius <= found.max_contact_radius));
}

#[test]
fn contact_laws_reject_impossible_data() {
    let pair = glass_pair();
    let negative = |quantity, value| Err(LawError::Negative { quantity, value });
    assert_eq!(kuwabara_kono(&pair, -1.0), negative("dissipation_time", -1.0));
    assert_eq!(falcon(&pair, -1.0), negative("damping", -1.0));
    assert_eq!(
        power(0.0, 1.5, 0.0, 0.0),
        Err(LawError::NotPositive { quantity: "stiffness", value: 0.0 })
    );
    for value in [0.0, -0.1, 1.1, f64::NAN] {
        assert!(tsuji_coefficient(value).is_err());
        assert!(hunt_crossley(&pair, value, 0.5).is_err());
        assert!(linear_from_restitution(&pair, value, 1e-4, EndRule::ZeroForce).is_err());
    }
    assert!(morgado_oppenheim(&pair, 1.0, 1.0).is_err());
    let model = LawImpact::new(&pair, hertz(&pair).unwrap());
    assert!(model.impact(0.0).is_err());
    assert!(model.impact(f64::NAN).is_err());
    assert!(model.with_tolerance(0.0).is_err());
    assert!(kuwabara_kono(&pair, 1e300).is_err());
    assert!(LawImpact::new(&pair, falcon(&pair, 1e300).unwrap()).impact(1e-200).is_err());
}
