//! The schema of cases in a validator that others wrote, beside the program itself.

use std::path::Path;

use serde_json::{Value, json};

use crate::common::Place;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn validator() -> jsonschema::Validator {
    let ran = Place::new().succeed(&["schema", "case"]);
    let schema: Value = serde_json::from_str(&ran.stdout).unwrap();
    jsonschema::draft7::new(&schema).unwrap()
}

fn read(path: &Path) -> Value {
    toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn glass() -> Value {
    read(&root().join("cases/glass_0.5ms.toml"))
}

/// The glass pair with one value in another place, or without it.
fn with(pointer: &str, value: Option<Value>) -> Value {
    let mut case = glass();
    let (table, key) = pointer.rsplit_once('/').unwrap();
    let mut at = &mut case;
    for part in table.split('/').filter(|part| !part.is_empty()) {
        at = match at {
            Value::Array(items) => &mut items[part.parse::<usize>().unwrap()],
            table => {
                let keys = table.as_object_mut().unwrap();
                keys.entry(part.to_string()).or_insert_with(|| json!({}))
            }
        };
    }
    let table = at.as_object_mut().unwrap();
    match value {
        Some(value) => table.insert(key.to_string(), value),
        None => table.remove(key),
    };
    case
}

/// What the program says of it: 0 or 2.
fn status(place: &Place, case: &Value) -> Option<i32> {
    place.write("tried.toml", &toml::to_string(case).unwrap());
    place.run(&["check", "tried.toml"]).code
}

#[test]
fn every_case_of_the_repository_is_taken() {
    let (validator, mut n) = (validator(), 0);
    for file in std::fs::read_dir(root().join("cases")).unwrap() {
        let case = read(&file.unwrap().path());
        if case.get("body").is_none() {
            continue;
        }
        n += 1;
        let faults: Vec<_> = validator.iter_errors(&case).map(|fault| fault.to_string()).collect();
        assert_eq!(faults, Vec::<String>::new(), "{case}");
    }
    assert!(n > 10, "{n}");
}

/// Each is one step from a good case, and program and schema both refuse it.
#[test]
fn what_the_program_refuses_the_schema_refuses() {
    let (validator, place) = (validator(), Place::new());
    let glass = "/material/glass";
    let faults = [
        ("/titel".into(), Some(json!("x"))),
        ("/body".into(), None),
        ("/body/0/name".into(), None),
        ("/body/0/sphere".into(), None),
        ("/body/0/wall".into(), Some(json!({}))),
        ("/body/0/material".into(), None),
        ("/body/0/material".into(), Some(json!("lib:stel"))),
        ("/body/0/sphere/diameter".into(), Some(json!("22.2 s"))),
        ("/body/0/sphere/diameter".into(), Some(json!("22.2 mmm"))),
        ("/body/0/sphere/diameter".into(), Some(json!("22,2 mm"))),
        ("/body/0/sphere/diameter".into(), Some(json!("-22.2 mm"))),
        ("/body/0/sphere/diameter".into(), Some(json!(-1))),
        ("/body/0/sphere/diameter".into(), Some(json!("22.2 m/s"))),
        ("/body/0/sphere/radius".into(), Some(json!(1))),
        ("/body/0/approach_speed".into(), Some(json!("0.5 m"))),
        ("/body/0/approach_speed".into(), Some(json!("1e-3 kg/s"))),
        ("/body/0/held".into(), Some(json!("yes"))),
        (format!("{glass}/density"), None),
        (format!("{glass}/density"), Some(json!("2390 kg/m^2"))),
        (format!("{glass}/density"), Some(json!(0))),
        (format!("{glass}/youngs_modulus"), Some(json!("63 gigapascal"))),
        (format!("{glass}/youngs_modulus"), Some(json!("63 N/m"))),
        (format!("{glass}/shear_modulus"), Some(json!("25 GPa"))),
        (format!("{glass}/poissons_ratio"), None),
        (format!("{glass}/poissons_ratio"), Some(json!(0.5))),
        (format!("{glass}/relaxation/terms/0/relaxation_time"), Some(json!("1 s"))),
        (format!("{glass}/relaxation/terms/0/decay_rate"), Some(json!("2708 s"))),
        (format!("{glass}/relaxation/terms/0/weight"), Some(json!(1.5))),
        (format!("{glass}/relaxation/acts_on"), Some(json!("bulk"))),
        ("/model".into(), Some(json!({ "ting": {}, "hertz": {} }))),
        ("/model".into(), Some(json!({}))),
        ("/model".into(), Some(json!("tinge"))),
        ("/model/law".into(), Some(json!({ "end": "zero_force" }))),
        ("/model/law/tsuji".into(), Some(json!({ "e": 0.9, "alpha": 0.1 }))),
        ("/model/law/tsuji".into(), Some(json!({ "e": 1.1 }))),
        ("/model/law/falcon".into(), Some(json!({}))),
        ("/model/law/linear".into(), Some(json!({ "k": 1e7, "e": 0.9 }))),
        ("/time/step_factor".into(), Some(json!(1.5))),
        ("/mesh/growth".into(), Some(json!(1))),
        ("/stop/bounces".into(), Some(json!(0))),
        ("/accuracy/tolerance/peak_force".into(), Some(json!(0.9))),
        ("/output/snapshots".into(), Some(json!(["middle"]))),
        ("/effects/gravity".into(), Some(json!("on"))),
    ];
    for (pointer, value) in faults {
        let case = with(&pointer, value.clone());
        assert!(!validator.is_valid(&case), "the schema takes {pointer} = {value:?}");
        assert_eq!(status(&place, &case), Some(2), "the program takes {pointer} = {value:?}");
    }
}

/// Every way to write a unit that the program reads.
#[test]
fn what_the_program_reads_the_schema_takes() {
    let (validator, place) = (validator(), Place::new());
    let taken = [
        (
            "/body/0/sphere/diameter",
            &["22.2 mm", "22.2mm", "14 µm", "1 in", "0.1 ft", "2e-2 m"][..],
        ),
        (
            "/body/0/approach_speed",
            &["50 cm/s", "1.8 km/h", "1 mph", "0.5 m s^-1", "0.5 m s⁻¹", "0.5 m·s-1"],
        ),
        (
            "/material/glass/density",
            &["2390 kg/m^3", "2.39 g/cm³", "2.39 g cm^-3", "2.39 kg/L", "2.39 t/m**3"],
        ),
        (
            "/material/glass/youngs_modulus",
            &["63 GPa", "63e9 N/m^2", "63 kN/mm²", "9e6 psi", "63e9 kg/(m s^2)"],
        ),
        (
            "/material/glass/relaxation/terms/0/decay_rate",
            &["2708 1/s", "2708 /s", "2.708 kHz", "2708 s^-1", "2.7 1/ms"],
        ),
        ("/material/glass/relaxation/terms/0/weight", &["50 %", "0.5"]),
        ("/limits/memory", &["8 GB", "8 GiB"]),
    ];
    for (pointer, texts) in taken {
        for text in texts {
            let case = with(pointer, Some(json!(text)));
            assert_eq!(status(&place, &case), Some(0), "the program refuses {pointer} = {text}");
            let faults: Vec<_> =
                validator.iter_errors(&case).map(|fault| fault.to_string()).collect();
            assert_eq!(faults, Vec::<String>::new(), "{pointer} = {text}");
        }
    }
}
