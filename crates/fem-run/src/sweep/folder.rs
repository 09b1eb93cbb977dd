//! The folder of a sweep: `sweep.json` by which it is known, one folder a member in `members/`,
//! table and picture. Several processes may write into it at the same time.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use fem::results::{HISTORY_FILE, PROGRAM, SUMMARY_FILE};
use fem_case::Keep;
use serde_json::Value;

use crate::failure::Failure;
use crate::hidden_folder::sweep_leftovers;
use crate::occupant::missing_parents;
use crate::standard_output::one_line;
use crate::whole_file::{PREFIX, write_streamed};

/// What the sweep is: its keys and the members' values and folders.
pub const MARK_FILE: &str = "sweep.json";
/// The plot.
pub const PICTURE_FILE: &str = "sweep.svg";
const MEMBERS: &str = "members";

/// A folder that holds this sweep and no other result.
#[derive(Clone, Debug)]
pub struct SweepFolder {
    path: PathBuf,
}

impl SweepFolder {
    /// Takes a new or empty folder or that of an earlier sweep, and writes what `mark` writes into it.
    ///
    /// # Errors
    /// A place that cannot be written, or that holds something else.
    pub fn claim(
        out: &Path,
        mark: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<Self, Failure> {
        let named = one_line(&out.display().to_string());
        let refuse = |found: &str| {
            Err(Failure::bad_input(format!("--out {named}: {found}")).with_help(
                "name another folder with --out, or move this one away; a sweep goes on only in \
                 a folder of fem-run sweep",
            ))
        };
        if out.file_name().is_none() {
            return refuse("this is no name of a folder");
        }
        match fs::metadata(out) {
            Ok(metadata) if !metadata.is_dir() => return refuse("a file is in the way"),
            Ok(_) => match is_ours(out) {
                Ok(true) => {}
                Ok(false) => return refuse("this folder holds something else than a sweep"),
                Err(error) => return refuse(&format!("this folder cannot be read: {error}")),
            },
            Err(_) => {}
        }
        sweep_leftovers(out);
        sweep_leftovers(&out.join(MEMBERS));
        let made: Vec<_> = missing_parents(&out.join(MEMBERS));
        let folder = Self { path: out.to_path_buf() };
        folder.prepare(mark).map_err(|error| {
            for folder in &made {
                // Only removes what is empty.
                let _ = fs::remove_dir(folder);
            }
            let message = format!("--out {named}: a sweep cannot be written here: {error}");
            Failure::bad_input(message).with_help("name a folder in a place that you may write to")
        })?;
        Ok(folder)
    }

    /// As [`SweepFolder::claim`], of a folder that may hold this sweep already: its mark is left as it is.
    ///
    /// # Errors
    /// As [`SweepFolder::claim`].
    pub fn join(
        out: &Path,
        mark: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<Self, Failure> {
        match out.join(MARK_FILE).is_file() && is_ours(out).unwrap_or(false) {
            true => Ok(Self::at(out)),
            false => Self::claim(out, mark),
        }
    }

    /// The folder as it is, to look into; it may not be there.
    pub fn at(out: &Path) -> Self {
        Self { path: out.to_path_buf() }
    }

    /// The mark comes first: a folder without it is not taken for a sweep's.
    fn prepare(&self, mark: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        fs::create_dir_all(&self.path)?;
        self.write(MARK_FILE, mark)?;
        fs::create_dir_all(self.path.join(MEMBERS))
    }

    /// The folder, as the user named it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where the result of a member goes.
    pub fn member(&self, identity: &str) -> PathBuf {
        self.path.join(MEMBERS).join(identity)
    }

    /// Whether all that is to be kept of a member is there.
    pub fn has(&self, identity: &str, keep: Keep) -> bool {
        let folder = self.member(identity);
        let has_history = keep == Keep::Summary || folder.join(HISTORY_FILE).is_file();
        has_history && self.summary(identity).is_some()
    }

    /// The summary of a member that has been computed.
    pub fn summary(&self, identity: &str) -> Option<Value> {
        let bytes = fs::read(self.member(identity).join(SUMMARY_FILE)).ok()?;
        let summary: Value = serde_json::from_slice(&bytes).ok()?;
        (summary["program"] == PROGRAM && summary["complete"].is_boolean()).then_some(summary)
    }

    /// Writes a file in one go: readers see the old one or the new one.
    ///
    /// # Errors
    /// The file system.
    pub fn write(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        write_streamed(&self.path.join(name), &self.path, write)
    }

    /// Removes a file that is out of date, if it is there.
    pub fn remove(&self, name: &str) {
        let _ = fs::remove_file(self.path.join(name));
    }
}

/// Whether the folder is empty or a sweep's, perhaps one that another process is just making.
fn is_ours(path: &Path) -> io::Result<bool> {
    let mark = fs::read(path.join(MARK_FILE)).unwrap_or_default();
    if serde_json::from_slice::<Value>(&mark).is_ok_and(|mark| mark["program"] == PROGRAM) {
        return Ok(true);
    }
    for entry in fs::read_dir(path)? {
        if !entry?.file_name().to_string_lossy().starts_with(PREFIX) {
            // The mark may have come in between.
            let mark = fs::read(path.join(MARK_FILE)).unwrap_or_default();
            let mark = serde_json::from_slice::<Value>(&mark);
            return Ok(mark.is_ok_and(|mark| mark["program"] == PROGRAM));
        }
    }
    Ok(true)
}
