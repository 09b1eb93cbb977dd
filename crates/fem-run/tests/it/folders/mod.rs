//! Result folders: their files, what they replace, and what interrupted or killed runs leave.

mod corrupted_restart;
mod full_disk;
mod killed_run_recovery;
mod repeatability;
mod restart;
mod result_folder;
mod result_replacement;
mod stopping;

/// Sends a signal to a process.
#[cfg(unix)]
pub fn send(child: &std::process::Child, signal: nix::sys::signal::Signal) {
    let process = nix::unistd::Pid::from_raw(child.id().cast_signed());
    nix::sys::signal::kill(process, signal).unwrap();
}
