//! Every class of fault of a case file: the key that it is found at.

use std::path::Path;

use fem_case::Case;
use fem_case::schema::*;

use super::pair::{Change, glass, made, mesh, parsed, relaxation, snapshots, sphere};

/// Every class of fault that a case file can have: a change of the pair, the key that it is found
/// at, a part of the message.
const FAULTS: &[(Change, &str, &str)] = &[
    // Units.
    (
        |file| sphere(file).diameter = "22.2 kg".into(),
        "body.0.sphere.diameter",
        "\"22.2 kg\" is a mass; diameter must be a length",
    ),
    (
        |file| glass(file).youngs_modulus = Some("63 Gpa".into()),
        "material.glass.youngs_modulus",
        "unknown unit `Gpa`",
    ),
    (
        |file| file.body[0].approach_speed = Some("".into()),
        "body.0.approach_speed",
        "does not begin with a number",
    ),
    // Not finite.
    (
        |file| sphere(file).diameter = f64::NAN.into(),
        "body.0.sphere.diameter",
        "diameter is NaN m, which is not finite",
    ),
    (
        |file| relaxation(file).terms[1].relaxation_time = Some(f64::INFINITY.into()),
        "material.glass.relaxation.terms.1.relaxation_time",
        "not finite",
    ),
    (|file| mesh(file).growth = Some(f64::NEG_INFINITY.into()), "mesh.growth", "not finite"),
    (
        |file| {
            file.output.get_or_insert_default().snapshots = Some(SnapshotsValue::Count(f64::NAN))
        },
        "output.snapshots",
        "not finite",
    ),
    // Out of range.
    (|file| sphere(file).diameter = 0.0.into(), "body.0.sphere.diameter", "diameter is 0.0 m"),
    (|file| glass(file).density = (-1.0).into(), "material.glass.density", "must be positive"),
    (
        |file| glass(file).poissons_ratio = Some(0.5.into()),
        "material.glass.poissons_ratio",
        "must lie",
    ),
    (|file| mesh(file).contact_element_size = Some(0.0.into()), "mesh.contact_element_size", "is"),
    (
        |file| file.time.get_or_insert_default().step_factor = Some(1.01.into()),
        "time.step_factor",
        "step_factor is",
    ),
    (
        |file| file.limits.get_or_insert_default().elements = Some(1.5.into()),
        "limits.elements",
        "elements is",
    ),
    (
        |file| file.start.get_or_insert_default().gap = Some("-1 nm".into()),
        "start.gap",
        "gap is \"-1 nm\"",
    ),
    (
        |file| file.contact.get_or_insert_default().penalty_factor = Some(0.0.into()),
        "contact.penalty_factor",
        "penalty_factor is 0.0",
    ),
    // Moduli and relaxation.
    (|file| glass(file).youngs_modulus = None, "material.glass", "exactly two of"),
    (
        |file| {
            *glass(file) = MaterialTable { poissons_ratio: None, ..glass(file).clone() };
            glass(file).bulk_modulus = Some(1e9.into());
        },
        "material.glass.bulk_modulus",
        "implies poissons_ratio",
    ),
    (
        |file| relaxation(file).terms[0].relaxation_time = Some(1.0.into()),
        "material.glass.relaxation.terms.0.relaxation_time",
        "both decay_rate and",
    ),
    (
        |file| relaxation(file).terms[0].decay_rate = None,
        "material.glass.relaxation.terms.0",
        "neither decay_rate nor",
    ),
    (|file| relaxation(file).terms.clear(), "material.glass.relaxation.terms", "at least one term"),
    // Bodies.
    (|file| file.body.clear(), "body", "no [[body]]"),
    (|file| drop(file.body.pop()), "body", "only one [[body]]"),
    (|file| file.body.push(BodyTable::wall("c")), "body.2", "the case has 3 [[body]]"),
    (|file| file.body[1].name = "striker".into(), "body.1.name", "both bodies have the name"),
    (|file| file.body[1].name = String::new(), "body.1.name", "not a body's name"),
    (|file| file.body[0].name = "the striker".into(), "body.0.name", "not a body's name"),
    (
        |file| file.body = vec![BodyTable::wall("a"), BodyTable::wall("b")],
        "body.1.wall",
        "both bodies are walls",
    ),
    (
        |file| {
            let blocks = ["a", "b"].map(|name| BodyTable::half_space(name, "glass"));
            file.body = blocks.to_vec();
        },
        "body.1.half_space",
        "both bodies are half-spaces",
    ),
    (|file| file.body[1].wall = Some(EmptyTable {}), "body.1.wall", "both sphere and wall"),
    (|file| file.body[1].sphere = None, "body.1", "neither sphere, wall nor half_space"),
    (|file| file.body[1].material = None, "body.1", "the key `material` is missing"),
    (|file| file.body[1].material = Some("ice".into()), "body.1.material", "no material \"ice\""),
    (
        |file| file.body[1] = BodyTable::wall("w").approaching(-0.1),
        "body.1.approach_speed",
        "approach_speed is",
    ),
    (
        |file| file.body[0].approach_speed = Some(0.0.into()),
        "body.0.approach_speed",
        "receding or at rest",
    ),
    (|file| sphere(file).mesh = Some(String::new()), "body.0.sphere.mesh", "an empty path"),
    // Snapshots.
    (|file| snapshots(file, &["maximum", "maximun"]), "output.snapshots.1", "not the label"),
    (
        |file| file.output.get_or_insert_default().snapshots = Some(SnapshotsValue::Count(1.5)),
        "output.snapshots",
        "snapshots is 1.5",
    ),
    // Models.
    (|file| file.model = Some(ModelTable::default()), "model", "names no model"),
    (
        |file| file.model.get_or_insert_default().ting = Some(TingTable::default()),
        "model.ting",
        "the keys fem and ting",
    ),
    (
        |file| {
            let tolerance = Some(ToleranceValue::Share("2".into()));
            file.accuracy = Some(AccuracyTable { tolerance });
        },
        "accuracy.tolerance",
        "tolerance is \"2\"",
    ),
    (
        |file| file.model = Some(ModelTable::law(LawTable::default())),
        "model.law",
        "model.law names no law",
    ),
    (
        |file| file.model = Some(ModelTable::law(TsujiTable::default())),
        "model.law.tsuji",
        "the key `e` is missing",
    ),
    (
        |file| {
            let (e, alpha) = (Some(0.9.into()), Some(0.1.into()));
            file.model = Some(ModelTable::law(TsujiTable { e, alpha, ..Default::default() }));
        },
        "model.law.tsuji.alpha",
        "both e and alpha are given",
    ),
    (
        |file| {
            let (k, contact_time) = (Some(1e7.into()), Some("60 us".into()));
            let linear = LinearTable { k, contact_time, ..Default::default() };
            file.model = Some(ModelTable::law(linear));
        },
        "model.law.linear.contact_time",
        "both k and contact_time are given",
    ),
    (
        |file| {
            let steps = Some("many".into());
            file.model = Some(CondensedTable { steps, ..Default::default() }.into());
        },
        "model.condensed.steps",
        "does not begin with a number",
    ),
];

/// Faults of several keys that contradict each other: the change, the key that is found in a case
/// that is made so, the key that is found in an edit, which is to blame, a part of the message.
const CONTRADICTIONS: &[(Change, &str, &str, &str)] = &[
    (
        |file| glass(file).shear_modulus = Some(1e9.into()),
        "material.glass.poissons_ratio",
        "material.glass.shear_modulus",
        "exactly two of",
    ),
    (
        |file| relaxation(file).terms.push(TermTable::with_decay_rate(0.5, 1.0)),
        "material.glass.relaxation.terms",
        "material.glass.relaxation.terms.2.weight",
        "at most 1",
    ),
    (
        |file| file.body[0].name = "target".into(),
        "body.1.name",
        "body.0.name",
        "both bodies have the name",
    ),
    (
        |file| file.body[1] = BodyTable { material: Some("glass".into()), ..BodyTable::wall("w") },
        "body.1.material",
        "body.1.wall",
        "a wall has no material",
    ),
    (
        |file| snapshots(file, &["maximum", "maximum"]),
        "output.snapshots.1",
        "output.snapshots.0",
        "listed twice",
    ),
    (
        |file| snapshots(file, &["1 us", "maximum"]),
        "output.snapshots.1",
        "output.snapshots.0",
        "mixes",
    ),
    (
        |file| snapshots(file, &["mid-compression", "1 us"]),
        "output.snapshots.1",
        "output.snapshots.1",
        "mixes",
    ),
    (
        |file| file.model = Some(ModelTable { fem: Some(EmptyTable {}), ..ModelTable::ting() }),
        "model.ting",
        "model.ting",
        "the keys fem and ting",
    ),
];

#[test]
fn faults_of_code_name_their_key() {
    let pair = parsed(&[]);
    let same = FAULTS.iter().map(|(change, key, message)| (change, key, key, message));
    let others =
        CONTRADICTIONS.iter().map(|(change, made, edited, part)| (change, made, edited, part));
    for (change, in_made, in_edited, message) in same.chain(others) {
        let mut file = made();
        change(&mut file);
        for (found, key) in [(Case::of(file), *in_made), (pair.edited(change), *in_edited)] {
            let error = found.map(|_| ()).expect_err(key);
            assert_eq!((error.key(), error.source_name()), (Some(key), key), "{error}");
            assert_eq!((error.line(), error.column(), error.span()), (None, None, None));
            assert!(error.message().contains(message), "{error}");
            assert!(error.to_string().starts_with(&format!("{key}: {}", error.message())));
        }
    }
}

/// The same wrong case has the same fault at the same key, in code and in a text of it.
#[test]
fn faults_of_code_are_those_of_text() {
    let contradictions = CONTRADICTIONS.iter().map(|(change, key, ..)| (change, key));
    for (change, key) in FAULTS.iter().map(|(change, key, _)| (change, key)).chain(contradictions) {
        let mut file = made();
        change(&mut file);
        let text = file.to_toml().unwrap();
        let error = Case::parse("x.toml", &text, Path::new("."), &[]).unwrap_err();
        assert_eq!(error.key(), Some(*key), "{error}");
        assert!(error.line().is_some());
    }
}

#[test]
fn a_quoted_name_is_one_part_of_a_key() {
    let bad = MaterialTable::from_bulk_shear(-1.0, 1.0, 1.0);
    let error = Case::of(made().with_material("my \"glass\" 1.5", bad)).unwrap_err();
    assert_eq!(error.key(), Some(r#"material."my \"glass\" 1.5".density"#));
}
