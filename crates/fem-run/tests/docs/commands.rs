//! Checks that the program accepts the commands of the pages and that their input files exist.

use std::path::PathBuf;
use std::process::Command;

use crate::pages::{Page, root};
use crate::pointers::APART;
use crate::shell::{Shown, commands, words};

/// Folders of the repository that commands read.
const FOLDERS: [&str; 5] = ["cases/", "validation/", "meshes/", ".ci/", "crates/"];

/// Returns the source of the example or test that a cargo command names.
fn target(command: &Shown) -> Option<PathBuf> {
    let behind = |flag: &str| {
        let place = command.words.iter().position(|word| word == flag)?;
        command.words.get(place + 1)
    };
    let name = behind("-p")?;
    let apart = APART.iter().find(|(apart, _)| apart == name);
    let package = match apart {
        Some((_, folder)) => root().join(folder),
        None => root().join("crates").join(name),
    };
    match (behind("--example"), behind("--test")) {
        (Some(name), _) => Some(package.join(format!("examples/{name}.rs"))),
        (_, Some(name)) => Some(package.join(format!("tests/{name}/main.rs"))),
        _ => Some(package),
    }
}

/// Returns the fault of a command, if any: the program prints help only if all arguments before it are valid.
fn fault(command: &Shown) -> Option<String> {
    let missing = command.words.iter().find(|word| {
        let path = word.trim_start_matches("./");
        // NAME is a placeholder.
        let is_meant = !path.contains("NAME");
        is_meant
            && FOLDERS.iter().any(|folder| path.starts_with(folder))
            && !root().join(path).exists()
    });
    if let Some(path) = missing {
        return Some(format!("{}: there is no {path}", command.place));
    }
    if let Some(target) = target(command).filter(|target| !target.exists()) {
        return Some(format!("{}: there is no {}", command.place, target.display()));
    }
    let arguments = command.arguments()?;
    let mut program = Command::new(env!("CARGO_BIN_EXE_fem-run"));
    let ran = program.args(arguments).arg("--help").output().unwrap();
    (!ran.status.success()).then(|| {
        let shown = command.words.join(" ");
        format!("{}: {shown}: {}", command.place, String::from_utf8_lossy(&ran.stderr))
    })
}

#[test]
fn commands_in_docs_are_parsed() {
    let mut shown = Vec::new();
    for page in Page::all() {
        shown.extend(page.blocks().iter().flat_map(|block| commands(&page, block)));
        for code in page.code().iter().filter(|code| code.text.starts_with("fem-run ")) {
            let words = words(&code.text.replace('…', ""));
            shown.push(Shown { place: format!("{}:{}", page.path, code.line), words });
        }
    }
    assert!(shown.len() > 40, "{}", shown.len());
    let faults: Vec<String> = shown.iter().filter_map(fault).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
