//! Hidden folders in which results are written, and the recovery of those whose process was killed.
//!
//! A hidden folder lies next to the final place of its result. It contains a lock file with the name of that
//! place, which its process keeps locked: whoever gets the lock knows that the process is gone. The lock file
//! is the first file in the folder and the last one to be removed, so a killed process leaves a folder with
//! a lock file or an empty one.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::TempDir;

use super::existing_output::{ExistingOutput, LOCK_FILE};
use super::whole_file::{PREFIX, SUFFIX, with_usual_permissions};

/// The subfolder that holds the old result while a new one takes its place.
const OLD: &str = "old";
/// Age from which a temporary file is removed; it has no lock that would show whether it is in use.
const GRACE: Duration = Duration::from_secs(3600);
/// Attempts to create a folder that other processes may remove before it is locked.
const ATTEMPTS: usize = 10;

/// A hidden folder of this process. Dropping it removes it.
#[derive(Debug)]
pub struct HiddenFolder {
    folder: TempDir,
    /// `None` on a file system without locks, where no process cleans up.
    lock: Option<File>,
    is_temporary: bool,
}

impl HiddenFolder {
    /// Creates a folder next to `target` with the permissions of any new folder.
    pub fn beside(target: &Path) -> io::Result<Self> {
        let parent = target.parent().unwrap_or(Path::new("/"));
        let name = target.file_name().unwrap_or_default();
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX);
        with_usual_permissions(&mut builder, 0o777);
        for _ in 0..ATTEMPTS {
            let folder = builder.tempdir_in(parent)?;
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
            return Ok(Self { folder, lock, is_temporary: true });
        }
        Err(io::Error::other("other runs keep removing new folders"))
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn old(&self) -> PathBuf {
        self.path().join(OLD)
    }

    pub fn keep(&mut self) -> PathBuf {
        self.disarm();
        // Without a lock file no process removes the folder.
        let _ = fs::remove_file(self.path().join(LOCK_FILE));
        self.path().to_path_buf()
    }

    /// Makes dropping the folder leave it where it is.
    pub fn disarm(&mut self) {
        self.is_temporary = false;
        self.folder.disable_cleanup(true);
    }

    /// Removes the folder if it contains nothing but the lock file.
    pub fn remove(&mut self) -> io::Result<()> {
        fs::remove_file(self.path().join(LOCK_FILE))?;
        fs::remove_dir(self.path())
    }

    /// Moves the folder to the place of its result.
    pub fn move_to(&mut self, target: &Path) -> io::Result<()> {
        // Other systems do not move a folder with an open file.
        if cfg!(not(unix)) {
            drop(self.lock.take());
        }
        fs::rename(self.path(), target)?;
        self.disarm();
        let _ = fs::remove_file(target.join(LOCK_FILE));
        Ok(())
    }
}

impl Drop for HiddenFolder {
    fn drop(&mut self) {
        if self.is_temporary {
            let _ = remove_lock_last(self.path());
        }
    }
}

fn remove_lock_last(path: &Path) -> io::Result<()> {
    for entry in lock_last(path)? {
        match entry.symlink_metadata()?.is_dir() {
            true => fs::remove_dir_all(entry)?,
            false => fs::remove_file(entry)?,
        }
    }
    fs::remove_dir(path)
}

/// Returns the entries of a hidden folder in the order in which they are removed.
fn lock_last(path: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(path)?.map(|entry| entry.map(|entry| entry.path()));
    let mut entries = entries.collect::<io::Result<Vec<_>>>()?;
    entries.sort_by_key(|entry| entry.ends_with(LOCK_FILE));
    Ok(entries)
}

/// Recovers what killed processes left in a folder: finished results are moved to their places, files of the
/// user go back to their result, everything else is removed. Files that cannot be removed stay.
pub fn recover_leftovers(parent: &Path) {
    let Ok(entries) = fs::read_dir(parent) else { return };
    let names = entries.filter_map(Result::ok).map(|entry| entry.file_name());
    let hidden = names.filter(|name| name.to_string_lossy().starts_with(PREFIX));
    let mut with_old = Vec::new();
    for name in hidden {
        let path = parent.join(&name);
        if path.is_dir() {
            if path.join(OLD).is_dir() {
                with_old.push(path);
            } else if let Some((lock, target)) = take_abandoned(parent, &path) {
                recover_new(&path, &target);
                drop(lock);
            } else {
                // Removes an empty folder whose process was killed before it had a lock. A process that
                // lives creates another folder.
                let _ = fs::remove_dir(&path);
            }
        } else if name.to_string_lossy().ends_with(SUFFIX) && is_past_grace(&path) {
            let _ = fs::remove_file(&path);
        }
    }
    // After the new results, which may take the places of the old ones.
    for path in with_old {
        if let Some((lock, target)) = take_abandoned(parent, &path) {
            recover_old(&path, &target);
            drop(lock);
        }
    }
}

/// Locks a folder whose process is gone; returns the lock and the place of the result.
fn take_abandoned(parent: &Path, path: &Path) -> Option<(File, PathBuf)> {
    let lock_file = path.join(LOCK_FILE);
    let mut file = File::options().read(true).write(true).open(&lock_file).ok()?;
    file.try_lock().ok()?;
    let mut name = Vec::new();
    file.read_to_end(&mut name).ok()?;
    let name = String::from_utf8(name).ok()?;
    // Another process may have recovered the folder in the meantime.
    lock_file.exists().then(|| (file, parent.join(name)))
}

fn recover_new(path: &Path, target: &Path) {
    match (ExistingOutput::at(path), target.file_name()) {
        (Ok(ExistingOutput::Result(new)), Some(_)) => match ExistingOutput::at(target) {
            // The process was killed after it had moved the old result aside.
            Ok(ExistingOutput::Absent) => {
                if fs::rename(path, target).is_ok() {
                    let _ = fs::remove_file(target.join(LOCK_FILE));
                }
            }
            Ok(_) => {
                let moved = new.move_user_files(path, target);
                let _ = moved.and_then(|()| remove_lock_last(path));
            }
            Err(_) => {}
        },
        // An unfinished result contains no file of the user.
        (Ok(_), _) => drop(remove_lock_last(path)),
        (Err(_), _) => {}
    }
}

fn recover_old(path: &Path, target: &Path) {
    let old = path.join(OLD);
    let is_free = matches!(ExistingOutput::at(target), Ok(ExistingOutput::Absent));
    let done = match ExistingOutput::at(&old) {
        _ if is_free => fs::rename(&old, target),
        Ok(ExistingOutput::Result(result)) => {
            result.move_user_files(&old, target).and_then(|()| result.remove_own_files(&old))
        }
        Ok(ExistingOutput::Empty) => fs::remove_dir(&old),
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

    /// A process that is killed while it removes a folder leaves one that the next process recovers.
    #[test]
    fn the_lock_file_is_removed_last() {
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

    /// A folder without a lock may be removed by others; its process creates another one.
    #[test]
    fn folders_are_created_while_others_recover() {
        let place = tempfile::tempdir().unwrap();
        let ends = AtomicBool::new(false);
        thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    while !ends.load(Ordering::Relaxed) {
                        recover_leftovers(place.path());
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
