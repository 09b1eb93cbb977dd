//! What helps a run that stopped: the keys that remedies name are keys of a case.

use std::path::Path;

use fem::{Case, Stop, stop_advice};

const GLASS: &str = include_str!("../../../../cases/glass_0.5ms.toml");
const PAGE: &str = include_str!("../../../../docs/cases.md");

/// A stop of each kind.
fn stops() -> Vec<Stop> {
    let (time, step) = (1e-6, 10);
    let why = String::new;
    let stops = vec![
        Stop::Interrupted { time, step },
        Stop::ContactBeyondCandidates { time, step, radius: 1e-3 },
        Stop::SurfaceTurnsOver { time, step, radius: 1e-3, body: 1, node: 3, place: [1e-3; 2] },
        Stop::ContactTooLarge { ratio: 0.9 },
        Stop::EnergyGrowth { time, step, ratio: 2.0, body: 0, node: 3, place: [1e-3; 2] },
        Stop::NoNumber { time, step, body: 0, node: 3, place: [1e-3; 2] },
        Stop::ElementCollapsed {
            time,
            step,
            body: 1,
            element: 7,
            place: [1e-3; 2],
            volume_ratio: -0.1,
        },
        Stop::StabilityLost {
            time,
            step,
            body: 1,
            element: 7,
            place: [1e-3; 2],
            stretches: [1.0, 0.9, 1.0],
            law: "hencky".to_string(),
        },
        Stop::NoStepShortEnough { time, step, body: 0, place: [1e-3; 2], of_contact: true },
        Stop::NoStepShortEnough { time, step, body: 1, place: [1e-3; 2], of_contact: false },
        Stop::EnergyImbalance { time, relative: 0.1 },
        Stop::NoSeparation { time, step },
        Stop::NoContact { time, step, approach: 1e-9 },
        Stop::TooManyUpdates { time, step, element_updates: 1000 },
        Stop::NoContactState { time },
        Stop::NotMade(why()),
        Stop::OutOfMemory(why()),
        Stop::NotFinished(why()),
        Stop::OutsideValidity(why()),
        Stop::OutOfRange(why()),
    ];
    // Does not compile without a kind that is new: add it above, too.
    for stop in &stops {
        match stop {
            Stop::Interrupted { .. }
            | Stop::ContactBeyondCandidates { .. }
            | Stop::SurfaceTurnsOver { .. }
            | Stop::ContactTooLarge { .. }
            | Stop::EnergyGrowth { .. }
            | Stop::NoNumber { .. }
            | Stop::ElementCollapsed { .. }
            | Stop::StabilityLost { .. }
            | Stop::NoStepShortEnough { .. }
            | Stop::EnergyImbalance { .. }
            | Stop::NoSeparation { .. }
            | Stop::NoContact { .. }
            | Stop::TooManyUpdates { .. }
            | Stop::NoContactState { .. }
            | Stop::NotMade(_)
            | Stop::OutOfMemory(_)
            | Stop::NotFinished(_)
            | Stop::OutsideValidity(_)
            | Stop::OutOfRange(_) => {}
        }
    }
    stops
}

/// The dotted keys in a text.
fn keys(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || "._".contains(c)));
    let words = words.map(|word| word.trim_matches('.'));
    words.filter(|word| word.contains('.') && word.starts_with(char::is_alphabetic)).collect()
}

/// Whether the language of cases has a key, `N` and `NAME` put in.
fn is_known(key: &str) -> bool {
    let key = key.replace("law.NAME", "law.tsuji").replace(".N.", ".0.").replace("NAME", "glass");
    let set = format!("{key}=[]");
    match Case::parse("glass.toml", GLASS, Path::new("."), &[set]) {
        Ok(_) => true,
        Err(error) => !error.message().contains("unknown key"),
    }
}

#[test]
fn a_remedy_names_keys_that_there_are() {
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

/// Memory that there is not is no fault of a mesh file.
#[test]
fn each_cause_is_its_own() {
    let cause = |stop: &Stop| stop_advice(stop).unwrap().cause;
    let [not_made, no_memory] =
        [Stop::NotMade, Stop::OutOfMemory].map(|stop| cause(&stop(String::new())));
    assert!(not_made.contains("mesh") && !no_memory.contains("mesh"), "{no_memory}");
}
