//! Rejected files: each error, its message, and that the old file is unchanged.

use fem_vtk::{Error, VtuWriter, write_collection};

const POINTS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const QUADS: [[u32; 4]; 1] = [[0, 1, 2, 3]];

/// Writes over an old file; returns the error after checking that nothing changed.
fn refusal(writer: VtuWriter) -> Error {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.vtu");
    std::fs::write(&path, "old").unwrap();
    let error = writer.write(&path).unwrap_err();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "a temporary file is left");
    error
}

/// Asserts that a writer fails with this error.
macro_rules! refused {
    ($writer:expr, $error:pat) => {{
        let error = refusal($writer);
        assert!(matches!(error, $error), "{error:?}");
    }};
}

fn square() -> VtuWriter<'static> {
    VtuWriter::new(&POINTS, &QUADS)
}

#[test]
fn writer_rejects_empty_meshes_and_arrays() {
    refused!(VtuWriter::new(&[], &QUADS), Error::Empty { .. });
    refused!(VtuWriter::new(&POINTS, &[]), Error::Empty { .. });
    refused!(square().field_data("none", 1, &[0.0; 0]), Error::Empty { .. });
    refused!(square().point_data("none", 1, &[0.0; 0]), Error::Empty { .. });
}

#[test]
fn writer_errors_say_what_is_wrong() {
    let mut values = [0.0; 12];
    values[7] = f64::NAN;
    for (writer, message) in [
        (
            square().point_data("v", 3, &[0.0; 11]),
            "PointData array \"v\": found 11 values; 4 points x 3 components are needed",
        ),
        (
            square().cell_data("body", 1, &[0_u8; 2]),
            "CellData array \"body\": found 2 values; 1 cells x 1 components are needed",
        ),
        (
            square().point_data("velocity", 3, &values),
            "PointData array \"velocity\": value NaN at index 2 (component 1)",
        ),
        (
            VtuWriter::new(&POINTS, &[[0, 1, 4, 3]]),
            "cell 0, corner 2: point 4; the mesh has 4 points, numbered from 0",
        ),
    ] {
        assert_eq!(refusal(writer).to_string(), message);
    }
}

#[test]
fn writer_rejects_arrays_of_wrong_length_and_components() {
    refused!(square().field_data("f", 3, &[0.0; 4]), Error::Length { .. });
    refused!(square().cell_data("f", usize::MAX, &[0.0; 4]), Error::Length { .. });
    refused!(square().point_data("v", 2, &[0.0; 8]), Error::Components { components: 2, .. });
    refused!(square().cell_data("v", 0, &[0.0; 1]), Error::Components { components: 0, .. });
    refused!(square().field_data("v", 0, &[0.0; 1]), Error::Components { components: 0, .. });
}

#[test]
fn writer_rejects_values_that_are_not_finite() {
    refused!(square().cell_data("p", 1, &[f64::INFINITY]), Error::NotFinite { index: 0, .. });
    refused!(square().field_data("p", 1, &[f64::NEG_INFINITY]), Error::NotFinite { .. });
    refused!(square().time(f64::NAN), Error::NotFinite { .. });
    let mut points = POINTS;
    points[3][1] = f64::NAN;
    refused!(
        VtuWriter::new(&points, &QUADS),
        Error::NotFinite { section: "Points", index: 3, component: 1, .. }
    );
}

#[test]
fn writer_rejects_invalid_and_duplicate_names() {
    for name in ["", "a\nb", "a\u{1}"] {
        refused!(square().cell_data(name, 1, &[0.0]), Error::Name { .. });
    }
    let twice = square().cell_data("p", 1, &[0.0]).cell_data("p", 1, &[0.0]);
    refused!(twice, Error::DuplicateName { section: "CellData", .. });
    let time = square().time(0.0).field_data("TimeValue", 1, &[0.0]);
    refused!(time, Error::DuplicateName { section: "FieldData", .. });
}

#[test]
fn one_name_may_stand_at_points_and_at_cells() {
    let folder = tempfile::tempdir().unwrap();
    let writer = square().cell_data("pressure", 1, &[0.0]).point_data("pressure", 1, &[0.0; 4]);
    writer.write(folder.path().join("both.vtu")).unwrap();
}

#[test]
fn a_missing_folder_is_named() {
    let message = square().write("/nonexistent/folder/a.vtu").unwrap_err().to_string();
    assert!(message.contains("/nonexistent/folder/a.vtu"), "{message}");
}

#[cfg(unix)]
#[test]
fn files_have_the_permissions_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let plain = folder.path().join("plain");
    std::fs::write(&plain, "").unwrap();
    let path = folder.path().join("a.vtu");
    square().write(&path).unwrap();
    let mode = |path: &std::path::Path| std::fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&path), mode(&plain));
}

#[test]
fn write_collection_rejects_invalid_times_and_file_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.pvd");
    let refuse = |snapshots: &[(f64, &str)]| write_collection(&path, snapshots).unwrap_err();
    assert!(matches!(refuse(&[]), Error::Empty { .. }));
    assert!(matches!(refuse(&[(f64::NAN, "a.vtu")]), Error::Time { .. }));
    assert!(matches!(
        refuse(&[(1.0, "a.vtu"), (1.0, "b.vtu")]),
        Error::Time { previous: Some(1.0), .. }
    ));
    assert!(matches!(refuse(&[(1.0, "a.vtu"), (0.5, "b.vtu")]), Error::Time { .. }));
    for name in ["", "/tmp/a.vtu", "C:\\a.vtu", "a\\b.vtu", "a\n.vtu"] {
        assert!(matches!(refuse(&[(1.0, name)]), Error::FileName { .. }), "{name:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
