//! Readers of files of a user.

mod case;
mod checkpoint;
mod code;
mod command;
mod mesh;
mod sweep;
mod table;

use std::fs;
use std::path::{Path, PathBuf};

use crate::trial::Target;

/// An entry of the list of targets.
pub struct Entry {
    /// Name of the target.
    pub name: &'static str,
    /// Share of all inputs, per cent; cheap targets get more.
    pub share: u64,
    /// Creates the target from the path of the command, which one target runs.
    pub make: fn(&Path) -> Box<dyn Target>,
}

const fn entry(name: &'static str, share: u64, make: fn(&Path) -> Box<dyn Target>) -> Entry {
    Entry { name, share, make }
}

/// All fuzz targets.
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

/// Returns the files of a folder of the repository with this extension, in the order of their names.
fn files(folder: &str, ending: &str) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(root().join(folder)).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == ending));
    paths.sort();
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().to_string();
    paths.iter().filter_map(|path| Some((name(path), fs::read(path).ok()?))).collect()
}

/// Returns the cases of the repository.
fn cases() -> Vec<Vec<u8>> {
    let shipped = files("cases", "toml").into_iter();
    shipped.filter(|(name, _)| !name.starts_with("sweep")).map(|(_, text)| text).collect()
}
