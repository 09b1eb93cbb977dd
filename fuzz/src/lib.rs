//! Hostile inputs for everything that reads what a user has written.
//!
//! ```text
//! random ─ mutate ─ Target::make ─ bytes ─ Target::take ─ accepted, refused, a finding
//! seed,    words,   one file a     of a    under          panic, lie, hang, memory,
//! number   lines,   reader         number  bounds         a file where there must be none
//!          bytes
//! ```
//!
//! An input is made of a seed and a number, and nothing else: a finding is known by these. Inputs are
//! changes of the shipped cases, data and meshes, so that many get past the first test. It runs on
//! stable Rust.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a program of its own, with clock and terminal"
)]

pub mod bounds;
mod mutate;
mod random;
mod target;
mod targets;
mod trial;

pub use target::{Taken, Target};
pub use targets::{Entry, TARGETS};
pub use trial::{Counts, Finding, input_of, try_inputs};
