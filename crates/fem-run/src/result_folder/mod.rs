//! The folder of a result: claimed before the run, filled in a hidden folder next to its final place, and moved
//! there in one step at the end.
//!
//! ```text
//! whole_file ─ existing_output ─ origin ─ hidden_folder ─ ResultFolder ─ run_files, restart, command_output
//! ```
//!
//! An old result stays in place until then, and survives a run that is rejected or killed. It is replaced by
//! a complete or interrupted result of the same [`Origin`]. Files that users put into a result folder are moved
//! to the new one.

pub mod command_output;
mod existing_output;
mod hidden_folder;
mod origin;
pub mod restart;
pub mod run_files;
pub mod whole_file;

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::text::{Failure, shown};
use existing_output::{ExistingOutput, ExistingResult};
use hidden_folder::HiddenFolder;
use whole_file::{MadeFolders, unwritten, write_lasting};

pub use hidden_folder::recover_leftovers;
pub use origin::Origin;

const ATTEMPTS: usize = 100;
/// Looks at a folder after which it counts as foreign.
const LOOKS: usize = 5;

#[derive(Debug)]
pub struct ResultPath {
    pub out: PathBuf,
    /// The default folder, if it holds another result.
    pub taken: Option<PathBuf>,
    /// Whether the folder holds the result of an earlier version of the same files, which will be replaced.
    pub replaces_earlier: bool,
}

impl ResultPath {
    /// Returns `out` if it is given, and else `runs/<name>`. If that holds a result that may not be replaced, the
    /// folder is the first free one beside it ([`Origin::folders_beside`]).
    pub fn choose(out: Option<&Path>, name: &str, origin: &Origin, force: bool) -> Self {
        let allows = |old: &ExistingResult, at: &Path| force || origin.replaces(old, at);
        let existing = |path: &Path| match ExistingOutput::at(path) {
            Ok(ExistingOutput::Result(old)) => Some(old),
            _ => None,
        };
        let at = |out: &Path, taken: Option<PathBuf>| {
            let is_earlier = |old: ExistingResult| {
                allows(&old, out) && old.made_from() != Some(origin.made_from())
            };
            let replaces_earlier = existing(out).is_some_and(is_earlier);
            Self { out: out.to_path_buf(), taken, replaces_earlier }
        };
        if let Some(out) = out {
            return at(out, None);
        }
        let is_free = |path: &Path| existing(path).is_none_or(|old| allows(&old, path));
        let default = Path::new("runs").join(name);
        if is_free(&default) {
            return at(&default, None);
        }
        let beside = origin.folders_beside(&default).find(|path| is_free(path));
        at(&beside.unwrap_or_else(|| default.clone()), Some(default))
    }

    /// Returns why the folder is not the default one, or what it replaces, to follow its name.
    pub fn note(&self) -> String {
        match (&self.taken, self.replaces_earlier) {
            (Some(taken), _) => format!(" ({} holds another result)", shown(taken)),
            (None, true) => " (replaces an earlier result)".to_string(),
            (None, false) => String::new(),
        }
    }
}

/// A claimed folder. Dropped before it is published, it leaves nothing behind.
#[derive(Debug)]
pub struct ResultFolder {
    /// The path in messages, as the user named it.
    shown: PathBuf,
    /// The absolute path with symbolic links resolved.
    target: PathBuf,
    hidden: Option<HiddenFolder>,
    /// What the result to come is made from; without it, it may replace any.
    origin: Option<Origin>,
    force: bool,
    /// Dropped after the hidden folder.
    _made: MadeFolders,
}

impl ResultFolder {
    /// Claims `out` for a result of this origin without touching its content, and recovers what killed runs left next
    /// to it. `longest_name` is the longest file name to come; `force` allows it to replace any result.
    pub fn claim(
        out: &Path,
        longest_name: &str,
        origin: Origin,
        force: bool,
    ) -> Result<Self, Failure> {
        if let Some(parent) = resolve(out)?.parent() {
            recover_leftovers(parent);
        }
        Self::claim_recovered(out, longest_name, Some(origin), force)
    }

    /// Claims a folder where nothing is left to recover.
    pub(crate) fn claim_recovered(
        out: &Path,
        longest_name: &str,
        origin: Option<Origin>,
        force: bool,
    ) -> Result<Self, Failure> {
        let target = resolve(out)?;
        check_place(out, &target, |old| allows(origin.as_ref(), force, old, &target))?;
        let cannot = |error: io::Error| {
            let what = format!("{}: a result", shown(out));
            unwritten(&what, &error, "name a folder in a place that you may write to")
        };
        let parent = target.parent().unwrap_or(Path::new("/")).to_path_buf();
        let made = MadeFolders::above(&target);
        // A folder beside the target of a link is not beside the link.
        let shown = if out.is_symlink() { target.clone() } else { out.to_path_buf() };
        let mut folder = Self { shown, target, hidden: None, origin, force, _made: made };
        fs::create_dir_all(&parent).map_err(cannot)?;
        // The system rejects an impossible name only now.
        ExistingOutput::at(&folder.target).map_err(cannot)?;
        let hidden = HiddenFolder::beside(&folder.target).map_err(cannot)?;
        let probe = hidden.path().join(longest_name);
        folder.hidden = Some(hidden);
        fs::write(&probe, "fem-run\n").and_then(|()| fs::remove_file(&probe)).map_err(cannot)?;
        Ok(folder)
    }

    /// Returns the hidden folder for the files.
    pub fn path(&self) -> &Path {
        self.hidden.as_ref().map_or(&self.target, HiddenFolder::path)
    }

    /// Writes a file into the final place at once, which may hold an old result or not exist yet.
    pub(crate) fn write_ahead(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        match fs::create_dir(&self.target) {
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error),
            _ => {}
        }
        write_lasting(&self.target.join(name), self.path(), bytes)
    }

    /// Moves the files to their place and returns it as the user would name it. A result that lacks files is
    /// written next to an old one.
    pub fn publish(mut self, is_whole: bool) -> Result<PathBuf, Failure> {
        let Some(mut hidden) = self.hidden.take() else { return Ok(self.shown.clone()) };
        let may_replace = |old: &ExistingResult| {
            is_whole && allows(self.origin.as_ref(), self.force, old, &self.target)
        };
        let placed = put_in_place(&mut hidden, &self.target, &self.shown, may_replace);
        let place = shown(&self.shown);
        match placed {
            // The place was free for this result when it was claimed.
            Ok(beside) if is_whole && beside != self.shown => {
                let message = format!("{place}: another result was written here meanwhile");
                Err(Failure::failed(message)
                    .with_help(format!("that result stays; this one is in {}", shown(&beside))))
            }
            Ok(place) => Ok(place),
            Err(error) => {
                let message = format!("{place}: the result cannot be moved here: {error}");
                let kept = format!("it is kept in {}", shown(&hidden.keep()));
                Err(Failure::failed(message).with_help(kept))
            }
        }
    }

    /// Returns the source of the result to come ([`Origin::source`]).
    pub fn source(&self) -> Option<String> {
        self.origin.as_ref().and_then(|origin| origin.source(&self.target))
    }
}

fn resolve(out: &Path) -> Result<PathBuf, Failure> {
    let fault = |found: &str| {
        Failure::bad_input(format!("{}: {found}", shown(out)))
            .with_help("name a folder for the result, such as --out runs/first")
    };
    if out.symlink_metadata().is_ok() {
        return out.canonicalize().map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => {
                fault("this is a symbolic link to something that does not exist")
            }
            _ => fault(&error.to_string()),
        });
    }
    let path = std::path::absolute(out).ok().filter(|_| out.file_name().is_some());
    path.ok_or_else(|| fault("this is not the name of a folder"))
}

fn allows(origin: Option<&Origin>, force: bool, old: &ExistingResult, target: &Path) -> bool {
    force || origin.is_none_or(|origin| origin.replaces(old, target))
}

fn check_place(
    out: &Path,
    target: &Path,
    allows: impl Fn(&ExistingResult) -> bool,
) -> Result<(), Failure> {
    let named = shown(out);
    let refuse = |found: &str| {
        Err(Failure::bad_input(format!("{named}: {found}")).with_help(
            "name another folder with --out, or move this one away; only result folders of fem-run \
             are replaced",
        ))
    };
    match ExistingOutput::at(target) {
        Ok(ExistingOutput::File) => refuse("a file is in the way"),
        Ok(ExistingOutput::Foreign) => refuse("this folder is not a result of fem-run"),
        Ok(ExistingOutput::Absent) => Ok(()),
        Ok(ExistingOutput::Result(old)) if !allows(&old) => {
            let source = old.source().map_or(String::new(), |source| format!(": {source}"));
            let message = format!("{named}: this folder holds another result{source}");
            Err(Failure::bad_input(message).with_help(
                "name another folder with --out, or replace that result with --force; without it, a result \
                 replaces only one of the same files and overrides, or of the same case",
            ))
        }
        Ok(ExistingOutput::Empty | ExistingOutput::Result(_)) => {
            let is_current = env::current_dir()
                .and_then(|folder| folder.canonicalize())
                .is_ok_and(|folder| folder.starts_with(target));
            if is_current { refuse("this is the folder you are in") } else { Ok(()) }
        }
        // A path through a file: creating its folder will report that.
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => Ok(()),
        Err(error) => refuse(&format!("this folder cannot be read: {error}")),
    }
}

/// Moves a hidden folder to `target`, or next to it, and returns its place as the user would name it.
fn put_in_place(
    hidden: &mut HiddenFolder,
    target: &Path,
    shown: &Path,
    may_replace: impl Fn(&ExistingResult) -> bool,
) -> io::Result<PathBuf> {
    let (mut target, mut shown) = (target.to_path_buf(), shown.to_path_buf());
    let mut n_foreign = 0;
    for _ in 0..ATTEMPTS {
        let existing = match ExistingOutput::at(&target) {
            // Another run removed it during the look.
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            existing => existing?,
        };
        match existing {
            ExistingOutput::Absent | ExistingOutput::Empty => {
                // Renaming fails if the folder is not empty: another run was faster.
                match hidden.move_to(&target) {
                    Err(error) if is_taken(&error) => {}
                    result => return result.map(|()| shown),
                }
            }
            ExistingOutput::Result(old) if may_replace(&old) => {
                if replace(hidden, &target)? {
                    return Ok(shown);
                }
            }
            // A result that another run is removing looks foreign: look again.
            ExistingOutput::Foreign if n_foreign < LOOKS => n_foreign += 1,
            // Someone put it there during the run, or the new result lacks files.
            ExistingOutput::Foreign | ExistingOutput::File | ExistingOutput::Result(_) => {
                target = with_suffix(&target, ".new");
                shown = with_suffix(&shown, ".new");
            }
        }
    }
    Err(io::Error::other("other runs keep writing to it"))
}

/// Replaces an old result; returns false if another run has replaced it first. If it is killed on the way, the next run
/// recovers the hidden folders that it leaves.
fn replace(hidden: &mut HiddenFolder, target: &Path) -> io::Result<bool> {
    let mut aside = HiddenFolder::beside(target)?;
    let old_folder = aside.old();
    match fs::rename(target, &old_folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
        result => result?,
    }
    // From now on the folder holds the old result and must not be removed.
    aside.disarm();
    let put_back = |mut aside: HiddenFolder| {
        fs::rename(&old_folder, target)?;
        aside.remove()
    };
    // Another run may have replaced what was seen before; nobody can any more.
    let ExistingOutput::Result(old) = ExistingOutput::at(&old_folder)? else {
        return put_back(aside).map(|()| false);
    };
    let moved = old.move_user_files(&old_folder, hidden.path());
    let placed = moved.and_then(|()| hidden.move_to(target));
    if let Err(error) = &placed
        && !is_taken(error)
    {
        put_back(aside)?;
        return placed.map(|()| false);
    }
    // What cannot be deleted stays; no result is lost.
    let _ = old.remove_own_files(&old_folder).and_then(|()| aside.remove());
    Ok(placed.is_ok())
}

fn is_taken(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::DirectoryNotEmpty | io::ErrorKind::AlreadyExists)
}

fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(suffix);
    path.with_file_name(name)
}
