//! Files that appear whole or not at all: VTK reads a truncated file as zero points, silently.

use std::io::Write;
use std::path::Path;

use crate::error::Error;

/// Writes a hidden temporary file beside `path`, then renames it over `path`.
pub(crate) fn write_atomically(path: &Path, parts: &[&[u8]]) -> Result<(), Error> {
    let io_error = |source| Error::Io { path: path.to_path_buf(), source };
    let name =
        path.file_name().ok_or_else(|| io_error(std::io::ErrorKind::InvalidFilename.into()))?;
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let prefix = format!(".{}.", name.to_string_lossy());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any new file: the umask applies. The default of the crate is owner only.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder).map_err(io_error)?;
    for part in parts {
        file.write_all(part).map_err(io_error)?;
    }
    file.persist(path).map_err(|error| io_error(error.error))?;
    Ok(())
}
