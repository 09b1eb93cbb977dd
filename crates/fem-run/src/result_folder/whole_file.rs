//! Files that appear whole or not at all, and files of other programs that are never overwritten.

use std::error::Error;
use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::text::{Failure, shown, standard_output};

pub const PREFIX: &str = ".fem-run-";
pub const SUFFIX: &str = ".tmp";
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
    written(beside, write)?.persist(path)?;
    Ok(())
}

/// Writes a file that does not exist yet; see [`write_whole`].
pub fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    written(folder_of(path), |file| file.write_all(bytes))?.persist_noclobber(path)?;
    Ok(())
}

/// Replaces a file that must survive a crash of the machine in one step; see [`write_whole`].
pub fn write_lasting(path: &Path, beside: &Path, bytes: &[u8]) -> io::Result<()> {
    let file = written(beside, |file| file.write_all(bytes))?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}

/// Returns the folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Returns a temporary file with the output of `write`.
fn written(
    beside: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    with_usual_permissions(&mut builder, 0o666);
    let file = builder.tempfile_in(beside)?;
    let mut buffer = BufWriter::new(file.as_file());
    write(&mut buffer)?;
    buffer.into_inner()?;
    Ok(file)
}

/// Returns why a file cannot be written, without the path of a temporary file.
pub fn cause(error: &(dyn Error + 'static)) -> String {
    let Some(found) = system_error(error) else { return error.to_string() };
    match found.kind() {
        io::ErrorKind::FileTooLarge => {
            "the limit on the size of files (ulimit -f) is reached".into()
        }
        io::ErrorKind::QuotaExceeded => "the disk quota is used up".into(),
        io::ErrorKind::StorageFull => "the disk is full".into(),
        kind if found.get_ref().is_some() => kind.to_string(),
        _ => found.to_string(),
    }
}

/// Returns the failure of a command that cannot write `what`: a valid job without room, or a place for which `help` is.
pub fn unwritten(what: &str, error: &(dyn Error + 'static), help: &str) -> Failure {
    use io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
    let message = format!("{what} cannot be written: {}", cause(error));
    let kind = system_error(error).map(io::Error::kind);
    match matches!(kind, Some(FileTooLarge | QuotaExceeded | StorageFull)) {
        true => Failure::failed(message),
        false => Failure::bad_input(message).with_help(help),
    }
}

/// Returns the error of the operating system that others wrap.
fn system_error<'a>(error: &'a (dyn Error + 'static)) -> Option<&'a io::Error> {
    if let Some(csv::ErrorKind::Io(inner)) = error.downcast_ref().map(csv::Error::kind) {
        return Some(inner);
    }
    let Some(found) = error.downcast_ref::<io::Error>() else {
        return error.source().and_then(system_error);
    };
    let inner = found.get_ref().and_then(|inner| system_error(inner));
    Some(inner.unwrap_or(found))
}

/// Folders that a command makes for its files. Those that are empty when it is dropped are removed.
#[derive(Debug)]
pub struct MadeFolders(Vec<PathBuf>);

impl MadeFolders {
    /// Notes the missing folders above a path, the innermost first.
    pub fn above(path: &Path) -> Self {
        let is_missing = |folder: &&Path| folder.symlink_metadata().is_err();
        Self(path.ancestors().skip(1).take_while(is_missing).map(Path::to_path_buf).collect())
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        for folder in &self.0 {
            let _ = fs::remove_dir(folder);
        }
    }
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
        let help = format!("name a file in a folder that you may write to with {}", self.option);
        write_whole(path, folder_of(path), bytes)
            .map_err(|error| unwritten(&shown, &error, &help))?;
        let (first, rest) = self.what.split_at(1);
        Ok(format!("{}{rest}: {shown}\n", first.to_uppercase()))
    }
}
