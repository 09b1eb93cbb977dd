//! Result folders: their files, what they replace, and what interrupted or killed runs leave.

mod disturbed;
mod full_disk;
mod leftovers;
mod repeatability;
mod replacing;
mod restart;
mod result_folder;
mod stopping;
