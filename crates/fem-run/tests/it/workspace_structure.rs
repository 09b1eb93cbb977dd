//! The structure of the workspace, which docs/architecture.md shows, what crates may not depend on, and how docstrings
//! are written.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

const COMMAND: &str = "fem-run";
/// Crates that contain the command: the Python module, and programs of developers.
const WITH_COMMAND: [&str; 3] = ["fem-python", "fem-tools", "fem-validate"];

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

/// Crates that compute collisions: measured data are read and fitted without them.
const COLLIDING: [&str; 5] =
    ["fem-contact", "fem-condensed", "fem-explicit", "fem-simulation", "faer"];

/// Crates for arguments, terminals and signals.
const TERMINAL: [&str; 7] =
    ["clap", "clap_complete", "comfy-table", "indicatif", "miette", "signal-hook", "textwrap"];

pub fn root() -> PathBuf {
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

/// docs/architecture.md has one row per crate: its name, the `description` of its manifest and the crates that it depends
/// on, each of which has its row before.
#[test]
fn architecture_page_lists_the_dependencies_of_every_crate() {
    let workspace = workspace();
    let page = fs::read_to_string(root().join("docs/architecture.md")).expect("a page");
    let rows = page.lines().skip_while(|line| !line.starts_with("| crate |")).skip(2);
    let shown: Vec<&str> = rows.take_while(|line| line.starts_with('|')).collect();
    let mut before = BTreeSet::new();
    for shown in &shown {
        let name = shown.split('`').nth(1).unwrap_or_default();
        let Some(found) = workspace.get(name) else {
            panic!("{name} is on the page and not in the workspace")
        };
        let below = found.dependencies.iter().filter(|below| workspace.contains_key(*below));
        let below: Vec<String> = below.map(|below| format!(" `{below}`")).collect();
        assert_eq!(*shown, format!("| `{name}` | {} |{} |", found.description, below.concat()));
        assert!(below.iter().all(|below| before.contains(below)), "{name} stands on a later row");
        before.insert(format!(" `{name}`"));
    }
    let names = workspace.keys().filter(|name| !before.contains(&format!(" `{name}`")));
    assert_eq!(names.collect::<Vec<_>>(), [""; 0], "not on the page");
}

#[test]
fn cases_and_data_depend_on_no_solver() {
    let workspace = workspace();
    for (name, lacks) in [("fem-case", &SOLVERS[..]), ("fem-data", &COLLIDING)] {
        let compiled = compiled(&workspace, name);
        let solvers: Vec<_> = lacks.iter().filter(|solver| compiled.contains(**solver)).collect();
        assert!(solvers.is_empty(), "{name} compiles {solvers:?}");
        assert!(compiled.contains("toml") && compiled.contains("serde_core"), "{compiled:?}");
    }
}

#[test]
fn only_fem_run_depends_on_terminal_crates() {
    let workspace = workspace();
    let is_below = |name: &&String| *name != COMMAND && !WITH_COMMAND.contains(&name.as_str());
    for name in workspace.keys().filter(is_below) {
        let compiled = compiled(&workspace, name);
        let known: Vec<_> = TERMINAL.iter().filter(|other| compiled.contains(**other)).collect();
        assert!(known.is_empty(), "{name} compiles {known:?}");
    }
    let command = compiled(&workspace, COMMAND);
    assert!(TERMINAL.iter().all(|name| command.contains(*name)), "a name that nobody has");
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

/// Returns the first paragraphs of a source file's docstrings, each with its line number.
fn docstrings(source: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let (mut marker, mut is_open) = ("", false);
    for (k, line) in source.lines().enumerate() {
        let line = line.trim_start();
        let own = ["///", "//!"].into_iter().find(|own| line.starts_with(own)).unwrap_or_default();
        let text = line[own.len()..].trim();
        if own.is_empty() {
            is_open = false;
        } else if own != marker {
            found.push((k + 1, text.to_string()));
            is_open = true;
        } else if text.is_empty() {
            is_open = false;
        } else if is_open && let Some((_, paragraph)) = found.last_mut() {
            *paragraph += &format!(" {text}");
        }
        marker = own;
    }
    found
}

/// Docstrings are sentences: none has one or two words, or begins as a fragment.
#[test]
fn docstrings_are_sentences() {
    const FRAGMENTS: [&str; 3] = ["Of ", "What a ", "What an "];
    let (mut faults, mut n_read) = (Vec::new(), 0);
    for (path, source) in sources(root()) {
        for (line, text) in docstrings(&source) {
            n_read += 1;
            let starts = FRAGMENTS.iter().any(|start| text.starts_with(start));
            if text.split_whitespace().count() <= 2 || starts {
                faults.push(format!("{}:{line}: {text}", path.display()));
            }
        }
    }
    assert!(n_read > 5000, "{n_read}");
    assert!(faults.is_empty(), "{} fragments:\n{}", faults.len(), faults.join("\n"));
}

/// Comments name types in backticks. A type's name without them stands where renaming a type has replaced a word of the
/// sentence.
#[test]
fn comments_name_types_in_backticks() {
    let sources = sources(root());
    let words = |text: &str| -> Vec<String> {
        let words =
            text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
        words.map(String::from).collect()
    };
    let is_of_two_words = |name: &String| {
        let pairs = name.chars().zip(name.chars().skip(1));
        name.starts_with(char::is_uppercase)
            && pairs.into_iter().any(|(a, b)| a.is_lowercase() && b.is_uppercase())
    };
    let mut types = HashSet::new();
    for (_, source) in &sources {
        let words = words(source);
        let named = words
            .windows(2)
            .filter(|pair| ["struct", "enum", "trait", "type"].contains(&&*pair[0]));
        types.extend(named.map(|pair| pair[1].clone()).filter(is_of_two_words));
    }
    assert!(types.len() > 300, "{}", types.len());
    let mut faults = Vec::new();
    for (path, source) in &sources {
        let mut is_code = false;
        for (line, text) in (1..).zip(source.lines()) {
            let Some(text) = text.trim_start().strip_prefix("//") else {
                is_code = false;
                continue;
            };
            let text = text.trim_start_matches(['/', '!']);
            is_code ^= text.trim_start().starts_with("```");
            // Tables and lists of items are indented; a link's target follows its name.
            if is_code || text.starts_with("     ") || text.trim_start().starts_with("[`") {
                continue;
            }
            let prose: String = text.split('`').step_by(2).collect::<Vec<_>>().join(" ");
            let prose = prose.split("](").enumerate().map(|(i, part)| match i {
                0 => part,
                _ => part.split_once(')').map_or("", |(_, after)| after),
            });
            for part in prose {
                let found = words(part).into_iter().filter(|word| types.contains(word));
                faults.extend(found.map(|word| format!("{}:{line}: {word}", path.display())));
            }
        }
    }
    assert!(faults.is_empty(), "{} names without backticks:\n{}", faults.len(), faults.join("\n"));
}

/// Messages show lengths with a prefix, 300 µm. Input for other programs, in `fem-data/src/dem`, is in SI.
#[test]
fn messages_show_no_bare_metres() {
    let bare = ["} m\"", "} m;", "} m,", "} m)"];
    let mut faults = Vec::new();
    for (path, source) in sources(root()) {
        let path = path.to_string_lossy().into_owned();
        let is_message = |line: &&str| !line.trim_start().starts_with("//");
        let found = source.lines().filter(is_message);
        let found = found.filter(|line| bare.iter().any(|it| line.contains(it)));
        if path.contains("/src/") && !path.contains("/tests") && !path.contains("fem-data/src/dem")
        {
            faults.extend(found.map(|line| format!("{path}: {}", line.trim())));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Returns all source files below a folder with their paths.
pub fn sources(folder: PathBuf) -> Vec<(PathBuf, String)> {
    let (mut sources, mut open) = (Vec::new(), vec![folder]);
    while let Some(path) = open.pop() {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            let is_left = name == "target" || name.starts_with('.') && name != "..";
            let entries = fs::read_dir(&path).expect("a folder").filter(|_| !is_left);
            open.extend(entries.map(|entry| entry.expect("an entry").path()));
        } else if name.ends_with(".rs") {
            let source = fs::read_to_string(&path).expect("a source file");
            sources.push((path, source));
        }
    }
    sources
}
