//! Prony series, the exact step, and materials that relax.

use fem_material::{
    ActsOn, ElasticModuli, Material, MaterialError, PronySeries, PronyTerm, RelaxationStep,
    ShiftLaw,
};

fn series(terms: &[(f64, f64)], acts_on: ActsOn) -> Result<PronySeries, MaterialError> {
    let terms = terms
        .iter()
        .map(|&(weight, relaxation_time)| PronyTerm { weight, relaxation_time })
        .collect();
    PronySeries::new(terms, acts_on)
}

/// Three terms over four decades, and an equilibrium modulus of 0.2.
fn three_terms() -> PronySeries {
    series(&[(0.3, 1e-2), (0.4, 1.0), (0.1, 30.0)], ActsOn::Shear).unwrap()
}

/// Stress over G_0 at the end of a strain history, given by the strain at each of `times`.
fn march(prony: &PronySeries, times: &[f64], strain: impl Fn(f64) -> f64) -> f64 {
    let mut branches = vec![0.0; prony.terms().len()];
    for pair in times.windows(2) {
        let increment = strain(pair[1]) - strain(pair[0]);
        for (q, term) in branches.iter_mut().zip(prony.terms()) {
            let step = RelaxationStep::new(term.relaxation_time, pair[1] - pair[0]);
            *q = step.advance(*q, increment);
        }
    }
    let viscous: f64 = branches.iter().zip(prony.terms()).map(|(q, term)| term.weight * q).sum();
    prony.equilibrium_weight() * strain(times[times.len() - 1]) + viscous
}

fn evenly(end: f64, n_steps: usize) -> Vec<f64> {
    (0..=n_steps).map(|i| end * i as f64 / n_steps as f64).collect()
}

#[test]
fn limits_of_the_relaxation_function() {
    let prony = three_terms();
    assert!((prony.equilibrium_weight() - 0.2).abs() < 1e-15);
    assert!((prony.relaxation(0.0) - 1.0).abs() < 1e-15);
    assert_eq!(prony.relaxation(-1.0), prony.relaxation(0.0));
    assert_eq!(prony.relaxation(f64::INFINITY), prony.equilibrium_weight());
    // Between the decades only the slower terms are left: the first leaves 0.3 e^{−30} = 3e-14.
    assert!(
        (prony.relaxation(0.3) - (0.2 + 0.4 * (-0.3f64).exp() + 0.1 * (-0.01f64).exp())).abs()
            < 1e-13
    );
    let values: Vec<f64> = evenly(100.0, 1000).iter().map(|&t| prony.relaxation(t)).collect();
    assert!(values.windows(2).all(|pair| pair[1] < pair[0]));
}

/// ∫ g(t−s) ds = g∞ t + Σ g_k τ_k (1 − e^{−t/τ_k}) for a strain that grows as t: the step is
/// exact for a constant rate, so steps of any length add up to it. A strain that stops growing is two ramps, in the limit
/// a step that relaxes as g(t).
#[test]
fn ramp_equals_the_convolution_integral_for_any_steps() {
    let prony = three_terms();
    let end = 5.0f64;
    let ramp = |time: f64| {
        let viscous = prony.terms().iter().map(|term| {
            -term.weight * term.relaxation_time * (-time / term.relaxation_time).exp_m1()
        });
        prony.equilibrium_weight() * time + viscous.sum::<f64>()
    };
    for times in [evenly(end, 1), evenly(end, 7), evenly(end, 1000), vec![0.0, 1e-9, 0.2, 4.9, end]]
    {
        // A thousand roundings of 1e-16.
        assert!((march(&prony, &times, |t| t) - ramp(end)).abs() < 1e-13);
    }
    let held = march(&prony, &[0.0, 0.7, 2.0, 3.0, end], |t| t.min(2.0));
    assert!((held - (ramp(end) - ramp(end - 2.0))).abs() < 1e-13);
    for end in [1e-3, 0.1, 1.0, 50.0] {
        let stress = march(&prony, &[0.0, 1e-13, 0.4 * end, end], |t| f64::from(t > 0.0));
        // The loading takes 1e-13 of the shortest relaxation time 1e-2.
        assert!((stress - prony.relaxation(end)).abs() < 1e-11);
    }
}

#[test]
fn step_is_accurate_over_24_decades() {
    for exponent in -12..=12 {
        let ratio = 10f64.powi(exponent);
        let step = RelaxationStep::new(1.0, ratio);
        // (1 − e^{−x})/x by its series up to 0.1, where 14 terms leave nothing; directly above.
        let gain = if ratio < 0.5 {
            let mut term = 1.0;
            (1..=14).fold(0.0, |sum, n| {
                let next = sum + term;
                term *= -ratio / f64::from(n + 1);
                next
            })
        } else {
            (1.0 - (-ratio).exp()) / ratio
        };
        assert!((step.gain / gain - 1.0).abs() < 1e-13, "Δt/τ = {ratio}: {}", step.gain);
        assert!((step.decay - (1.0 - ratio * gain)).abs() < 1e-15);
    }
    assert_eq!(RelaxationStep::new(f64::MAX, 1e-300), RelaxationStep { decay: 1.0, gain: 1.0 });
    assert_eq!(
        RelaxationStep::new(f64::MIN_POSITIVE, 1e300),
        RelaxationStep { decay: 0.0, gain: 0.0 }
    );
}

/// The ODE of the Kelvin element, integrated by classical Runge–Kutta, knows nothing of Prony.
#[test]
fn three_parameter_solid_relaxes_as_its_ode() {
    let (k1, k2, viscosity) = (3.0, 1.25, 0.7);
    let prony = PronySeries::three_parameter_solid(k1, k2, viscosity, ActsOn::All).unwrap();
    assert_eq!(prony.terms().len(), 1);
    assert_eq!(prony.acts_on(), ActsOn::All);

    let rate = |kelvin_strain: f64| (k1 * (1.0 - kelvin_strain) - k2 * kelvin_strain) / viscosity;
    let (n_steps, dt) = (1000, 1e-3);
    let mut kelvin_strain = 0.0;
    for i in 0..=n_steps {
        let stress = k1 * (1.0 - kelvin_strain);
        let time = f64::from(i) * dt;
        // Runge–Kutta's error (Δt/τ)⁴/120 is 1e-11 here.
        assert!((stress / k1 - prony.relaxation(time)).abs() < 1e-10, "t = {time}");
        let a = rate(kelvin_strain);
        let b = rate(kelvin_strain + 0.5 * dt * a);
        let c = rate(kelvin_strain + 0.5 * dt * b);
        let d = rate(kelvin_strain + dt * c);
        kelvin_strain += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
}

/// Without the Kelvin spring it is Maxwell's fluid; Table 1 of the paper with τ = η/k₁.
#[test]
fn three_parameter_solid_without_kelvin_spring_is_maxwells() {
    let fluid = PronySeries::three_parameter_solid(2.53e10, 0.0, 2.53e10 * 1.676e-4, ActsOn::Shear)
        .unwrap();
    assert_eq!(fluid.equilibrium_weight(), 0.0);
    assert!((fluid.terms()[0].relaxation_time / 1.676e-4 - 1.0).abs() < 1e-15);
    let stiffness = |k1, k2, eta| PronySeries::three_parameter_solid(k1, k2, eta, ActsOn::All);
    assert!(stiffness(0.0, 1.0, 1.0).is_err());
    assert!(stiffness(1.0, -1.0, 1.0).is_err());
    assert!(stiffness(1.0, f64::NAN, 1.0).is_err());
    assert!(stiffness(1.0, 1.0, f64::INFINITY).is_err());
}

#[test]
fn impossible_series_are_refused() {
    let negative = MaterialError::RelaxationWeight { index: 1, value: -0.1 };
    for (terms, expected) in [
        (&[][..], MaterialError::NoRelaxationTerms),
        (&[(0.1, 1.0), (-0.1, 1.0)], negative),
        (&[(0.1, 0.0)], MaterialError::RelaxationTime { index: 0, value: 0.0 }),
        (&[(0.75, 1.0), (0.5, 2.0)], MaterialError::RelaxationWeightSum { sum: 1.25 }),
    ] {
        assert_eq!(series(terms, ActsOn::All), Err(expected), "{terms:?}");
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(series(&[(bad, 1.0)], ActsOn::All).is_err());
        assert!(series(&[(0.1, bad)], ActsOn::All).is_err());
    }
    // The rounding of a sum is forgiven, a real excess is not.
    let rounded = series(&[(1.0 + 5e-13, 1.0)], ActsOn::All).unwrap();
    assert_eq!(rounded.equilibrium_weight(), 0.0);
    assert!(series(&[(1.0 + 2e-12, 1.0)], ActsOn::All).is_err());
}

fn glass(relaxation: Option<PronySeries>) -> Material {
    let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(63e9, 0.244).unwrap();
    Material::new(2390.0, moduli, relaxation).unwrap()
}

/// An elastic material keeps its moduli; where all relaxes, Poisson's ratio is constant, and where shear alone does, the bulk
/// modulus.
#[test]
fn moduli_relax_as_the_series_acts_on_them() {
    for acts_on in [None, Some(ActsOn::All), Some(ActsOn::Shear)] {
        let material = glass(acts_on.map(|on| series(&[(1.0, 1.0 / 2708.0)], on).unwrap()));
        let moduli = *material.instantaneous();
        let left = |time: f64| if acts_on.is_some() { (-2708.0 * time).exp() } else { 1.0 };
        for time in [0.0, 3e-5, 1e-3, 1.0, f64::INFINITY] {
            let [shear, bulk] = [material.shear_modulus_at(time), material.bulk_modulus_at(time)];
            // One or two roundings each.
            assert!((shear - left(time) * moduli.shear_modulus()).abs() < 1e-4);
            match acts_on {
                Some(ActsOn::All) => {
                    assert!((bulk - left(time) * moduli.bulk_modulus()).abs() < 1e-4);
                }
                _ => assert_eq!(bulk, moduli.bulk_modulus()),
            }
            assert!(acts_on.is_some() || shear == moduli.shear_modulus());
        }
        let lasting = material.equilibrium_shear_modulus();
        assert_eq!(lasting, left(f64::INFINITY) * moduli.shear_modulus());
    }
    let material = glass(Some(three_terms()));
    let limit = material.shear_modulus_at(f64::INFINITY);
    assert_eq!(material.equilibrium_shear_modulus(), limit);
    assert!((limit / material.instantaneous().shear_modulus() - 0.2).abs() < 1e-15);
}

#[test]
fn impossible_density_is_refused() {
    let moduli = *glass(None).instantaneous();
    for density in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            Material::new(density, moduli, None),
            Err(MaterialError::NotPositive { quantity: "density", .. })
        ));
    }
}

/// The complex modulus of one term, its limits, and its Fourier integral.
#[test]
fn complex_moduli_are_the_transform_of_the_relaxation() {
    let one = series(&[(0.6, 0.01)], ActsOn::All).unwrap();
    let [storage, loss] = one.complex_modulus(100.0);
    assert!((storage - 0.7).abs() < 1e-15 && (loss - 0.3).abs() < 1e-15);
    assert_eq!(one.complex_modulus(0.0), [0.4, 0.0]);
    for frequency in [1e200, f64::INFINITY] {
        let [storage, loss] = one.complex_modulus(frequency);
        assert!((storage - 1.0).abs() < 1e-15 && loss < 1e-150);
    }
    // iω ∫ (g − g∞) e^{−iωs} ds + g∞, by Simpson's rule in ln s from where g changes by 1e-9 to where it is 1e-15.
    let prony = three_terms();
    for exponent in -4..=0 {
        let frequency = 10f64.powi(exponent);
        let (from, to, n) = (1e-14f64.ln(), 1100f64.ln(), 400_000);
        let step = (to - from) / f64::from(n);
        let mut sum = [prony.equilibrium_weight(), 0.0];
        for k in 0..=n {
            let time = (from + step * f64::from(k)).exp();
            let weight = match k {
                0 => 1.0,
                _ if k == n => 1.0,
                _ if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let decaying = prony.relaxation(time) - prony.equilibrium_weight();
            let part = weight * step / 3.0 * frequency * time * decaying;
            let (sin, cos) = (frequency * time).sin_cos();
            sum = [sum[0] + part * sin, sum[1] + part * cos];
        }
        let exact = prony.complex_modulus(frequency);
        assert!((sum[0] - exact[0]).abs() < 1e-6, "{frequency}: {sum:?} {exact:?}");
        assert!((sum[1] - exact[1]).abs() < 1e-6, "{frequency}: {sum:?} {exact:?}");
    }
}

#[test]
fn shift_laws_have_their_values() {
    // The universal constants of Williams, Landel & Ferry (1955), 50 K above the glass transition.
    let wlf = ShiftLaw::Wlf { c1: 17.44, c2: 51.6 };
    let shift = wlf.log10_shift(423.15, 373.15).unwrap();
    assert!((shift + 17.44 * 50.0 / 101.6).abs() < 1e-12);
    assert_eq!(wlf.log10_shift(373.15, 373.15), Some(0.0));
    assert_eq!(wlf.log10_shift(373.15 - 51.6, 373.15), None);
    let arrhenius = ShiftLaw::Arrhenius { activation_temperature: 10_000.0 };
    let shift = arrhenius.log10_shift(250.0, 300.0).unwrap();
    assert!((shift - 1e4 * (1.0 / 250.0 - 1.0 / 300.0) / 10f64.ln()).abs() < 1e-12);
    let table = ShiftLaw::Table(vec![(280.0, 2.0), (300.0, 0.0), (310.0, -0.5)]);
    let at = [279.0, 280.0, 285.0, 300.0, 305.0, 310.0, 311.0];
    let found = at.map(|temperature| table.log10_shift(temperature, 300.0));
    let known = [None, Some(2.0), Some(1.5), Some(0.0), Some(-0.25), Some(-0.5), None];
    assert_eq!(found, known);
}

/// The given series itself is the reference: smooth, ragged and coinciding times over many decades and over less than one.
#[test]
fn many_close_terms_relax_as_seven_in_an_octave() {
    let spread = |decades: f64, n: usize, weight: fn(usize) -> f64| -> Vec<(f64, f64)> {
        let sum: f64 = (0..n).map(weight).sum();
        let time = |k: usize| 10f64.powf(-6.0 + decades * k as f64 / (n - 1) as f64);
        (0..n).map(|k| (0.97 * weight(k) / sum, time(k))).collect()
    };
    let ragged = |k: usize| ((k * 7919) % 101) as f64 / 101.0;
    let cases = [
        (spread(2.0, 1000, |_| 1.0), 49),
        (spread(8.0, 1000, ragged), 7 * 27),
        (spread(0.2, 40, ragged), 7),
        (vec![(0.01, 1e-3); 60], 1),
        (spread(0.3, 8, |k| if k == 3 { 1.0 } else { 1e-12 }), 7),
    ];
    for (terms, most) in cases {
        let given = series(&terms, ActsOn::All).unwrap();
        let merged = given.clone().merged();
        let n_terms = merged.terms().len();
        assert!(n_terms <= most, "{n_terms} terms of {}", terms.len());
        assert!(merged.terms().iter().all(|term| term.weight > 0.0));
        for k in 0..400 {
            let time = 10f64.powf(-8.0 + 0.03 * k as f64);
            let difference = merged.relaxation(time) - given.relaxation(time);
            assert!(
                difference.abs() < 1e-9,
                "{difference:e} at {time:e} s of {} terms",
                terms.len()
            );
            let [ours, exact] = [&merged, &given].map(|of| of.complex_modulus(time.recip()));
            for part in 0..2 {
                let difference = ours[part] - exact[part];
                assert!(difference.abs() < 1e-8, "{difference:e} of part {part} at {time:e} s");
            }
        }
    }
    let few = three_terms();
    assert_eq!(few.clone().merged(), few);
}
