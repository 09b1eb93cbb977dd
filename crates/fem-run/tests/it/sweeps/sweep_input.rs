//! Bad sweep files: exit status 2, line and column of the error, nothing written.

use crate::common::{CASE, Place};

/// Runs a sweep file that must be rejected at LINE:COLUMN with a message that contains `expected`.
#[track_caller]
fn refused(sweep: &str, position: &str, expected: &str) {
    let place = Place::new();
    place.write("sweep.toml", sweep);
    let before = place.list(".");
    let ran = place.fails(2, "sweep sweep.toml");
    let start = format!("error: sweep.toml:{position}: ");
    assert!(ran.stderr.starts_with(&start), "wants {start}\n{}", ran.stderr);
    ran.tells(expected);
    assert_eq!(place.list("."), before);
}

/// Returns a sweep with these lines in `[vary]`, which begin at line 3.
fn vary(lines: &str) -> String {
    format!("case = 'case.toml'\n[vary]\n{lines}\n")
}

#[test]
fn files_that_are_no_sweep_are_refused() {
    refused("case = \n", "1:8", "");
    refused("cases = 'case.toml'\n[vary]\na = [1]\n", "1:1", "unknown key|did you mean `case`");
    refused("[vary]\n'body.0.approach_speed' = [1]\n", "1:1", "`case` is missing");
    refused("case = 'missing.toml'\n[vary]\na = [1]\n", "1:8", "missing.toml|no such file");
    refused(&("combine = 'some'\n".to_string() + &vary("a = [1]")), "1:11", "\"all\", \"paired\"");
    refused(
        &("keep = 1\n".to_string() + &vary("a = [1]")),
        "1:8",
        "\"summary\", \"packed\", \"all\"",
    );
    refused("case = 'case.toml'\n", "1:1", "varies no key|[vary]");
    refused("case = 'case.toml'\nvary = 3\n", "2:8", "not a table");
    refused(&vary(""), "2:1", "varies no key");
}

#[test]
fn keys_that_cannot_be_varied_are_refused() {
    refused(&vary("'body.0.approach_sped' = [1]"), "3:9", "unknown key|approach_speed");
    refused(&vary("'body.2.approach_speed' = [1]"), "3:7", "not an index");
    refused(&vary("'body.0..approach_speed' = [1]"), "3:9", "empty");
    refused(&vary("'body.0.name.x' = [1]"), "3:9", "single value");
    refused(&vary("'body.0.approach_speed' = []"), "3:27", "has no values");
    refused(&vary("'body.0.approach_speed' = 1"), "3:27", "not a list|in brackets");
    let ends = "{ from = \"0.1 m/s\", to = \"2 m/s\", n = 10 }";
    refused(&vary("'body.0.approach_speed' = '0.1..2 m/s'"), "3:27", ends);
    refused(&vary("body.0 = {}"), "3:6", "has no values");
    let twice = "'body.0.approach_speed' = [1]\nbody.0.approach_speed = [2]";
    refused(&vary(twice), "4:8", "varied twice");
    let inner = "'body.0.sphere.diameter' = [1e-3]\n'body.0.sphere' = [{ diameter = 1e-3 }]";
    refused(&vary(inner), "4:1", "contains body.0.sphere.diameter");
    let outer = "'body.0' = [1]\n'body.00.sphere' = [{ diameter = 1e-3 }]";
    refused(&vary(outer), "4:1", "is part of body.0");
}

#[test]
fn ranges_and_tables_that_make_no_values_are_refused() {
    let range = |table: &str| vary(&format!("'body.0.approach_speed' = {table}"));
    refused(
        &range("{ from = 1, to = 2 }"),
        "3:27",
        "there is no `n` and no `step`|log = true|step =",
    );
    refused(&range("{ from = 1, to = 2, n = 1 }"), "3:51", "n is 1|2 to");
    refused(&range("{ from = 1, to = 2, n = 3, logs = true }"), "3:54", "unknown key|log");
    refused(&range("{ from = '1 mm', to = '2 s', n = 3 }"), "3:49", "units of the same quantity");
    let scales = vary("scene.temperature = { from = '20 degC', to = '330 K', n = 3 }");
    refused(&scales, "3:46", "units of the same quantity");
    refused(&range("{ from = '1 furlong', to = 2, n = 3 }"), "3:36", "furlong");
    refused(&range("{ from = inf, to = 2, n = 3 }"), "3:36", "not a number");
    refused(&range("{ from = 0, to = 2, n = 3, log = true }"), "3:36", "greater than 0");
    refused(&range("{ from = 1, to = 2, n = 3, step = 1 }"), "3:61", "not both");
    refused(&range("{ from = 1, to = 2, step = 0.3 }"), "3:54", "does not end at `to`|n = 4");
    refused(&range("{ from = 1, to = 2, step = -0.5 }"), "3:54", "does not lead");
    refused(&range("{ from = 1, to = 2, step = 0.5, log = true }"), "3:54", "no step");
    // The range is valid, but its values are not lengths.
    let lengths = vary("'body.0.approach_speed' = { from = '1 m', to = '2 m', n = 3 }");
    refused(&lengths, "3:27", "\"1 m\" is a length");
    refused(&range("{ table = 'none.csv' }"), "3:37", "no such file|a CSV file");
    refused(&range("{ table = 'case.toml' }"), "3:37", "case.toml");
    let linked = "'body.0.approach_speed, body.1.approach_speed' =";
    refused(
        &vary(&format!("{linked} {{ table = 'a', columns = ['v'] }}")),
        "3:75",
        "1 columns for 2",
    );
    refused(&vary("'body.0.approach_speed, body.0.approach_speed' = [1]"), "3:1", "varied twice");
    refused(&vary("'body.0.approach_speed, ' = [1]"), "3:25", "empty");
}

#[test]
fn sweep_value_that_makes_an_invalid_case_is_marked() {
    let speed = "'body.0.approach_speed' = ['1 m/s', 0.5, '2 m']";
    refused(&vary(speed), "3:42", "length|\"0.5 m/s\"");
    refused(&vary("body.0.sphere.diameter = [0.01,\n  nan]"), "4:3", "diameter");
    refused(&vary("material.glass.density = [2390, true]"), "3:33", "density");
    // The key that becomes invalid is in the base case; the message gives its position.
    let names = "'body.1.sphere.diameter' = [1e-2]\n'body.1.name' = ['other', 'striker']";
    refused(&vary(names), "4:27", "striker");
    let materials = "'body.0.material' = ['glass', 'glas']";
    refused(&vary(materials), "3:31", "did you mean");
    let poisson = "material.glass = [{ density = 2390, youngs_modulus = 1e9 }]";
    refused(&vary(poisson), "3:19", "poissons_ratio");
    let both = "'body.0.material' = ['glass']\n'body.1.name' = ['target', 'striker']\n\
                body.0.approach_speed = [1, 2]";
    refused(&vary(both), "4:28", "striker");
    // Too expensive: the limit is in the list, the element size in the base case.
    let limit = "limits.elements = [1e6, 100]";
    refused(&vary(limit), "3:25", "elements|the member is limits.elements = 100");
}

#[test]
fn lists_that_do_not_fit_are_refused() {
    let lists = "body.0.approach_speed = [1, 2]\nbody.1.approach_speed = [1, 2, 3]";
    let paired = format!("combine = 'paired'\n{}", vary(lists));
    refused(&paired, "5:8", "has 3 values|has 2 values");
    let few = format!("max_members = 5\n{}", vary(lists));
    refused(&few, "3:1", "the sweep has 6 members|at most 5|max_members");
    refused(&format!("max_members = 0.5\n{}", vary(lists)), "1:15", "whole number");
    let speeds: Vec<_> = (1..=101).map(|n| format!("{n}e-2")).collect();
    let many = format!("[{}]", speeds.join(","));
    let many = format!("body.0.approach_speed = {many}\nbody.1.approach_speed = {many}");
    refused(&vary(&many), "2:1", "10201 members|at most 10000");
}

#[test]
fn sweep_plots_of_unknown_columns_are_rejected() {
    let lists = "'body.0.approach_speed' = [1, 2]\n'body.0.name' = ['a', 'b']\n[plot]\n";
    let plot = |line: &str| vary(&format!("{lists}{line}"));
    refused(&plot("x = 'body.1.approach_speed'"), "6:5", "not varied|body.0.approach_speed");
    refused(&plot("x = 'body.0.name'"), "6:5", "are not numbers");
    refused(&plot("y = ['restitution', 'contact_time']"), "6:21", "contact_time_s");
    refused(&plot("y = []"), "6:5", "no column");
    refused(&plot("series = 'body.0.approach_speed'"), "6:10", "same key");
    refused(&plot("z = 'restitution'"), "6:1", "unknown key|series");
}

#[test]
fn faults_of_base_case_and_overrides_are_attributed_to_their_source() {
    let place = Place::with(&crate::common::CASE.replace("63 GPa", "63 Gpa"));
    place.write("sweep.toml", &vary("body.0.approach_speed = [1]"));
    let ran = place.run("sweep sweep.toml");
    assert!(ran.stderr.starts_with("error: case.toml:5:18: unknown unit"), "{}", ran.stderr);
    let place = Place::new();
    place.write("sweep.toml", &vary("body.0.approach_speed = [1]"));
    for (set, expected) in [
        ("mesh.size=1", "unknown key"),
        ("body.0.approach_speed=2", "varies body.0.approach_speed"),
        ("nonsense", "no `=`"),
    ] {
        let ran = place.fails(2, ["sweep", "sweep.toml", "--set", set]);
        assert!(ran.stderr.starts_with("error: --set "), "{}", ran.stderr);
        ran.tells(expected);
    }
    for (arguments, expected) in [
        (&["sweep", "missing.toml"][..], "sweep file"),
        (&["sweep", "sweep.toml", "--shard", "0/3"], "K/N"),
        (&["sweep", "sweep.toml", "--shard", "4/3"], "K/N"),
        (&["sweep", "sweep.toml", "--threads", "0"], "--threads"),
    ] {
        place.fails(2, arguments).tells(expected);
    }
    assert_eq!(place.list("."), ["case.toml", "sweep.toml"]);
}

/// All errors are reported at once, in the order of the file, each once.
#[test]
fn all_faults_of_a_sweep_file_are_reported_at_once() {
    let places = |sweep: &str| {
        let place = Place::new();
        place.write("sweep.toml", sweep);
        let ran = place.fails(2, "sweep sweep.toml");
        let heads = ran.stderr.lines().filter_map(|line| line.split_once("sweep.toml:"));
        let places = heads.map(|(_, rest)| rest.split(": ").next().unwrap_or_default().to_string());
        (places.collect::<Vec<_>>(), ran.stderr)
    };
    // Errors of the file itself.
    let (found, stderr) = places(
        "case = 'none.toml'\ncombin = 'all'\nkeep = 'some'\n[vary]\n'body.0.approach_speed' = []\n\
         'body.1.approach_speed' = 3\nbody.0.sphere.diameter = { from = 1, to = 2 }\n[plot]\nz = 1\n",
    );
    assert_eq!(found, ["1:8", "2:1", "3:8", "5:27", "6:27", "7:26", "9:1"], "{stderr}");
    // Errors of values, each combined with valid ones of the other lists.
    let (found, stderr) = places(&vary(
        "body.0.sphere.diameter = ['1 cm', '1 kg', -1]\nbody.0.approach_speed = [nan, 1, '2 m']\n\
         body.1.name = ['a', 'striker']",
    ));
    assert_eq!(found, ["3:35", "3:43", "4:26", "4:34", "5:21"], "{stderr}");
    // Keys without any valid value hide no other errors.
    let (found, stderr) = places(&vary(
        "'body.0.aproach_speed' = ['1 m/s', '2 kg']\nbody.0.sphere.diameter = ['1 cm', '-2 mm']\n\
         modell = ['ting']",
    ));
    assert_eq!(found, ["3:9", "4:35", "5:1"], "{stderr}");
}

/// Warnings of members are printed once, with the number of members and the first one, where nothing else
/// says so.
#[test]
fn warnings_of_sweep_members_are_printed_once() {
    let place = Place::new();
    place.write("sweep.toml", &vary("'body.0.approach_speed' = [0.5, 0.6, 0.7]"));
    let set = "model={ ting = {} }";
    let library = "body=[{ name='a', sphere.diameter='1 m', material='lib:steel', approach_speed=1 }, \
                   { name='b', sphere.diameter='1 m', material='lib:steel' }]";
    let arguments = ["sweep", "sweep.toml", "--quiet", "--set", set, "--set", library];
    // A finished sweep prints them again.
    for _ in 0..2 {
        let ran = place.succeed(arguments);
        let told: Vec<&str> =
            ran.stderr.lines().filter(|line| line.contains("yields from")).collect();
        assert!(told.len() == 1 && told[0].starts_with("warning: a yields from"), "{}", ran.stderr);
        assert!(
            told[0].contains("3 members") && told[0].contains("= 0.5, last in "),
            "{}",
            ran.stderr
        );
        assert_eq!(ran.stdout, "");
    }
}

/// A step in place of the number of values, in another unit than the ends; a range of temperatures, on scales with an offset, whose
/// step is one of degrees; and ends in two units of one quantity, which are as written, the others in the unit of the last. A bare
/// number is SI.
#[test]
fn ranges_have_the_units_of_their_ends() {
    let (speed, temperature) = ("body.0.approach_speed", "scene.temperature");
    for (key, range, expected) in [
        (
            speed,
            "from = '50 cm/s', to = '2 m/s', step = '500 mm/s'",
            &["50 cm/s", "1 m/s", "1.5 m/s", "2 m/s"][..],
        ),
        (
            temperature,
            "from = '-20 degC', to = '20 degC', step = '20 degC'",
            &["-20 degC", "0 degC", "20 degC"],
        ),
        (speed, "from = '50 mm/s', to = '2 m/s', n = 3, log = true", &["50 mm/s", "2 m/s"]),
        (speed, "from = '50 mm/s', to = 2, n = 3, log = true", &["50 mm/s", "2.0"]),
    ] {
        let place = Place::new();
        place.write("sweep.toml", &vary(&format!("{key} = {{ {range} }}")));
        let relaxing = "--set model.ting={} --set body.1.material='lib:pvb'";
        place.succeed(("sweep sweep.toml --quiet --out runs/sweep", relaxing));
        let table = place.text("runs/sweep/sweep.csv");
        let mut texts: Vec<_> =
            table.lines().skip(1).filter_map(|row| row.split(',').next()).collect();
        if range.contains("log") {
            // The geometric mean: √(0.05 · 2) m/s.
            let middle: f64 = texts.remove(1).trim_end_matches(" m/s").parse().unwrap();
            assert!((middle - 0.1f64.sqrt()).abs() < 1e-15, "{middle}");
        }
        assert_eq!(texts, expected);
        // The picture has the scale of the user.
        let svg = place.text("runs/sweep/sweep.svg");
        let is_warm = svg.contains(">temperature [°C]<") && svg.contains(">\u{2212}20<");
        assert_eq!(is_warm, key == temperature, "{key}");
    }
}

/// A list of diameters without a unit is one of metres: it is rejected with its place in the sweep file.
#[test]
fn bare_numbers_of_a_sweep_need_their_unit() {
    let place = Place::new();
    let sweep = |values: &str| {
        place.write(
            "sweep.toml",
            &format!("case = 'case.toml'\n[vary]\nbody.0.sphere.diameter = {values}\n"),
        );
        place.run("sweep sweep.toml --dry-run --set model.ting={}")
    };
    let ran = sweep("[0.01, 10]");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    ran.tells("sweep.toml:3|diameter = \"10 mm\"");
    assert_eq!(sweep("['1 cm', '10 m']").code, Some(0));
}

/// Members whose tolerance no mesh meets are warned of before any is computed, and not those of models without a mesh.
#[test]
fn a_tolerance_that_no_mesh_meets_is_warned_of() {
    let place = Place::with(CASE.split("[mesh]").next().unwrap());
    place.write("sweep.toml", &vary("accuracy.tolerance = [1e-2, 1e-5]"));
    place
        .succeed("sweep sweep.toml --dry-run")
        .tells("accuracy.tolerance cannot be met|(1 member: accuracy.tolerance = 1e-5)");
    assert_eq!(place.succeed("sweep sweep.toml --dry-run --quiet --set model.ting={}").stderr, "");
}
