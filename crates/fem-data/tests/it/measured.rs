//! Quantities with uncertainties, tables of any dialect, and measured pairs.

use std::f64::consts::PI;

use fem_case::schema::{BodyTable, MaterialTable};
use fem_case::{Case, CaseFile, RowsFault};
use fem_data::instruments::cradle::Measured;
use fem_data::table::{
    DataError, Kind, MeasuredPairs, Restitutions, Table, UncertaintyError, decode, parse_measured,
    rows_below,
};

#[test]
fn values_and_uncertainties_are_read() {
    let read = |kind, text| {
        let Measured { value, uncertainty } = parse_measured(kind, text).unwrap();
        (value, uncertainty)
    };
    assert_eq!(read(Kind::Length, "20 cm"), (0.2, 0.0));
    assert_eq!(read(Kind::Length, "20 cm ± 1 mm"), (0.2, 0.001));
    assert_eq!(read(Kind::Length, "20 +/- 0.1 cm"), (0.2, 0.001));
    assert_eq!(read(Kind::Length, "0.2"), (0.2, 0.0));
    assert_eq!(read(Kind::Mass, "2 kg ± 50 %"), (2.0, 1.0));
    for text in ["30 deg ± 0.5 deg", "30 ± 0.5 deg", "30° +- 0.5°"] {
        let (value, uncertainty) = read(Kind::Angle, text);
        // π/180 is rounded.
        assert!((value - PI / 6.0).abs() < 1e-15, "{text}");
        assert!((uncertainty - PI / 360.0).abs() < 1e-16, "{text}");
    }
    assert_eq!(read(Kind::Angle, "0.35"), (0.35, 0.0));
    // 350 × 0.001 is rounded.
    assert!((read(Kind::Angle, "350 mrad").0 - 0.35).abs() < 1e-15);
}

#[test]
fn other_quantities_are_rejected() {
    for (kind, text) in [
        (Kind::Length, "20 g"),
        (Kind::Length, "20 cm ± 1 g"),
        (Kind::Length, "20 cm ± -1 mm"),
        (Kind::Length, ""),
        (Kind::Mass, "3 %"),
        (Kind::Mass, "2 kg ± nan %"),
        (Kind::Mass, "1e300 kg ± 1e300 %"),
        (Kind::Angle, "30"),
        (Kind::Angle, "30 cm"),
        (Kind::Angle, "30 cm deg"),
        (Kind::Angle, "deg"),
        (Kind::Angle, "±"),
    ] {
        assert!(parse_measured(kind, text).is_err(), "{text}");
    }
}

#[test]
fn encodings_are_recognised() {
    assert_eq!(decode("µ".as_bytes()), "µ");
    assert_eq!(decode(b"t [\xb5s]"), "t [µs]");
    let units: Vec<u16> = "v;µ\n".encode_utf16().collect();
    let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
    let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
    for (mark, bytes) in [([0xff, 0xfe], &little), ([0xfe, 0xff], &big)] {
        assert_eq!(decode(&[&mark[..], bytes].concat()), "v;µ\n");
        assert_eq!(decode(bytes), "v;µ\n");
    }
}

fn rows(text: &[u8], names: [&str; 2]) -> Result<Vec<Vec<String>>, RowsFault> {
    rows_below("pairs.csv", text, &names.map(String::from))
}

/// The values do not depend on the separator and the place of the units.
#[test]
fn tables_are_read_in_all_dialects() {
    let names = ["d1", "body.0.approach_speed"];
    for (text, expected) in [
        (&b"body.0.approach_speed,d1\n0.5 m/s,10 mm\n"[..], ["10 mm", "0.5 m/s"]),
        (b"# pairs\nD1;body.0.approach_speed\n10 mm;0,5 m/s\n", ["10 mm", "0.5 m/s"]),
        (b"d1\tbody.0.approach_speed\n0,01\t0,5\n", ["0.01", "0.5"]),
        (b"sep=;\nd1 [mm];body.0.approach_speed\n10;0,5\n", ["0.01 m", "0.5"]),
        (b"d1_mm,body.0.approach_speed_cm_s,\xb5\n10,50,1\n", ["0.01 m", "0.5 m/s"]),
        (b"# d1  e\nd1  body.0.approach_speed\n\n 0,01   0,5\n", ["0.01", "0.5"]),
    ] {
        assert_eq!(rows(text, names).unwrap(), [expected], "{}", String::from_utf8_lossy(text));
    }
}

#[test]
fn row_errors_name_file_line_and_column() {
    let names = ["d1", "d2"];
    for (text, expected) in [
        ("d1;d2\n1;2\n1\n", "pairs.csv:3"),
        ("d1;d2\n1;\n", "pairs.csv:2: a cell has no value"),
        ("d1;d3\n1;2\n", "there is no column d2; found are d1, d3"),
        ("d1;d2\n", "no row"),
        ("d1_mm;d2\n1 kg;2\n", "pairs.csv:2"),
        ("d1;d2;d1\n1;2;3\n", "pairs.csv:1: the columns 1 and 3 have the same name, d1"),
        ("d1;d2\n0.5;2\n3;1,500\n", "pairs.csv:3: \"1,500\" has a comma, and \"0.5\" a point"),
    ] {
        let fault = rows(text.as_bytes(), names).unwrap_err();
        assert!(fault.message.contains(expected), "{text}: {}", fault.message);
    }
}

#[test]
fn data_error_has_its_line_and_no_control_characters() {
    let error = DataError::new("e.csv", "speed is \"\u{1b}[2J\"");
    assert_eq!(error.to_string(), "e.csv: speed is \"\u{fffd}[2J\"");
    assert_eq!(error.in_line(3).to_string(), "e.csv:3: speed is \"\u{fffd}[2J\"");
}

#[test]
fn points_are_sorted_by_pairs_and_repeats_are_found() {
    let data = Restitutions::of("e", &[(0.1, 0.9), (0.1, 0.8), (0.1, 0.91), (0.2, 0.9)]);
    let sizes = [[Some(0.01), None], [Some(0.02), None]];
    let measured = MeasuredPairs::sorted(data, |point| sizes[point % 2]);
    assert_eq!(measured.pairs[0].points, [0, 2]);
    assert_eq!(measured.pairs[1].points, [1, 3]);
    assert_eq!([0, 1, 2, 3].map(|point| measured.pair_of(point)), [0, 1, 0, 1]);
    assert_eq!(measured.collisions(), [0, 1, 0, 3]);
    assert_eq!(measured.uncertainties(), None);
}

#[test]
fn an_uncertainty_is_set_once_and_within_its_range() {
    let mut measured = Restitutions::of("e", &[(0.5, 0.9)]);
    for bad in [0.0, -1.0, 1.1, f64::NAN] {
        let refused = measured.set_uncertainty(bad);
        assert!(matches!(refused, Err(UncertaintyError::OutOfRange(_))), "{bad}");
    }
    assert_eq!(measured.set_uncertainty(1.0), Ok(()));
    assert_eq!(measured.points[0].restitution_uncertainty, Some(1.0));
    let again = measured.set_uncertainty(0.1);
    assert_eq!(again, Err(UncertaintyError::Known("e".to_string())));
}

fn ball() -> Case {
    let glass = MaterialTable::from_youngs_modulus_poissons_ratio(2500.0, 70e9, 0.2);
    let ball = BodyTable::sphere("ball", 0.01, "glass").approaching(1.0);
    Case::of(CaseFile::of_bodies(BodyTable::wall("floor"), ball).with_material("glass", glass))
        .unwrap()
}

/// The uncertainty of a restitution has many names; that of another quantity is none of them.
#[test]
fn names_of_uncertainties_are_read() {
    let read = |name: &str| {
        let table = Table::parse("e.csv", &format!("v_m_s;e;{name}\n1;0,9;0,02\n2;0,8;0,02\n"));
        let data = Restitutions::read(&table.unwrap(), ball().scene()).unwrap();
        data.points[1].restitution_uncertainty
    };
    let names = "± e|±e|+- e|delta e|Δe|u(e)|u_e|sigma_e|σ(e)|\
        e_err|e error|COR_std|uncertainty|sigma|restitution_uncertainty|u(e) [-]|de";
    for name in names.split('|') {
        assert_eq!(read(name), Some(0.02), "{name}");
    }
    assert_eq!(read("u(e) [%]"), Some(2e-4));
    for name in ["u(v)", "delta v", "speed_err", "e2", "temperature"] {
        assert_eq!(read(name), None, "{name}");
    }
}

/// Values and uncertainties are read wherever spreadsheets and papers put them, by the one reader of all commands.
#[test]
fn tables_of_papers_and_spreadsheets_are_read() {
    for (text, speed, uncertainty) in [
        ("v in m/s;e\n0,5;0,91 ± 0,02\n1;0,9 ± 0,02\n", 0.5, Some(0.02)),
        ("v / (cm/s);e\n50;0,91 +/- 0,02\n60;0,9 ± 0,02\n", 0.5, Some(0.02)),
        ("v/(cm/s);e;±\n50;0,91;0,02\n60;0,9;0,02\n", 0.5, Some(0.02)),
        ("v [cm/s];±;e;±\n50;1;0,91;0,02\n60;1;0,9;0,02\n", 0.5, Some(0.02)),
        ("v [ft/s];e;s.d.\n10;0,91;0,02\n20;0,9;0,02\n", 3.048, Some(0.02)),
        ("v in mph,e,std. dev.\n10,0.91,0.02\n20,0.9,0.02\n", 4.4704, Some(0.02)),
        ("v,e\n30 ± 0.5 cm/s,0.5 ± 10 %\n40 ± 0.5 cm/s,0.4 ± 10 %\n", 0.3, Some(0.05)),
        ("v (m/s);COR (%)\n0,5;91 ± 2\n1;90 ± 2\n", 0.5, Some(0.02)),
        ("v,e\ncm/s,%\n50 ± 1,91 ± 2\n60 ± 1,90 ± 2\n", 0.5, Some(0.02)),
        ("v, m/s;e\n0,5;0,91\n1;0,9\n", 0.5, None),
        ("v,e\n0.5,0.91(2)\n1,0.90(2)\n", 0.5, Some(0.02)),
        ("Glass on glass\nv,e\n0.5,0.91\n1,0.90\n", 0.5, None),
        ("Glass, dry\nv_n;e_n\n0,5;0,91 ± 0,02\n1;0,90 ± 0,02\n", 0.5, Some(0.02)),
    ] {
        let table = Table::parse("e.csv", text).unwrap();
        let data = Restitutions::read(&table, ball().scene()).unwrap();
        let point = &data.points[0];
        assert!((point.speed - speed).abs() < 1e-12, "{text}: {}", point.speed);
        let found = point.restitution_uncertainty;
        let is_same = |(a, b): (f64, f64)| (a - b).abs() < 1e-12;
        assert!(found.zip(uncertainty).map_or(found == uncertainty, is_same), "{text}: {found:?}");
    }
    // Renaming a column takes the uncertainty of its cells with it.
    let table = Table::parse("e.csv", "v;bounce\n1;0,91 ± 0,02\n2;0,9 ± 0,02\n").unwrap();
    let table = table.renamed(&[("restitution", "bounce")]).unwrap();
    let data = Restitutions::read(&table, ball().scene()).unwrap();
    assert_eq!(data.points[0].restitution_uncertainty, Some(0.02));
}

/// Drop and rebound heights, and speeds before and after, give speeds and restitutions with their uncertainties.
#[test]
fn heights_and_speeds_after_give_restitutions() {
    let fall = |height: f64| (2.0 * 9.80665 * height).sqrt();
    let e = (49.6f64 / 65.0).sqrt();
    let of_heights = 0.5 * e * (0.5f64 / 49.6).hypot(0.25 / 65.0);
    for (text, speed, restitution, uncertainty) in [
        ("drop height (cm),rebound height (cm)\n65,49.6\n55,42.1\n", fall(0.65), e, None),
        ("Height of fall [cm],Height of bounce [cm]\n65,49.6\n55,42.1\n", fall(0.65), e, None),
        ("h0 [m],h1 [m]\n0.65,0.496\n0.55,0.421\n", fall(0.65), e, None),
        ("h1 [m],h2 [m]\n0.65,0.496\n0.55,0.421\n", fall(0.65), e, None),
        (
            "h0,h1\n65 ± 0.25 cm,49.6 ± 0.5 cm\n55 ± 0.25 cm,42 ± 0.5 cm\n",
            fall(0.65),
            e,
            Some(of_heights),
        ),
        ("Drop height (mm),COR\n50,0.68\n100,0.64\n", fall(0.05), 0.68, None),
        ("speed before,speed after\n2 ± 0.02 m/s,-1.5\n3 ± 0.03 m/s,2\n", 2.0, 0.75, Some(0.0075)),
    ] {
        let table = Table::parse("e.csv", text).unwrap();
        let data = Restitutions::read(&table, ball().scene()).unwrap();
        let point = data.points[0];
        assert!((point.speed - speed).abs() < 1e-12, "{text}: {point:?}");
        assert!((point.restitution - restitution).abs() < 1e-12, "{text}: {point:?}");
        let found = point.restitution_uncertainty;
        let is_same = |(a, b): (f64, f64)| (a - b).abs() < 1e-12;
        assert!(found.zip(uncertainty).map_or(found == uncertainty, is_same), "{text}: {found:?}");
        let has_note = data.warnings().iter().any(|it| it.contains("air drag is left out"));
        assert_eq!(has_note, !text.contains("speed"), "{:?}", data.warnings());
    }
    let table = Table::parse("e.csv", "drop height,rebound height\n0,0\n").unwrap();
    assert!(Restitutions::read(&table, ball().scene()).is_err());
    // Impacts that were repeated are points of their own, and an empty cell is none.
    let table =
        Table::parse("e.csv", "v (m/s),e1,e2,e3\n1,0.9,0.91,0.89\n2,0.8,,0.81\n,,,\n").unwrap();
    let data = Restitutions::read(&table, ball().scene()).unwrap();
    let points: Vec<(f64, f64)> = data.points.iter().map(|it| (it.speed, it.restitution)).collect();
    assert_eq!(points, [(1.0, 0.9), (1.0, 0.91), (1.0, 0.89), (2.0, 0.8), (2.0, 0.81)]);
    assert_eq!((&data.lines[..], data.n_left_out), (&[2, 2, 2, 3, 3][..], 1));
    // A class writes a title, a name per row and a mean.
    let class = "Bouncing ball, 10b\n\nGroup;Drop height (cm);Rebound 1 (cm);Rebound 2 (cm)\nAnna;65;49,6;49,6\nBen;65;49,6;\n\
                 Mean;65;49,6;49,6\n";
    let data = Restitutions::read(&Table::parse("e.csv", class).unwrap(), ball().scene()).unwrap();
    assert_eq!(data.points.len(), 3);
    for point in &data.points {
        assert!((point.restitution - e).abs() + (point.speed - fall(0.65)).abs() < 1e-12);
    }
}

/// A restitution above 1 is warned of in the words of the cradle, with its line; above 1.2 it is an error.
#[test]
fn restitutions_above_one_are_warned_of() {
    let read = |rows: &str| {
        let table = Table::parse("e.csv", &format!("speed_m_s,e,u(e)\n{rows}")).unwrap();
        Restitutions::read(&table, ball().scene()).map(|data| data.warnings())
    };
    assert_eq!(read("1,0.9,0.02\n2,1.0,0.02\n").unwrap(), [""; 0]);
    let warnings = read("1,0.9,0.02\n2,1.01,0.02\n3,1.04,0.02\n").unwrap();
    let expected = "e.csv:4: restitution above 1 by 2.0 of its uncertainty in 2 rows, at most 1.04: scatter, or a wrong column";
    assert_eq!(warnings, [expected]);
    assert!(read("1,1.21,0.02\n").unwrap_err().to_string().contains("the restitution is 1.21"));
}
