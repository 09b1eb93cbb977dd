//! Everything that reads what a user has written.

mod case;
mod checkpoint;
mod code;
mod command;
mod mesh;
mod sweep;
mod table;

use std::fs;
use std::path::{Path, PathBuf};

use crate::target::Target;

/// Something that is fed.
pub struct Entry {
    /// What it is called.
    pub name: &'static str,
    /// Its part of all inputs, per cent: more of those that are cheap.
    pub share: u64,
    /// Makes it, of the path of the command, which one of them runs.
    pub make: fn(&Path) -> Box<dyn Target>,
}

const fn entry(name: &'static str, share: u64, make: fn(&Path) -> Box<dyn Target>) -> Entry {
    Entry { name, share, make }
}

/// All of them.
pub const TARGETS: [Entry; 7] = [
    entry("mesh", 30, |_| Box::new(mesh::MeshFile::new())),
    entry("table", 25, |_| Box::new(table::DataTable::new())),
    entry("sweep", 20, |_| Box::new(sweep::SweepText::new())),
    entry("checkpoint", 12, |_| Box::new(checkpoint::Checkpoint::new())),
    entry("code", 5, |_| Box::new(code::CaseInCode::new())),
    entry("case", 7, |_| Box::new(case::CaseText::new())),
    entry("command", 1, |path| Box::new(command::Command::new(path))),
];

fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_path_buf()
}

/// The files of a folder of the repository with this ending, in the order of their names.
fn files(folder: &str, ending: &str) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(root().join(folder)).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == ending));
    paths.sort();
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().to_string();
    paths.iter().filter_map(|path| Some((name(path), fs::read(path).ok()?))).collect()
}

/// The cases of the repository.
fn cases() -> Vec<Vec<u8>> {
    let shipped = files("cases", "toml").into_iter();
    shipped.filter(|(name, _)| !name.starts_with("sweep")).map(|(_, text)| text).collect()
}
