//! Tables of measured data: every spelling gives the same data, and faults have their place.

use fem::measured::{MeasuredPairs, Restitutions, Table};
use fem::schema::{BodyTable, MaterialTable};
use fem::{Case, CaseFile};

fn case(lower: BodyTable) -> Case {
    let glass = MaterialTable::from_youngs_modulus_poissons_ratio(2390.0, "63 GPa", 0.244);
    let target = BodyTable::sphere("target", "15.9 mm", "glass").approaching("0.25 m/s");
    Case::of(CaseFile::of_bodies(lower, target).with_material("glass", glass)).unwrap()
}

fn spheres() -> Case {
    case(BodyTable::sphere("striker", "22.2 mm", "glass"))
}

#[test]
fn contact_times_are_read_on_request() {
    let text = "speed_m_s,e,contact_time_us,humidity\n0.5,0.95,65,0.4\n";
    let table = Table::parse("e.csv", text).unwrap();
    let case = spheres();
    let read = Restitutions::read(&table, case.scene()).unwrap();
    assert_eq!(read.points[0].contact_time, None);
    assert_eq!(read.warnings(), ["columns that are not read: humidity"]);
    let read = Restitutions::read_with_contact_times(&table, case.scene()).unwrap();
    // The product 65 × 1e-6 is rounded.
    assert!((read.points[0].contact_time.unwrap() - 65e-6).abs() < 1e-19);
}

#[test]
fn diameters_make_pairs() {
    let text = "diameter_1_mm,speed_m_s,e\n10,0.5,0.95\n20,0.5,0.94\n10,1,0.95\n";
    let table = Table::parse("e.csv", text).unwrap();
    let read = MeasuredPairs::read(&table, spheres().scene()).unwrap();
    assert_eq!(read.pairs[0].diameters, [Some(0.01), None]);
    assert_eq!((&read.pairs[0].points[..], &read.pairs[1].points[..]), (&[0, 2][..], &[1][..]));
    assert_eq!(read.data.lines, [2, 3, 4]);
    let resized = spheres().edited(|file| read.pairs[1].resize(file)).unwrap();
    let diameters = resized.scene().bodies().each_ref().map(|body| body.diameter().unwrap());
    assert_eq!(diameters, [0.02, 0.0159]);
}

#[test]
fn faults_have_name_line_and_column() {
    let fault = |case: &Case, text: &str| {
        let table = Table::parse("bad.csv", text)?;
        MeasuredPairs::read(&table, case.scene()).map(|_| ())
    };
    for (text, place, column, message) in [
        ("", "bad.csv", None, "there is no row below the header"),
        ("speed_m_s,e\n1,0.9,3\n", "bad.csv:2", None, "3 cells below a header of 2"),
        ("speed_m_s,e\n1,0.9\n2,much\n", "bad.csv:3", Some("e"), "which is not a number"),
        ("speed_m_s,e\n1,92\n", "bad.csv:2", Some("e"), "the restitution is 92"),
        ("speed_s,e\n1,0.9\n", "bad.csv:2", Some("speed_s"), "a column whose name ends in _s"),
        ("speed,e\n1 kg,0.9\n", "bad.csv:2", Some("speed"), "of another dimension"),
        ("v_m_s,speed_m_s,e\n1,1,0.9\n", "bad.csv:1", None, "mean the same"),
        ("speed_m_s,e,sigma\n1,0.9,5\n", "bad.csv:2", Some("sigma"), "sigma is 5"),
        ("diameter_1_mm,speed_m_s,e\n-3,1,0.9\n", "bad.csv:2", Some("diameter_1_mm"), "-0.003"),
        ("speed_m_s,e,uncertanty\n1,0.9,1\n", "bad.csv:1", Some("uncertanty"), "unknown column"),
        // An unknown unit is no missing value.
        ("speed,e\nfurlong,-\n500,0.95\n750,0.92\n", "bad.csv:2", Some("speed"), "not a number"),
    ] {
        let error = fault(&spheres(), text).unwrap_err();
        assert_eq!((error.place().as_str(), error.column.as_deref()), (place, column), "{error}");
        assert!(error.message.contains(message), "{error}");
    }
    let wall = case(BodyTable::wall("floor"));
    let error = fault(&wall, "diameter_1_mm,speed_m_s,e\n10,1,0.9\n").unwrap_err();
    assert_eq!(error.message, "diameter_1_mm belongs to the first body, and \"floor\" is a wall");
}

/// The formats of spreadsheets and instruments give the same data.
#[test]
fn all_common_formats_are_read() {
    let names: [(&str, &str); 3] = [("speed", "v"), ("restitution", "COR"), ("uncertainty", "u")];
    for (text, names) in [
        ("v;COR;u\n0,5;0,95;0,01\n0,75;0,92;0,02\n", &names[..]),
        ("v\tCOR\tu\n0.5\t0.95\t0.01\n0.75\t0.92\t0.02\n", &names),
        ("sep=;\r\nv;COR;u\r\n0,5;0,95;0,01;;\r\n0,75;0,92;0,02\r\n", &names),
        ("v [cm/s];COR [%];u\n50;95;0,01\n75;92;0,02\n", &names),
        ("speed;COR;v;u\n9;0,95;0,5;0,01\n9;0,92;0,75;0,02\n", &names),
        ("Impact speed (m/s),Coefficient of restitution,sigma\n.5,.95,.01\n.75,.92,.02\n", &[]),
        ("Impact velocity [cm/s];Restitution coefficient;sigma\n50;0,95;0,01\n75;0,92;0,02\n", &[]),
        ("v,e,u\n0.5,0.95,0.01\nnan,0.9,0.1\n0.6,,0.1\n0.75,0.92,0.02\n,,\n", &names[2..]),
        ("v,e,u\n0.5,0.95,0.01\n1,n/a,\n1,-,\n1,NaN,\n0.75,0.92,0.02\n", &names[2..]),
        ("# v  COR\nv  COR  u\n\n 0,5   0,95  0,01\n 0,75  0,92  0,02\n", &names),
        ("# a comment\nSpeed_cm_s, e,sigma\n50, 0.95,0.01\n75, 0.92,0.02\n", &[]),
        ("v,restitution_percent,u\n50 cm/s,95,0.01\n0.75 m/s,92,0.02\n", &names[2..]),
        ("speed,restitution,u,\nmm/s,-,-,\n500,0.95,0.01,\n750,0.92,0.02,\n", &names[2..]),
        // The other body moves at 0.25 m/s.
        (
            "body.0.approach_speed,restitution,complete,u\n0.25,0.95,true,0.01\n0.5,0.92,true,0.02\n1,,false,\n",
            &names[2..],
        ),
    ] {
        let table = Table::parse("e.csv", text).unwrap().renamed(names).unwrap();
        let read = Restitutions::read(&table, spheres().scene()).unwrap();
        assert_eq!(read.points.len(), 2, "{text}");
        for (point, [speed, restitution, uncertainty]) in
            read.points.iter().zip([[0.5, 0.95, 0.01], [0.75, 0.92, 0.02]])
        {
            let found = [point.speed, point.restitution, point.restitution_uncertainty.unwrap()];
            let is_near = |(a, b): (f64, f64)| (a - b).abs() < 1e-15;
            let expected = [speed, restitution, uncertainty];
            assert!(found.into_iter().zip(expected).all(is_near), "{text}: {point:?}");
        }
        assert_eq!(read.speeds(), (0.5, 0.75));
        let n_missing = if text.contains("nan") || text.contains("NaN") { 3 } else { 0 };
        assert_eq!(read.n_left_out, n_missing + usize::from(text.contains("false")), "{text}");
        assert_eq!(read.warnings().iter().any(|text| text.starts_with("3 rows")), n_missing > 0);
    }
    // Line numbers are those of the file.
    let table = Table::parse("e.csv", "sep=;\n# x\nv;e\n0,5;0,9\n1;viel\n").unwrap();
    let error = Restitutions::read(&table, spheres().scene()).unwrap_err();
    assert_eq!(error.place(), "e.csv:5");
    let table = Table::parse("e.csv", "v,e\n0.5,\"0,9\"\n").unwrap();
    let error = Restitutions::read(&table, spheres().scene()).unwrap_err();
    assert!(error.help.is_some_and(|help| help.contains("decimal points")));
    for packed in ["PK\u{3}\u{4}\u{14}", "\u{d0}\u{cf}\u{11}\u{e0}\u{a1}"] {
        let error = Table::parse("e.xlsx", packed).unwrap_err();
        assert!(error.help.is_some_and(|help| help.contains("as CSV")), "{packed}");
    }
    let table = Table::parse("e.csv", "v,e\n1,0.9\n").unwrap();
    let error = table.renamed(&[("restitution", "COR")]).unwrap_err();
    assert_eq!(error.to_string(), "e.csv:1: there is no column COR; found are v, e");
}

/// Rows without an uncertainty are left out, or all uncertainties are if most rows have none; a warning reports it.
#[test]
fn rows_without_an_uncertainty_are_counted() {
    for (cells, n_points, is_weighed, words) in [
        (["0.01", "", "0.02"], 2, true, "1 row without an uncertainty left out"),
        (["", "nan", "0.02"], 3, false, "only 1 row with an uncertainty, of 3: none is used"),
        (["0.01", "0.01", "0.02"], 3, true, ""),
    ] {
        let rows = cells.iter().enumerate().map(|(k, cell)| format!("{},0.9,{cell}\n", k + 1));
        let text = format!("v,e,u\n{}", rows.collect::<String>());
        let table = Table::parse("e.csv", &text).unwrap();
        let table = table.renamed(&[("uncertainty", "u")]).unwrap();
        let read = Restitutions::read(&table, spheres().scene()).unwrap();
        assert_eq!((read.points.len(), read.lines.len()), (n_points, n_points), "{text}");
        let weighed = read.points.iter().filter(|p| p.restitution_uncertainty.is_some()).count();
        assert_eq!(weighed, if is_weighed { n_points } else { 0 }, "{text}");
        assert_eq!(read.n_left_out, 0);
        let warnings = read.warnings();
        let is_reported = warnings.iter().any(|warning| warning.starts_with(words));
        assert_eq!(is_reported, !words.is_empty(), "{warnings:?}");
    }
}
