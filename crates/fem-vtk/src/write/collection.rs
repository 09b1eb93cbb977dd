//! Time series: a ParaView collection (`.pvd`) and the same series as JSON (`.vtu.series`).

use std::fmt::Write;
use std::path::Path;

use quick_xml::escape::escape;
use serde_json::json;

use crate::error::Error;
use crate::write::write_atomically;

/// Writes `path` (`<stem>.pvd`) and `<stem>.vtu.series` next to it.
///
/// `snapshots` are times in seconds and `.vtu` file names relative to `path`'s folder. Each of the two files is written
/// completely or not at all.
///
/// # Errors
///
/// There is no snapshot; a time is not finite or not later than the previous one (ParaView superposes files of the same
/// time); a file name is absolute or has `\` or control characters; or a file cannot be written.
pub fn write_collection<S: AsRef<str>>(
    path: impl AsRef<Path>,
    snapshots: &[(f64, S)],
) -> Result<(), Error> {
    let path = path.as_ref();
    if snapshots.is_empty() {
        return Err(Error::Empty { what: format!("collection {}", path.display()) });
    }
    let mut previous = None;
    for (time, file) in snapshots {
        check_snapshot(*time, previous, file.as_ref())?;
        previous = Some(*time);
    }
    write_atomically(&path.with_extension("vtu.series"), &[series(snapshots).as_bytes()])?;
    write_atomically(path, &[collection(snapshots).as_bytes()])
}

fn check_snapshot(time: f64, previous: Option<f64>, file: &str) -> Result<(), Error> {
    if !time.is_finite() || previous.is_some_and(|previous| time <= previous) {
        return Err(Error::Time { file: file.to_owned(), time, previous });
    }
    let absolute = file.starts_with('/') || file.contains(':');
    if file.is_empty() || absolute || file.contains('\\') || file.contains(char::is_control) {
        return Err(Error::FileName { file: file.to_owned() });
    }
    Ok(())
}

fn collection<S: AsRef<str>>(snapshots: &[(f64, S)]) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n",
    );
    for (time, file) in snapshots {
        let file = escape(file.as_ref());
        // `{:e}` is the shortest text that reads back as the same number.
        let _ = writeln!(
            text,
            "    <DataSet timestep=\"{time:e}\" group=\"\" part=\"0\" file=\"{file}\"/>"
        );
    }
    text.push_str("  </Collection>\n</VTKFile>\n");
    text
}

fn series<S: AsRef<str>>(snapshots: &[(f64, S)]) -> String {
    let files: Vec<_> =
        snapshots.iter().map(|(time, file)| json!({"name": file.as_ref(), "time": time})).collect();
    let series = json!({"file-series-version": "1.0", "files": files});
    format!("{series:#}\n")
}
