//! Faults of a case file: position, message and help.

mod gravity;
pub mod message_table;
mod positions;
mod scene;
