//! Faults of a case file: position, message and help.

mod gravity;
pub mod marked;
mod places;
mod scene;
