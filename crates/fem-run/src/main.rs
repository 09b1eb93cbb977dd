//! The `fem-run` command: how do two viscoelastic spheres collide?
//!
//! ```text
//! arguments ─ commands/run ─ fem ──────── result folder ─ fem ────── history, snapshots, ─ report
//!             one file a     Simulation   claimed         run        summary                stdout
//!             subcommand     (exit 2)     (exit 2)        (1, 130)   files, renamed
//!                                                                    into place
//! ```
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
mod failure;
mod fit;
mod forecast;
mod hidden_folder;
mod interrupt;
mod last_sound;
mod law_arguments;
mod law_failures;
mod occupant;
mod output;
mod page;
mod peak_memory;
mod place;
mod progress;
mod report;
mod restart;
mod result_files;
mod result_folder;
mod standard_output;
mod stopwatch;
mod sweep;
mod tables;
mod uncertainty;
mod validation;
mod whole_file;

use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let started = Instant::now();
    match arguments::parse().execute(started) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.print();
            failure.status().into()
        }
    }
}
