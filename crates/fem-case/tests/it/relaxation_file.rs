//! `[material.NAME.relaxation]`: files, temperatures and shift laws.

use std::path::Path;

use fem_case::{Case, CaseError};

use crate::{BALL_ON_WALL, parse_in};

const POLYMER: &str = r#"
    material.solid = { density = 1200, youngs_modulus = "2 GPa", poissons_ratio = 0.35,
        relaxation.file = "polymer.relaxation.toml" }"#;

const SERIES: &str = r#"# a series
acts_on = "all"
band = { from = 0.01, to = 100 }
reference_temperature = 293.15
shift = { wlf = { c1 = 10, c2 = 100 } }
terms = [{ weight = 0.3, relaxation_time = 1e-3 }, { weight = 0.2, decay_rate = 10 }]
"#;

fn parse(series: &str, overrides: &[&str]) -> Result<Case, CaseError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("polymer.relaxation.toml"), series).unwrap();
    parse_in(folder.path(), "ball.toml", &format!("{POLYMER}{BALL_ON_WALL}"), overrides)
}

fn times(case: &Case) -> Vec<f64> {
    let material = case.scene().bodies()[0].material().unwrap();
    material.relaxation().unwrap().terms().iter().map(|term| term.relaxation_time).collect()
}

#[test]
fn a_file_gives_the_series_and_the_temperature_shifts_it() {
    let case = parse(SERIES, &[]).unwrap();
    assert_eq!(times(&case), [1e-3, 0.1]);
    let measured = case.scene().bodies()[0].measured().unwrap();
    assert_eq!(measured.frequencies, Some([0.01, 100.0]));
    assert!(case.scene().reference_temperatures().unwrap().contains("20.0 degC"));
    // The case is independent of the file: its identity has the content.
    let written = case.file().to_toml().unwrap();
    assert!(written.contains("0.3") && !written.contains("relaxation.toml"));
    let again = Case::parse("ball.toml", &written, Path::new("/nowhere"), &[]).unwrap();
    assert_eq!(again.scene().bodies(), case.scene().bodies());
    // 10 K above the reference, log10 a_T is −10 · 10/110.
    let factor = 10f64.powf(-100.0 / 110.0);
    for temperature in ["'30 degC'", "303.15", "'86 °F'"] {
        let case = parse(SERIES, &[&format!("scene.temperature={temperature}")]).unwrap();
        for (time, known) in times(&case).into_iter().zip([1e-3, 0.1]) {
            assert!((time / known / factor - 1.0).abs() < 1e-9, "{temperature}: {time}");
        }
        let [from, to] = case.scene().bodies()[0].measured().unwrap().frequencies.unwrap();
        assert!((from * factor / 0.01 - 1.0).abs() < 1e-9 && to > from);
        assert!(case.scene().reference_temperatures().is_none());
        let written = case.file().to_toml().unwrap();
        let again = Case::parse("ball.toml", &written, Path::new("/nowhere"), &[]).unwrap();
        assert_eq!(times(&again), times(&case));
    }
    let case = parse(SERIES, &["scene.temperature='30 ± 2 degC'"]).unwrap();
    let input = &case.scene().uncertain_inputs()[0];
    assert_eq!((input.key.as_str(), input.uncertainty), ("scene.temperature", 2.0));
    let arrhenius = "{ arrhenius = { activation_temperature = 20000 } }";
    let series = SERIES.replace("{ wlf = { c1 = 10, c2 = 100 } }", arrhenius);
    let found = times(&parse(&series, &["scene.temperature=303.15"]).unwrap())[0] / 1e-3;
    assert!((found.ln() - 2e4 * (1.0 / 303.15 - 1.0 / 293.15)).abs() < 1e-9);
    let table = "{ table = [['10 degC', 1], ['20 degC', 0], ['40 degC', -1]] }";
    let series = SERIES.replace("{ wlf = { c1 = 10, c2 = 100 } }", table);
    let found = times(&parse(&series, &["scene.temperature=303.15"]).unwrap())[0] / 1e-3;
    assert!((found.log10() + 0.5).abs() < 1e-9, "{found}");
}

#[test]
fn faults_of_files_and_temperatures_have_one_answer() {
    let shift = "shift = { wlf = { c1 = 10, c2 = 100 } }\n";
    let reference = "reference_temperature = 293.15\n";
    let check = |series: &str, overrides: &[&str], expected: &str| {
        let error = parse(series, overrides).expect_err(series).to_string();
        assert!(error.contains(expected), "{series}{overrides:?}\n{error}\nlacks {expected}");
    };
    // Whole files.
    for (series, expected) in [
        ("", "the key `acts_on` is missing in material.solid.relaxation"),
        ("acts_on = 'all'\n", "at least one term"),
        (
            "acts_on = 'all'\nterms = [{ wait = 1 }]\n",
            "polymer.relaxation.toml:2: unknown field `wait`",
        ),
        ("acts_on = \n", "polymer.relaxation.toml:1: "),
        ("file = 'other.toml'\n", "polymer.relaxation.toml names another file"),
    ] {
        check(series, &[], expected);
    }
    // Overrides of a valid one.
    for (set, expected) in [
        ("material.solid.relaxation.file='none.toml'", "none.toml: there is no such file"),
        ("material.solid.relaxation.acts_on='all'", "relaxation has file and other keys"),
        ("scene.temperature='-90 degC'", "shift has no value at the temperature -90.0 degC"),
        ("scene.temperature='hot'", "its scale is degC, K or degF"),
        ("scene.temperature=-3", "temperature is -3.0 K"),
    ] {
        check(SERIES, &[set], expected);
    }
    let without = SERIES.replace(shift, "");
    check(&without, &["scene.temperature=300"], "no material depends on the temperature");
    // Parts of a valid one.
    for (part, wrong, expected) in [
        (shift, "shift = {}\n", "shift is exactly one law"),
        (shift, "shift = { wlf = { c1 = 10, c2 = 0 } }\n", "c2 is 0"),
        (shift, "shift = { table = [[300, 0], [290, 1]] }\n", "the temperatures do not rise"),
        (reference, "", "shift needs reference_temperature"),
        ("100 }", "0.001 }", "the band ends below its beginning"),
        ("100 }", "100, loss_uncertainty = [[1, 2]] }", "loss_uncertainty is 2.0"),
        ("100 }", "100, loss_uncertainty = [[1, 0.1], [1, 0.2]] }", "the frequencies do not rise"),
    ] {
        check(&SERIES.replacen(part, wrong, 1), &[], expected);
    }
}
