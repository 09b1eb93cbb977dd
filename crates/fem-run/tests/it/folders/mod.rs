//! Result folders: their files, what they replace, and what interrupted or killed runs leave.

mod corrupted_restart;
mod full_disk;
mod killed_run_recovery;
mod repeatability;
mod restart;
mod result_folder;
mod result_replacement;
mod stopping;
