//! Printing of results.

use std::io::{ErrorKind, Write, stderr, stdout};

use crate::failure::Failure;

pub use fem_report::number_text::one_line;

/// Prints to stdout. A reader that has gone away (`fem-run check CASE | head`) is no fault.
///
/// # Errors
/// A stdout that takes no more, such as a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::failed(format!("the standard output cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}

/// Warnings on stderr, which go with any result that is asked for.
pub fn warn(warnings: impl IntoIterator<Item = String>) {
    for warning in warnings {
        // Nobody is left to tell if stderr is closed.
        let _ = writeln!(stderr(), "warning: {}", one_line(&warning));
    }
}
