//! The command as its users call it, in one program: linked once, its tests run side by side.

mod accuracy;
mod bad_input;
mod bounces;
mod common;
mod cost_estimate;
mod folders;
mod laws;
mod models;
mod one_number;
mod sweeps;
mod texts;
mod validate;
mod workspace_structure;

/// The program that these tests run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_fem-run");

/// Sends a signal to a process.
#[cfg(unix)]
pub fn send(child: &std::process::Child, signal: nix::sys::signal::Signal) {
    let process = nix::unistd::Pid::from_raw(child.id().cast_signed());
    nix::sys::signal::kill(process, signal).unwrap();
}
