//! From noisy moduli to a restitution with its error bar.

use std::f64::consts::TAU;
use std::fmt::Write;

use fem::measured::ModulusTable;
use fem::relaxation::{FoundRelaxation, RelaxationSettings};
use fem::{QuantityOfInterest, ShiftLaw};
use fem_material::{ActsOn, PronySeries, PronyTerm};

use crate::scene::{simulation_of, summary_of};

/// A polymer with a broad glass transition, E0 = 2.6 GPa at 20 °C.
fn polymer() -> PronySeries {
    let weight = |k: i32| (-(f64::from(k) / 4.0).powi(2)).exp();
    let sum: f64 = (-8..=8).map(weight).sum();
    let term = |k| PronyTerm { weight: 0.97 * weight(k) / sum, relaxation_time: 10f64.powi(k) };
    PronySeries::new((-8..=8).map(term).collect(), ActsOn::All).unwrap()
}

/// Moduli of [`polymer`] from 0.1 to 100 Hz at seven temperatures, C1 = 12 and C2 = 120 K, with relative noise.
fn moduli(noise: f64, seed: u64) -> String {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut scatter = || 1.0 + noise * ((0..12).map(|_| random.f64()).sum::<f64>() - 6.0);
    let law = ShiftLaw::Wlf { c1: 12.0, c2: 120.0 };
    let mut text = "f [Hz],E' [Pa],E'' [Pa],T [°C]\n".to_string();
    for block in 0..7 {
        let celsius = 10.0 * f64::from(block) - 10.0;
        let shift = law.log10_shift(celsius + 273.15, 293.15).unwrap();
        for k in 0..10 {
            let frequency = 10f64.powf(-1.0 + f64::from(k) / 3.0);
            let moduli = polymer().complex_modulus(TAU * frequency * 10f64.powf(shift));
            let [storage, loss] = moduli.map(|modulus| 2.6e9 * modulus * scatter());
            writeln!(text, "{frequency},{storage},{loss},{celsius}").unwrap();
        }
    }
    text
}

/// A ball of 2 cm inside the measured band, a small and fast one, and one so cold that its contact is faster than all data.
const IMPACTS: [[&str; 3]; 3] =
    [["20 mm", "1 m/s", "20 degC"], ["3 mm", "5 m/s", "45 degC"], ["20 mm", "1 m/s", "-10 degC"]];

/// Returns the restitution of an impact on a rigid wall and its standard uncertainty by the material.
fn restitution(material: &str, [diameter, speed, temperature]: [&str; 3]) -> (f64, f64) {
    let case = format!(
        "model.ting = {{}}\nscene.temperature = '{temperature}'\n{material}\n[[body]]\nname = 'ball'\n\
         sphere.diameter = '{diameter}'\nmaterial = 'polymer'\napproach_speed = '{speed}'\n[[body]]\nname = 'floor'\nwall = {{}}\n"
    );
    let summary = summary_of::<&str>(&case, &[]);
    let quantity = QuantityOfInterest::Restitution;
    let input = summary.uncertainty.of(quantity).input.unwrap_or(0.0);
    (summary.collision.number(quantity).unwrap(), input)
}

/// Returns the number of draws in which each restitution is within two standard uncertainties, with noise from 1 to 3 %, and the mean squares
/// of the deviations over these.
fn coverage(n: u64) -> [(u64, f64); 3] {
    let terms: Vec<String> = (polymer().terms().iter())
        .map(|it| {
            format!("{{ weight = {:e}, relaxation_time = {:e} }}", it.weight, it.relaxation_time)
        })
        .collect();
    let known = format!(
        "[material.polymer]\ndensity = 1180\nyoungs_modulus = 2.6e9\npoissons_ratio = 0.38\n[material.polymer.relaxation]\n\
         acts_on = 'all'\nreference_temperature = 293.15\nshift.wlf = {{ c1 = 12, c2 = 120 }}\nterms = [{}]\n",
        terms.join(", ")
    );
    let known = IMPACTS.map(|impact| restitution(&known, impact).0);
    let mut found = [(0, 0.0); 3];
    for seed in 0..n {
        let noise = 0.01 + 0.02 * seed as f64 / n as f64;
        let text = moduli(noise, seed);
        let table = ModulusTable::parse("a.csv", &text, &[], None).unwrap();
        let relaxation = FoundRelaxation::of(table, RelaxationSettings::default()).unwrap();
        let material = relaxation.material_toml("polymer", Some(1180.0), Some(0.38));
        let material =
            format!("{material}[material.polymer.relaxation]\n{}", relaxation.relaxation_toml());
        for ((n_inside, squares), (impact, known)) in
            found.iter_mut().zip(IMPACTS.iter().zip(known))
        {
            let (e, uncertainty) = restitution(&material, *impact);
            // Within the measured band the loss has a bar of up to twice the noise of the moduli.
            let is_narrow = uncertainty < 2.0 * noise * (1.0 - known);
            assert!(is_narrow || impact == &IMPACTS[2], "{uncertainty} {noise} {known}");
            *n_inside += u64::from((e - known).abs() < 2.0 * uncertainty);
            *squares += ((e - known) / uncertainty).powi(2) / n as f64;
        }
    }
    found
}

/// If 95 in 100 draws are inside, 6 or fewer of 8 are in one of 17 runs and 5 or fewer in one of 170.
#[test]
fn restitutions_of_noisy_moduli_are_within_their_bars() {
    for found in coverage(8) {
        assert!(found.0 >= 6, "{found:?} of 8");
    }
}

#[test]
#[ignore = "a hundred fits take a minute without optimisation"]
fn restitutions_are_within_their_bars_in_95_of_100_draws() {
    let found = coverage(100);
    assert!(found.iter().all(|it| it.0 >= 95), "{found:?}");
}

/// The data are of a material with 2.6 GPa; 5 % less is as good.
#[test]
fn a_modulus_that_is_not_that_of_the_data_is_warned_of() {
    let warnings = |modulus: &str, of_data: &str| {
        let case = format!(
            "model.ting = {{}}\n[material.polymer]\ndensity = 1180\nyoungs_modulus = '{modulus}'\npoissons_ratio = 0.3\n\
             [material.polymer.relaxation]\nacts_on = 'all'\n{of_data}\nterms = [{{ weight = 0.1, relaxation_time = 1e-4 }}]\n\
             [[body]]\nname = 'ball'\nsphere.diameter = '1 cm'\nmaterial = 'polymer'\napproach_speed = '0.1 m/s'\n\
             [[body]]\nname = 'floor'\nwall = {{}}\n"
        );
        simulation_of::<&str>(&case, &[]).warnings_before().join("\n")
    };
    for of_data in ["youngs_modulus = '2.6 GPa'", "shear_modulus = '1 GPa'"] {
        assert!(!warnings("2.5 GPa", of_data).contains("that of the data"));
        let found = warnings("2 GPa", of_data);
        assert!(found.contains("of ball is ") && found.contains("but that of the data"), "{found}");
        assert!(found.lines().all(|line| line.chars().count() <= 230), "{found}");
    }
}
