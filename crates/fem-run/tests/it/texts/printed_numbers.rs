//! Printed numbers are readable: no sixteen digits, no exponent without need, in any command.

use std::path::Path;

use crate::common::{FAILS, Place};

/// Returns a number that nobody would write; text for programs is left out.
fn odd_number(text: &str) -> Option<&str> {
    // A resolved case has its numbers to the last bit.
    let for_people = text.lines().filter(|line| line.starts_with('#') || !line.contains(" = "));
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '.';
    let words = for_people.flat_map(move |line| line.split(move |c| !is_part(c)));
    let is_number = |word: &&str| word.starts_with(|c: char| c.is_ascii_digit());
    let mut numbers = words.filter(is_number);
    numbers.find(|word| {
        let digits = word.split('e').next().unwrap_or(word);
        let n = digits.trim_start_matches(['0', '.']).matches(|c: char| c.is_ascii_digit()).count();
        (digits.contains('.') && n > 7) || word.ends_with("e0") || n > 15
    })
}

#[test]
fn odd_number_detector_finds_long_digits_and_needless_exponents() {
    for odd in ["5.49602204001348 cm/s", "lost 0.0e0", "x = 1\n1000000000000000.0"] {
        assert!(odd_number(odd).is_some(), "{odd}");
    }
    for fine in ["0.0012345 m", "a = 0.12345678901", "62.82 µs", "1.5e-4", "12,345,678"] {
        assert_eq!(odd_number(fine), None, "{fine}");
    }
}

#[test]
fn no_command_prints_odd_numbers() {
    let place = Place::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let data = root.join("validation/data/bridges_ice.csv");
    let data = data.to_str().unwrap();
    place.write(
        "sweep.toml",
        "case = 'case.toml'\n[vary]\n'body.0.approach_speed' = { from = '5 cm/s', to = '2 m/s', n = 4, log = true }\nmodel = ['ting']\n",
    );
    let mut commands: Vec<Vec<&str>> = vec![
        vec!["case.toml", "--set", "model=ting"],
        vec!["case.toml", "--set", "model.ting.finite_size=true", "--out", "finite"],
        vec!["check", "case.toml"],
        vec!["check", "case.toml", "--set", "model=ting"],
        vec!["fit", "case.toml", "--data", data, "--law", "all"],
        vec!["export", "case.toml"],
        vec!["export", "case.toml", "--diameters", "1 mm,1 in", "--out", "pairs"],
        vec!["invert", "case.toml", "--restitution", "0.9"],
        vec!["invert", "case.toml", "--restitution", "0.2", "--law", "hunt_crossley"],
        vec!["materials", "pmma"],
        vec!["sweep", "sweep.toml"],
    ];
    commands.push([&["case.toml", "--out", "failed"][..], &FAILS].concat());
    let cases: Vec<_> = std::fs::read_dir(root.join("cases")).unwrap().collect();
    let names: Vec<String> =
        cases.into_iter().map(|case| case.unwrap().path().display().to_string()).collect();
    for name in names.iter().step_by(4) {
        commands.push(vec!["check", name]);
    }
    for name in &names {
        commands.push(vec![name, "--set", "model=hertz", "--out", "out", "--force"]);
    }
    for command in commands {
        let ran = place.run(&command);
        for text in [&ran.stdout, &ran.stderr] {
            assert_eq!(odd_number(text), None, "{command:?}: {text}");
        }
    }
}
