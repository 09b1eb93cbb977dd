//! Overrides `--set KEY=VALUE`: their effect, and faults that name the override and not a line of the file.

use std::path::Path;

use fem_case::{Case, CaseError, Shape, Snapshots};

use crate::parse_in;

const CASE: &str = r#"
    material.glass = { density = 2390, youngs_modulus = 63e9, poissons_ratio = 0.244 }
    material."my glass" = { density = 2500, youngs_modulus = 63e9, poissons_ratio = 0.244 }
    body = [{ name = "striker", sphere.diameter = 0.02, material = "glass", approach_speed = 0.5 },
            { name = "target", sphere.diameter = 0.01, material = "glass" }]
    output.snapshots = ["maximum"]"#;

fn with(overrides: &[&str]) -> Result<Case, CaseError> {
    parse_in(Path::new("."), "pair.toml", CASE, overrides)
}

#[test]
fn values_are_replaced_and_added() {
    let case = with(&[
        "body.0.approach_speed=\"1 m/s\"",
        "mesh.contact_element_size=28e-6",
        "title='a pair'",
        "body.1.sphere={ diameter = '3 mm' }",
        " time . step_factor = 0.5 ",
        "\"time\".'mass_scaling'=0",
        "output.snapshots.0='last-contact'",
        "material.\"my glass\".density='3 g/cm^3'",
        "body.1.material='my glass'",
        "model.fem={}",
    ])
    .unwrap();
    let scene = case.scene();
    assert_eq!(scene.bodies()[0].velocity(), 1.0);
    assert_eq!(scene.mesh().contact_element_size, Some(28e-6));
    assert_eq!(scene.title(), "a pair");
    assert_eq!(scene.bodies()[1].diameter(), Some(0.003));
    assert_eq!(scene.step_factor(), Some(0.5));
    assert_eq!(scene.mass_scaling(), Some(0.0));
    assert!(matches!(&scene.snapshots(), Some(Snapshots::Labels(labels)) if labels.len() == 1));
    assert_eq!(scene.bodies()[1].material().unwrap().density(), 3000.0);
}

#[test]
fn overrides_are_applied_left_to_right() {
    let case = with(&["start={gap = 1}", "start.gap=2", "start.gap=3"]).unwrap();
    assert_eq!(case.scene().gap(), Some(3.0));
    let case = with(&["start.gap=2", "start={}"]).unwrap();
    assert_eq!(case.scene().gap(), None);
    // Only the case that results is validated.
    with(&["start.gap=-2", "start.gap=0"]).unwrap();
}

#[test]
fn a_table_that_is_absent_is_made() {
    let case = with(&[
        "material.ice.density=900",
        "material.ice.youngs_modulus='10 GPa'",
        "material.ice.poissons_ratio=0.3",
        "material.glass.relaxation.acts_on='all'",
        "material.glass.relaxation.terms=[{weight=1, decay_rate='2708 1/s'}]",
        "body.1={name='b', wall={}}",
    ])
    .unwrap();
    assert_eq!(case.scene().bodies()[1].shape(), &Shape::Wall);
    assert!(case.scene().bodies()[0].material().unwrap().relaxation().is_some());
}

/// Checks the fault of the override `marked`, in which «» enclose the text that must be underlined.
#[track_caller]
fn fault(key: &str, marked: &str, message: &str) {
    let (before, rest) = marked.split_once('«').unwrap();
    let (culprit, after) = rest.split_once('»').unwrap();
    let text = format!("{before}{culprit}{after}");
    let error = with(&["title='ä'", &text, "time.step_factor=0.5"]).unwrap_err();
    assert_eq!(error.source_name(), format!("--set {key}=…"), "{error}");
    assert_eq!(error.source_text(), Some(text.as_str()));
    assert_eq!(error.span().unwrap(), before.len()..before.len() + culprit.len(), "{error}");
    assert_eq!((error.line(), error.column()), (Some(1), Some(before.chars().count() + 1)));
    assert!(error.message().contains(message), "{error}");
    assert!(error.to_string().contains(&format!("--set {key}=…:1:")), "{error}");
}

#[test]
fn faults_in_an_overrides_value_are_marked() {
    let speed = "body.0.approach_speed";
    fault(speed, "body.0.approach_speed=«1 kg/s»", "approach_speed must be a speed");
    fault("body.0.held", "body.0.held=«yes»", "held is a string");
    fault("title", "title=«{glass»", "not a TOML value");
    fault("title", "title=«[1, 2»", "not a TOML value");
    fault("title", "title=«a = 2»", "not a TOML value");
    fault("model", "model=«tng»", "unknown model \"tng\"");
    fault("title", "title=«\"glass»", "not a TOML value");
    fault("title", "title=«'a' b»", "not a TOML value");
    fault("start.gap", "start.gap=«1\ntitle = 2»", "not a TOML value");
    fault("start.gap", "start.gap«=»", "no value after");
    fault("start.gap", "start.gap «=» ", "no value after");
    fault("start.gap", "start.gap=«\"1 kg\"»", "gap must be a length");
    fault("body.0.sphere.diameter", "body.0.sphere.diameter=«nan»", "not finite");
    fault("body.0.sphere", "body.0.sphere={diameter=«true»}", "diameter is a boolean");
    fault("body.0.sphere", "body.0.sphere=«{}»", "`diameter` is missing");
    fault("body.1.approach_speed", "body.1.approach_speed=«-0.5»", "the bodies do not approach");
    fault("material.glass", "material.glass={«densty»=1}", "unknown key `densty`");
    fault("body", "body=«[]»", "no [[body]]");
    fault("mesh", "mesh=«3»", "mesh is an integer");
    fault("accuracy.tolerance", "accuracy.tolerance=«0»", "tolerance is 0");
    fault("model.ting", "model.ting={«finite»=true}", "unknown key `finite` in model.ting");
}

/// A shell removes the quotes of `body.0.approach_speed="1 m/s"`.
#[test]
fn text_that_is_not_toml_is_a_string() {
    for (bare, quoted) in [
        ("body.0.approach_speed=1 m/s", "body.0.approach_speed='1 m/s'"),
        ("mesh.contact_element_size=14um", "mesh.contact_element_size='14um'"),
        ("effects.finite_strain=off", "effects.finite_strain='off'"),
        ("title= two words ", "title='two words'"),
        ("model=ting", "model={ting={}}"),
        ("model='hertz'", "model={hertz={}}"),
        ("model.law=hertz", "model={law={hertz={}}}"),
    ] {
        let [bare, quoted] = [bare, quoted].map(|text| with(&[text]).unwrap());
        assert_eq!(format!("{:?}", bare.scene()), format!("{:?}", quoted.scene()));
    }
    // Later overrides of its keys work.
    let case = with(&["model=ting", "model.ting.tolerance=1e-4"]).unwrap();
    let ting = case.file().model.as_ref().and_then(|model| model.ting.clone()).unwrap();
    assert_eq!(ting.tolerance.unwrap().si().ok(), Some(1e-4));
    for text in [format!("{CASE}\n[model]\nlaw = 'hertz'\n"), format!("model = 'hertz'\n{CASE}")] {
        Case::parse("pair.toml", &text, Path::new("."), &[]).unwrap();
    }
}

#[test]
fn faults_in_an_overrides_key_are_marked() {
    fault("body.2.name", "body.«2».name='x'", "not an index of this array of 2");
    fault("body.2", "body.«2»={}", "not an index of this array of 2");
    fault("body.first.name", "body.«first».name='x'", "not an index");
    fault("body.-1.name", "body.«-1».name='x'", "not an index");
    let long = "body.«99999999999999999999».name='x'";
    fault("body.99999999999999999999.name", long, "not an index");
    let beyond = "output.snapshots.«1»='maximum'";
    fault("output.snapshots.1", beyond, "not an index of this array of 1");
    fault("material.glass.density.x", "material.glass.«density».x=1", "a single value");
    fault("mesh.size", "mesh.«size»=1", "unknown key `size` in mesh");
    fault("weather", "«weather»=1", "unknown key `weather`");
    fault("material.ice.density", "material.«ice».density=1", "exactly two");
    fault("body..name", "body.«.»name='x'", "empty");
    fault(".body", "«.»body=1", "empty");
    fault("body.", "body.«=»1", "empty");
    fault("", "«=»1", "empty");
    fault("a b", "a «b»=1", "is not allowed in a key");
    fault("größe", "gr«ö»ße=1", "is not allowed in a key");
    fault("a[0]", "a«[»0]=1", "is not allowed in a key");
    fault("\"a=1", "«\"a=1»", "has no end");
    fault("title", "«title»", "no `=`");
    fault("", "«»", "empty");
    let deep = ["a"; 40].join(".");
    let marked = format!("«{}».{}=1", ["a"; 33].join("."), ["a"; 7].join("."));
    fault(&deep, &marked, "too many parts");
}

#[test]
fn an_override_is_blamed_for_contradictions() {
    let text = "
        material.glass = { density = 1, youngs_modulus = 2, bulk_modulus = 2, relaxation = { acts_on = 'all',
            terms = [{ weight = 0.1, relaxation_time = 1 }, { weight = 0.2, decay_rate = 1 }] } }
        body = [{ name = 'a', wall = {} },
                { name = 'b', sphere.diameter = 1, material = 'glass', approach_speed = 1 }]
        model.fem = {}";
    let parse = |overrides: &[String]| Case::parse("x", text, Path::new("."), overrides);
    parse(&[]).unwrap();
    for (key, value) in [
        ("material.glass.relaxation.terms.0.decay_rate", "1"),
        ("material.glass.relaxation.terms.1.relaxation_time", "1"),
        ("material.glass.relaxation.terms.0.weight", "0.9"),
        ("material.glass.youngs_modulus", "20"),
        ("material.glass.bulk_modulus", "0.2"),
        ("material.glass.poissons_ratio", "0.2"),
        ("material.glass.shear_modulus", "1"),
        ("body.0.sphere.diameter", "1"),
        ("body.1.wall", "{}"),
        ("body.0.material", "'glass'"),
        ("body.0.name", "'b'"),
        ("body.1.name", "'a'"),
        ("body.1.approach_speed", "-1"),
        ("accuracy.tolerance.peak_force", "-1"),
    ] {
        let error = parse(&[format!("{key}={value}"), "start.gap=0".to_string()]).unwrap_err();
        assert_eq!(error.source_name(), format!("--set {key}=…"), "{error}");
        assert_eq!(error.column(), Some(key.len() + 2), "{error}");
    }
}

#[test]
fn a_fault_of_the_file_still_points_into_the_file() {
    let error = with(&["body.0.approach_speed=0"]).unwrap_err();
    // The second body has no approach_speed: the sum is at fault, and the override is to blame.
    assert_eq!(error.source_name(), "--set body.0.approach_speed=…");
    let overrides = ["start.gap=0".to_string()];
    let text = CASE.replace("2390", "-2390");
    let error = Case::parse("pair.toml", &text, Path::new("."), &overrides).unwrap_err();
    assert_eq!(error.source_name(), "pair.toml");
    assert_eq!((error.line(), error.column()), (Some(2), Some(34)));
}

/// A key in the wrong table, a body by its name or without its index, and a table of a material that no body is of.
#[test]
fn a_misplaced_key_is_answered_with_its_path() {
    for (text, meant) in [
        ("approach_speed=2", "did you mean `body.0.approach_speed`?"),
        ("speed=2", "did you mean `body.0.approach_speed`?"),
        ("diameter=2", "did you mean `body.0.sphere.diameter` or `body.1.sphere.diameter`?"),
        ("body.1.diameter=2", "did you mean `body.1.sphere.diameter`?"),
        ("sphere.diameter=2", "did you mean `body.0.sphere` or `body.1.sphere`?"),
        ("body.target.sphere.diameter=2", "did you mean `body.1.sphere.diameter`?"),
        ("body.approach_speed=2", "did you mean `body.0.approach_speed`?"),
        ("temperature='30 degC'", "did you mean `scene.temperature`?"),
        ("tolerance=0.1", "did you mean `accuracy.tolerance`?"),
        ("relaxation.terms=[]", "did you mean `material.glass.relaxation`?"),
        ("thickness=1", "did you mean `body.0.plate.thickness`?"),
        ("nonsense=1", "the keys here are title"),
        ("material.steel.flow={}", "they are of glass, whose keys are in [material.glass]"),
    ] {
        let error = with(&[text]).map(|_| ()).unwrap_err();
        assert!(error.help().unwrap().contains(meant), "{error}");
    }
    let of_library = "body.0.material='lib:glass'";
    let own = with(&[of_library, "material.glas.flow={}", "body.1.material='lib:glass'"]);
    let message = own.map(|_| ()).unwrap_err().to_string();
    assert!(
        message.contains(r#"of lib:glass, whose keys are in [material."lib:glass"]"#),
        "{message}"
    );
}
