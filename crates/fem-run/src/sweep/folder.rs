//! The folder of a sweep: `sweep.json` by which it is known, in `members/` one folder a member or
//! [packs](super::packs), table and picture. Several processes may write into it at the same time.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use fem::results::{HISTORY_FILE, PROGRAM, SUMMARY_FILE};
use fem_case::Keep;
use serde_json::Value;

use super::packs::{Pack, Packs, Whose};
use super::shard::Shard;
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
/// Summaries that are in memory at the same time.
const AT_ONCE: usize = 1024;
/// Of a mark what tells that it is one.
const HEAD: u64 = 256;

/// A folder for a sweep.
#[derive(Debug)]
pub struct SweepFolder {
    path: PathBuf,
    packs: Packs,
}

impl SweepFolder {
    /// The folder as it is, to look into; it may not be there. `whose` packs are looked at.
    pub fn at(out: &Path, whose: Whose) -> Self {
        Self { path: out.to_path_buf(), packs: Packs::of(out.join(MEMBERS), whose) }
    }

    /// Whether it can be claimed, as far as that can be told without writing.
    ///
    /// # Errors
    /// A place that holds something else than a sweep.
    pub fn check(&self) -> Result<(), Failure> {
        let out = &self.path;
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
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => {
                return refuse("a file is in the way");
            }
            Err(_) => {}
        }
        Ok(())
    }

    /// Takes a new or empty folder or that of an earlier sweep, and writes what `mark` writes into it.
    ///
    /// # Errors
    /// A place that cannot be written, or that holds something else.
    pub fn claim(
        &self,
        mark: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        self.check()?;
        let out = &self.path;
        let named = one_line(&out.display().to_string());
        sweep_leftovers(out);
        sweep_leftovers(&out.join(MEMBERS));
        let made: Vec<_> = missing_parents(&out.join(MEMBERS));
        self.prepare(mark).map_err(|error| {
            for folder in &made {
                // Only removes what is empty.
                let _ = fs::remove_dir(folder);
            }
            let message = format!("--out {named}: a sweep cannot be written here: {error}");
            Failure::bad_input(message).with_help("name a folder in a place that you may write to")
        })
    }

    /// As [`SweepFolder::claim`], of a folder that may hold this sweep already: its mark is left as it is.
    ///
    /// # Errors
    /// As [`SweepFolder::claim`].
    pub fn join(&self, mark: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
        match self.path.join(MARK_FILE).is_file() && is_ours(&self.path).unwrap_or(false) {
            true => Ok(()),
            false => self.claim(mark),
        }
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

    /// A pack for this process.
    pub fn pack(&self, shard: Shard) -> Pack {
        Pack::new(&self.path.join(MEMBERS), shard)
    }

    /// Whether all that is to be kept of a member is there.
    pub fn has(&self, identity: &str, keep: Keep) -> bool {
        match keep {
            Keep::All => {
                self.member(identity).join(HISTORY_FILE).is_file() && self.alone(identity).is_some()
            }
            Keep::Summary => self.packs.has(identity) || self.alone(identity).is_some(),
            // Of a million members no file system is asked for what is not there.
            Keep::Packed => self.packs.has(identity) || self.unpacked(identity).is_some(),
        }
    }

    /// Looks at what other processes and this one have added.
    pub fn refresh(&mut self) {
        self.packs.refresh();
    }

    /// The summaries of members that have been computed, in the order of the members; some are in memory at
    /// a time.
    pub fn summaries<'a>(
        &'a self,
        mut identities: impl Iterator<Item = String> + 'a,
    ) -> impl Iterator<Item = Option<Value>> + 'a {
        std::iter::from_fn(move || {
            let some: Vec<String> = identities.by_ref().take(AT_ONCE).collect();
            (!some.is_empty()).then(|| {
                let packed = self.packs.summaries(&some);
                let both = some.into_iter().zip(packed);
                both.map(|(identity, packed)| packed.or_else(|| self.unpacked(&identity)))
            })
        })
        .flatten()
    }

    /// As `alone`, asked where the last look has found folders.
    fn unpacked(&self, identity: &str) -> Option<Value> {
        self.packs.has_others().then(|| self.alone(identity)).flatten()
    }

    /// The summary of a member in a folder of its own.
    fn alone(&self, identity: &str) -> Option<Value> {
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
    if has_mark(path) {
        return Ok(true);
    }
    for entry in fs::read_dir(path)? {
        if !entry?.file_name().to_string_lossy().starts_with(PREFIX) {
            // The mark may have come in between.
            return Ok(has_mark(path));
        }
    }
    Ok(true)
}

/// Whether there is a mark, which begins with the program whatever its spaces; of a million members it is
/// long.
fn has_mark(path: &Path) -> bool {
    let mut head = Vec::new();
    let file = File::open(path.join(MARK_FILE));
    let _ = file.and_then(|file| file.take(HEAD).read_to_end(&mut head));
    head.retain(|byte| !byte.is_ascii_whitespace());
    head.starts_with(format!("{{\"program\":\"{PROGRAM}\",").as_bytes())
}
