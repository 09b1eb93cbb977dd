//! The identity of a build's numerics moves with what decides bits, and with nothing else.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

#[path = "../../build/digest.rs"]
mod digest;

use digest::{crates_below, digest};

const ABOVE: [&str; 4] = ["fem-figure", "fem-data", "fem-study", "fem-run"];

fn own() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The names of the crates whose sources decide bits.
fn below() -> Vec<String> {
    let folders = crates_below(&own()).unwrap();
    let name = |folder: PathBuf| folder.file_name().unwrap().to_string_lossy().to_string();
    folders.into_iter().map(name).collect()
}

/// The solvers and what they stand on two crates further down, but not what stands on this crate.
#[test]
fn build_digest_covers_all_solver_crates() {
    let below = below();
    for name in [
        "fem-simulation",
        "fem-case",
        "fem-condensed",
        "fem-explicit",
        "fem-element",
        "fem-material",
    ] {
        assert!(below.iter().any(|found| found == name), "{name}: {below:?}");
    }
    assert!(ABOVE.iter().all(|name| !below.iter().any(|found| found == name)), "{below:?}");
}

/// A build that had not looked at its sources again would have an older one.
#[test]
fn build_digest_equals_that_of_the_current_sources() {
    assert_eq!(digest(&own(), env!("FEM_NUMERICS_TARGET")).unwrap(), fem_simulation::NUMERICS);
    assert_eq!(fem_simulation::NUMERICS.len(), 16);
    assert_ne!(digest(&own(), "another machine").unwrap(), fem_simulation::NUMERICS);
}

/// A copy of the workspace without what is never looked at: sources, manifests, versions.
fn copy() -> TempDir {
    let copy = TempDir::new().unwrap();
    let root = own().join("../..");
    for name in below().into_iter().chain(ABOVE.map(String::from)) {
        for part in ["Cargo.toml", "src"] {
            let part = Path::new("crates").join(&name).join(part);
            copy_all(&root.join(&part), &copy.path().join(&part));
        }
    }
    for name in ["Cargo.toml", "Cargo.lock"] {
        fs::copy(root.join(name), copy.path().join(name)).unwrap();
    }
    copy
}

fn copy_all(from: &Path, to: &Path) {
    if !from.is_dir() {
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(from, to).unwrap();
        return;
    }
    for entry in fs::read_dir(from).unwrap() {
        let name = entry.unwrap().file_name();
        copy_all(&from.join(&name), &to.join(&name));
    }
}

fn change(path: &Path) {
    let mut text = fs::read_to_string(path).unwrap();
    text.push('\n');
    fs::write(path, text).unwrap();
}

/// Wherever the workspace lies; a line in any crate below, a version, a level of optimisation moves it.
#[test]
fn build_digest_changes_with_sources_versions_and_opt_level() {
    let place = copy();
    let own = place.path().join("crates/fem-simulation");
    let now = || digest(&own, env!("FEM_NUMERICS_TARGET")).unwrap();
    let mut last = now();
    assert_eq!(last, fem_simulation::NUMERICS);
    let mut moves = |path: &str| {
        change(&place.path().join(path));
        let before = std::mem::replace(&mut last, now());
        before != last
    };
    for name in below() {
        assert!(moves(&format!("crates/{name}/src/lib.rs")), "{name}");
    }
    assert!(moves("crates/fem-explicit/src/stress/kernel.rs"));
    assert!(moves("Cargo.toml") && moves("Cargo.lock"));
    for name in ABOVE {
        assert!(!moves(&format!("crates/{name}/Cargo.toml")), "{name}");
    }
    assert!(!moves("crates/fem-explicit/src/stress/kernel/tests.rs"));
}

/// As cargo unpacks it from a registry: alone, and no other crate is where a neighbour would be.
#[test]
fn build_digest_exists_for_an_unpacked_crate() {
    let place = copy();
    let alone = place.path().join("fem-simulation-0.1.0");
    fs::rename(place.path().join("crates/fem-simulation"), &alone).unwrap();
    assert_eq!(crates_below(&alone).unwrap().len(), 1);
    assert_eq!(digest(&alone, "any").unwrap().len(), 16);
}
