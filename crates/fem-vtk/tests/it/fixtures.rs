//! Files of VTK's own writer and of meshio (`fixtures/make_fixtures.py`) come in as they are.

use std::path::PathBuf;

use fem_vtk::{Error, VtuFile, read_quad_mesh};

/// All hold the mesh of `make_fixtures.py`; with the number type of its floats.
const WHOLE: [&str; 12] = [
    "vtk_ascii.vtu",
    "vtk_inline_plain_u32.vtu",
    "vtk_inline_zlib_u64.vtu",
    "vtk_appended_base64_zlib_u32.vtu",
    "vtk_appended_base64_plain_u64.vtu",
    "vtk_appended_raw_zlib_u64.vtu",
    "vtk_appended_raw_zlib_many_blocks.vtu",
    "vtk_appended_raw_plain_f32.vtu",
    "meshio_ascii.vtu",
    "meshio_plain.vtu",
    "meshio_zlib.vtu",
    "meshio_zlib_u64.vtu",
];

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

#[test]
fn every_encoding_gives_the_same_mesh_and_data() {
    let points: Vec<[f64; 3]> =
        (0..12).map(|k| [0.5 * f64::from(k % 4), 0.25 * f64::from(k / 4) - 1.0, 0.0]).collect();
    let quads = [0, 1, 2, 4, 5, 6].map(|k| [k, k + 1, k + 5, k + 4]);
    let temperature: Vec<f64> = (0..12).map(|k| 0.5 * f64::from(k) - 1.0).collect();
    let vector: Vec<f64> = (0..12).flat_map(|k| [f64::from(k), -f64::from(k), 0.25]).collect();
    let one = read_quad_mesh(fixture("vtk_one_quad_plain_u32.vtu")).unwrap();
    assert_eq!(one.quads, [[0, 1, 5, 4]]);
    for name in WHOLE {
        let file = VtuFile::open(fixture(name)).unwrap();
        let mesh = file.quad_mesh().unwrap();
        assert_eq!(mesh.points, points, "{name}");
        assert_eq!(mesh.quads, quads, "{name}");
        assert!(file.point_data_names().eq(["temperature", "vector"]), "{name}");
        let read = file.point_data("temperature").unwrap();
        assert_eq!(read.as_float(), Some(&temperature[..]), "{name}");
        let read = file.point_data("vector").unwrap();
        assert_eq!((read.components, read.as_float()), (3, Some(&vector[..])), "{name}");
        let bodies = file.cell_data("body").unwrap();
        assert_eq!(bodies.as_integer(), Some(&[0, 1, 0, 1, 0, 1][..]), "{name}");
        if name.starts_with("vtk") {
            let time = file.field_data("TimeValue").unwrap();
            assert_eq!(time.as_float(), Some(&[0.125][..]), "{name}");
        }
    }
}

#[test]
fn triangles_and_other_compressors_are_refused_with_the_remedy() {
    let triangle = ["vtk_triangle.vtu", "cell 1 of type 5 (VTK_TRIANGLE)", "Mesh.RecombineAll = 1"];
    let compressor = ["vtk_appended_lz4.vtu", "vtkLZ4DataCompressor", "vtkZLibDataCompressor"];
    for words in [triangle, compressor] {
        let message = read_quad_mesh(fixture(words[0])).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    }
}

#[test]
fn missing_array_error_lists_the_available_arrays() {
    let file = VtuFile::open(fixture("meshio_zlib.vtu")).unwrap();
    let error = file.point_data("pressure").unwrap_err();
    assert!(matches!(error, Error::MissingArray { .. }));
    let message = error.to_string();
    assert!(message.contains("pressure") && message.contains("temperature, vector"), "{message}");
}

#[test]
fn a_truncated_file_is_an_error() {
    for name in WHOLE {
        let bytes = std::fs::read(fixture(name)).unwrap();
        let whole = bytes.trim_ascii_end().len();
        for length in (0..whole).step_by(5) {
            let cut = VtuFile::from_bytes(name, bytes[..length].to_vec());
            assert!(cut.is_err(), "{name} cut at {length}");
        }
    }
}

/// Reads everything; only a panic would fail.
fn read_all(bytes: Vec<u8>) -> Result<(), Error> {
    let file = VtuFile::from_bytes("damaged.vtu", bytes)?;
    let mesh = file.quad_mesh();
    let names: Vec<&str> = file.point_data_names().collect();
    for name in names {
        file.point_data(name)?;
    }
    file.cell_data("body")?;
    mesh.map(|_| ())
}

#[test]
fn no_damaged_byte_panics() {
    for name in WHOLE {
        let bytes = std::fs::read(fixture(name)).unwrap();
        for position in (0..bytes.len()).step_by(31) {
            for flip in [0x01, 0x80, 0xff] {
                let mut damaged = bytes.clone();
                damaged[position] ^= flip;
                let _ = read_all(damaged);
            }
            let mut shorter = bytes.clone();
            shorter.remove(position);
            let _ = read_all(shorter);
        }
    }
}
