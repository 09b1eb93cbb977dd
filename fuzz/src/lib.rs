//! Fuzzing: feeds damaged inputs to everything that reads files of a user.
//!
//! ```text
//! Random ─── mutate ───────────── Target::make ─ bytes ─ Target::take ─ accepted, rejected, or a finding:
//! seed and   words, lines, bytes   one input              with limits    panic, wrong value, time, memory,
//! number                                                                a file that should not exist
//! ```
//!
//! A seed and a number determine an input, so they identify a finding. Inputs are mutations of the shipped cases, data and
//! meshes, so that many pass the first checks. It runs on stable Rust.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a program that uses clock and terminal"
)]

pub mod bounds;
mod mutate;
mod targets;
mod trial;

pub use targets::{Entry, TARGETS};
pub use trial::{Counts, Finding, Taken, Target, input_of, try_inputs};
