//! `fem-run measure` on the command line.

use std::time::{Duration, Instant};

use crate::common::Place;

const BOUNCES: &str = include_str!("../../../../../validation/data/bounce_times.csv");

#[test]
fn bounce_times_become_a_table_that_fit_and_calibrate_read() {
    let place = Place::new();
    place.write("drop.csv", BOUNCES);
    let ran = place.succeed("measure drop.csv --height '50 cm ± 1 mm'");
    ran.prints("13 restitutions|3.1316 ± 0.0031 m/s|by the scatter|air drag neglected");
    assert_eq!(place.list("runs/drop_measure"), ["measure.csv", "measure.json", "measure.svg"]);
    let numbers = place.json("runs/drop_measure/measure.json");
    assert_eq!(numbers["kind"], "bounce-times");
    assert_eq!(numbers["impacts"].as_array().unwrap().len(), 13);
    // The data are made with e = 0.95 − 0.02 v/(m/s); the first impact has 3.13 m/s.
    let e = numbers["impacts"][0]["restitution"].as_f64().unwrap();
    assert!((e - 0.8874).abs() < 1e-3, "{e}");
    let table = "--data runs/drop_measure/measure.csv";
    place.succeed(("fit case.toml --law kuwabara_kono --out fit", table));
    let fit = place.json("fit/fit.json");
    assert_eq!((&fit["weighted"], &fit["points"]), (&true.into(), &13.into()));
    assert!(!fit["warnings"].to_string().contains("not read"), "{}", fit["warnings"]);
    place.succeed(("calibrate case.toml --terms 1 --model ting --out calibrate -q", table));
}

#[test]
fn options_of_a_record_are_checked() {
    let place = Place::new();
    place.write("drop.csv", BOUNCES);
    place.write("two.csv", "time_ms\n400\n1000\n");
    for (options, expected) in [
        ("drop.csv --kind film", "a record is one of bounce-times"),
        ("drop.csv --gravity 0", "--gravity is 0.0"),
        ("drop.csv --gravity '9.8 m'", "is not an acceleration"),
        ("drop.csv --diameter 1cm", "air drag needs the diameter and the density"),
        ("drop.csv --columns time=when", "there is no column when; found are time_s"),
        ("drop.csv --rest 2s", "the ball is at rest at 2 s and bounces at"),
        ("two.csv", "two instants are one flight"),
        ("none.csv", "there is no such file"),
    ] {
        let ran = place.fails(2, &format!("measure {options}"));
        ran.tells(expected);
        assert_eq!(ran.stderr.matches("error: ").count(), 1, "{}", ran.stderr);
        assert!(!place.path("runs").exists());
    }
    place.succeed("measure two.csv --height 1m").prints("restitution 0.66");
}

/// A list of 100,000 instants, and one that no ball makes, end within the two seconds that a user waits.
#[test]
#[allow(clippy::disallowed_methods, reason = "the test measures the time of a command")]
fn hostile_lists_end_soon() {
    let place = Place::new();
    let many: String = (0..100_000).map(|k| format!("{}\n", f64::from(k) * 1e-3)).collect();
    place.write("many.csv", &format!("time_s\n{many}"));
    let fast: String = (0..900).map(|k| format!("{}\n", f64::from(k) * 1e-3)).collect();
    place.write("fast.csv", &format!("time_s\n{fast}"));
    for options in ["many.csv", "fast.csv"] {
        let started = Instant::now();
        let ran = place.fails(2, &format!("measure {options} --diameter 1cm --density 8000"));
        assert_eq!(ran.stderr.matches("error: ").count(), 1, "{}", ran.stderr);
        assert!(ran.stderr.len() < 1000, "{}", ran.stderr);
        // Tests run side by side, and without optimisation.
        assert!(started.elapsed() < Duration::from_secs(10), "{options}");
    }
}
