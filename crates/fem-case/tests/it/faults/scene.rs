//! Faults of materials, bodies, models, snapshots and probes.

use fem_case::Probe;

use super::marked::{VALID, error_at_mark, fault, parse};

#[test]
fn moduli() {
    fault(
        "poissons_ratio = 0.244",
        "shear_modulus = 1e9\npoissons_ratio = «0.244»",
        "exactly two of youngs_modulus, shear_modulus, bulk_modulus, poissons_ratio",
        "",
    );
    fault(
        "[material.glass]\ndensity = \"2390 kg/m^3\"\nyoungs_modulus = \"63 GPa\"",
        "«[material.glass]»\ndensity = \"2390 kg/m^3\"",
        "exactly two",
        "",
    );
    fault("poissons_ratio = 0.244", "shear_modulus = «1e9»", "implies poissons_ratio", "");
    fault("poissons_ratio = 0.244", "bulk_modulus = «1e9»", "implies poissons_ratio", "");
}

#[test]
fn relaxation() {
    fault("decay_rate", "relaxation_time = «1», decay_rate", "both decay_rate and", "keep one");
    fault(
        "{ weight = 0.5, decay_rate = \"2708 1/s\" }",
        "«{ weight = 0.5 }»",
        "neither decay_rate nor",
        "decay_rate = \"2708 1/s\"",
    );
    fault(
        "[{ weight = 0.5, decay_rate = \"2708 1/s\" }, { weight = 0.25, relaxation_time = 1e-3 }]",
        "«[]»",
        "at least one term",
        "",
    );
    fault(
        "[{ weight = 0.5, decay_rate = \"2708 1/s\" }, { weight = 0.25, relaxation_time = 1e-3 }]",
        "«[{ weight = 0.8, decay_rate = 1 }, { weight = 0.3, decay_rate = 2 }]»",
        "at most 1",
        "",
    );
    fault("\"2708 1/s\"", "«1e-320»", "relaxation_time must be positive and finite", "");
}

#[test]
fn materials() {
    fault(
        "material = \"glass\"",
        "material = «\"glas\"»",
        "no material \"glas\"",
        "did you mean `glass`? the case has glass",
    );
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
fn bodies() {
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
        ("wall = {}", "wall = «{}»\nsphere.diameter = 1", "both sphere and wall"),
        ("wall = {}", "wall = {}\nhalf_space = «{}»", "both wall and half_space"),
        (TARGET, "«[[body]]»\nname = \"target\"\nhalf_space = {}", "the key `material` is missing"),
        (
            "wall = {}",
            "half_space = {}\nmaterial = 'glass'\napproach_speed = «-0.5»",
            "approach_speed is -0.5",
        ),
        (TARGET, "«[[body]]»\nname = \"target\"", "neither sphere, wall nor half_space"),
        ("sphere = { diameter = 1 }\nmaterial = \"glass\"", "wall = {}", "both bodies are walls"),
        (
            "sphere = { diameter = 1 }",
            "half_space = {}",
            "one body is a wall and the other a half-space",
        ),
        ("\"target\"", "«\"striker\"»", "both bodies have the name"),
        ("\"target\"", "«\"the target\"»", "not a body's name"),
        ("\"target\"", "«\"\"»", "not a body's name"),
        ("\"target\"", "«'Kügel'»", "not a body's name"),
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
fn snapshots() {
    let list = "[\"mid-compression\", \"maximum\"]";
    fault(list, "[\"maximum\", «\"maximun\"»]", "not the label", "did you mean `maximum`?");
    fault(list, "[\"maximum\", «\"maximum\"»]", "twice", "");
    fault(list, "[\"maximum\", «1e-6»]", "mixes", "");
    fault(list, "[\"1 us\", «\"maximum\"»]", "mixes", "");
    fault(list, "[«\"1 um\"»]", "snapshots must be a time", "");
    fault(list, "[«-1e-6»]", "snapshots is -1e-6 s", "");
    fault(list, "[«[]»]", "snapshots.0 is an array", "");
    fault(list, "«0»", "snapshots is 0", "a whole number");
    fault(list, "«1.5»", "snapshots is 1.5", "a whole number");
}

#[test]
fn models() {
    fault("fem = {}", "auto = «3»", "auto is an integer", "");
    fault("fem = {}", "fem = {}\nting = «{}»", "the keys fem and ting", "keep exactly one");
    fault("[model]\nfem = {}", "«[model]»", "names no model", "fem = {}");
    fault("fem = {}", "condensed.steps = «\"many\"»", "does not begin with a number", "");
    fault("fem = {}", "law = «{}»", "model.law names no law", "kuwabara_kono");
    fault("fem = {}", "law.tsuji = «{}»", "the key `e` is missing", "write e");
    let two = "[model.law.tsuji]\ne = 0.9\nalpha = «0.1»";
    fault("[model]\nfem = {}", two, "both e and alpha are given", "");
    let two = "[model.law.linear]\nk = 1e7\ncontact_time = «\"60 us\"»";
    fault("[model]\nfem = {}", two, "both k and contact_time are given", "");
    let accuracy = "[accuracy]\ntolerance = «\"2\"»\n[model]\nfem = {}";
    fault("[model]\nfem = {}", accuracy, "tolerance is \"2\"", "at most 0.5");
}

#[test]
fn probes() {
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
