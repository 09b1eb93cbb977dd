//! Printing of results and warnings.

use std::io::{ErrorKind, Write, stderr, stdout};
use std::path::Path;

use comfy_table::Table;

use super::failure::Failure;
use super::tables::wrapped_at;

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
    tell("note: ", note);
}

pub fn warn(warnings: impl IntoIterator<Item = String>) {
    warnings.into_iter().for_each(|warning| tell("warning: ", &warning));
}

/// Prints a text to stderr, on one line or, on a terminal, on as many as its width needs.
pub fn tell(before: &str, text: &str) {
    let text = format!("{before}{}", one_line(text));
    let indent = " ".repeat(before.len());
    let width = Table::new().use_stderr().width().map(usize::from);
    let text = width.map_or(text.clone(), |width| wrapped_at(width, &indent, &text));
    // A closed stderr is no reason to end.
    let _ = writeln!(stderr(), "{text}");
}
