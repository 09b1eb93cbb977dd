//! A run that is killed and continued ends with the bits of an unbroken run.

#![allow(clippy::disallowed_methods, reason = "tests that kill another process by the clock")]

use std::fs;
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::common::{Place, set};

const RESTART_FILE: &str = "fem-run.restart";
/// Options that write many restart files.
const KEPT: &str = "--checkpoint-every 0.02 --quiet";

/// A ball that falls three times.
const BALL: &str = r#"
    material.rubber = { density = "1100 kg/m^3", youngs_modulus = "4 MPa", poissons_ratio = 0.45,
        relaxation = { acts_on = "shear", terms = [{ weight = 0.6, relaxation_time = "0.3 ms" }] } }
    body = [{ name = "floor", wall = {} },
            { name = "ball", sphere.diameter = "2 cm", material = "rubber" }]
    start.gap = "5 cm"
    gravity.acceleration = "9.81 m/s^2"
    stop.bounces = 3
    mesh.contact_element_size = "0.3 mm""#;

/// Scenes with everything that a restart state contains: relaxation of all moduli and of shear only,
/// springs, viscosity with the force of the previous step, half of a scene, finished contacts.
fn scenes() -> Vec<(&'static str, Place, Vec<&'static str>)> {
    let shear = "material.glass.relaxation={acts_on='shear', \
                 terms=[{weight=0.5, decay_rate=2e4}, {weight=0.3, relaxation_time=1e-5}]}";
    let twin = "body.1={name='twin', sphere={diameter='22.2 mm'}, material='glass'}";
    let size = "mesh.contact_element_size='40 um'";
    let fast = [
        "body.0.approach_speed=150",
        "mesh.contact_element_size='0.5 mm'",
        "effects.bulk_viscosity='on'",
    ];
    let spread = "output.snapshots=7";
    // The soft pair, so coarse that finite strain takes a second.
    let soft = "material.glass={density=1100, youngs_modulus=4e6, poissons_ratio=0.45, \
                hyperelastic='neo-hooke', relaxation={acts_on='shear', \
                terms=[{weight=0.3, relaxation_time='0.5 ms'}]}}";
    let finite = [
        soft,
        "body.0.approach_speed=2",
        "mesh.contact_element_size='0.3 mm'",
        spread,
        "output.probe=[{body='target', r=0, y='1 mm'}]",
        "effects.finite_strain='on'",
    ];
    vec![
        ("finite strain", Place::new(), set(&finite)),
        ("relaxing", Place::new(), set(&[size, spread])),
        ("shear", Place::new(), set(&[size, shear])),
        ("fast", Place::new(), set(&fast)),
        ("twins", Place::new(), set(&[size, twin])),
        ("ball", Place::with(BALL), vec![]),
    ]
}

fn command(place: &Place, set: &[&str], more: &[&str]) -> Child {
    let mut command = place.command(("case.toml --out out", KEPT, set, more));
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Pseudo-random numbers from 0 to 1.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Returns whether a run ended before it was killed this long after its start.
fn ends_before(mut child: Child, instant: Duration) -> bool {
    let begin = Instant::now();
    while begin.elapsed() < instant {
        if child.try_wait().unwrap().is_some() {
            break;
        }
        sleep(Duration::from_micros(200));
    }
    // SIGKILL: the process does nothing after it.
    let _ = child.kill();
    let ran = child.wait_with_output().unwrap();
    let stderr = String::from_utf8_lossy(&ran.stderr);
    assert!(matches!(ran.status.code(), None | Some(0)), "{stderr}");
    ran.status.code() == Some(0)
}

/// Kills runs of all scenes at random instants until `n_gone_on` runs of each have continued from a restart
/// file; returns the number of killed runs.
fn kill_at_random(n_gone_on: usize, seed: u64) -> usize {
    let mut chance = Chance(seed);
    let mut killed = 0;
    for (name, place, set) in scenes() {
        let begin = Instant::now();
        place.succeed(("case.toml --out whole --quiet", &set));
        let whole = place.result("whole");
        let length = begin.elapsed();
        let mut gone_on = 0;
        while gone_on < n_gone_on {
            let _ = fs::remove_dir_all(place.path("out"));
            loop {
                gone_on += usize::from(place.path("out").join(RESTART_FILE).exists());
                // The last run is not killed.
                let is_last = gone_on >= n_gone_on;
                let instant = length.mul_f64(1.2 * chance.next());
                let instant = if is_last { Duration::MAX } else { instant };
                if ends_before(command(&place, &set, &["--restart"]), instant) {
                    break;
                }
                killed += 1;
            }
            assert!(place.result("out") == whole, "{name}: other bits after {killed} kills");
            let left: Vec<_> = place.list(".").into_iter().filter(|n| n.starts_with('.')).collect();
            assert_eq!(left, [""; 0], "{name}");
        }
    }
    killed
}

#[cfg(unix)]
#[test]
fn run_killed_at_random_instants_restarts_to_the_same_bits() {
    assert!(kill_at_random(1, 1) >= 4);
}

/// `cargo test --release -p fem-run --test it -- --ignored a_hundred`
#[cfg(unix)]
#[test]
#[ignore = "minutes"]
fn a_hundred_random_instants_of_every_scene() {
    assert!(kill_at_random(100, 2) >= 450);
}

/// Starts a run and kills it once it has left a restart file.
fn killed(place: &Place, set: &[&str]) {
    let mut child = command(place, set, &[]);
    let begin = Instant::now();
    while !place.path("out").join(RESTART_FILE).exists() {
        assert!(begin.elapsed() < Duration::from_secs(60));
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(place.list("out"), [RESTART_FILE]);
}

/// A mesh so fine that the run is killed long before its end.
const FINE: [&str; 2] = ["--set", "mesh.contact_element_size='12 um'"];

#[test]
fn a_restart_file_of_another_case_or_build_is_refused() {
    let place = Place::new();
    killed(&place, &FINE);
    let path = format!("out/{RESTART_FILE}");
    let file = place.read(&path);
    let restart = |set: &[&str]| place.run(("case.toml --out out --restart", FINE, set));
    let other = ["--set", "body.0.approach_speed=0.4"];
    for set in [&other[..], &["--set", "output.snapshots=3"], &[&other[..], &["--force"]].concat()]
    {
        let ran = restart(set);
        assert_eq!(ran.code, Some(2), "{}", ran.stderr);
        ran.tells("belongs to another case");
    }
    let text = String::from_utf8_lossy(&file).to_string();
    let (_, numerics) = text.split_once("\"numerics\":\"").unwrap();
    let line = file.iter().position(|byte| *byte == b'\n').unwrap();
    let place_of = text.find(&numerics[..16]).unwrap();
    let with = |at: usize, byte: u8| {
        let mut file = file.clone();
        file[at] = byte;
        file
    };
    let digit = if file[place_of] == b'0' { b'1' } else { b'0' };
    for (bytes, message) in [
        (with(place_of, digit), "belongs to another build"),
        (with(line + 100, file[line + 100] ^ 1), "damaged"),
        (file[..file.len() - 1].to_vec(), "damaged"),
        (file[..line].to_vec(), "not a checkpoint"),
        (Vec::new(), "not a checkpoint"),
    ] {
        fs::write(place.path(&path), bytes).unwrap();
        let ran = restart(&[]);
        assert_eq!(ran.code, Some(2), "{message}: {}", ran.stderr);
        ran.tells(message);
        assert_eq!(place.list("out"), [RESTART_FILE]);
    }
}

/// An unfinished run is not replaced by another case, with or without --out.
#[test]
fn another_case_leaves_the_restart_file_alone() {
    let place = Place::new();
    killed(&place, &FINE);
    fs::create_dir(place.path("runs")).unwrap();
    fs::rename(place.path("out"), place.path("runs/case")).unwrap();
    let ting = ["--set", "model.ting={}"];
    place.succeed(("case.toml", ting));
    assert_eq!(place.list("runs/case"), [RESTART_FILE]);
    assert_eq!(place.list("runs").len(), 2);
    place.fails(2, ("case.toml --out runs/case", ting));
    // Nor does another case continue it.
    fs::remove_dir_all(place.path("runs").join(&place.list("runs")[1])).unwrap();
    place.fails(2, ("case.toml --restart", ting)).tells("belongs to another case");
}

#[test]
fn restart_without_a_file_starts_anew_with_a_message() {
    let place = Place::new();
    place.succeed("case.toml --restart").tells("starting anew");
    place.succeed("case.toml --out other");
    assert_eq!(place.result("runs/case"), place.result("other"));
    // A model without restart state.
    place
        .succeed(["case.toml", "--checkpoint-every", "1", "--set", "model.ting={}"])
        .tells("leaves no restart file");
    for seconds in ["-1", "nan", "soon"] {
        assert_eq!(place.run(["case.toml", "--checkpoint-every", seconds]).code, Some(2));
    }
}

/// Ctrl-C leaves the results so far and a restart file.
#[cfg(unix)]
#[test]
fn interrupted_run_restarts_to_the_same_result() {
    let place = Place::new();
    let size = ["--set", "mesh.contact_element_size='20 um'"];
    place.succeed(("case.toml --out whole --quiet", size));
    let mut child = command(&place, &size, &[]);
    while !place.path("out").join(RESTART_FILE).exists() {
        sleep(Duration::from_millis(1));
    }
    crate::folders::send(&child, nix::sys::signal::Signal::SIGINT);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let summary = place.json("out/summary.json");
    assert_eq!(summary["complete"], false);
    assert!(summary["files"].to_string().contains(RESTART_FILE), "{}", summary["files"]);
    assert!(place.list("out").contains(&RESTART_FILE.to_string()));
    place.write("out/notes.txt", "mine");
    place.succeed(("case.toml --out out --restart", size)).tells("continuing from step");
    fs::remove_file(place.path("out/notes.txt")).unwrap();
    assert_eq!(place.result("out"), place.result("whole"));
}
