//! Faults of cases in code, which name their key.

use fem_case::Case;
use fem_case::schema::*;

use super::pair::{Change, glass, made, parsed, relaxation, snapshots, sphere};

/// Faults of single keys and tables, and of several keys that contradict each other: the change, the key of the fault in a
/// case that is made so, the key of the fault in an edit, and a part of the message. The tests of faults in texts compare
/// each of theirs with the same case in code.
const FAULTS: &[(Change, &str, &str, &str)] = &[
    (
        |file| sphere(file).diameter = "22.2 kg".into(),
        "body.0.sphere.diameter",
        "body.0.sphere.diameter",
        "diameter must be a length, such as \"22.2 mm\"; \"22.2 kg\" is a mass",
    ),
    (|file| glass(file).youngs_modulus = None, "material.glass", "material.glass", "exactly two"),
    (|file| file.body.push(BodyTable::wall("c")), "body.2", "body.2", "the case has 3 [[body]]"),
    (|file| file.body[1].material = None, "body.1", "body.1", "the key `material` is missing"),
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
    for (change, in_made, in_edited, message) in FAULTS {
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

#[test]
fn a_quoted_name_is_one_part_of_a_key() {
    let bad = MaterialTable::from_bulk_shear(-1.0, 1.0, 1.0);
    let error = Case::of(made().with_material("my \"glass\" 1.5", bad)).unwrap_err();
    assert_eq!(error.key(), Some(r#"material."my \"glass\" 1.5".density"#));
}
