//! Printed numbers are readable: no sixteen digits, no exponent without need, in any command.

use std::ffi::OsString;
use std::path::Path;

use crate::common::{FAILS, Place, Words, set};

/// Returns a number that nobody would write; text for programs is left out.
pub fn odd_number(text: &str) -> Option<&str> {
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
    place.write(
        "sweep.toml",
        "case = 'case.toml'\n[vary]\n'body.0.approach_speed' = { from = '5 cm/s', to = '2 m/s', n = 4, log = true }\nmodel = ['ting']\n",
    );
    let mut commands: Vec<Vec<OsString>> = vec![
        "case.toml --set model=ting".words(),
        "case.toml --set model.ting.finite_size=true --out finite".words(),
        "check case.toml".words(),
        "check case.toml --set model=ting".words(),
        ("fit case.toml --law all --data", [data]).words(),
        "export case.toml".words(),
        "export case.toml --diameters '1 mm,1 in' --out pairs".words(),
        "invert case.toml --restitution 0.9".words(),
        "invert case.toml --restitution 0.2 --law hunt_crossley".words(),
        "materials pmma".words(),
        "sweep sweep.toml".words(),
        ("case.toml --out failed", set(&FAILS)).words(),
    ];
    let cases = std::fs::read_dir(root.join("cases")).unwrap();
    for (k, case) in cases.map(|case| case.unwrap().path()).enumerate() {
        if k % 4 == 0 {
            commands.push(("check", [&case]).words());
        }
        commands.push(([case], "--set model=hertz --out out --force").words());
    }
    for command in commands {
        let ran = place.run(&command);
        for text in [&ran.stdout, &ran.stderr] {
            assert_eq!(odd_number(text), None, "{command:?}: {text}");
        }
    }
}
