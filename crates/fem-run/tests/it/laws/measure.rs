//! `fem-run measure` on the command line.

use std::time::{Duration, Instant};

use crate::common::Place;

const BOUNCES: &str = include_str!("../../../../../validation/data/bounce_times.csv");
const TRACK: &str = include_str!("../../../../../validation/data/ball_track.csv");
const FORCE: &str = include_str!("../../../../../validation/data/ball_force.csv");

#[test]
fn bounce_times_become_a_table_that_fit_and_calibrate_read() {
    let place = Place::new();
    place.write("drop.csv", BOUNCES);
    let ran = place.succeed("measure drop.csv --height '50 cm ± 1 mm'");
    ran.prints("13 restitutions|3.1316 ± 0.0031 m/s|by the scatter|air drag neglected");
    assert_eq!(place.list("runs/drop_measure"), ["measure.csv", "measure.json", "measure.svg"]);
    let numbers = place.json("runs/drop_measure/measure.json");
    assert_eq!(numbers["kind"], "bounces");
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
    // What scripts rely on: the numbers alone on stdout, and the table where they want it.
    let ran = place
        .succeed("measure drop.csv --kind bounces --height '50 cm ± 1 mm' --json --out table.csv");
    let printed: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(printed["events"].as_array().unwrap().len(), 14);
    assert_eq!(printed["velocities"].as_array().unwrap().len(), 13);
    let of = |key: &str| printed["restitution"][key].as_f64().unwrap();
    assert!((of("value") - 0.91).abs() < 0.01 && of("uncertainty") < 1e-3, "{printed}");
    assert_eq!(place.text("table.csv"), place.text("runs/drop_measure/measure.csv"));
    // Another name of the kind from before, and a file that is not a table of the program.
    place.succeed("measure drop.csv --kind bounces --out table.csv -q");
    place.write("notes.csv", "mine\n");
    place.fails(2, "measure drop.csv --out notes.csv").tells("notes.csv: this file is not a table");
    place.succeed("measure drop.csv --out notes.csv --force");
}

/// The data are made with e = 0.85 − 0.02 v/(m/s) and 0.82 − 0.03 v/(m/s).
#[test]
fn tracks_and_forces_become_tables() {
    let place = Place::new();
    place.write("track.csv", TRACK);
    place.write("force.csv", FORCE);
    let e = |folder: &str, k: usize| {
        let numbers = place.json(&format!("runs/{folder}/measure.json"));
        let impact = &numbers["impacts"][k];
        let of = |key: &str| impact[key].as_f64().unwrap();
        [of("speed_m_s"), of("restitution"), of("restitution_uncertainty")]
    };
    place.succeed("measure track.csv").prints("4 restitutions|fitted g: 9.80|318 frames");
    let [speed, restitution, uncertainty] = e("track_measure", 0);
    assert!((restitution - 0.85 + 0.02 * speed).abs() < 3.0 * uncertainty);
    let ran = place.succeed("measure force.csv --mass '10 g ± 0.02 g' --height '3 cm ± 0.1 mm'");
    ran.prints("2 restitutions|peak force|contact time at 10 %|1.180 ms|noise of a sample: 27 mN");
    for k in 0..2 {
        let [speed, restitution, uncertainty] = e("force_measure", k);
        assert!((restitution - 0.82 + 0.03 * speed).abs() < 3.0 * uncertainty);
    }
    // The contact times are data of a fit too.
    let table = "--data runs/force_measure/measure.csv";
    let ran =
        place.succeed(("fit case.toml --law linear --contact-time --free c,k --out fit", table));
    assert!(!ran.stderr.contains("not read"), "{}", ran.stderr);
    for kind in ["track", "force"] {
        let svg = place.text(format!("runs/{kind}_measure/measure.svg"));
        assert!(svg.starts_with("<svg") && svg.contains("restitution"), "{kind}");
    }
}

#[test]
fn options_of_a_record_are_checked() {
    let place = Place::new();
    place.write("drop.csv", BOUNCES);
    place.write("force.csv", FORCE);
    place.write("two.csv", "time_ms\n400\n1000\n");
    for (options, expected) in [
        ("drop.csv --kind film", "possible values: bounces, track, force, sound"),
        ("drop.csv --gravity 0", "--gravity is 0"),
        ("drop.csv --gravity '9.8 m'", "is not an acceleration"),
        ("drop.csv --diameter 1cm", "air drag needs the diameter and the density"),
        ("drop.csv --diameter 1cm --density '1 kg/m^3'", "a ball of 1 kg/m³ does not fall in air"),
        ("drop.csv --height '50 cm ± 3 % cm'", "is not a length"),
        ("drop.csv --columns time=when", "there is no column when; found are time_s"),
        ("drop.csv --rest 2s", "the ball is at rest at 2 s and bounces at"),
        ("force.csv", "the 2 pulses give no restitution|--mass of the moving body"),
        ("force.csv --mass 10g --speed 1m/s --sensor-mass 20g", "the mass in front of the sensor"),
        ("force.csv --kind track", "there is no column height; found are time_ms, force_n"),
        ("two.csv", "two instants are one flight"),
        ("none.csv", "there is no such file"),
    ] {
        let ran = place.fails(2, &format!("measure {options}"));
        ran.tells(expected);
        assert_eq!(ran.stderr.matches("error: ").count(), 1, "{}", ran.stderr);
        assert!(!place.path("runs").exists());
    }
    // The flight between the pulses gives the speed of the second one.
    let ran = place.succeed("measure force.csv --mass 10g");
    ran.prints("restitution 0.80");
    ran.tells("the pulse at 0.0040 s gives no restitution: --speed or --height");
    place.succeed("measure two.csv --height 1m").prints("restitution 0.66");
}

/// Returns a WAV file (16 bits, one channel) of bursts at these times, s.
fn wav(rate: u32, seconds: f64, bursts: &[(f64, f64)]) -> Vec<u8> {
    let n = (seconds * f64::from(rate)) as usize;
    let sample = |k: usize| {
        let time = k as f64 / f64::from(rate);
        let burst = |(start, size): &(f64, f64)| {
            let s = time - start;
            if (0.0..0.03).contains(&s) {
                size * (-s / 2e-3).exp() * (2.5e4 * s).sin()
            } else {
                0.0
            }
        };
        let hum = 0.02 * (300.0 * time).sin() + 1e-3 * ((k * 7919 % 1009) as f64 / 504.0 - 1.0);
        let value: f64 = bursts.iter().map(burst).sum::<f64>() + hum;
        ((value * 32_767.0).clamp(-32_768.0, 32_767.0) as i16).to_le_bytes()
    };
    let data: Vec<u8> = (0..n).flat_map(sample).collect();
    let size = u32::try_from(data.len()).unwrap();
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((36 + size).to_le_bytes());
    bytes.extend(b"WAVEfmt ");
    bytes.extend(16u32.to_le_bytes());
    bytes.extend([1, 0, 1, 0]);
    bytes.extend(rate.to_le_bytes());
    bytes.extend((2 * rate).to_le_bytes());
    bytes.extend([2, 0, 16, 0]);
    bytes.extend(b"data");
    bytes.extend(size.to_le_bytes());
    bytes.extend(data);
    bytes
}

/// A minute of sound with 48,000 samples per second, as a WAV file and as a table of 2.9 million rows, ends within the two
/// seconds that a user waits; so does a minute of noise.
#[test]
#[allow(clippy::disallowed_methods, reason = "the test measures the time of a command")]
fn a_minute_of_sound_is_measured_soon() {
    let place = Place::new();
    let (mut time, mut flight, mut bursts) = (1.0, 0.6, Vec::new());
    while flight > 0.05 {
        bursts.push((time, flight));
        time += flight;
        flight *= 0.85;
    }
    let bytes = wav(48_000, 60.0, &bursts);
    std::fs::write(place.path("drop.wav"), &bytes).unwrap();
    std::fs::write(place.path("cut.wav"), &bytes[..400_000]).unwrap();
    std::fs::write(place.path("noise.wav"), wav(48_000, 60.0, &[])).unwrap();
    let row = |(k, pair): (usize, &[u8])| {
        format!("{:.7},{}\n", k as f64 / 48e3, i16::from_le_bytes([pair[0], pair[1]]))
    };
    let rows: String = bytes[44..].chunks_exact(2).enumerate().map(row).collect();
    place.write("drop.csv", &format!("Recorder,X1\nTIME,CH1\n{rows}"));
    for (options, expected) in [
        ("drop.wav", "restitution"),
        ("drop.csv", "restitution"),
        ("cut.wav", "restitution"),
        ("noise.wav", "no bounce stands out from the noise"),
    ] {
        let started = Instant::now();
        let ran = place.run(&format!("measure {options} --out {}", options.replace('.', "_")));
        assert!(
            format!("{}{}", ran.stdout, ran.stderr).contains(expected),
            "{options}: {}",
            ran.stderr
        );
        assert_eq!(ran.code, Some(if options == "noise.wav" { 2 } else { 0 }), "{options}");
        // Tests run side by side, and without optimisation.
        assert!(started.elapsed() < Duration::from_secs(20), "{options}: {:?}", started.elapsed());
    }
    for folder in ["drop_wav", "drop_csv"] {
        let numbers = place.json(&format!("{folder}/measure.json"));
        let impacts = numbers["impacts"].as_array().unwrap();
        assert_eq!(impacts.len(), bursts.len() - 2, "{}", numbers["warnings"]);
        for impact in impacts {
            let of = |key: &str| impact[key].as_f64().unwrap();
            assert!((of("restitution") - 0.85).abs() < 1e-3 + 3.0 * of("restitution_uncertainty"));
        }
    }
    for (bytes, expected) in [
        (&b"RIFF\x04\0\0\0AVI LIST"[..], "no WAV file"),
        (b"RIFF\x04\0\0\0WAVEfmt \x10\0\0\0\x55\0\x01\0", "the format of the samples"),
    ] {
        std::fs::write(place.path("bad.wav"), bytes).unwrap();
        place.fails(2, "measure bad.wav").tells(expected);
    }
    place
        .fails(2, "measure drop.wav --kind track")
        .tells("a WAV file is a record of the kind sound");
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
