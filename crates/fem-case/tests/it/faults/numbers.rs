//! Faults of numbers: units, ranges, and values that are not finite.

use super::marked::{VALID, fault, parse};

#[test]
fn wrong_units() {
    fault(
        "\"22.2 mm\"",
        "«\"22.2 kg\"»",
        "diameter must be a length, such as \"22.2 mm\"; \"22.2 kg\" is a mass",
        "or a bare number in m",
    );
    fault("\"63 GPa\"", "«\"63 Gpa\"»", "unknown unit `Gpa`", "did you mean `GPa`?");
    fault("\"63 GPa\"", "«\"63 GN\"»", "youngs_modulus must be a pressure", "");
    fault("\"2708 1/s\"", "«\"2708 s\"»", "decay_rate must be a rate", "\"2708 1/s\"");
    fault("1e-3", "«\"1e3 1/s\"»", "relaxation_time must be a time", "");
    fault("\"0.5 m/s\"", "«\"0.5\"»", "has no unit", "a bare number in m/s");
    fault("\"0.5 m/s\"", "«\"0,5 m/s\"»", "decimal comma", "");
    fault("\"0.5 m/s\"", "«\"fast\"»", "does not begin with a number", "\"0.5 m/s\"");
    fault("0.244", "«\"0.244 m\"»", "poissons_ratio must be a plain number", "");
    fault("\"8 GB\"", "«\"8 kg\"»", "memory must be an amount of memory", "\"8 GB\"");
}

#[test]
fn not_finite() {
    for (part, replacement) in [
        ("\"22.2 mm\"", "«nan»"),
        ("\"22.2 mm\"", "«inf»"),
        ("\"22.2 mm\"", "«-inf»"),
        ("0.244", "«nan»"),
        ("weight = 0.5", "weight = «nan»"),
        ("1e-3", "«inf»"),
        ("\"0.5 m/s\"", "«+nan»"),
        ("\"1 um\"", "«nan»"),
        ("1.1", "«inf»"),
        ("0.9", "«nan»"),
        ("2e-4", "«nan»"),
        ("200000", "«inf»"),
        ("[\"mid-compression\", \"maximum\"]", "«nan»"),
        ("[\"mid-compression\", \"maximum\"]", "[«nan»]"),
    ] {
        fault(part, replacement, "not finite", "");
    }
    fault("\"22.2 mm\"", "«\"nan mm\"»", "does not begin with a number", "");
    fault("\"22.2 mm\"", "«\"inf mm\"»", "does not begin with a number", "");
    fault("\"22.2 mm\"", "«\"1e400 mm\"»", "out of the range", "");
    fault("\"22.2 mm\"", "«1e400»", "overflow", "");
}

#[test]
fn out_of_range() {
    for (part, bad, message) in [
        ("\"22.2 mm\"", "«0»", "diameter is 0.0 m"),
        ("\"22.2 mm\"", "«\"-1 mm\"»", "diameter is \"-1 mm\""),
        ("\"2390 kg/m^3\"", "«0»", "density must be positive"),
        ("\"2390 kg/m^3\"", "«-2390»", "density must be positive"),
        ("\"63 GPa\"", "«0»", "youngs_modulus must be positive"),
        ("\"63 GPa\"", "«\"-63 GPa\"»", "youngs_modulus must be positive"),
        ("0.244", "«0.5»", "poissons_ratio must lie"),
        ("0.244", "«-1»", "poissons_ratio must lie"),
        ("0.244", "«24.4»", "poissons_ratio must lie"),
        ("\"2708 1/s\"", "«0»", "decay_rate is 0.0 1/s"),
        ("\"2708 1/s\"", "«\"-1 1/s\"»", "decay_rate is \"-1 1/s\""),
        ("1e-3", "«0»", "relaxation_time is 0.0 s"),
        ("1e-3", "«\"-1 ms\"»", "relaxation_time is \"-1 ms\""),
        ("weight = 0.5", "weight = «-0.5»", "relaxation term 0: weight"),
        ("\"1 um\"", "«-1e-6»", "gap is"),
        ("\"14 um\"", "«0»", "contact_element_size is 0.0 m"),
        ("\"0.3 mm\"", "«0»", "refined_radius is"),
        ("1.1", "«1»", "growth is 1.0"),
        ("penalty_factor = 1.0", "penalty_factor = «0»", "penalty_factor is 0.0"),
        ("0.9", "«0»", "step_factor is"),
        ("0.9", "«1.01»", "step_factor is"),
        ("2e-4", "«-1e-9»", "mass_scaling is"),
        ("2e-4", "«0.11»", "mass_scaling is"),
        ("200000", "«0»", "elements is"),
        ("200000", "«1.5»", "elements is"),
        ("1e12", "«1e30»", "element_updates is"),
        ("\"8 GB\"", "«0»", "memory is 0.0 bytes"),
    ] {
        fault(part, bad, message, "");
    }
    fault("\"22.2 mm\"", "«0»", "", "diameter must be greater than 0");
}

#[test]
fn implausible_numbers_cause_warnings() {
    let odd = |part: &str, replacement: &str| {
        assert!(VALID.contains(part), "{part}");
        parse(&VALID.replacen(part, replacement, 1)).unwrap().scene().implausible_numbers()
    };
    assert!(parse(VALID).unwrap().scene().implausible_numbers().is_empty());
    for (part, replacement, told) in [
        ("\"22.2 mm\"", "5", "diameter of striker is 5.000 m"),
        ("\"15.9 mm\"", "\"3 m\"", "that of the other body"),
        ("\"22.2 mm\"", "\"101 m\"", "diameter of striker is 101.0 m"),
        ("\"2390 kg/m^3\"", "2.39", "density of striker is 2.39"),
        ("\"2390 kg/m^3\"", "\"26 g/cm^3\"", "density of"),
        ("\"63 GPa\"", "63", "Young's modulus of striker is"),
    ] {
        let found = odd(part, replacement);
        assert!(found.iter().any(|text| text.contains(told)), "{replacement}: {found:?}");
    }
    // Rare values that are plausible.
    for (part, replacement) in
        [("\"22.2 mm\"", "1.5"), ("\"2390 kg/m^3\"", "11"), ("\"63 GPa\"", "\"1 kPa\"")]
    {
        assert_eq!(odd(part, replacement), [""; 0], "{replacement}");
    }
}
