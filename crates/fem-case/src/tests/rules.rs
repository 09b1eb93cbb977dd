//! Rules for values and between keys, added to a schema: ranges, exclusive shapes, and names of the library.
//!
//! [`crate::validate`] has the complete rules and takes precedence; a test applies both to a list of faulty cases.

use fem_laws::{KeyNeed, KeyRange, KeySet};
use serde_json::{Value, json};

use crate::library;
use crate::quantity::range::Range;
use crate::schema::model_tables::{LawKey, LawTable};

/// Keys of a definition, and their range ([`rule`]).
const RANGES: &[(&str, &[&str], Range)] = &[
    ("SceneTable", &["temperature"], Range::POSITIVE),
    (
        "MaterialTable",
        &["density", "youngs_modulus", "shear_modulus", "bulk_modulus", "yield_strength"],
        Range::POSITIVE,
    ),
    ("MaterialTable", &["surface_energy"], Range::SURFACE_ENERGY),
    ("MaterialTable", &["poissons_ratio"], Range::POISSONS_RATIO),
    ("TermTable", &["decay_rate", "relaxation_time"], Range::POSITIVE),
    ("TermTable", &["weight"], Range::SHARE),
    (
        "RelaxationTable",
        &["reference_temperature", "youngs_modulus", "shear_modulus"],
        Range::POSITIVE,
    ),
    ("BandTable", &["from", "to"], Range::POSITIVE),
    ("ArrheniusTable", &["activation_temperature"], Range::NOT_NEGATIVE),
    ("FlowTable", &["yield_strength"], Range::POSITIVE),
    ("HardeningTable", &["modulus"], Range::NOT_NEGATIVE),
    ("SwiftTable", &["strain"], Range::POSITIVE),
    ("SwiftTable", &["exponent"], Range::HARDENING_EXPONENT),
    ("JohnsonCookTable", &["c"], Range::NOT_NEGATIVE),
    ("JohnsonCookTable", &["reference_rate"], Range::POSITIVE),
    ("SphereTable", &["diameter", "mass"], Range::POSITIVE),
    ("PlateTable", &["thickness", "diameter"], Range::POSITIVE),
    ("GravityTable", &["acceleration"], Range::POSITIVE),
    ("MeshTable", &["contact_element_size", "refined_radius", "far_radius"], Range::POSITIVE),
    ("MeshTable", &["growth"], Range::GROWTH),
    ("ContactTable", &["penalty_factor"], Range::POSITIVE),
    ("ContactTable", &["work_of_adhesion"], Range::WORK_OF_ADHESION),
    ("ContactTable", &["friction"], Range::NOT_NEGATIVE),
    ("TimeTable", &["step_factor"], Range::STEP_FACTOR),
    ("TimeTable", &["mass_scaling"], Range::MASS_SCALING),
    ("StopTable", &["bounces"], Range::BOUNCES),
    ("StartTable", &["gap"], Range::NOT_NEGATIVE),
    ("CondensedTable", &["vibration_modes"], Range::VIBRATION_MODES),
    ("CondensedTable", &["steps"], Range::CONDENSED_STEPS),
    (
        "ToleranceTable",
        &["restitution", "contact_time", "peak_force", "peak_pressure"],
        Range::TOLERANCE,
    ),
];

const MODULI: [&str; 4] = ["youngs_modulus", "shear_modulus", "bulk_modulus", "poissons_ratio"];
const SHAPES: [&str; 4] = ["sphere", "wall", "half_space", "plate"];

/// Adds the rules to the schema of cases; `laws` are the names of laws.
pub(crate) fn add_to(schema: &mut Value, laws: &[&str]) {
    for (table, keys, range) in RANGES {
        for key in *keys {
            add(schema, &format!("/definitions/{table}/properties/{key}"), [rule(*range)]);
        }
    }
    add(schema, "/definitions/MaterialTable", [two_of(&MODULI)]);
    let needs_material = json!({
        "if": { "required": ["wall"] },
        "then": { "not": { "required": ["material"] } },
        "else": { "required": ["material"] },
    });
    add(schema, "/definitions/BodyTable", [one_of(&SHAPES), needs_material]);
    let names: Vec<String> = library::names();
    let others = library::materials().values().flat_map(|entry| &entry.names);
    let others = others.map(|name| format!("{}{name}", library::PREFIX));
    let of_library = json!({
        "if": { "pattern": "^lib:" },
        "then": { "enum": names.iter().cloned().chain(others).collect::<Vec<_>>() },
        "examples": names,
    });
    add(schema, "/definitions/BodyTable/properties/material", [of_library]);
    add(schema, "/definitions/TermTable", [one_of(&["decay_rate", "relaxation_time"])]);
    let of_file = json!({
        "if": { "required": ["file"] },
        "then": { "maxProperties": 1 },
        "else": { "required": ["acts_on", "terms"] },
    });
    add(schema, "/definitions/RelaxationTable", [of_file]);
    for choice in ["ModelTable", "HardeningTable", "ShiftTable"] {
        let rule = json!({ "minProperties": 1, "maxProperties": 1 });
        add(schema, &format!("/definitions/{choice}"), [rule]);
    }
    add(schema, "/definitions/LawTable", [one_of(laws)]);
    add_laws(schema);
}

/// Adds the ranges of the laws' keys, and which of them must be given.
fn add_laws(schema: &mut Value) {
    for &LawKey { table, key, range, .. } in LawTable::KEYS {
        if range != KeyRange::NotNegative {
            let pointer = format!("/definitions/{table}/properties/{key}");
            add(schema, &pointer, [rule(Range::from(range))]);
        }
    }
    let mut tables: Vec<_> = LawTable::KEYS.iter().map(|key| (key.table, key.family)).collect();
    tables.dedup();
    for (table, family) in tables {
        let required = |set: &KeySet| {
            let keys = set.iter().filter(|(_, need)| *need == KeyNeed::Required);
            keys.map(|(key, _)| *key).collect::<Vec<_>>()
        };
        let sets = family.key_sets();
        let rule = match sets {
            [set] => json!({ "required": required(set) }),
            // Without keys the materials give the values.
            _ if sets.iter().any(|set| set.is_empty()) => continue,
            _ if sets.iter().all(|set| set.len() == 1) => {
                one_of(&sets.iter().flat_map(required).collect::<Vec<_>>())
            }
            _ => {
                let alone = sets.iter().map(|set| {
                    let is_own = |key: &str| set.iter().any(|(own, _)| *own == key);
                    let others = sets.iter().copied().flatten().filter(|(key, _)| !is_own(key));
                    let others: Vec<_> =
                        others.map(|(key, _)| json!({ "required": [key] })).collect();
                    json!({ "required": required(set), "not": { "anyOf": others } })
                });
                json!({ "oneOf": alone.collect::<Vec<_>>() })
            }
        };
        add(schema, &format!("/definitions/{table}"), [rule]);
    }
}

/// Returns the rule for a bare number in a range. A string for a number greater than 0 must not begin with a minus.
fn rule(range: Range) -> Value {
    if range == Range::POSITIVE {
        return json!({ "exclusiveMinimum": 0, "pattern": "^\\s*[^-−\\s]" });
    }
    let low = if range.is_low_open { "exclusiveMinimum" } else { "minimum" };
    let high = if range.is_high_open { "exclusiveMaximum" } else { "maximum" };
    match range.high.is_finite() {
        true => json!({ low: range.low, high: range.high }),
        false => json!({ low: range.low }),
    }
}

/// Adds rules to a definition.
fn add<const N: usize>(schema: &mut Value, pointer: &str, rules: [Value; N]) {
    let Some(Value::Object(place)) = schema.pointer_mut(pointer) else { return };
    // Draft 7 ignores all other keys beside a reference.
    if let Some(reference) = place.remove("$ref") {
        place.insert("allOf".to_string(), json!([{ "$ref": reference }]));
    }
    let all = place.entry("allOf").or_insert_with(|| json!([]));
    if let Value::Array(all) = all {
        all.extend(rules);
    }
}

/// Returns the rule that requires exactly one of these keys.
fn one_of(keys: &[&str]) -> Value {
    json!({ "oneOf": keys.iter().map(|key| json!({ "required": [key] })).collect::<Vec<_>>() })
}

/// Returns the rule that requires exactly two of these keys.
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
