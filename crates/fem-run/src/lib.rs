//! The `fem-run` command: how do two viscoelastic spheres collide?
//!
//! ```text
//! arguments ─ commands ────── fem ───────── result_folder ─ fem ──────── result_folder ─ text
//!             one file per    Simulation    claimed         progress     files, moved    stdout
//!             command         (exit 2)      (exit 2)        (1, 130)     into place
//! ```
//!
//! The program in `bin` consists of one call of [`run`]. Other front ends, such as Python, use [`run`] for the
//! command, and the functions of `jobs` ([`numbers_of`] and others) for what a command computes before it writes files. The
//! program of the claims, `fem-validate`, is a job of its own ([`run_job`]) with the same folders, progress and text.
//!
//! stdout carries the result, stderr everything else. The exit status is 0 (done), 1 (the run failed), 2 (bad
//! input, nothing written) or 130 (interrupted).

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "the command has the clock, the terminal and the exit status"
)]

mod arguments;
mod commands;
mod forecast;
mod jobs;
mod progress;
mod result_folder;
mod sweep;
mod text;

use std::ffi::OsString;
use std::time::Instant;

pub use arguments::case::parse_count;
pub use commands::sweep::thread_pool;
pub use jobs::{JobInput, check, material, numbers_of, options, stopped};
pub use progress::ItemProgress;
pub use progress::interrupt::Interrupt;
pub use progress::stopwatch::{Stopwatch, Timed};
pub use result_folder::run_files::save;
pub use result_folder::whole_file::OwnedFileKind;
pub use result_folder::{Origin, ResultFolder};
pub use text::failure::{Failure, Status};
pub use text::standard_output::print;
pub use text::{headed, one_line, shown, table};

/// Runs a command line, whose first word is the program's name, and returns the exit status. Help, version
/// and invalid command lines end the process.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    let started = Instant::now();
    run_job(|| arguments::parse(words).execute(started))
}

/// Runs the job of a program, prints why it fails, and returns the exit status.
pub fn run_job(job: impl FnOnce() -> Result<(), Failure>) -> u8 {
    progress::interrupt::survive_file_limits();
    match job() {
        Ok(()) => 0,
        Err(failure) => {
            failure.print();
            failure.status() as u8
        }
    }
}
