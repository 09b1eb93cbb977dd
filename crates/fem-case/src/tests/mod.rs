//! The shipped JSON schemas of case and sweep files, for editors that complete keys and mark errors, are those of the structs
//! that read the files.
//!
//! A schema knows keys, types, words, units, most ranges and which keys exclude each other. Rules
//! across the whole case, such as bodies that never meet, are checked only by the reader: a case that satisfies the schema
//! may still be rejected.

mod quantity_pattern;
mod rules;

use std::borrow::Cow;
use std::{env, fs};

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use self::quantity_pattern::{pattern, temperature_pattern};
use crate::quantity::{Number, Quantity, QuantityInfo, QuantityKind, Stress, Time};
use crate::schema::accuracy_table::{ToleranceTable, ToleranceValue};
use crate::schema::{
    CaseFile, FlowPoints, HardeningTable, LawTable, ModelTable, SnapshotLabel, SnapshotsValue,
};
use crate::sweep::file::SweepFile;

/// With `UPDATE=1` in the environment the test writes the files instead.
#[test]
fn shipped_schemas_are_current() {
    for (name, schema) in [("case", of_cases()), ("sweep", of_sweeps())] {
        let path = format!("{}/schemas/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = format!("{schema:#}\n");
        if env::var_os("UPDATE").is_some() {
            fs::write(&path, &text).unwrap();
        }
        let is_current = fs::read_to_string(&path).is_ok_and(|shipped| shipped == text);
        assert!(is_current, "cargo test -p fem-case --features schema with UPDATE=1 writes {path}");
    }
}

/// Returns the schema of a case file.
fn of_cases() -> Value {
    let mut schema = schema_of::<CaseFile>("A case of fem-run");
    rules::add_to(&mut schema, LawTable::NAMES);
    or_name(&mut schema, "/properties/model", ModelTable::NAMES);
    or_name(&mut schema, "/definitions/ModelTable/properties/law", LawTable::NAMES);
    or_name(&mut schema, "/definitions/FlowTable/properties/hardening", HardeningTable::NAMES);
    schema
}

/// Allows a name instead of a table.
fn or_name(schema: &mut Value, pointer: &str, names: &[&str]) {
    if let Some(place) = schema.pointer_mut(pointer) {
        *place = json!({ "anyOf": [{ "enum": names }, place.take()] });
    }
}

/// Returns the schema of a sweep file.
fn of_sweeps() -> Value {
    schema_of::<SweepFile>("A sweep of fem-run")
}

/// Returns the schema of a type in draft 7, which the TOML plugins of editors support.
fn schema_of<T: JsonSchema>(title: &str) -> Value {
    let settings = SchemaSettings::draft07().with_transform(WithoutNull);
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    schema.insert("title".to_string(), json!(title));
    schema.to_value()
}

/// Removes `null` from optional keys, since TOML has no null.
#[derive(Clone)]
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        let Some(keys) = schema.as_object_mut() else { return };
        // `format` names Rust's number types; a default means an absent key.
        keys.remove("format");
        keys.remove("default");
        if let Some(Value::Array(types)) = keys.get_mut("type") {
            types.retain(|name| name != "null");
            if let [one] = types.as_slice() {
                let one = one.clone();
                keys.insert("type".to_string(), one);
            }
        }
        if let Some(Value::Array(choices)) = keys.get_mut("anyOf") {
            choices.retain(|choice| choice.get("type") != Some(&json!("null")));
            // Draft 7 ignores a description beside a reference, so the reference goes into `allOf`.
            if let [Value::Object(_)] = choices.as_slice() {
                let one = keys.remove("anyOf");
                keys.insert("allOf".to_string(), one.unwrap_or_default());
            }
        }
    }
}

impl<K: QuantityKind> JsonSchema for Quantity<K> {
    /// Returns the name of the kind without its article: "length" for "a length".
    fn schema_name() -> Cow<'static, str> {
        let name = K::INFO.name;
        name.split_once(' ').map_or(name, |(_, noun)| noun).replace(' ', "_").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let QuantityInfo { name, si, example, .. } = K::INFO;
        let bare = match si {
            "" => format!("{name}, such as {example}"),
            si => format!("{name}: a number in {si}, or a string with its unit, {example}"),
        };
        let pattern = if si == "K" { temperature_pattern() } else { pattern(K::INFO.dimension.0) };
        let part = json!({ "type": ["number", "string"] });
        json_schema!({
            "description": bare,
            "anyOf": [
                { "type": "number" },
                { "type": "string", "pattern": pattern.clone() },
                {
                    "type": "object",
                    "description": "a value and its uncertainty",
                    "properties": { "value": part.clone(), "uncertainty": part },
                    "required": ["value", "uncertainty"],
                    "additionalProperties": false,
                },
            ],
        })
    }
}

impl JsonSchema for SnapshotsValue {
    fn schema_name() -> Cow<'static, str> {
        "Snapshots".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let label = generator.subschema_for::<SnapshotLabel>();
        let time = generator.subschema_for::<Quantity<Time>>();
        json_schema!({
            "anyOf": [
                { "type": "number", "description": "a number of snapshots, evenly over the contact" },
                { "type": "array", "items": { "anyOf": [label, time] } },
            ],
        })
    }
}

impl JsonSchema for ToleranceValue {
    fn schema_name() -> Cow<'static, str> {
        "Tolerance".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let share = generator.subschema_for::<Quantity<Number>>();
        let table = generator.subschema_for::<ToleranceTable>();
        json_schema!({ "anyOf": [share, table] })
    }
}

impl JsonSchema for FlowPoints {
    fn schema_name() -> Cow<'static, str> {
        "FlowPoints".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let strain = generator.subschema_for::<Quantity<Number>>();
        let stress = generator.subschema_for::<Quantity<Stress>>();
        json_schema!({
            "anyOf": [
                { "type": "string", "description": "path of a CSV file" },
                {
                    "type": "array",
                    "items": { "type": "array", "items": [strain, stress], "minItems": 2, "maxItems": 2 },
                },
            ],
        })
    }
}
