//! The most memory that this process ever held.

use fem::Simulation;

/// Bytes that the process will have held when a run is through: its companions may have taken more before it, or take
/// more after it. None of models without elements.
pub fn peak_memory_with(simulation: &Simulation) -> Option<u64> {
    let (run, companions) = simulation.memory_ahead()?;
    let held = peak_memory().unwrap_or(0);
    Some(run.max(held + companions.unwrap_or(0)))
}

/// Bytes; `None` where the system does not tell.
///
/// Linux: the high-water mark of the resident set since the program was loaded (`VmHWM`);
/// `getrusage` would also count the process that started this one.
#[cfg(target_os = "linux")]
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}

/// Bytes; `None` where the system does not tell.
#[cfg(all(unix, not(target_os = "linux")))]
pub fn peak_memory() -> Option<u64> {
    use nix::sys::resource::{UsageWho, getrusage};
    let size = u64::try_from(getrusage(UsageWho::RUSAGE_SELF).ok()?.max_rss()).ok()?;
    Some(if cfg!(target_vendor = "apple") { size } else { 1024 * size })
}

/// Bytes; `None` where the system does not tell.
#[cfg(not(unix))]
pub fn peak_memory() -> Option<u64> {
    None
}
