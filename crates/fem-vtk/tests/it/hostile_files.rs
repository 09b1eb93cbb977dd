//! Files with wrong numbers: an error with its position, no panic, and no memory for data that do not exist.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use fem_vtk::{Error, VtuFile};

const POINTS: &str = "0 0 0 1 0 0 1 1 0 0 1 0";

/// A square in ascii with replaceable parts.
pub fn square(piece: &str, points: &str, connectivity: &str, offsets: &str, types: &str) -> String {
    format!(
        r#"<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid><Piece {piece}>
        <Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
        <Cells><DataArray type="Int32" Name="connectivity" format="ascii">{connectivity}</DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">{offsets}</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">{types}</DataArray></Cells>
        </Piece></UnstructuredGrid></VTKFile>"#
    )
}

fn ascii(points: &str, connectivity: &str, offsets: &str, types: &str) -> String {
    square("NumberOfPoints=\"4\" NumberOfCells=\"1\"", points, connectivity, offsets, types)
}

fn message(text: &str) -> String {
    let file = VtuFile::from_bytes("lie.vtu", text.as_bytes().to_vec());
    let error = file.and_then(|file| file.quad_mesh()).expect_err("a refusal");
    assert!(matches!(error, Error::Malformed { .. } | Error::MissingArray { .. }), "{error:?}");
    let message = error.to_string();
    assert!(message.starts_with("lie.vtu: "), "{message}");
    message
}

#[track_caller]
fn refuse(text: &str, words: &str) {
    let message = message(text);
    assert!(message.contains(words), "{message}\nlacks: {words}");
}

#[test]
fn unmodified_square_is_read() {
    let bytes = ascii(POINTS, "0 1 2 3", "4", "9").into_bytes();
    let mesh = VtuFile::from_bytes("square.vtu", bytes).unwrap().quad_mesh().unwrap();
    assert_eq!(mesh.quads, [[0, 1, 2, 3]]);
}

/// A vertex, lines and a polyline around two quadrilaterals, as meshio writes the named boundaries of gmsh.
#[test]
fn points_and_lines_beside_quadrilaterals_are_left_out() {
    let points = format!("{POINTS} 2 0 0 2 1 0");
    let text = square(
        "NumberOfPoints=\"6\" NumberOfCells=\"6\"",
        &points,
        "0  0 1  0 1 2 3  2 3 0  1 4 5 2  4 5",
        "1 3 7 10 14 16",
        "1 3 9 4 9 3",
    );
    let mesh = VtuFile::from_bytes("gmsh.vtu", text.into_bytes()).unwrap().quad_mesh().unwrap();
    assert_eq!((mesh.points.len(), mesh.quads), (6, vec![[0, 1, 2, 3], [1, 4, 5, 2]]));
}

/// Every wrong number of the mesh: points, connectivity, offsets and types, and what the message says.
#[test]
fn reader_rejects_wrong_numbers_in_the_mesh() {
    let good = [POINTS, "0 1 2 3", "4", "9"];
    let pieces = POINTS.replacen(' ', " <!-- first point --> ", 1);
    for (part, wrong, words) in [
        (0, "0 0 0 1 0 0 1 1 0 0 1", "found 11 values; allowed: 4 tuples x 3"),
        (0, "0 0 0 1 0 0 1 1 0 0 nan 0", "NaN at index 3 (component 1)"),
        (0, "0 0 0 1 0 0 1 1 0 0 x 0", "found \"x\"; allowed: numbers of type Float64"),
        (0, &pieces, "data in several pieces"),
        (1, "0 1 2 4", "point 4 at corner 3 of cell 0; allowed: 0 to 3"),
        (1, "0 1 -2 3", "point -2 at corner 2"),
        (1, "0 1 2", "found 4 at cell 0; allowed: 0 to 3"),
        (1, "0 1 2 3 0", "found 5 values; allowed: 4 tuples x 1"),
        (2, "3", "found 3 points of cell 0; allowed: four"),
        (2, "5", "found 5 at cell 0; allowed: 0 to 4"),
        (2, "-4", "found -4 at cell 0"),
        (2, "4 8", "found 2 values; allowed: 1 tuples"),
        (3, "23", "type 23 (VTK_QUADRATIC_QUAD); allowed: only four-node"),
        (3, "23", "Mesh.ElementOrder = 1"),
        (3, "", "found 0 values"),
    ] {
        let mut parts = good;
        parts[part] = wrong;
        let [points, connectivity, offsets, types] = parts;
        refuse(&ascii(points, connectivity, offsets, types), words);
    }
}

#[test]
fn reader_rejects_wrong_point_and_cell_counts() {
    let largest = usize::MAX;
    for (piece, words) in [
        ("NumberOfPoints=\"0\" NumberOfCells=\"0\"", "found 0 points, 0 cells"),
        ("NumberOfPoints=\"-4\" NumberOfCells=\"1\"", "NumberOfPoints \"-4\""),
        ("NumberOfPoints=\"4\"", "NumberOfCells \"\""),
        (&format!("NumberOfPoints=\"{largest}\" NumberOfCells=\"1\""), "found 12 values"),
        (&format!("NumberOfPoints=\"4\" NumberOfCells=\"{largest}\""), "found 1 values"),
    ] {
        refuse(&square(piece, POINTS, "0 1 2 3", "4", "9"), words);
    }
}

#[test]
fn reader_rejects_other_file_types() {
    refuse("", "no VTKFile element");
    refuse("# vtk DataFile Version 5.1\nASCII\n", "no VTKFile element");
    refuse("<html></html>", "root element html");
    refuse("<VTKFile type=\"PolyData\"/>", "type \"PolyData\"");
    refuse("<VTKFile type=\"UnstructuredGrid\"/>", "no VTKFile element with a Piece");
    let square = ascii(POINTS, "0 1 2 3", "4", "9");
    let second = "</Piece><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"/>";
    for (part, wrong, words) in [
        ("LittleEndian", "BigEndian", "byte_order \"BigEndian\""),
        ("<VTKFile", "<VTKFile header_type=\"UInt16\"", "header_type \"UInt16\""),
        ("Int32", "Int31", "type \"Int31\""),
        (
            "\"connectivity\"",
            "\"other\"",
            "no array \"connectivity\"; it has: other, offsets, types",
        ),
        ("ascii", "morse", "format \"morse\""),
        ("ascii", "appended", "AppendedData element"),
        ("Components=\"3\"", "Components=\"0\"", "NumberOfComponents \"0\""),
        ("NumberOfComponents=\"3\"", "", "1 components of type Float64"),
        ("</Piece>", second, "2 pieces"),
        ("<Cells>", "<Cells", "broken XML"),
        ("0 1 2 3", "0 1 &lt; 3", "XML references"),
        ("</UnstructuredGrid></VTKFile>", "", "still open"),
    ] {
        assert!(square.contains(part), "{part}");
        refuse(&square.replace(part, wrong), words);
    }
}

/// The square with its points in base64; `attributes` go to the root.
fn binary(attributes: &str, points: &[u8]) -> String {
    encoded(attributes, &STANDARD.encode(points))
}

fn encoded(attributes: &str, points: &str) -> String {
    ascii(points, "0 1 2 3", "4", "9")
        .replacen("ascii", "binary", 1)
        .replace("<VTKFile", &format!("<VTKFile {attributes}"))
}

const WIDE: &str = "header_type=\"UInt64\"";
pub const ZLIB: &str = "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"";

pub fn header_bytes(numbers: &[u64]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

#[test]
fn reader_rejects_headers_that_claim_too_many_bytes() {
    for n_bytes in [1, 96, 1 << 40, u64::MAX] {
        refuse(&binary(WIDE, &header_bytes(&[n_bytes])), "truncated");
    }
    refuse(&binary(WIDE, &[1, 2, 3]), "truncated");
    refuse(&binary(WIDE, &[]), "truncated");

    for n_blocks in [1, 1 << 20, 1 << 60, u64::MAX] {
        refuse(&binary(ZLIB, &header_bytes(&[n_blocks, 32768, 0])), "truncated");
    }
    refuse(&binary(ZLIB, &header_bytes(&[1, 32768, 96, u64::MAX])), "truncated");
    refuse(&binary(ZLIB, &header_bytes(&[2, 32768, 96, u64::MAX, u64::MAX])), "truncated");
    refuse(&binary(ZLIB, &header_bytes(&[0, 0, 0])), "found 0 values");
}

/// As VTK encodes it: header and blocks each padded.
fn zlib_points(numbers: &[u64], blocks: &[u8]) -> String {
    encoded(ZLIB, &(STANDARD.encode(header_bytes(numbers)) + &STANDARD.encode(blocks)))
}

#[test]
fn blocks_that_are_not_what_the_header_says() {
    use std::io::Write;
    let deflate = |bytes: &[u8]| {
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    };
    let sound: Vec<u8> =
        POINTS.split(' ').flat_map(|word| word.parse::<f64>().unwrap().to_le_bytes()).collect();
    let block = deflate(&sound);
    let size = block.len() as u64;
    let file =
        VtuFile::from_bytes("sound.vtu", zlib_points(&[1, 32768, 96, size], &block).into_bytes())
            .unwrap();
    assert_eq!(file.quad_mesh().unwrap().points[2], [1.0, 1.0, 0.0]);

    for (block_size, last_size) in
        [(0, 0), (32768, 0), (32768, 95), (32768, 97), (64, 96), (1 << 62, 1 << 61)]
    {
        refuse(&zlib_points(&[1, block_size, last_size, size], &block), "damaged zlib");
    }
    refuse(&zlib_points(&[1, 32768, 96, size], &vec![7; block.len()]), "damaged zlib");
    refuse(&zlib_points(&[1, 32768, 96, size - 1], &block), "damaged zlib");
}

#[test]
fn broken_base64_and_offsets() {
    let short = binary(WIDE, &[0; 7]);
    assert!(short.contains("AAAAAAAAAA=="), "seven bytes fill the characters of a header");
    refuse(&short, "truncated");
    let base64 = binary(WIDE, &header_bytes(&[96]));
    refuse(&base64.replacen("YAAA", "Y!AA", 1), "broken base64");
    let appended =
        ascii("", "0 1 2 3", "4", "9").replacen("\"ascii\"", "\"appended\" offset=\"9\"", 1);
    let close = |data: &str| {
        appended.replace(
            "</VTKFile>",
            &format!("<AppendedData encoding=\"raw\">{data}</AppendedData></VTKFile>"),
        )
    };
    refuse(&close("_12345678"), "offset \"9\"; allowed: 0 to 8");
    refuse(&close("_123456789"), "truncated");
    refuse(&close("12345678"), "no _ before the data");
    refuse(&close("_12345678").replace("\"raw\"", "\"hex\""), "encoding \"hex\"");
    refuse(&close("_12345678").replace("</VTKFile>", ""), "truncated");
    refuse(&close("_12345678").replace("</AppendedData>", ""), "truncated");
}

/// Messages contain no control characters of a file.
#[test]
fn control_characters_are_not_quoted() {
    let strange = ["\u{1b}[2J", "\u{7f}", "\u{9b}31m"];
    let sound = ascii(POINTS, "0 1 2 3", "4", "9");
    for word in
        ["VTKFile type", "/DataArray", "\"offsets\"", "Float64", "NumberOfCells=\"1", "0 1 2 3"]
    {
        for strange in strange {
            let said = message(&sound.replacen(word, &format!("{strange}{word}"), 1));
            assert!(!said.contains(char::is_control), "{said:?}");
        }
    }
    let said = message(&sound.replacen("\"offsets\"", "\"off\u{1b}sets\"", 1));
    assert!(said.contains("it has: connectivity, off\u{fffd}sets, types"), "{said:?}");
}
