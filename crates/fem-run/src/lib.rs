//! The `fem-run` command: how do two viscoelastic spheres collide?
//!
//! ```text
//! arguments ─ commands/run ─ fem ──────── result folder ─ fem ────── history, snapshots, ─ report
//!             one file a     Simulation   claimed         run        summary                stdout
//!             subcommand     (exit 2)     (exit 2)        (1, 130)   files, renamed
//!                                                                    into place
//! ```
//!
//! The program in `bin` is one line over [`run`]. Another front door, such as Python's, takes [`run`] for the
//! command, and of what commands do the part before files and printing ([`fit`] and the others of `jobs`).
//!
//! stdout carries the result, stderr everything else. The exit status is 0 (done), 1 (the run
//! failed), 2 (bad input, nothing written) or 130 (interrupted).

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "the command has the clock, the terminal and the exit status"
)]

mod accuracy;
mod arguments;
mod bounces;
mod calibrate;
mod case_arguments;
mod commands;
mod data_file;
mod export;
mod failure;
mod failure_figure;
mod fit;
mod forecast;
mod hidden_folder;
mod interrupt;
mod jobs;
mod law_arguments;
mod law_failures;
mod occupant;
mod output;
mod own_file;
mod peak_memory;
mod place;
mod progress;
mod report;
mod restart;
mod result_files;
mod result_folder;
mod save;
mod standard_output;
mod stopwatch;
mod sweep;
mod tables;
mod uncertainty;
mod validation;
mod whole_file;

use std::ffi::OsString;
use std::time::Instant;

pub use failure::{Failure, Status};
pub use jobs::{Given, calibrate, check, cradle, export, fit, invert, material, stopped};
pub use save::save;
pub use stopwatch::{Stopwatch, Timed};

/// Does what a command line asks for, the name of the program first, and gives the exit status; help, version
/// and what is no command line end the process.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    let started = Instant::now();
    match arguments::parse(words).execute(started) {
        Ok(()) => 0,
        Err(failure) => {
            failure.print();
            failure.status() as u8
        }
    }
}
