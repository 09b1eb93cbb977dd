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

fn square() -> VtuWriter<'static> {
    VtuWriter::new(&POINTS, &QUADS)
}

/// Empty meshes and arrays, wrong lengths and components, values that are not finite, invalid and duplicate names: the
/// error, by the beginning of its `Debug`, and a part of the message, or the message alone.
#[test]
fn writer_rejects_invalid_input_and_says_what_is_wrong() {
    let (mut values, mut points) = ([0.0; 12], POINTS);
    (values[7], points[3][1]) = (f64::NAN, f64::NAN);
    let corner = [[0, 1, 4, 3]];
    let rows: Vec<(VtuWriter<'_>, &str, &str)> = vec![
        (VtuWriter::new(&[], &QUADS), "Empty", ""),
        (VtuWriter::new(&POINTS, &[]), "Empty", ""),
        (square().field_data("none", 1, &[0.0; 0]), "Empty", ""),
        (square().point_data("none", 1, &[0.0; 0]), "Empty", ""),
        (
            square().point_data("v", 3, &[0.0; 11]),
            "",
            "PointData array \"v\": found 11 values; 4 points x 3 components are needed",
        ),
        (
            square().cell_data("body", 1, &[0_u8; 2]),
            "",
            "CellData array \"body\": found 2 values; 1 cells x 1 components are needed",
        ),
        (
            VtuWriter::new(&POINTS, &corner),
            "",
            "cell 0, corner 2: point 4; the mesh has 4 points, numbered from 0",
        ),
        (square().field_data("f", 3, &[0.0; 4]), "Length", ""),
        (square().cell_data("f", usize::MAX, &[0.0; 4]), "Length", ""),
        (square().point_data("v", 2, &[0.0; 8]), "Components", "2"),
        (square().cell_data("v", 0, &[0.0; 1]), "Components", "0"),
        (square().field_data("v", 0, &[0.0; 1]), "Components", "0"),
        (
            square().point_data("velocity", 3, &values),
            "",
            "PointData array \"velocity\": value NaN at index 2 (component 1)",
        ),
        (square().cell_data("p", 1, &[f64::INFINITY]), "NotFinite", "at index 0"),
        (square().field_data("p", 1, &[f64::NEG_INFINITY]), "NotFinite", ""),
        (square().time(f64::NAN), "NotFinite", ""),
        (VtuWriter::new(&points, &QUADS), "NotFinite", "at index 3 (component 1)"),
        (square().cell_data("", 1, &[0.0]), "Name", ""),
        (square().cell_data("a\nb", 1, &[0.0]), "Name", ""),
        (square().cell_data("a\u{1}", 1, &[0.0]), "Name", ""),
        (square().cell_data("p", 1, &[0.0]).cell_data("p", 1, &[0.0]), "DuplicateName", "CellData"),
        (square().time(0.0).field_data("TimeValue", 1, &[0.0]), "DuplicateName", "FieldData"),
    ];
    for (row, (writer, kind, message)) in rows.into_iter().enumerate() {
        let error = refusal(writer);
        assert!(format!("{error:?}").starts_with(kind), "{row}: {error:?} is no {kind}");
        let said = error.to_string();
        assert!(said.contains(message) && (!kind.is_empty() || said == message), "{row}: {said}");
    }
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
