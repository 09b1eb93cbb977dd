//! Probes, and implausible numbers.

use std::path::Path;

use fem_case::{Case, Probe};

use super::message_table::{VALID, parse};

#[test]
fn a_probe_is_a_place_of_a_body() {
    let probe = "[[output.probe]]\nbody = \"target\"\nr = \"1 mm\"\ny = 2e-3\n";
    let case = parse(&format!("{VALID}{probe}")).unwrap();
    assert_eq!(case.scene().probes(), [Probe { body: 1, r: 1e-3, y: 2e-3 }]);
}

#[test]
fn implausible_numbers_cause_warnings() {
    let odd = |part: &str, replacement: &str| {
        assert!(VALID.contains(part), "{part}");
        parse(&VALID.replacen(part, replacement, 1)).unwrap().scene().implausible_numbers()
    };
    assert!(parse(VALID).unwrap().scene().implausible_numbers().is_empty());
    for (part, replacement, warning) in [
        ("\"22.2 mm\"", "5", "diameter of striker is 5.000 m"),
        ("\"15.9 mm\"", "\"3 m\"", "that of the other body"),
        ("\"22.2 mm\"", "\"101 m\"", "diameter of striker is 101.0 m"),
        ("\"2390 kg/m^3\"", "2.39", "density of striker is 2.39"),
        ("\"2390 kg/m^3\"", "\"26 g/cm^3\"", "density of"),
        ("\"63 GPa\"", "63", "Young's modulus of striker is"),
        (
            "\"63 GPa\"",
            "\"63 ± 2000 GPa\"",
            "youngs_modulus is 3170 % of its value: check its unit",
        ),
        ("\"22.2 mm\"", "\"22.2 mm ± 0.1 m\"", "diameter is 450 % of its value: check its unit"),
    ] {
        let found = odd(part, replacement);
        assert!(found.iter().any(|text| text.contains(warning)), "{replacement}: {found:?}");
    }
    // Rare values that are plausible.
    for (part, replacement) in [
        ("\"22.2 mm\"", "1.5"),
        ("\"2390 kg/m^3\"", "11"),
        ("\"63 GPa\"", "\"1 kPa\""),
        ("\"63 GPa\"", "\"63 ± 62 GPa\""),
    ] {
        assert_eq!(odd(part, replacement), [""; 0], "{replacement}");
    }
}

/// Density, Young's modulus, diameter and speed as a deck has them: the proposals are of one system of units, and name
/// every bare number of a deck.
#[test]
fn units_are_proposed_in_one_system() {
    let case = |[density, modulus, diameter, speed]: [&str; 4]| {
        format!(
            "[material.m]\ndensity = {density}\nyoungs_modulus = {modulus}\npoissons_ratio = 0.3\n\
             [[body]]\nname = \"floor\"\nwall = {{}}\n[[body]]\nname = \"ball\"\n\
             sphere = {{ diameter = {diameter} }}\nmaterial = \"m\"\napproach_speed = {speed}\n"
        )
    };
    let keys = ["diameter", "approach_speed", "density", "youngs_modulus"];
    for (numbers, units) in [
        (["1.1e-9", "6.0", "50.0", "4429"], ["mm", "mm/s", "t/mm^3", "MPa"]),
        (["7.85e-9", "210000", "50", "0.5"], ["mm", "mm/s", "t/mm^3", "MPa"]),
        (["1.1e-3", "6", "50", "4.4"], ["mm", "m/s", "g/mm^3", "MPa"]),
        (["1.1e-6", "0.006", "50", "4.4"], ["mm", "m/s", "kg/mm^3", "GPa"]),
        (["7.33e-4", "30e6", "1", "174"], ["in", "in/s", "lbf s^2/in^4", "psi"]),
        (["2.39", "63", "22.2", "2"], ["mm", "", "g/cm^3", "GPa"]),
        (["1100", "5000", "0.05", "4"], ["", "", "", "MPa"]),
        (["7850", "210e9", "9", "2"], ["mm", "", "", ""]),
        (["7850", "210e9", "0.009", "2000"], ["", "mm/s", "", ""]),
        (["7850", "210e9", "0.009", "\"2000 m/s\""], ["", "", "", ""]),
    ] {
        let [density, modulus, diameter, speed] = numbers;
        let mut expected = Vec::new();
        for (k, text) in [diameter, speed, density, modulus].into_iter().enumerate() {
            if !units[k].is_empty() {
                expected.push(format!("write the unit: {} = \"{text} {}\", or", keys[k], units[k]));
            }
        }
        let mut helps = Vec::new();
        if let Err(error) = parse(&case(numbers)).unwrap().check_units(false) {
            let all = std::iter::once(&error).chain(error.others());
            helps = all.map(|error| error.help().unwrap().to_string()).collect();
        }
        let are_alike = expected.iter().zip(&helps).all(|(all, help)| help.starts_with(all));
        assert!(are_alike && expected.len() == helps.len(), "{numbers:?}: {helps:#?}");
    }
    // A bare number of an override in code is SI.
    let faster = ["body.1.approach_speed=2000".to_string()];
    let text = case(["7850", "210e9", "0.009", "2"]);
    let case = Case::parse("pair.toml", &text, Path::new("."), &faster).unwrap();
    assert!(case.check_units(true).is_ok() && case.check_units(false).is_err());
}
