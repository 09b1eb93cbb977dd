//! The folder of a result: claimed before the run, filled in a hidden folder beside it, and put in
//! its place at the end in one go.
//!
//! An older result is in place until then, and survives a run that is refused or killed. Whatever
//! a run has computed, complete or not, then takes the place of a result that the same case has made.
//! What users put into a result folder moves on into the new one.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::hidden_folder::{HiddenFolder, sweep_leftovers};
use crate::occupant::{Occupant, OldResult, missing_parents};
use crate::whole_file::write_lasting;

/// Tries to get into a place that other runs are changing.
const TRIES: usize = 100;
/// Looks after which what seems no result is none.
const LOOKS: usize = 5;

/// Which older results a new one may take the place of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Replaces {
    /// All of this program.
    Any,
    /// Those that were made from the same, known by its digest.
    MadeFrom(String),
}

impl Replaces {
    /// Those of the same case, or all by force.
    pub fn only(made_from: &str, force: bool) -> Self {
        if force { Self::Any } else { Self::MadeFrom(made_from.to_string()) }
    }

    /// Whether this one may be replaced.
    pub fn allows(&self, old: &OldResult) -> bool {
        match self {
            Self::Any => true,
            Self::MadeFrom(own) => old.made_from() == Some(own),
        }
    }
}

/// A claimed folder. Dropped before it is published, it leaves nothing behind.
#[derive(Debug)]
pub struct ResultFolder {
    /// As the user named it.
    shown: PathBuf,
    /// Absolute, symbolic links resolved.
    target: PathBuf,
    staging: Option<HiddenFolder>,
    replaces: Replaces,
    /// Folders that were made for it, innermost first.
    made: Vec<PathBuf>,
}

impl ResultFolder {
    /// Claims `out`; nothing in it is touched. `longest_name` is the longest file name to come. What
    /// killed runs have left beside it is swept away.
    ///
    /// # Errors
    /// A place that cannot be written, or that holds something else than a result that may be replaced.
    pub fn claim(out: &Path, longest_name: &str, replaces: Replaces) -> Result<Self, Failure> {
        if let Some(parent) = resolve(out)?.parent() {
            sweep_leftovers(parent);
        }
        Self::claim_swept(out, longest_name, replaces)
    }

    /// As [`ResultFolder::claim`], in a place where nothing is to be swept.
    ///
    /// # Errors
    /// As [`ResultFolder::claim`].
    pub fn claim_swept(
        out: &Path,
        longest_name: &str,
        replaces: Replaces,
    ) -> Result<Self, Failure> {
        let target = resolve(out)?;
        check_occupant(out, &target, &replaces)?;
        let cannot = |error: io::Error| {
            let message = format!("--out {}: a result cannot be written here: {error}", show(out));
            Failure::bad_input(message).with_help("name a folder in a place that you may write to")
        };
        let parent = target.parent().unwrap_or(Path::new("/")).to_path_buf();
        let made = missing_parents(&target);
        // What goes beside a linked folder is not beside the link.
        let shown = if out.is_symlink() { target.clone() } else { out.to_path_buf() };
        let mut folder = Self { shown, target, staging: None, replaces, made };
        fs::create_dir_all(&parent).map_err(cannot)?;
        // Only now the system looks at the name itself.
        Occupant::of(&folder.target).map_err(cannot)?;
        let staging = HiddenFolder::beside(&folder.target).map_err(cannot)?;
        let probe = staging.path().join(longest_name);
        folder.staging = Some(staging);
        fs::write(&probe, PROBE).and_then(|()| fs::remove_file(&probe)).map_err(cannot)?;
        Ok(folder)
    }

    /// Where the files go until they are published.
    pub fn path(&self) -> &Path {
        self.staging.as_ref().map_or(&self.target, HiddenFolder::path)
    }

    /// Puts a file into the place itself, which may hold an older result or not be there yet.
    ///
    /// # Errors
    /// The file system; a file of the same name is as it was then.
    pub fn write_ahead(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        match fs::create_dir(&self.target) {
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error),
            _ => {}
        }
        write_lasting(&self.target.join(name), self.path(), bytes)
    }

    /// Puts the files in their place and tells where that is, in the user's terms. A result that lacks
    /// files goes beside an older one.
    ///
    /// # Errors
    /// The place cannot be taken any more; the message says where the files are.
    pub fn publish(mut self, is_whole: bool) -> Result<PathBuf, Failure> {
        let Some(mut staging) = self.staging.take() else { return Ok(self.shown.clone()) };
        self.made.clear();
        let replaces = self.replaces.clone();
        let may_replace = |old: &OldResult| is_whole && replaces.allows(old);
        let placed = put_in_place(&mut staging, &self.target, &self.shown, may_replace);
        placed.map_err(|error| {
            let message = format!(
                "--out {}: the result cannot be put in its place: {error}",
                show(&self.shown)
            );
            Failure::failed(message).with_help(format!("it is in {}", show(&staging.keep())))
        })
    }
}

impl Drop for ResultFolder {
    fn drop(&mut self) {
        drop(self.staging.take());
        for folder in &self.made {
            // Only removes what is empty.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// What is written to see whether a file can be.
const PROBE: &[u8] = b"fem-run\n";

/// The absolute path of `out` with symbolic links resolved.
fn resolve(out: &Path) -> Result<PathBuf, Failure> {
    let named = show(out);
    let fault = |found: &str| {
        Failure::bad_input(format!("--out {named}: {found}"))
            .with_help("name a folder for the result, such as --out runs/first")
    };
    if out.symlink_metadata().is_ok() {
        return out.canonicalize().map_err(|error| {
            let is_dangling = error.kind() == io::ErrorKind::NotFound;
            if is_dangling {
                fault("this is a symbolic link to something that does not exist")
            } else {
                fault(&error.to_string())
            }
        });
    }
    let is_folder_name = out.file_name().is_some();
    let path = std::path::absolute(out).ok().filter(|_| is_folder_name);
    path.ok_or_else(|| fault("this is no name of a folder"))
}

fn check_occupant(out: &Path, target: &Path, replaces: &Replaces) -> Result<(), Failure> {
    let named = show(out);
    let refuse = |found: &str| {
        Err(Failure::bad_input(format!("--out {named}: {found}")).with_help(
            "name another folder with --out, or move this one away; only a result folder of \
             fem-run is replaced",
        ))
    };
    match Occupant::of(target) {
        Ok(Occupant::File) => refuse("a file is in the way"),
        Ok(Occupant::Foreign) => refuse("this folder is not a result of fem-run"),
        Ok(Occupant::Absent) => Ok(()),
        Ok(Occupant::Result(old)) if !replaces.allows(&old) => {
            let message = format!("--out {named}: this folder holds the result of another case");
            Err(Failure::bad_input(message).with_help(
                "name another folder with --out, or replace that result with --force; other [output] \
                 alone is no other case",
            ))
        }
        Ok(Occupant::Empty | Occupant::Result(_)) => {
            let is_around = env::current_dir()
                .and_then(|folder| folder.canonicalize())
                .is_ok_and(|folder| folder.starts_with(target));
            if is_around { refuse("this is the folder you are in") } else { Ok(()) }
        }
        // A path through a file does not exist; making its folder will say so.
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => Ok(()),
        Err(error) => refuse(&format!("this folder cannot be read: {error}")),
    }
}

/// Moves `staging` to `target`, or beside it, and returns where it is as the user would say it.
fn put_in_place(
    staging: &mut HiddenFolder,
    target: &Path,
    shown: &Path,
    may_replace: impl Fn(&OldResult) -> bool,
) -> io::Result<PathBuf> {
    let (mut target, mut shown) = (target.to_path_buf(), shown.to_path_buf());
    let mut n_strange = 0;
    for _ in 0..TRIES {
        let occupant = match Occupant::of(&target) {
            // Another run took it away while it was looked at.
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            occupant => occupant?,
        };
        match occupant {
            Occupant::Absent | Occupant::Empty => {
                // Renaming onto a folder that is not empty fails: another run was faster.
                match staging.move_to(&target) {
                    Err(error) if is_taken(&error) => {}
                    result => return result.map(|()| shown),
                }
            }
            Occupant::Result(old) if may_replace(&old) => {
                if replace(staging, &target)? {
                    return Ok(shown);
                }
            }
            // A result that another run takes away while it is looked at has lost its marks: once more.
            Occupant::Foreign if n_strange < LOOKS => n_strange += 1,
            // Someone put it there during the run, or the new result lacks files.
            Occupant::Foreign | Occupant::File | Occupant::Result(_) => {
                target = append(&target, ".new");
                shown = append(&shown, ".new");
            }
        }
    }
    Err(io::Error::other("other runs keep writing to it"))
}

/// Replaces an older result; false if another run was faster. Killed on the way, it leaves hidden
/// folders that the next run puts in order.
fn replace(staging: &mut HiddenFolder, target: &Path) -> io::Result<bool> {
    let mut aside = HiddenFolder::beside(target)?;
    let old_folder = aside.old();
    match fs::rename(target, &old_folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
        result => result?,
    }
    // What is in it now is not to go with it.
    aside.hold();
    let put_back = |mut aside: HiddenFolder| {
        fs::rename(&old_folder, target)?;
        aside.remove()
    };
    // Out of reach of other runs, it is what it is: one may have replaced what was seen before.
    let old = match Occupant::of(&old_folder)? {
        Occupant::Result(old) => old,
        _ => return put_back(aside).map(|()| false),
    };
    let moved = old.move_foreign_files(&old_folder, staging.path());
    let placed = moved.and_then(|()| staging.move_to(target));
    if let Err(error) = &placed
        && !is_taken(error)
    {
        put_back(aside)?;
        return placed.map(|()| false);
    }
    // What cannot be deleted stays: no result is lost by it.
    let _ = old.remove_own_files(&old_folder).and_then(|()| aside.remove());
    Ok(placed.is_ok())
}

fn is_taken(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::DirectoryNotEmpty | io::ErrorKind::AlreadyExists)
}

/// The folder beside `path` whose name has an ending more.
fn append(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(ending);
    path.with_file_name(name)
}

fn show(path: &Path) -> String {
    crate::standard_output::one_line(&path.display().to_string())
}
