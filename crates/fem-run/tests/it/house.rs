//! The structure of the workspace: which crate depends on which, and what crates may not depend on.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Each crate with the `description` of its manifest and the crates that it depends on. A crate follows
/// those that it depends on.
const HOUSE: [(&str, &str, &[&str]); 20] = [
    (
        "fem-material",
        "Isotropic viscoelastic materials: elastic moduli, Prony relaxation, hyperelastic laws",
        &[],
    ),
    (
        "fem-mesh",
        "Graded axisymmetric quadrilateral meshes of spheres and half-spaces, their boundary curves and quality",
        &[],
    ),
    (
        "fem-element",
        "Axisymmetric four-node elements: geometry, stabilisation, element matrices, eigenvalue bounds",
        &[],
    ),
    ("fem-vtk", "VTK XML writer and mesh reader", &[]),
    ("fem-figure", "Charts and filled contours as self-contained SVG", &[]),
    (
        "fem-laws",
        "Closed forms and reduced laws for the collision of two spheres",
        &["fem-material"],
    ),
    (
        "fem-case",
        "Case files: TOML with units to a validated, resolved case",
        &["fem-laws", "fem-material"],
    ),
    (
        "fem-contact",
        "Frictionless penalty contact between two axisymmetric boundaries or a boundary and a rigid body",
        &["fem-mesh"],
    ),
    (
        "fem-collision",
        "Requests and results of a collision, the same for every model",
        &["fem-element", "fem-material", "fem-mesh"],
    ),
    (
        "fem-condensed",
        "Collisions of linear viscoelastic bodies condensed to their contact nodes",
        &["fem-collision", "fem-contact", "fem-element", "fem-material", "fem-mesh"],
    ),
    (
        "fem-explicit",
        "Explicit dynamics of two viscoelastic bodies in contact, at small or finite strain",
        &["fem-collision", "fem-contact", "fem-element", "fem-material", "fem-mesh"],
    ),
    (
        "fem-simulation",
        "One collision: estimate, effects, plan, model, run, results and their error",
        &[
            "fem-case",
            "fem-collision",
            "fem-condensed",
            "fem-contact",
            "fem-explicit",
            "fem-laws",
            "fem-material",
            "fem-mesh",
            "fem-vtk",
        ],
    ),
    (
        "fem-study",
        "Many collisions: sweeps, calibration, contact laws, measured data, accuracy studies",
        &["fem-case", "fem-collision", "fem-laws", "fem-material", "fem-mesh", "fem-simulation"],
    ),
    (
        "fem",
        "The library of fem-run: one collision, many collisions, cases and results under one name",
        &[
            "fem-case",
            "fem-collision",
            "fem-condensed",
            "fem-explicit",
            "fem-laws",
            "fem-material",
            "fem-mesh",
            "fem-simulation",
            "fem-study",
        ],
    ),
    (
        "fem-report",
        "Reports and figures of results: the report page, charts of sweeps and fits, stress in section",
        &["fem", "fem-case", "fem-collision", "fem-figure", "fem-laws", "fem-vtk"],
    ),
    (
        "fem-validate",
        "Claims about collisions, each checked against independent references",
        &[
            "fem",
            "fem-case",
            "fem-collision",
            "fem-contact",
            "fem-element",
            "fem-explicit",
            "fem-figure",
            "fem-laws",
            "fem-material",
            "fem-mesh",
        ],
    ),
    (
        "fem-page",
        "The HTML page that computes collisions in the browser, in WebAssembly",
        &["fem", "fem-case", "fem-figure", "fem-report"],
    ),
    (
        COMMAND,
        "The fem-run command: how do two viscoelastic spheres collide?",
        &[
            "fem",
            "fem-case",
            "fem-collision",
            "fem-figure",
            "fem-laws",
            "fem-mesh",
            "fem-report",
            "fem-validate",
            "fem-vtk",
        ],
    ),
    (
        PYTHON,
        "The Python module fem_run, with the command in the same wheel",
        &["fem", "fem-case", "fem-collision", "fem-run", "fem-vtk"],
    ),
    (
        "fem-fuzz",
        "Hostile input for everything that reads: cases, meshes, tables, restart files, sweeps, the command",
        &["fem", "fem-case", "fem-mesh", "fem-vtk"],
    ),
];

const COMMAND: &str = "fem-run";
/// The Python module, which contains the command.
const PYTHON: &str = "fem-python";

/// Crates that compute on meshes: cases are read and changed without them.
const SOLVERS: [&str; 8] = [
    "fem-mesh",
    "fem-element",
    "fem-contact",
    "fem-collision",
    "fem-condensed",
    "fem-explicit",
    "faer",
    "nalgebra",
];

/// Crates for arguments, terminals and signals.
const TERMINAL: [&str; 7] =
    ["clap", "clap_complete", "comfy-table", "ctrlc", "indicatif", "miette", "textwrap"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A crate of the workspace.
struct Crate {
    description: String,
    manifest: PathBuf,
    /// Dependencies for all targets and features, without those of tests.
    dependencies: BTreeSet<String>,
}

/// Returns all crates of the workspace by name.
fn workspace() -> BTreeMap<String, Crate> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("metadata");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_string();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let read = |package: &Value| {
        let dependencies = list(&package["dependencies"]);
        let normal = dependencies.iter().filter(|dependency| dependency["kind"].is_null());
        let known = Crate {
            description: text(&package["description"]),
            manifest: text(&package["manifest_path"]).into(),
            dependencies: normal.map(|dependency| text(&dependency["name"])).collect(),
        };
        (text(&package["name"]), known)
    };
    list(&metadata["packages"]).iter().map(read).collect()
}

/// Returns all packages that a crate compiles on any platform, its own and external ones.
fn compiled(workspace: &BTreeMap<String, Crate>, name: &str) -> BTreeSet<String> {
    let lock = fs::read_to_string(root().join("Cargo.lock")).expect("Cargo.lock");
    let lock: toml::Table = lock.parse().expect("TOML");
    let mut others: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for package in lock["package"].as_array().expect("packages") {
        // `name`, or `name version` if there are several versions, which count as one.
        let names = package.get("dependencies").and_then(|list| list.as_array()).into_iter();
        let names = names.flatten().filter_map(|name| name.as_str()?.split(' ').next());
        let name = package["name"].as_str().expect("a name");
        others.entry(name).or_default().extend(names.map(String::from));
    }
    let (mut found, mut open) = (BTreeSet::new(), vec![name.to_string()]);
    while let Some(name) = open.pop() {
        let dependencies = match workspace.get(&name) {
            Some(own) => &own.dependencies,
            None => others.get(name.as_str()).expect("locked"),
        };
        open.extend(dependencies.iter().filter(|name| !found.contains(*name)).cloned());
        found.insert(name);
    }
    found
}

#[test]
fn crates_stand_on_each_other_as_the_table_says() {
    let workspace = workspace();
    let mut faults = Vec::new();
    let known: BTreeSet<&str> = HOUSE.iter().map(|row| row.0).collect();
    for name in workspace.keys().filter(|name| !known.contains(name.as_str())) {
        faults.push(format!("{name} is not in the table"));
    }
    for (k, (name, meaning, allowed)) in HOUSE.iter().enumerate() {
        let Some(found) = workspace.get(*name) else {
            faults.push(format!("{name} is in the table and not in the workspace"));
            continue;
        };
        if found.description != *meaning {
            faults.push(format!("{name} says of itself: {}", found.description));
        }
        for below in found.dependencies.iter().filter(|below| workspace.contains_key(*below)) {
            if !allowed.contains(&below.as_str()) {
                faults.push(format!("{name} -> {below} is not allowed"));
            }
        }
        for below in *allowed {
            if !found.dependencies.contains(*below) {
                faults.push(format!("{name} -> {below} is in the table, and nobody uses it"));
            }
            if HOUSE[..k].iter().all(|row| row.0 != *below) {
                faults.push(format!("{name} comes before {below}, on which it stands"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_language_of_cases_compiles_no_solver() {
    let compiled = compiled(&workspace(), "fem-case");
    let solvers: Vec<_> = SOLVERS.iter().filter(|solver| compiled.contains(**solver)).collect();
    assert!(solvers.is_empty(), "fem-case compiles {solvers:?}");
    assert!(compiled.contains("toml") && compiled.contains("serde_core"), "{compiled:?}");
}

#[test]
fn only_the_command_knows_a_terminal() {
    let workspace = workspace();
    for name in workspace.keys().filter(|name| ![COMMAND, PYTHON].contains(&name.as_str())) {
        let compiled = compiled(&workspace, name);
        let known: Vec<_> = TERMINAL.iter().filter(|other| compiled.contains(**other)).collect();
        assert!(known.is_empty(), "{name} compiles {known:?}");
    }
    let command = compiled(&workspace, COMMAND);
    assert!(TERMINAL.iter().all(|name| command.contains(*name)), "a name that nobody has");
}

/// `cargo test` and `cargo build` take every crate but two.
#[test]
fn every_crate_but_two_is_a_default_member() {
    let manifest: toml::Table =
        fs::read_to_string(root().join("Cargo.toml")).expect("a manifest").parse().expect("TOML");
    let patterns = manifest["workspace"]["default-members"].as_array().expect("default members");
    let is_default = |name: &str| {
        let folder = match name {
            "fem-validate" => "validation",
            "fem-fuzz" => "fuzz",
            _ => &format!("crates/{name}"),
        };
        patterns.iter().filter_map(|pattern| pattern.as_str()).any(|pattern| {
            let others = pattern.strip_suffix("[!p]*");
            others.map_or(pattern == folder, |before| {
                folder.strip_prefix(before).is_some_and(|rest| !rest.starts_with('p'))
            })
        })
    };
    let others: Vec<String> = workspace().into_keys().filter(|name| !is_default(name)).collect();
    assert_eq!(others, ["fem-fuzz", PYTHON]);
}

#[test]
fn every_crate_has_the_lints_of_the_workspace() {
    for (name, own) in workspace() {
        let text = fs::read_to_string(&own.manifest).expect("a manifest");
        let manifest: toml::Table = text.parse().expect("TOML");
        let lints = manifest.get("lints").and_then(|lints| lints.get("workspace"));
        assert_eq!(lints, Some(&toml::Value::Boolean(true)), "{name}: [lints] workspace = true");
    }
}

/// docs/architecture.md contains the table, row for row.
#[test]
fn the_page_on_architecture_shows_the_table() {
    let page = fs::read_to_string(root().join("docs/architecture.md")).expect("a page");
    let row = |(name, meaning, allowed): &(&str, &str, &[&str])| {
        let below: Vec<String> = allowed.iter().map(|below| format!(" `{below}`")).collect();
        format!("| `{name}` | {meaning} |{} |", below.concat())
    };
    let expected: Vec<String> = HOUSE.iter().map(row).collect();
    let rows = page.lines().skip_while(|line| !line.starts_with("| crate |")).skip(2);
    let shown: Vec<&str> = rows.take_while(|line| line.starts_with('|')).collect();
    assert_eq!(shown, expected);
}
