//! Reading returns the written data bit for bit.

use fem_vtk::{QuadMesh, VtuFile, VtuWriter, pad_vectors};

/// A strip of `n_cells` squares.
fn strip(n_cells: u32) -> QuadMesh {
    let points =
        (0..2 * (n_cells + 1)).map(|k| [f64::from(k / 2), f64::from(k % 2), -0.0]).collect();
    let quads = (0..n_cells).map(|k| [2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1]).collect();
    QuadMesh { points, quads }
}

#[test]
fn all_number_types_and_sizes_come_back() {
    let folder = tempfile::tempdir().unwrap();
    // 4096 doubles fill one block of 32768 bytes.
    for n_cells in [1, 2, 3, 4095, 4096, 4097, 12288] {
        let mesh = strip(n_cells);
        let n_points = mesh.points.len();
        let float: Vec<f64> =
            (0..n_cells).map(|k| 10_f64.powi(k as i32 % 600 - 300) * f64::from(k)).collect();
        let vector: Vec<f64> = (0..3 * n_points).map(|k| -1e-300 / (k as f64 + 1.0)).collect();
        let byte: Vec<u8> = (0..n_cells).map(|k| (k % 256) as u8).collect();
        let signed: Vec<i32> = (0..n_cells as i32).map(|k| i32::MIN + k).collect();
        let long: Vec<i64> = (0..i64::from(n_cells)).map(|k| i64::MIN + k).collect();
        {
            let path = folder.path().join(format!("{n_cells}.vtu"));
            VtuWriter::new(&mesh.points, &mesh.quads)
                .time(-1e-9)
                .point_data("v <&\"'> \u{3c3}", 3, &vector)
                .cell_data("float", 1, &float)
                .cell_data("byte", 1, &byte)
                .cell_data("signed", 1, &signed)
                .cell_data("long", 1, &long)
                .field_data("pair", 2, &[1, -2_i32])
                .write(&path)
                .unwrap();
            let file = VtuFile::open(&path).unwrap();
            assert_eq!(file.quad_mesh().unwrap(), mesh);
            let read = file.point_data("v <&\"'> \u{3c3}").unwrap();
            assert_eq!((read.components, read.as_float()), (3, Some(&vector[..])));
            assert_eq!(file.cell_data("float").unwrap().as_float(), Some(&float[..]));
            let integers =
                |name: &str| file.cell_data(name).unwrap().as_integer().unwrap().to_vec();
            assert!(integers("byte").into_iter().eq(byte.iter().map(|&value| i64::from(value))));
            assert!(
                integers("signed").into_iter().eq(signed.iter().map(|&value| i64::from(value)))
            );
            assert_eq!(integers("long"), long);
            assert_eq!(file.field_data("TimeValue").unwrap().as_float(), Some(&[-1e-9][..]));
            assert_eq!(file.field_data("pair").unwrap().components, 2);
            let names = ["float", "byte", "signed", "long"];
            assert!(file.cell_data_names().eq(names));
        }
    }
}

#[test]
fn signs_of_zero_and_subnormal_numbers_keep_their_bits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bits.vtu");
    let mesh = strip(1);
    let values = [-0.0, 5e-324, f64::MIN, f64::MAX];
    VtuWriter::new(&mesh.points, &mesh.quads).point_data("bits", 1, &values).write(&path).unwrap();
    let read = VtuFile::open(&path).unwrap().point_data("bits").unwrap();
    let bits = read.as_float().unwrap().iter().map(|value| value.to_bits());
    assert!(bits.eq(values.map(f64::to_bits)));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = strip(100);
    let write = |name: &str| {
        let path = folder.path().join(name);
        VtuWriter::new(&mesh.points, &mesh.quads).time(1.0).write(&path).unwrap();
        std::fs::read(path).unwrap()
    };
    assert_eq!(write("a.vtu"), write("b.vtu"));
}

/// The first scalar and the first vector are active; planar vectors get a zero.
#[test]
fn the_first_scalar_and_vector_are_active() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("active.vtu");
    let mesh = strip(1);
    let writer = VtuWriter::new(&mesh.points, &mesh.quads);
    let writer = writer.point_data("displacement", 3, &[0.0; 12]);
    let writer = writer.point_data("velocity", 3, &[0.0; 12]).point_data("p<q", 1, &[0.0; 4]);
    writer.write(&path).unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.contains("<PointData Scalars=\"p&lt;q\" Vectors=\"displacement\">"), "{text}");
    assert_eq!(pad_vectors(&[1.0, 2.0, 3.0, 4.0]), [1.0, 2.0, 0.0, 3.0, 4.0, 0.0]);
}
