//! What keys ask of their values and of each other, added to a schema: ranges, shapes of which one is
//! wanted, names of the library.
//!
//! The reader has all of it in [`crate::validate`], which is right where the two differ; a test holds every
//! faulty case of a list against both.

use serde_json::{Value, json};

use crate::library;

/// Keys of a definition that are greater than 0 as a bare number, and begin with no minus as a string.
const POSITIVE: &[(&str, &[&str])] = &[
    (
        "MaterialTable",
        &["density", "youngs_modulus", "shear_modulus", "bulk_modulus", "yield_strength"],
    ),
    ("TermTable", &["decay_rate", "relaxation_time"]),
    ("SphereTable", &["diameter"]),
    ("GravityTable", &["acceleration"]),
    ("MeshTable", &["contact_element_size", "refined_radius", "far_radius"]),
    ("ContactTable", &["penalty_factor"]),
    ("LinearTable", &["k", "contact_time"]),
    ("PowerTable", &["k", "gamma"]),
    ("MishraMurtyTable", &["k"]),
    ("HuntCrossleyTable", &["v"]),
];

/// Keys of a definition and what a bare number of theirs is.
const RANGES: &[(&str, &str, &str, f64, &str, f64)] = &[
    ("MaterialTable", "poissons_ratio", "exclusiveMinimum", -1.0, "exclusiveMaximum", 0.5),
    ("TermTable", "weight", "minimum", 0.0, "maximum", 1.0),
    ("MeshTable", "growth", "exclusiveMinimum", 1.0, "maximum", f64::MAX),
    ("TimeTable", "step_factor", "exclusiveMinimum", 0.0, "maximum", 1.0),
    ("TimeTable", "mass_scaling", "minimum", 0.0, "maximum", 0.1),
    ("StopTable", "bounces", "minimum", 1.0, "maximum", 1e4),
    ("StartTable", "gap", "minimum", 0.0, "maximum", f64::MAX),
    ("CondensedTable", "vibration_modes", "minimum", 0.0, "maximum", 100.0),
    ("CondensedTable", "steps", "minimum", 50.0, "maximum", 1e5),
    ("LinearTable", "e", "exclusiveMinimum", 0.0, "maximum", 1.0),
    ("HuntCrossleyTable", "e", "exclusiveMinimum", 0.0, "maximum", 1.0),
    ("TsujiTable", "e", "exclusiveMinimum", 0.0, "maximum", 1.0),
    ("ZhangWhitenTable", "e", "exclusiveMinimum", 0.0, "maximum", 1.0),
    ("MorgadoOppenheimTable", "eta_2", "exclusiveMinimum", -1.0, "exclusiveMaximum", 1.0),
    ("ToleranceTable", "restitution", "exclusiveMinimum", 0.0, "maximum", 0.5),
    ("ToleranceTable", "contact_time", "exclusiveMinimum", 0.0, "maximum", 0.5),
    ("ToleranceTable", "peak_force", "exclusiveMinimum", 0.0, "maximum", 0.5),
    ("ToleranceTable", "peak_pressure", "exclusiveMinimum", 0.0, "maximum", 0.5),
];

const MODULI: [&str; 4] = ["youngs_modulus", "shear_modulus", "bulk_modulus", "poissons_ratio"];
const SHAPES: [&str; 3] = ["sphere", "wall", "half_space"];

/// Adds the rules to the schema of cases; `laws` are the names of laws.
pub(crate) fn add_to(schema: &mut Value, laws: &[&str]) {
    for (table, keys) in POSITIVE {
        for key in *keys {
            let above = json!({ "exclusiveMinimum": 0, "pattern": "^\\s*[^-−\\s]" });
            add(schema, &format!("/definitions/{table}/properties/{key}"), [above]);
        }
    }
    for (table, key, low, least, high, most) in RANGES {
        let range = match *most {
            f64::MAX => json!({ *low: least }),
            most => json!({ *low: least, *high: most }),
        };
        add(schema, &format!("/definitions/{table}/properties/{key}"), [range]);
    }
    add(schema, "/definitions/MaterialTable", [two_of(&MODULI)]);
    let needs_material = json!({
        "if": { "required": ["wall"] },
        "then": { "not": { "required": ["material"] } },
        "else": { "required": ["material"] },
    });
    add(schema, "/definitions/BodyTable", [one_of(&SHAPES), needs_material]);
    let names: Vec<String> = library::names();
    let of_library = json!({
        "if": { "pattern": "^lib:" },
        "then": { "enum": names },
        "examples": names,
    });
    add(schema, "/definitions/BodyTable/properties/material", [of_library]);
    add(schema, "/definitions/TermTable", [one_of(&["decay_rate", "relaxation_time"])]);
    add(schema, "/definitions/ModelTable", [json!({ "minProperties": 1, "maxProperties": 1 })]);
    add(schema, "/definitions/LawTable", [one_of(laws)]);
    for (law, keys) in [
        ("Falcon", &["c"][..]),
        ("MishraMurty", &["k", "c"]),
        ("HuntCrossley", &["e"]),
        ("Power", &["k", "gamma"]),
        ("MorgadoOppenheim", &["eta_1", "eta_2"]),
        ("BordbarHyppanen", &["a", "n"]),
    ] {
        add(schema, &format!("/definitions/{law}Table"), [json!({ "required": keys })]);
    }
    for law in ["Tsuji", "ZhangWhiten"] {
        add(schema, &format!("/definitions/{law}Table"), [one_of(&["e", "alpha"])]);
    }
    let without =
        |keys: [&str; 2]| json!({ "anyOf": keys.map(|key| json!({ "required": [key] })) });
    let linear = json!({ "oneOf": [
        { "required": ["k"], "not": without(["e", "contact_time"]) },
        { "required": ["e", "contact_time"], "not": without(["k", "c"]) },
    ] });
    add(schema, "/definitions/LinearTable", [linear]);
}

/// Puts rules beside what a place says already.
fn add<const N: usize>(schema: &mut Value, pointer: &str, rules: [Value; N]) {
    let Some(Value::Object(place)) = schema.pointer_mut(pointer) else { return };
    // Beside a reference draft 7 reads nothing else.
    if let Some(reference) = place.remove("$ref") {
        place.insert("allOf".to_string(), json!([{ "$ref": reference }]));
    }
    let all = place.entry("allOf").or_insert_with(|| json!([]));
    if let Value::Array(all) = all {
        all.extend(rules);
    }
}

/// Exactly one of some keys.
fn one_of(keys: &[&str]) -> Value {
    json!({ "oneOf": keys.iter().map(|key| json!({ "required": [key] })).collect::<Vec<_>>() })
}

/// Exactly two of some keys.
fn two_of(keys: &[&str]) -> Value {
    let mut pairs = Vec::new();
    for (k, first) in keys.iter().enumerate() {
        for second in &keys[k + 1..] {
            let others = keys.iter().filter(|key| *key != first && *key != second);
            let others: Vec<_> = others.map(|key| json!({ "required": [key] })).collect();
            pairs.push(json!({ "required": [first, second], "not": { "anyOf": others } }));
        }
    }
    json!({ "oneOf": pairs })
}
