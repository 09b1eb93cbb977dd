//! Printing of results and warnings.

use std::io::{ErrorKind, Write, stderr, stdout};
use std::path::Path;

use super::failure::Failure;

pub use fem_report::number_text::one_line;

/// Returns a path on one line.
pub fn shown(path: &Path) -> String {
    one_line(&path.display().to_string())
}

/// Prints text to stdout. A reader that has gone away (`fem-run check CASE | head`) is no error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::failed(format!("the standard output cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}

pub fn note(note: &str) {
    // A closed stderr is no reason to end.
    let _ = writeln!(stderr(), "note: {}", one_line(note));
}

pub fn warn(warnings: impl IntoIterator<Item = String>) {
    for warning in warnings {
        // A closed stderr is no reason to end.
        let _ = writeln!(stderr(), "warning: {}", one_line(&warning));
    }
}
