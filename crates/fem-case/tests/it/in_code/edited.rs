//! Edits of a case: unchanged keys, changed keys, and the key that is blamed for a fault.

use fem_case::schema::*;
use fem_case::{Case, CaseFile};

use super::pair::{Change, mesh, parsed, relaxation, snapshots};
use super::shipped::{exactly, paths, shipped};

#[test]
fn an_empty_edit_changes_nothing() {
    let mut n_filled_in = 0;
    for case in shipped() {
        let same = case.edited(|_| {}).unwrap();
        assert_eq!(exactly(&same), exactly(&case));
        assert_eq!(same.file(), case.file());
        for path in paths(case.file()) {
            n_filled_in += usize::from(!case.gives(&path));
            assert_eq!(same.gives(&path), case.gives(&path), "{path}");
            assert_eq!(same.error_at(&path, "here"), case.error_at(&path, "here"));
        }
    }
    assert!(n_filled_in > 10, "{n_filled_in}");
}

#[test]
fn unchanged_keys_keep_their_line() {
    let case = parsed(&["start.gap=2e-6", "limits.memory='1 GB'"]);
    let edited = case
        .edited(|file| {
            file.body[0].approach_speed = Some(1.0.into());
            mesh(file).growth = None;
            relaxation(file).terms[0].weight = 0.25.into();
            relaxation(file).terms.pop();
            snapshots(file, &["mid-compression", "last-contact"]);
            file.model = Some(ModelTable::condensed());
        })
        .unwrap();
    for path in [
        "title",
        "body",
        "body.0",
        "body.0.name",
        "body.1.sphere.diameter",
        "material.glass.relaxation",
        "material.glass.relaxation.terms.0.decay_rate",
        "mesh.contact_element_size",
        "start.gap",
        "limits.memory",
        "limits.elements",
        "output.snapshots.0",
        "effects.finite_strain",
        "nothing.at.all",
    ] {
        let error = edited.error_at(path, "here");
        assert_eq!(error, case.error_at(path, "here"));
        assert!(error.line().is_some() && error.key() == Some(path));
        assert_eq!(edited.gives(path), case.gives(path));
    }
    assert_eq!(edited.error_at("start.gap", "").source_name(), "--set start.gap=…");
    // What it changed, and tables that it took a key from.
    for path in [
        "body.0.approach_speed",
        "material.glass.relaxation.terms.0.weight",
        "material.glass.relaxation.terms",
        "output.snapshots.1",
        "mesh",
        "model.condensed",
    ] {
        let error = edited.error_at(path, "here");
        assert_eq!((error.line(), error.source_name()), (None, path));
        assert!(edited.gives(path));
    }
    for path in
        ["mesh.growth", "model.fem", "material.glass.relaxation.terms.1", "model.condensed.steps"]
    {
        assert!(!edited.gives(path), "{path}");
        assert_eq!(edited.error_at(path, "here").source_name(), path);
    }
}

#[test]
fn a_list_that_becomes_a_number_has_no_elements() {
    let case = parsed(&[]);
    let edited = case.edited(|file| {
        file.output.get_or_insert_default().snapshots = Some(SnapshotsValue::Count(3.0));
    });
    let edited = edited.unwrap();
    assert!(case.gives("output.snapshots.1") && !edited.gives("output.snapshots.1"));
    assert_eq!(edited.error_at("output.snapshots.1", "here").source_name(), "output.snapshots.1");
}

#[test]
fn an_edit_is_blamed_for_contradictions() {
    let blamed = |case: &Case, change: Change| case.edited(change).unwrap_err();
    let case = parsed(&["model.law.tsuji.alpha=0.1", "body.1.approach_speed=0"]);
    let law = |file: &mut CaseFile| {
        file.model.as_mut().unwrap().law.as_mut().unwrap().tsuji.as_mut().unwrap().e =
            Some(0.9.into());
    };
    assert_eq!(blamed(&case, law).source_name(), "model.law.tsuji.e");
    let speed = |file: &mut CaseFile| file.body[0].approach_speed = Some(0.0.into());
    assert_eq!(blamed(&case, speed).source_name(), "body.0.approach_speed");
    // Of two edits the later one.
    let first = case.edited(|file| file.body[1].name = "other".into()).unwrap();
    let error = blamed(&first, |file| file.body[0].name = "other".into());
    assert_eq!(error.source_name(), "body.0.name");
}
