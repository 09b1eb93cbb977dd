//! Cases made in code are the same as those that are read.

use std::path::Path;

use fem_case::schema::*;
use fem_case::{Case, CaseFile, Scene, Shape};

use super::pair::{made, parsed};
use super::shipped::{exactly, shipped};

#[test]
fn a_case_in_code_is_the_same_as_its_text() {
    let case = Case::of(made()).unwrap();
    assert_eq!(exactly(&case), exactly(&parsed(&[])));
    // The same keys are given, whichever the way.
    let text = made().to_toml().unwrap();
    let read = Case::parse("made.toml", &text, Path::new("."), &[]).unwrap();
    for path in ["body", "body.0.sphere.diameter", "material.glass.relaxation.terms.1.weight"] {
        assert!(case.gives(path) && read.gives(path), "{path}");
    }
    for path in ["body.1.approach_speed", "body.2", "mesh.x", "model.law"] {
        assert!(!case.gives(path) && !read.gives(path), "{path}");
    }
    // A relaxation by the other pair of moduli.
    let file = made().with_material("glass", MaterialTable::from_bulk_shear(1.0, 2.0, "3 Pa"));
    let moduli = *Case::of(file).unwrap().scene().bodies()[0].material().unwrap().instantaneous();
    assert_eq!((moduli.bulk_modulus(), moduli.shear_modulus()), (2.0, 3.0));
}

#[test]
fn models_in_code_are_the_same_as_in_text() {
    let tsuji =
        TsujiTable { e: Some(0.9.into()), end: Some(End::ZeroOverlap), ..Default::default() };
    let condensed = CondensedTable { vibration_modes: Some(12.into()), ..Default::default() };
    for (model, text) in [
        (ModelTable::fem(), "fem={}"),
        (ModelTable::condensed(), "condensed={}"),
        (condensed.into(), "condensed={vibration_modes=12}"),
        (ModelTable::hertz(), "hertz={}"),
        (HertzTable { finite_size: Some(true) }.into(), "hertz={finite_size=true}"),
        (ModelTable::ting(), "ting={}"),
        (
            TingTable { finite_size: None, tolerance: Some(1e-5.into()) }.into(),
            "ting={tolerance=1e-5}",
        ),
        (ModelTable::law(HertzLawTable::default()), "law={hertz={}}"),
        (ModelTable::law(tsuji), "law={tsuji={e=0.9, end='zero_overlap'}}"),
    ] {
        let case = Case::of(made().with_model(model)).unwrap();
        assert_eq!(exactly(&case), exactly(&parsed(&[&format!("model.{text}")])));
    }
}

#[test]
fn shipped_cases_can_be_made_in_code() {
    for case in shipped() {
        let made = Case::of(case.file().clone()).unwrap();
        assert_eq!(exactly(&made), exactly(&case));
        assert_eq!(made.file(), case.file());
    }
}

#[test]
fn titles_and_folders_have_defaults() {
    let file = CaseFile { title: None, ..made() };
    let case = Case::of(file.clone()).unwrap();
    assert_eq!(case.scene().title(), "striker and target");
    // A title that an edit takes away is that of the file again.
    let read = Case::parse("x/ball.toml", &file.to_toml().unwrap(), Path::new("x"), &[]).unwrap();
    let titled = read.edited(|file| file.title = Some("other".into())).unwrap();
    assert_eq!(titled.scene().title(), "other");
    assert_eq!(titled.edited(|file| file.title = None).unwrap().scene().title(), "ball");

    let mesh = |file: &mut CaseFile| {
        file.body[0].sphere.as_mut().unwrap().mesh = Some("a/b.vtu".into());
    };
    let found = |scene: &Scene| match &scene.bodies()[0].shape() {
        Shape::Sphere { mesh, .. } => mesh.clone().unwrap(),
        _ => panic!("a sphere"),
    };
    let current = std::env::current_dir().unwrap();
    assert_eq!(found(case.edited(mesh).unwrap().scene()), current.join("a/b.vtu"));
    assert_eq!(found(read.edited(mesh).unwrap().scene()), current.join("x/a/b.vtu"));
}
