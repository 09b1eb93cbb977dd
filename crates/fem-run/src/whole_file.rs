//! Files that appear whole or not at all.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::NamedTempFile;

/// Beginning and end of the names of files that are being written.
pub const PREFIX: &str = ".fem-run-";
/// See [`PREFIX`].
pub const SUFFIX: &str = ".tmp";

/// Writes a file in one go: readers see the old one, if there is one, or the new one. `beside` is a
/// folder of the same file system, in which it is written.
///
/// # Errors
/// The file system; nothing has changed then.
pub fn write_whole(path: &Path, beside: &Path, bytes: &[u8]) -> io::Result<()> {
    write_streamed(path, beside, |file| file.write_all(bytes))
}

/// As [`write_whole`], of what `write` writes.
///
/// # Errors
/// As [`write_whole`], and those of `write`.
pub fn write_streamed(
    path: &Path,
    beside: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = BufWriter::new(empty(beside)?);
    write(&mut file)?;
    file.into_inner()?.persist(path)?;
    Ok(())
}

/// As [`write_whole`], of a file that shall survive a machine that stops, too.
///
/// # Errors
/// As [`write_whole`].
pub fn write_lasting(path: &Path, beside: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = empty(beside)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}

fn empty(beside: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any new file: the umask applies.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(beside)
}
