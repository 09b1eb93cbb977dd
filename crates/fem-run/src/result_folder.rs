//! The folder of a result: claimed before the run, filled in a hidden folder beside it, and put in
//! its place at the end in one go.
//!
//! An older result is in place until then, and survives a run that is refused or killed. Whatever
//! a run has computed, complete or not, then takes its place. What users put into a result folder
//! moves on into the new one.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::failure::Failure;
use crate::occupant::{Occupant, missing_parents};

/// Beginning of the names of hidden folders that a run works in.
const HIDDEN_PREFIX: &str = ".fem-run-";
/// Tries to get into a place that other runs are changing.
const TRIES: usize = 100;
/// Looks after which what seems no result is none.
const LOOKS: usize = 5;

/// A claimed folder. Dropped before it is published, it leaves nothing behind.
#[derive(Debug)]
pub struct ResultFolder {
    /// As the user named it.
    shown: PathBuf,
    /// Absolute, symbolic links resolved.
    target: PathBuf,
    staging: Option<TempDir>,
    /// Folders that were made for it, innermost first.
    made: Vec<PathBuf>,
}

impl ResultFolder {
    /// Claims `out`; nothing in it is touched. `longest_name` is the longest file name to come.
    ///
    /// # Errors
    /// A place that cannot be written, or that holds something else than an older result.
    pub fn claim(out: &Path, longest_name: &str) -> Result<Self, Failure> {
        let target = resolve(out)?;
        check_occupant(out, &target)?;
        let cannot = |error: io::Error| {
            let message = format!("--out {}: a result cannot be written here: {error}", show(out));
            Failure::bad_input(message).with_help("name a folder in a place that you may write to")
        };
        let parent = target.parent().unwrap_or(Path::new("/")).to_path_buf();
        let made = missing_parents(&target);
        // What goes beside a linked folder is not beside the link.
        let shown = if out.is_symlink() { target.clone() } else { out.to_path_buf() };
        let mut folder = Self { shown, target, staging: None, made };
        fs::create_dir_all(&parent).map_err(cannot)?;
        // Only now the system looks at the name itself.
        Occupant::of(&folder.target).map_err(cannot)?;
        let staging = hidden_folder(&parent).map_err(cannot)?;
        let probe = staging.path().join(longest_name);
        folder.staging = Some(staging);
        fs::write(&probe, PROBE).and_then(|()| fs::remove_file(&probe)).map_err(cannot)?;
        Ok(folder)
    }

    /// Where the files go until they are published.
    pub fn path(&self) -> &Path {
        self.staging.as_ref().map_or(&self.target, TempDir::path)
    }

    /// Puts the files in their place and tells where that is, in the user's terms.
    ///
    /// # Errors
    /// The place cannot be taken any more; the message says where the files are.
    pub fn publish(mut self) -> Result<PathBuf, Failure> {
        let Some(staging) = self.staging.take() else { return Ok(self.shown.clone()) };
        self.made.clear();
        let staging = staging.keep();
        put_in_place(&staging, &self.target, &self.shown).map_err(|error| {
            let message = format!(
                "--out {}: the result cannot be put in its place: {error}",
                show(&self.shown)
            );
            Failure::failed(message).with_help(format!("it is in {}", show(&staging)))
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

fn check_occupant(out: &Path, target: &Path) -> Result<(), Failure> {
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
fn put_in_place(staging: &Path, target: &Path, shown: &Path) -> io::Result<PathBuf> {
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
                match fs::rename(staging, &target) {
                    Err(error) if is_taken(&error) => {}
                    result => return result.map(|()| shown),
                }
            }
            Occupant::Result(_) => {
                if replace(staging, &target)? {
                    return Ok(shown);
                }
            }
            // A result that another run takes away while it is looked at has lost its marks: once more.
            Occupant::Foreign if n_strange < LOOKS => n_strange += 1,
            // Someone put it there during the run.
            Occupant::Foreign | Occupant::File => {
                target = append(&target, ".new");
                shown = append(&shown, ".new");
            }
        }
    }
    Err(io::Error::other("other runs keep writing to it"))
}

/// Replaces an older result; false if another run was faster.
fn replace(staging: &Path, target: &Path) -> io::Result<bool> {
    let parent = target.parent().unwrap_or(Path::new("/"));
    let aside = hidden_folder(parent)?.keep();
    let old_folder = aside.join("old");
    let put_back = || fs::rename(&old_folder, target).and_then(|()| fs::remove_dir(&aside));
    match fs::rename(target, &old_folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            fs::remove_dir(&aside)?;
            return Ok(false);
        }
        result => result?,
    }
    // Out of reach of other runs, it is what it is: one may have replaced what was seen before.
    let old = match Occupant::of(&old_folder)? {
        Occupant::Result(old) => old,
        _ => return put_back().map(|()| false),
    };
    let moved = old.move_foreign_files(&old_folder, staging);
    let placed = moved.and_then(|()| fs::rename(staging, target));
    if let Err(error) = &placed
        && !is_taken(error)
    {
        put_back()?;
        return placed.map(|()| false);
    }
    // What cannot be deleted stays: no result is lost by it.
    let _ = old.remove_own_files(&old_folder).and_then(|()| fs::remove_dir(&aside));
    Ok(placed.is_ok())
}

fn is_taken(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::DirectoryNotEmpty | io::ErrorKind::AlreadyExists)
}

/// A new hidden folder with the permissions of any new folder.
fn hidden_folder(parent: &Path) -> io::Result<TempDir> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(HIDDEN_PREFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o777));
    }
    builder.tempdir_in(parent)
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
