//! Faults of bodies and probes, and implausible numbers.

use fem_case::Probe;

use super::message_table::{VALID, error_at_mark, parse};

#[test]
fn an_unused_material_is_checked_too() {
    let unused =
        "[material.\"ice (unused)\"]\ndensity = 1\nyoungs_modulus = 1\npoissons_ratio = 0\n";
    parse(&format!("{VALID}{unused}")).unwrap();
    let error = error_at_mark(&format!("{VALID}{}", unused.replace("= 0", "= «0.6»")));
    assert!(error.message().contains("poissons_ratio"), "{error}");
}

const GLASS: &str = "[material.glass]\ndensity = 1\nyoungs_modulus = 1\npoissons_ratio = 0\n";
const STRIKER: &str = "[[body]]\nname = \"striker\"\nsphere = { diameter = 1 }\nmaterial = \"glass\"\n\
                       approach_speed = 1\n";
const TARGET: &str = "[[body]]\nname = \"target\"\nwall = {}\n";

/// Every fault of the bodies: a part of the case, its replacement, and the message.
#[test]
fn faults_of_bodies_have_their_message_and_position() {
    let case = format!("{GLASS}{STRIKER}{TARGET}");
    parse(&case).unwrap();
    for (part, replacement, message) in [
        (STRIKER, "", "only one [[body]]"),
        (
            "wall = {}\n",
            "wall = {}\n«[[body]]»\nname = \"c\"\nwall = {}\n",
            "the case has 3 [[body]]",
        ),
        ("speed = 1", "speed = «0»", "the bodies do not approach"),
        ("speed = 1", "speed = «-1»", "the bodies do not approach"),
        ("approach_speed = 1\n[[body]]", "«[[body]]»", "the bodies do not approach"),
        (
            "wall = {}",
            "sphere.diameter = 1\nmaterial = 'glass'\napproach_speed = «-1.0»",
            "add up to 0.0",
        ),
        ("wall = {}", "wall = {}\napproach_speed = «-0.5»", "approach_speed is"),
        ("wall = {}", "wall = {}\nmaterial = «'glass'»", "has no material"),
        ("wall = {}", "wall = «{}»\nsphere.diameter = 1", "more than one shape: sphere and wall"),
        ("wall = {}", "wall = {}\nhalf_space = «{}»", "more than one shape: wall and half_space"),
        (TARGET, "«[[body]]»\nname = \"target\"\nhalf_space = {}", "the key `material` is missing"),
        (
            "wall = {}",
            "half_space = {}\nmaterial = 'glass'\napproach_speed = «-0.5»",
            "approach_speed is -0.5",
        ),
        (TARGET, "«[[body]]»\nname = \"target\"", "neither sphere, wall, half_space nor plate"),
        ("wall = {}", "plate = «{}»\nmaterial = 'glass'", "the key `thickness` is missing"),
        ("wall = {}", "plate = { thickness = «0» }\nmaterial = 'glass'", "thickness is 0"),
        (
            "wall = {}",
            "plate = { thickness = 1, diameter = «-1» }\nmaterial = 'glass'",
            "diameter is -1",
        ),
        (
            "wall = {}",
            "plate = { thickness = 1, support = «'glued'» }\nmaterial = 'glass'",
            "glued",
        ),
        (
            "wall = {}",
            "wall = {}\nplate = «{ thickness = 1 }»",
            "more than one shape: wall and plate",
        ),
        (
            TARGET,
            "«[[body]]»\nname = \"target\"\nplate = { thickness = 1 }",
            "the key `material` is missing",
        ),
        (
            "sphere = { diameter = 1 }",
            "plate = { thickness = 1 }",
            "one body is a plate and the other a wall",
        ),
        ("sphere = { diameter = 1 }\nmaterial = \"glass\"", "wall = {}", "both bodies are walls"),
        (
            "sphere = { diameter = 1 }",
            "half_space = {}",
            "one body is a half-space and the other a wall",
        ),
        ("\"target\"", "«\"striker\"»", "both bodies have the name"),
        ("\"target\"", "«\"the target\"»", "not a valid body name"),
        ("\"target\"", "«\"\"»", "not a valid body name"),
        ("\"target\"", "«'Kügel'»", "not a valid body name"),
        (GLASS, "", "no material \"glass\""),
        ("diameter = 1", "diameter = 1, mesh = «''»", "mesh is an empty path"),
    ] {
        assert!(case.contains(part), "{part}");
        let mut text = case.replacen(part, replacement, 1);
        // Where the fault is in the other body.
        if !text.contains('«') {
            text = match message {
                "only one [[body]]" => text.replacen("[[body]]", "«[[body]]»", 1),
                "no material \"glass\"" => text.replacen("\"glass\"", "«\"glass\"»", 1),
                _ => text.replacen("\"target\"\nwall = {}", "\"target\"\nwall = «{}»", 1),
            };
        }
        let error = error_at_mark(&text);
        assert!(error.message().contains(message), "{error}");
    }
    for text in [format!("«»{GLASS}"), "«»".to_string()] {
        assert!(error_at_mark(&text).message().contains("no [[body]]"));
    }
    let half_spaces = "[[body]]\nname = 'a'\nhalf_space = {}\nmaterial = 'glass'\n\
                       [[body]]\nname = 'b'\nhalf_space = «{}»\nmaterial = 'glass'";
    let error = error_at_mark(&format!("{GLASS}{half_spaces}"));
    assert!(error.message().contains("both bodies are half-spaces"), "{error}");
    // A moving wall, and a body that recedes more slowly than the other follows, are valid.
    let moving = case.replace("wall = {}", "wall = {}\napproach_speed = 2");
    parse(&moving.replace("speed = 1", "speed = -1")).unwrap();
}

#[test]
fn faults_of_probes_have_their_message_and_help() {
    let with = |probe: &str| format!("{VALID}[[output.probe]]\n{probe}");
    let is = |probe: &str, message: &str, help: &str| {
        let error = error_at_mark(&with(probe));
        assert!(error.message().contains(message), "{error}");
        assert!(error.help().is_some_and(|found| found.contains(help)), "{error:?}");
    };
    let at = |r: &str, y: &str| format!("body = \"target\"\nr = {r}\ny = {y}\n");
    let case = parse(&with(&at("\"1 mm\"", "2e-3"))).unwrap();
    let probe = Probe { body: 1, r: 1e-3, y: 2e-3 };
    assert_eq!(case.scene().probes(), [probe]);
    is(&at("«-1e-3»", "2e-3"), "r is -0.001 m", "0 or greater");
    is(&at("«\"1 s\"»", "2e-3"), "r", "");
    is(&at("0", "«-1e-3»"), "outside of \"target\"", "upper body, y >= 0");
    is("body = \"striker\"\nr = 0\ny = «1e-3»\n", "outside of \"striker\"", "lower body, y <= 0");
    is(&at("«\"5 mm\"»", "\"1 mm\""), "outside of \"target\"", "a radius of");
    is("body = «\"taget\"»\nr = 0\ny = 0\n", "no body \"taget\"", "did you mean `target`");
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
