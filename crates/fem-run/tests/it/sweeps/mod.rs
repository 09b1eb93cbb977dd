//! Sweeps: members, files, invalid sweep files, batch systems.

#[cfg(unix)]
mod slurm;
mod sweep;
mod sweep_input;
mod sweep_packed;
