//! The result, or anything else, that already exists where a result will be written.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use serde::Deserialize;

use fem::results::{PROGRAM, SUMMARY_FILE};
use fem::{CheckpointHead, checkpoint_head};
use fem_report::report::REPORT_FILE;

/// Files that identify a result folder: a run writes summary.json, the command of the same name each other file.
const IDENTIFYING_FILES: [&str; 8] = [
    SUMMARY_FILE,
    "fit.json",
    "calibrate.json",
    "export.json",
    "cradle.json",
    "measure.json",
    "relaxation.json",
    "accuracy.json",
];
/// The restart file in a result folder.
pub const RESTART_FILE: &str = "fem-run.restart";
/// Bytes that contain the first line of a restart file.
const HEAD_BYTES: u64 = 1024;
/// The file that the process writing a hidden folder keeps locked.
pub const LOCK_FILE: &str = ".fem-run-lock";

#[derive(Debug)]
pub enum ExistingOutput {
    Absent,
    Empty,
    Result(ExistingResult),
    Foreign,
    File,
}

/// A result folder of this program. It has one of [`IDENTIFYING_FILES`], or the restart file of an unfinished run.
#[derive(Debug)]
pub struct ExistingResult {
    /// Names of the files that the program wrote; all others belong to the user.
    files: BTreeSet<String>,
    made_from: Option<String>,
    source: Option<String>,
}

#[derive(Deserialize)]
struct OwnershipKeys {
    program: String,
    files: Vec<String>,
    made_from: Option<String>,
    source: Option<String>,
}

impl ExistingOutput {
    pub fn at(path: &Path) -> io::Result<Self> {
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
        let finished = IDENTIFYING_FILES.iter().find_map(|name| {
            let text = fs::read(path.join(name)).ok()?;
            let keys: OwnershipKeys = serde_json::from_slice(&text).ok()?;
            (keys.program == PROGRAM).then_some((keys.files, keys.made_from, keys.source))
        });
        let unfinished = || Some((Vec::new(), Some(restart_head(path)?.case), None));
        Ok(finished.or_else(unfinished).map_or(Self::Foreign, |(files, made_from, source)| {
            let hidden = [RESTART_FILE, LOCK_FILE, REPORT_FILE].map(String::from);
            Self::Result(ExistingResult {
                files: files.into_iter().chain(hidden).collect(),
                made_from,
                source,
            })
        }))
    }
}

impl ExistingResult {
    /// Returns the digest of the input that the result was made from, if it is recorded.
    pub fn made_from(&self) -> Option<&str> {
        self.made_from.as_deref()
    }

    /// Returns the files and options that the result was made from, if they are recorded ([`super::Origin::source`]).
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// Moves the user's files from `old` to `new`. A name that exists there gets `.kept` appended.
    pub fn move_user_files(&self, old: &Path, new: &Path) -> io::Result<()> {
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

    /// Deletes the program's files in `old`, the identifying ones last, and then the folder.
    pub fn remove_own_files(&self, old: &Path) -> io::Result<()> {
        let identifies = |name: &&String| IDENTIFYING_FILES.contains(&name.as_str());
        let (last, first): (Vec<_>, Vec<_>) = self.files.iter().partition(identifies);
        for name in first.into_iter().chain(last) {
            let path = old.join(name);
            // The program writes no files into folders below.
            if path.parent() == Some(old) && path.symlink_metadata().is_ok() {
                fs::remove_file(path)?;
            }
        }
        fs::remove_dir(old)
    }
}

/// Returns the head of the restart file in a folder, if there is one.
pub fn restart_head(folder: &Path) -> Option<CheckpointHead> {
    let mut bytes = Vec::new();
    let file = File::open(folder.join(RESTART_FILE)).ok()?;
    file.take(HEAD_BYTES).read_to_end(&mut bytes).ok()?;
    checkpoint_head(&bytes).ok()
}
