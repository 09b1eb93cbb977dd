//! What stands in the place where a result shall go.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use fem::results::{PROGRAM, SUMMARY_FILE};

use crate::hidden_folder::LOCK_FILE;
use crate::restart::{RESTART_FILE, head_of};
use fem_report::report::REPORT_FILE;

/// Files by which a result folder is known: of a run, and of the commands with one of their own.
const MARK_FILES: [&str; 6] =
    [SUMMARY_FILE, "fit.json", "calibrate.json", "export.json", "cradle.json", "accuracy.json"];

/// What is at a path.
#[derive(Debug)]
pub enum Occupant {
    /// Nothing.
    Absent,
    /// A folder without entries.
    Empty,
    /// A result folder of this program.
    Result(OldResult),
    /// A folder of someone else's.
    Foreign,
    /// No folder.
    File,
}

/// A result folder of this program, known by one of [`MARK_FILES`], or by a restart file of a run that
/// is not over.
#[derive(Debug)]
pub struct OldResult {
    /// Names of the files that the program wrote; all others are the user's.
    files: BTreeSet<String>,
    /// Digest of what was asked for, if it says so.
    made_from: Option<String>,
}

/// The keys of such a file that tell whose it is.
#[derive(Deserialize)]
struct Marks {
    program: String,
    files: Vec<String>,
    made_from: Option<String>,
}

impl Occupant {
    /// Looks at a path, symbolic links followed.
    ///
    /// # Errors
    /// A folder that may not be read.
    pub fn of(path: &Path) -> io::Result<Self> {
        let metadata = match fs::metadata(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::Absent),
            metadata => metadata?,
        };
        if !metadata.is_dir() {
            return Ok(Self::File);
        }
        if fs::read_dir(path)?.next().is_none() {
            return Ok(Self::Empty);
        }
        let marks = MARK_FILES.iter().filter_map(|name| {
            let text = fs::read(path.join(name)).unwrap_or_default();
            serde_json::from_slice::<Marks>(&text).ok()
        });
        let under_way = || {
            let made_from = Some(head_of(path)?.case);
            Some(Marks { program: PROGRAM.to_string(), files: Vec::new(), made_from })
        };
        let mut ours = marks.filter(|marks| marks.program == PROGRAM);
        Ok(ours.next().or_else(under_way).map_or(Self::Foreign, |marks| {
            let files = marks
                .files
                .into_iter()
                .chain([RESTART_FILE, LOCK_FILE, REPORT_FILE].map(String::from));
            Self::Result(OldResult { files: files.collect(), made_from: marks.made_from })
        }))
    }
}

impl OldResult {
    /// Digest of what was asked for, if it says so.
    pub fn made_from(&self) -> Option<&str> {
        self.made_from.as_deref()
    }

    /// Moves everything that the program did not write from `old` to `new`. A name that is taken
    /// there gets `.kept` appended.
    ///
    /// # Errors
    /// The file system.
    pub fn move_foreign_files(&self, old: &Path, new: &Path) -> io::Result<()> {
        for entry in fs::read_dir(old)? {
            let name = entry?.file_name();
            if name.to_str().is_some_and(|name| self.files.contains(name)) {
                continue;
            }
            let mut kept = name.clone();
            while new.join(&kept).symlink_metadata().is_ok() {
                kept.push(".kept");
            }
            fs::rename(old.join(&name), new.join(&kept))?;
        }
        Ok(())
    }

    /// Deletes the program's own files in `old`, and the folder if nothing else is in it; the files by
    /// which it is known last.
    ///
    /// # Errors
    /// The file system; the folder if something else is in it.
    pub fn remove_own_files(&self, old: &Path) -> io::Result<()> {
        let is_mark = |name: &&String| MARK_FILES.contains(&name.as_str());
        let (marks, others): (Vec<_>, Vec<_>) = self.files.iter().partition(is_mark);
        for name in others.into_iter().chain(marks) {
            let path = old.join(name);
            // A name with a folder in it was not written by the program.
            if path.parent() == Some(old) && path.symlink_metadata().is_ok() {
                fs::remove_file(path)?;
            }
        }
        fs::remove_dir(old)
    }
}

/// The folders above `path` that do not exist yet, the outermost last.
pub fn missing_parents(path: &Path) -> Vec<PathBuf> {
    let is_missing = |folder: &&Path| folder.symlink_metadata().is_err();
    path.ancestors().skip(1).take_while(is_missing).map(Path::to_path_buf).collect()
}
