//! The command as its users call it, in one program: linked once, its tests run side by side.

mod accuracy;
mod bad_input;
mod bounces;
mod calibrate;
mod common;
mod cost_estimate;
mod disturbed;
mod first_minutes;
mod fit;
mod full_disk;
mod house;
mod leftovers;
mod models;
mod numbers;
mod repeatability;
mod replacing;
mod report;
mod restart;
mod result_folder;
#[cfg(unix)]
mod slurm;
mod stopping;
mod streams;
mod sweep;
mod sweep_input;
mod sweep_packed;
mod terminal;
mod texts;
mod validate;
