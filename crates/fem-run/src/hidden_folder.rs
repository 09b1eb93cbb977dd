//! Hidden folders that results are made in, and what is left of those whose process was killed.
//!
//! A hidden folder lies beside the place of its result. In it is a file that its process holds locked
//! and that says which place that is: whoever gets the lock knows that the process is gone. That file is
//! the first in the folder and the last to go, so that whoever is killed leaves a folder with it or an
//! empty one.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::TempDir;

use crate::occupant::Occupant;
use crate::whole_file::{PREFIX, SUFFIX};

/// The file that is locked.
pub const LOCK_FILE: &str = ".fem-run-lock";
/// In it the older result waits while a new one takes its place.
const OLD: &str = "old";
/// A file that is being written has no lock, and is not touched before that.
const GRACE: Duration = Duration::from_secs(3600);
/// Folders that are swept away before they are locked.
const TRIES: usize = 10;

/// A hidden folder of this process; it goes when it is dropped.
#[derive(Debug)]
pub struct HiddenFolder {
    folder: TempDir,
    /// None where the file system has no locks: then nobody sweeps.
    lock: Option<File>,
    goes: bool,
}

impl HiddenFolder {
    /// A new one beside `target`, with the permissions of any new folder.
    ///
    /// # Errors
    /// The file system.
    pub fn beside(target: &Path) -> io::Result<Self> {
        let parent = target.parent().unwrap_or(Path::new("/"));
        let name = target.file_name().unwrap_or_default();
        for _ in 0..TRIES {
            let folder = new_folder(parent)?;
            let path = folder.path().join(LOCK_FILE);
            let mut file = match File::create_new(&path) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                file => file?,
            };
            let lock = match file.try_lock() {
                Err(TryLockError::WouldBlock) => continue,
                Err(TryLockError::Error(_)) => None,
                Ok(()) if !path.exists() => continue,
                Ok(()) => {
                    file.write_all(name.as_encoded_bytes())?;
                    Some(file)
                }
            };
            return Ok(Self { folder, lock, goes: true });
        }
        Err(io::Error::other("other runs keep sweeping new folders away"))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Where an older result waits in it.
    pub fn old(&self) -> PathBuf {
        self.path().join(OLD)
    }

    /// Leaves the folder where it is; what it holds is not lost.
    pub fn keep(&mut self) -> PathBuf {
        self.hold();
        // Nobody sweeps what has no lock.
        let _ = fs::remove_file(self.path().join(LOCK_FILE));
        self.path().to_path_buf()
    }

    /// From now on it does not go when it is dropped.
    pub fn hold(&mut self) {
        self.goes = false;
        self.folder.disable_cleanup(true);
    }

    /// Removes it if nothing is in it any more.
    ///
    /// # Errors
    /// Something is in it; the file system.
    pub fn remove(&mut self) -> io::Result<()> {
        fs::remove_file(self.path().join(LOCK_FILE))?;
        fs::remove_dir(self.path())
    }

    /// Moves it to the place of its result.
    ///
    /// # Errors
    /// The file system; a folder that is there and not empty. It stays then.
    pub fn move_to(&mut self, target: &Path) -> io::Result<()> {
        // Elsewhere a folder with an open file does not move.
        if cfg!(not(unix)) {
            drop(self.lock.take());
        }
        fs::rename(self.path(), target)?;
        // Where it was there is nothing any more.
        self.hold();
        let _ = fs::remove_file(target.join(LOCK_FILE));
        Ok(())
    }
}

impl Drop for HiddenFolder {
    fn drop(&mut self) {
        if self.goes {
            let _ = remove_lock_last(self.path());
        }
    }
}

/// Removes a hidden folder with all that is in it.
fn remove_lock_last(path: &Path) -> io::Result<()> {
    for entry in lock_last(path)? {
        match entry.symlink_metadata()?.is_dir() {
            true => fs::remove_dir_all(entry)?,
            false => fs::remove_file(entry)?,
        }
    }
    fs::remove_dir(path)
}

/// What is in a hidden folder, in the order in which it may go.
fn lock_last(path: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(path)?.map(|entry| entry.map(|entry| entry.path()));
    let mut entries = entries.collect::<io::Result<Vec<_>>>()?;
    entries.sort_by_key(|entry| entry.ends_with(LOCK_FILE));
    Ok(entries)
}

fn new_folder(parent: &Path) -> io::Result<TempDir> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o777));
    }
    builder.tempdir_in(parent)
}

/// Takes away what killed processes have left in a folder. What they had finished is put in its place;
/// what is the user's goes back to the result that it was in. What cannot be taken away stays.
pub fn sweep_leftovers(parent: &Path) {
    let Ok(entries) = fs::read_dir(parent) else { return };
    let names = entries.filter_map(Result::ok).map(|entry| entry.file_name());
    let hidden = names.filter(|name| name.to_string_lossy().starts_with(PREFIX));
    let mut with_old = Vec::new();
    for name in hidden {
        let path = parent.join(&name);
        if path.is_dir() {
            if path.join(OLD).is_dir() {
                with_old.push(path);
            } else if let Some((lock, target)) = abandoned(parent, &path) {
                sweep_new(&path, &target);
                drop(lock);
            } else {
                // Only removes what is empty: of one that was killed before it had a lock. A living one takes
                // another folder.
                let _ = fs::remove_dir(&path);
            }
        } else if name.to_string_lossy().ends_with(SUFFIX) && is_past_grace(&path) {
            let _ = fs::remove_file(&path);
        }
    }
    // After the new ones, which take the places of the old.
    for path in with_old {
        if let Some((lock, target)) = abandoned(parent, &path) {
            sweep_old(&path, &target);
            drop(lock);
        }
    }
}

/// The lock of a folder whose process is gone, and the place of its result.
fn abandoned(parent: &Path, path: &Path) -> Option<(File, PathBuf)> {
    let lock_file = path.join(LOCK_FILE);
    let mut file = File::options().read(true).write(true).open(&lock_file).ok()?;
    file.try_lock().ok()?;
    let mut name = Vec::new();
    file.read_to_end(&mut name).ok()?;
    let name = String::from_utf8(name).ok()?;
    // Another one that sweeps may have been faster.
    lock_file.exists().then(|| (file, parent.join(name)))
}

/// A new result whose process was killed.
fn sweep_new(path: &Path, target: &Path) {
    let has_name = target.file_name().is_some();
    match Occupant::of(path) {
        Ok(Occupant::Result(new)) if has_name => match Occupant::of(target) {
            // Killed when the older one was out of the way.
            Ok(Occupant::Absent) => {
                if fs::rename(path, target).is_ok() {
                    let _ = fs::remove_file(target.join(LOCK_FILE));
                }
            }
            Ok(_) => {
                let moved = new.move_foreign_files(path, target);
                let _ = moved.and_then(|()| remove_lock_last(path));
            }
            Err(_) => {}
        },
        // Not finished: there is nothing of the user's in it.
        Ok(_) => drop(remove_lock_last(path)),
        Err(_) => {}
    }
}

/// An older result that was out of the way when the process was killed.
fn sweep_old(path: &Path, target: &Path) {
    let old = path.join(OLD);
    let is_free = matches!(Occupant::of(target), Ok(Occupant::Absent));
    let done = match Occupant::of(&old) {
        _ if is_free => fs::rename(&old, target),
        Ok(Occupant::Result(marks)) => {
            marks.move_foreign_files(&old, target).and_then(|()| marks.remove_own_files(&old))
        }
        Ok(Occupant::Empty) => fs::remove_dir(&old),
        _ => return,
    };
    if done.is_ok() {
        let _ = fs::remove_file(path.join(LOCK_FILE)).and_then(|()| fs::remove_dir(path));
    }
}

fn is_past_grace(path: &Path) -> bool {
    let changed = path.metadata().and_then(|metadata| metadata.modified());
    changed.is_ok_and(|time| time.elapsed().is_ok_and(|age| age > GRACE))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::thread;

    use super::*;

    /// Killed at any instant of it, one that removes a folder leaves what the next finds.
    #[test]
    fn the_lock_is_the_last_that_goes() {
        let place = tempfile::tempdir().unwrap();
        let hidden = HiddenFolder::beside(&place.path().join("out")).unwrap();
        for name in [".a", "summary.json", "z"] {
            fs::write(hidden.path().join(name), "").unwrap();
        }
        fs::create_dir(hidden.path().join("folder")).unwrap();
        let order = lock_last(hidden.path()).unwrap();
        assert_eq!(order.len(), 5);
        assert!(order[4].ends_with(LOCK_FILE), "{order:?}");
        drop(hidden);
        assert!(fs::read_dir(place.path()).unwrap().next().is_none());
    }

    /// A folder that has no lock yet may be swept away; its process does not mind.
    #[test]
    fn folders_are_made_while_others_sweep() {
        let place = tempfile::tempdir().unwrap();
        let ends = AtomicBool::new(false);
        thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    while !ends.load(Ordering::Relaxed) {
                        sweep_leftovers(place.path());
                    }
                });
            }
            let made: Vec<_> =
                (0..2000).map(|_| HiddenFolder::beside(&place.path().join("out"))).collect();
            ends.store(true, Ordering::Relaxed);
            assert!(made.iter().flatten().all(|one| one.path().join(LOCK_FILE).exists()));
            assert_eq!(made.iter().filter(|one| one.is_err()).count(), 0);
        });
    }
}
