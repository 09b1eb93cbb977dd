//! Probes, and implausible numbers.

use fem_case::Probe;

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
