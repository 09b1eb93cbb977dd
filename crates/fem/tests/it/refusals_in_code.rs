//! What a model refuses of a case made or changed in code is named by its key.

use std::path::Path;

use fem::{METHODS, SharedModels, Simulation};
use fem_case::schema::MeshTable;
use fem_case::{Case, CaseError, CaseFile};

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");

fn refused(case: Case) -> CaseError {
    Simulation::new(case).map(|_| ()).unwrap_err()
}

fn mesh(file: &mut CaseFile) -> &mut MeshTable {
    file.mesh.get_or_insert_default()
}

#[test]
fn what_the_text_gives_keeps_its_line() {
    let text = format!("{GLASS}\n[mesh]\nrefined_radius = \"20 mm\"\n");
    let case = Case::parse("pair.toml", &text, Path::new("."), &[]).unwrap();
    let faster = case.edited(|file| file.body[0].approach_speed = Some(0.6.into())).unwrap();
    let error = refused(faster);
    assert_eq!(error.key(), Some("mesh.refined_radius"));
    assert_eq!(error.line(), Some(text.lines().count()), "{error}");
    let wider = case.edited(|file| mesh(file).refined_radius = Some("30 mm".into())).unwrap();
    let error = refused(wider);
    assert_eq!((error.source_name(), error.line()), ("mesh.refined_radius", None), "{error}");
}

#[test]
fn what_nobody_gave_is_named_too() {
    let file = Case::parse("pair.toml", GLASS, Path::new("."), &[]).unwrap().file().clone();
    let case = Case::of(file).unwrap();
    let fine = case.edited(|file| mesh(file).contact_element_size = Some("20 nm".into())).unwrap();
    assert_eq!(refused(fine).source_name(), "mesh.contact_element_size");
    let many = case.edited(|file| {
        mesh(file).contact_element_size = Some("1 um".into());
        file.model = Some(fem_case::schema::ModelTable::condensed());
        file.limits.get_or_insert_default().elements = Some(1e9.into());
    });
    assert_eq!(refused(many.unwrap()).source_name(), "limits.memory");
}

#[test]
fn a_method_refuses_a_scene_that_chose_another() {
    for model in ["fem={}", "condensed={}", "hertz={}", "ting={}", "law.falcon.c=300"] {
        let set = [format!("model.{model}")];
        let case = Case::parse("pair.toml", GLASS, Path::new("."), &set).unwrap();
        let scene = case.scene();
        for method in METHODS {
            let made = method.build(scene, &SharedModels::default());
            if method.name() == scene.model().name() {
                made.unwrap();
            } else {
                assert_eq!(made.unwrap_err().key, scene.model().path(), "{}", method.name());
            }
        }
    }
}
