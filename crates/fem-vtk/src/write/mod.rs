//! Writers of `.vtu` files and of their time series.

pub(crate) mod collection;
pub(crate) mod grid;
mod render;
pub(crate) mod writer;

use std::io::Write;
use std::path::Path;

use crate::error::Error;

/// Writes a hidden temporary file next to `path`, then renames it to `path`. A partly written file would be read by VTK as
/// zero points, without an error.
fn write_atomically(path: &Path, parts: &[&[u8]]) -> Result<(), Error> {
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
        // The umask applies as for any new file; the default of the crate is owner only.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder).map_err(io_error)?;
    for part in parts {
        file.write_all(part).map_err(io_error)?;
    }
    file.persist(path).map_err(|error| io_error(error.error))?;
    Ok(())
}
