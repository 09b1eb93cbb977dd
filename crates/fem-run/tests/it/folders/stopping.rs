//! Runs that do not end by themselves.

use std::path::Path;

use crate::common::{FAILS, Place, set};

#[test]
fn failed_run_states_cause_and_fix_and_keeps_its_results() {
    let place = Place::new();
    let ran = place.fails(1, ("case.toml --out runs/case", set(&FAILS)));
    ran.tells("error: |step|likely cause: |remedy: |runs/case");
    ran.prints("INCOMPLETE");
    let summary = place.json("runs/case/summary.json");
    assert_eq!(summary["complete"], false);
    assert!(summary["stopped_because"].as_str().unwrap().contains("folds at the radius"));
    for key in ["restitution", "contact_time_s"] {
        assert!(summary[key].is_null(), "{key}");
    }
    assert!(summary["bodies"][0]["velocity_after_m_s"].is_null());
    assert!(summary["peak_force_n"].as_f64().unwrap() > 0.0);
    let warnings = summary["warnings"].to_string();
    assert!(warnings.contains("stopped early"), "{warnings}");
    let history = place.text("runs/case/history.csv");
    assert!(history.lines().count() > 3);
    // The last valid state is in the collection and in a picture.
    let files = summary["files"].as_array().unwrap();
    for ending in ["_last-sound.vtu", "_last-sound.svg"] {
        let of = |file: &&serde_json::Value| file.as_str().unwrap().ends_with(ending);
        let name = files.iter().find(of).unwrap_or_else(|| panic!("{ending}: {files:?}"));
        let text =
            String::from_utf8(place.read(Path::new("runs/case").join(name.as_str().unwrap())));
        assert!(!text.unwrap().contains("NaN"), "{ending}");
    }
    let collection = place.text("runs/case/case.pvd");
    assert!(collection.contains("_last-sound.vtu"), "{collection}");
}

#[cfg(unix)]
mod signals {
    use std::io::{BufRead, BufReader, Read};
    use std::process::{Child, Stdio};

    use nix::sys::signal::Signal;

    use super::*;
    use crate::folders::send;

    /// A mesh so fine that the run would take hours.
    const ENDLESS: [&str; 4] =
        ["--set", "mesh.contact_element_size=6e-6", "--set", "time.step_factor=1e-2"];

    /// Starts an endless run and waits for its first line.
    fn start(place: &Place, more: &[&str]) -> (Child, BufReader<impl Read + use<>>) {
        let mut command = place.command(("case.toml", ENDLESS, more));
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut stderr = BufReader::new(child.stderr.take().unwrap());
        let mut line = String::new();
        stderr.read_line(&mut line).unwrap();
        assert!(line.contains("elements"), "{line}");
        (child, stderr)
    }

    /// Sends signals, which end the run in an orderly way, and returns its summary.
    fn interrupted(
        place: &Place,
        (mut child, mut stderr): (Child, BufReader<impl Read>),
        signals: &[Signal],
    ) -> serde_json::Value {
        for signal in signals {
            send(&child, *signal);
        }
        let mut message = String::new();
        stderr.read_to_string(&mut message).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130), "{message}");
        assert!(message.contains("interrupted at"), "{message}");
        assert_eq!(place.list("runs"), ["case"]);
        let summary = place.json("runs/case/summary.json");
        assert_eq!(summary["complete"], false);
        summary
    }

    /// `timeout` and some shells send one signal to the process and one to its group: they count as one.
    #[test]
    fn interrupted_run_writes_its_results_so_far() {
        let twice = &[Signal::SIGINT; 2][..];
        // Batch systems send the last two; that of the CPU limit comes again every second.
        let of_batch_systems = [&[Signal::SIGUSR1][..], &[Signal::SIGXCPU; 3]];
        let of_users = [&[Signal::SIGINT][..], &[Signal::SIGTERM], &[Signal::SIGHUP]];
        for signals in of_users.into_iter().chain(of_batch_systems).chain([twice; 3]) {
            let place = Place::new();
            let summary = interrupted(&place, start(&place, &[]), signals);
            assert!(summary["stopped_because"].as_str().unwrap().contains("interrupted"));
            let history = place.text("runs/case/history.csv");
            assert!(history.lines().count() >= 2, "{history}");
        }
    }

    #[test]
    fn condensed_bodies_are_interrupted_too() {
        let place = Place::new();
        let slow = ["--set", "model.condensed={steps=100000, vibration_modes=30}"];
        let fine = ["--set", "mesh.contact_element_size=20e-6"];
        let started = start(&place, &[slow, fine].concat());
        let summary = interrupted(&place, started, &[Signal::SIGINT]);
        assert!(summary["bodies"][0]["mass_kg"].as_f64().unwrap() > 0.0);
    }

    /// The collision takes seconds, within which nothing could be kept.
    #[test]
    fn a_model_without_steps_ends_at_once_and_writes_nothing() {
        let place = Place::new();
        let term = |k: i32| {
            let time = 10f64.powf(-6.0 + f64::from(k) / 30.0);
            format!("{{ weight = 0.016, relaxation_time = {time:e} }}")
        };
        let terms: Vec<String> = (0..60).map(term).collect();
        let case = format!(
            "material.gel = {{ density = 1200, youngs_modulus = 2e9, poissons_ratio = 0.4, \
             relaxation = {{ acts_on = \"all\", terms = [{}] }} }}\nmodel = \"ting\"\n\
             [[body]]\nname = \"block\"\nhalf_space = {{}}\nmaterial = \"gel\"\n\
             [[body]]\nname = \"ball\"\nsphere = {{ diameter = 0.01 }}\nmaterial = \"gel\"\napproach_speed = 0.1\n",
            terms.join(", ")
        );
        place.write("gel.toml", &case);
        let mut command = place.command("gel.toml");
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let mut stderr = BufReader::new(child.stderr.take().unwrap());
        let mut text = String::new();
        stderr.read_line(&mut text).unwrap();
        assert!(text.contains("seconds at most"), "{text}");
        send(&child, Signal::SIGINT);
        stderr.read_to_string(&mut text).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130), "{text}");
        assert!(text.ends_with("error: interrupted; no result was written\n"), "{text}");
        assert!(!place.path("runs/gel").exists());
    }

    #[test]
    fn only_an_interrupted_run_with_force_replaces_an_older_result() {
        let place = Place::new();
        place.succeed("case.toml --set model=ting");
        let before = place.read("runs/case/summary.json");
        let (mut child, _stderr) = start(&place, &[]);
        child.kill().unwrap();
        child.wait().unwrap();
        assert_eq!(place.read("runs/case/summary.json"), before);
        place.succeed("case.toml --set model=ting");
        interrupted(&place, start(&place, &["--force"]), &[Signal::SIGINT]);
    }
}
