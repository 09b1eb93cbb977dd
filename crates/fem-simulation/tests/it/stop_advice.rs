//! Advice after a stop or a rejection: it names keys of cases, and with the advised change the scene ends well.
//!
//! Advice on growing energy, on limits and on warnings is tested in `failure_messages.rs` and `warning_advice.rs`.
//! Growing energy, motion that is not a number, a time step that becomes too short, unbalanced energy of condensed
//! bodies and a missing contact state occur only in runs that are disturbed from inside: none of 900 random scenes at
//! the ends of all axes has one of them.

use fem_collision::{OutputRequest, StepInstant, Stop};
use fem_simulation::{Simulation, stop_advice};

use crate::scene::{ELASTIC_GLASS as GLASS, SOFT_SPHERE as SOFT, case_of, parse};

const PAGE: &str = include_str!("../../../../docs/cases.md");

const COARSE: &str = "mesh.contact_element_size='1 mm'";
const CONDENSED: &str = "model.condensed={}";
const SMALL_STRAIN: &str = "effects.finite_strain='off'";
const FAST: &str = "body.0.approach_speed='5 m/s'";

/// A case that fails, its overrides, words of the failure, and the changes that the advice names: words of the advice, and
/// the override that follows it.
type Row =
    (&'static str, &'static [&'static str], &'static str, &'static [(&'static str, &'static str)]);

const ROWS: [Row; 13] = [
    (
        SOFT,
        &[COARSE, "body.1.approach_speed='40 m/s'", "material.rubber.hyperelastic='hencky'"],
        "folds at the radius",
        &[("body.N.approach_speed", "body.1.approach_speed='20 m/s'")],
    ),
    (
        SOFT,
        &[
            COARSE,
            "body.1.approach_speed='15 m/s'",
            "material.rubber.hyperelastic='saint-venant-kirchhoff'",
        ],
        "loses ellipticity",
        &[
            ("body.N.approach_speed", "body.1.approach_speed='3 m/s'"),
            ("material.NAME.hyperelastic", "material.rubber.hyperelastic='neo-hooke'"),
        ],
    ),
    (
        GLASS,
        &[CONDENSED, SMALL_STRAIN, FAST, "material.glass.youngs_modulus='10 kPa'"],
        "of the smaller sphere's radius",
        &[
            ("body.N.approach_speed", "body.0.approach_speed='0.05 m/s'"),
            ("check the moduli and their units", "material.glass.youngs_modulus='10 MPa'"),
        ],
    ),
    (
        GLASS,
        &[COARSE, SMALL_STRAIN, FAST, "material.glass.youngs_modulus='1 kPa'"],
        "the edge of the region",
        &[
            ("body.N.approach_speed", "body.0.approach_speed='0.01 m/s'"),
            ("check the moduli and their units", "material.glass.youngs_modulus='1 MPa'"),
        ],
    ),
    (
        GLASS,
        &["model.condensed={penalty_springs=true}", COARSE, "body.0.approach_speed='10 um/s'"],
        "no spring between the surfaces has closed",
        &[("mesh.contact_element_size", "mesh.contact_element_size='0.5 um'")],
    ),
    (
        GLASS,
        &["model.law={falcon={c=1e300}}"],
        "no end of contact",
        &[("lower the damping", "model.law={falcon={c=0.1}}")],
    ),
    (
        GLASS,
        &["model.law={power={k=1e-300, gamma=10, c=1e300, n=50}}"],
        "must be positive and finite",
        &[("model.law.NAME", "model.law={power={k=1e9, gamma=1.5, c=1, n=1}}")],
    ),
    (
        GLASS,
        &[CONDENSED, "material.glass.poissons_ratio=0.4999999999999999"],
        "not positive definite",
        &[("", "material.glass.poissons_ratio=0.49999")],
    ),
    (
        GLASS,
        &[
            COARSE,
            SMALL_STRAIN,
            FAST,
            "material.glass.youngs_modulus='100 kPa'",
            "model.ting={finite_size=true}",
        ],
        "outside the validity",
        &[
            ("write finite_size = false", "model.ting={finite_size=false}"),
            ("use model fem", "model={fem={}}"),
        ],
    ),
    (
        GLASS,
        &[CONDENSED, "limits.memory='100 kB'"],
        "of memory",
        &[("limits.memory", "limits.memory='1 GB'")],
    ),
    (
        GLASS,
        &["limits.elements=100"],
        "elements",
        &[("limits.elements", "limits.elements=1e6"), ("mesh.contact_element_size", COARSE)],
    ),
    (
        GLASS,
        &[
            CONDENSED,
            "material.glass.relaxation={acts_on='all', terms=[{weight=1, decay_rate=1e11}]}",
        ],
        "flow into each other",
        &[(
            "weights whose sum is below 1",
            "material.glass.relaxation={acts_on='all', terms=[{weight=0.9, decay_rate=1e11}]}",
        )],
    ),
    (
        GLASS,
        &[COARSE, "limits.element_updates=1e4"],
        "element updates",
        &[("limits.element_updates", "limits.element_updates=1e9")],
    ),
];

/// Runs a case without snapshots; returns the message and the advice if it is stopped or rejected.
fn failure(
    case: &str,
    overrides: &[&str],
    max_contact_times: Option<f64>,
) -> Option<(String, String)> {
    let case = case_of(case, overrides);
    let mut simulation = match Simulation::new(case) {
        Ok(simulation) => simulation.without_snapshots(),
        Err(error) => {
            return Some((error.message().to_string(), error.help().unwrap_or("").to_string()));
        }
    };
    if let Some(max_contact_times) = max_contact_times {
        let request = OutputRequest { max_contact_times, ..simulation.request().clone() };
        simulation = simulation.with_output_request(request).unwrap();
    }
    let collision = simulation.run(&mut ());
    let stop = collision.stop()?;
    Some((stop.to_string(), stop_advice(stop).map_or("", |it| it.remedy).to_string()))
}

fn follow_advice<'a>(rows: impl Iterator<Item = &'a Row>) {
    for (case, overrides, message, remedies) in rows {
        let (found, help) =
            failure(case, overrides, None).unwrap_or_else(|| panic!("{overrides:?} ends well"));
        assert!(found.contains(message), "{overrides:?}: {found}");
        for (named, remedy) in *remedies {
            assert!(help.contains(named), "{found}: {help}");
            let with = [*overrides, &[*remedy]].concat();
            assert_eq!(failure(case, &with, None), None, "{found}: {remedy}");
        }
    }
}

#[test]
fn advice_of_a_sample_of_stops_lets_the_run_complete() {
    follow_advice(ROWS.iter().step_by(4));
}

#[test]
#[ignore = "takes many seconds; .ci/run runs it"]
fn advice_of_every_stop_lets_the_run_complete() {
    follow_advice(ROWS.iter());
}

/// A run that is stopped before the bodies separate is advised to give them an equilibrium stiffness.
#[test]
fn bodies_that_do_not_separate_need_equilibrium_stiffness() {
    let relaxing = |weight: f64| {
        format!(
            "material.glass.relaxation={{acts_on='all', terms=[{{weight={weight}, relaxation_time='3 us'}}]}}"
        )
    };
    let mesh = "mesh.contact_element_size='0.2 mm'";
    let fail = |weight: f64| failure(GLASS, &[CONDENSED, mesh, &relaxing(weight)], Some(2.0));
    let (message, help) = fail(0.97).expect("a stop");
    assert!(message.contains("have not separated"), "{message}");
    assert!(help.contains("the weights' sum below 1 leaves a lasting stiffness"), "{help}");
    assert_eq!(fail(0.3), None);
}

/// Returns a stop of each kind.
fn stops() -> Vec<Stop> {
    let time = 1e-6;
    let at = StepInstant { time, step: 10 };
    let why = String::new;
    vec![
        Stop::Interrupted { at },
        Stop::ContactBeyondCandidates { at, radius: 1e-3 },
        Stop::SurfaceTurnsOver { at, radius: 1e-3, body: 1, node: 3, place: [1e-3; 2] },
        Stop::ContactTooLarge { ratio: 0.9 },
        Stop::EnergyGrowth { at, ratio: 2.0, body: 0, node: 3, place: [1e-3; 2] },
        Stop::NoNumber { at, body: 0, node: 3, place: [1e-3; 2] },
        Stop::ElementCollapsed { at, body: 1, element: 7, place: [1e-3; 2], volume_ratio: -0.1 },
        Stop::StabilityLost {
            at,
            body: 1,
            element: 7,
            place: [1e-3; 2],
            stretches: [1.0, 0.9, 1.0],
            law: "hencky".to_string(),
        },
        Stop::NoStepShortEnough { at, body: 0, place: [1e-3; 2], of_contact: true },
        Stop::NoStepShortEnough { at, body: 1, place: [1e-3; 2], of_contact: false },
        Stop::EnergyImbalance { time, relative: 0.1 },
        Stop::NoSeparation { at },
        Stop::NoContact { at, approach: 1e-9 },
        Stop::TooManyUpdates { at, element_updates: 1000 },
        Stop::NoContactState { time },
        Stop::NotMade(why()),
        Stop::OutOfMemory(why()),
        Stop::NotFinished(why()),
        Stop::OutsideValidity(why()),
        Stop::OutOfRange(why()),
    ]
}

/// Returns the dotted keys in a text.
fn keys(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || "._".contains(c)));
    let words = words.map(|word| word.trim_matches('.'));
    words.filter(|word| word.contains('.') && word.starts_with(char::is_alphabetic)).collect()
}

/// Returns whether cases have a key, with `N` and `NAME` replaced.
fn is_known(key: &str) -> bool {
    let key = key.replace("law.NAME", "law.tsuji").replace(".N.", ".0.").replace("NAME", "glass");
    let error = parse(GLASS, &[format!("{key}=[]")]).err();
    error.is_none_or(|error| !error.message().contains("unknown key"))
}

#[test]
fn advice_names_keys_of_cases() {
    for stop in stops() {
        let Some(remedy) = stop_advice(&stop) else {
            assert!(matches!(stop, Stop::Interrupted { .. }), "{stop:?} has no remedy");
            continue;
        };
        let named = keys(remedy.remedy);
        assert!(!named.is_empty(), "{stop:?} names no key: {}", remedy.remedy);
        for key in named {
            assert!(is_known(key), "{stop:?}: there is no key {key}");
            let last = key.rsplit('.').find(|part| !part.starts_with('N')).unwrap();
            let on_page = [format!("`{last}"), format!(".{last}`"), format!("{last} = ")];
            assert!(on_page.iter().any(|word| PAGE.contains(word)), "docs/cases.md has no {key}");
        }
    }
    assert!(is_known("mesh.growth") && !is_known("mesh.size") && !is_known("model.law.NAME.ends"));
}

/// A lack of memory is not blamed on a mesh file.
#[test]
fn a_lack_of_memory_has_its_own_cause() {
    let cause = |stop: &Stop| stop_advice(stop).unwrap().cause;
    let [not_made, no_memory] =
        [Stop::NotMade, Stop::OutOfMemory].map(|stop| cause(&stop(String::new())));
    assert!(not_made.contains("mesh") && !no_memory.contains("mesh"), "{no_memory}");
}
