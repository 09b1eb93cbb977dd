//! Files that appear whole or not at all, and files of other programs that are never overwritten.

use std::fs::File;
use std::io::{self, BufWriter, Read, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::text::{Failure, shown, standard_output};

pub const PREFIX: &str = ".fem-run-";
pub const SUFFIX: &str = ".tmp";
/// The likely reasons why a file of a result cannot be written.
pub const DISK_FULL: &str = "is the disk full, or a quota or ulimit -f reached?";
/// Bytes at the beginning of a file in which its marker is searched.
const HEAD: u64 = 600;

/// Replaces a file in one step: readers see the old content or the new one. The temporary file is in the folder
/// `beside`, on the same file system.
pub fn write_whole(path: &Path, beside: &Path, bytes: &[u8]) -> io::Result<()> {
    write_streamed(path, beside, |file| file.write_all(bytes))
}

/// Replaces a file in one step by the output of `write`; see [`write_whole`].
pub fn write_streamed(
    path: &Path,
    beside: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = BufWriter::new(temporary_file(beside)?);
    write(&mut file)?;
    file.into_inner()?.persist(path)?;
    Ok(())
}

/// Replaces a file that must survive a crash of the machine in one step; see [`write_whole`].
pub fn write_lasting(path: &Path, beside: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = temporary_file(beside)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}

fn temporary_file(beside: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    with_usual_permissions(&mut builder, 0o666);
    builder.tempfile_in(beside)
}

/// Gives temporary files or folders the permissions of any new one, less the umask.
pub fn with_usual_permissions(builder: &mut tempfile::Builder<'_, '_>, mode: u32) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(mode));
    }
    #[cfg(not(unix))]
    let _ = (builder, mode);
}

/// A kind of file that a command writes where the user says. It replaces files of its own kind only.
#[derive(Clone, Copy, Debug)]
pub struct OwnedFileKind {
    /// The noun in messages.
    pub what: &'static str,
    /// The extension of its names.
    pub extension: &'static str,
    /// Text in the first lines of every such file.
    pub marker: &'static str,
    /// The option that names such a file.
    pub option: &'static str,
}

impl OwnedFileKind {
    /// Rejects a path with another extension, or of a file of another kind.
    pub fn check(&self, path: &Path) -> Result<(), Failure> {
        let shown = shown(path);
        let Self { what, extension, option, .. } = self;
        if path.extension().is_some_and(|found| !found.eq_ignore_ascii_case(extension)) {
            let message = format!("{shown}: a {what} of fem-run is a .{extension} file");
            let help = format!("name a .{extension} file with {option}");
            return Err(Failure::bad_input(message).with_help(help));
        }
        if path.exists() && !self.is_owned(path) {
            let message = format!("{shown}: this file is not a {what} of fem-run; it is kept");
            let help = format!("name another file with {option}");
            return Err(Failure::bad_input(message).with_help(help));
        }
        Ok(())
    }

    fn is_owned(&self, path: &Path) -> bool {
        let mut head = Vec::new();
        let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
        read.is_ok() && String::from_utf8_lossy(&head).contains(self.marker)
    }

    /// Writes such a file and returns the line that reports it; `-` is the standard output, without a line.
    pub fn write(&self, path: &Path, text: &str) -> Result<Option<String>, Failure> {
        if path == Path::new("-") {
            standard_output::print(text)?;
            return Ok(None);
        }
        self.check(path)?;
        self.replace(path, text.as_bytes()).map(Some)
    }

    /// Writes a file whatever is there, and returns the line that reports it.
    pub fn replace(&self, path: &Path, bytes: &[u8]) -> Result<String, Failure> {
        let shown = shown(path);
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        write_whole(path, folder.unwrap_or(Path::new(".")), bytes).map_err(|error| {
            use io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
            let message = format!("{shown}: {error}");
            if matches!(error.kind(), FileTooLarge | QuotaExceeded | StorageFull) {
                return Failure::failed(message).with_help(DISK_FULL);
            }
            let help =
                format!("name a file in a folder that you may write to with {}", self.option);
            Failure::bad_input(message).with_help(help)
        })?;
        let (first, rest) = self.what.split_at(1);
        Ok(format!("{}{rest}: {shown}\n", first.to_uppercase()))
    }
}
