//! Checks the documentation: links and source references exist, commands are valid, and quoted output is what they
//! print.
//!
//! ```text
//! pages     a page's blocks, code in its text, links
//! shell     the commands in a block
//! pictures  pictures, their descriptions and the command that makes them
//! pointers  files, items and anchors
//! commands  valid commands
//! printed   output and files of commands that are run
//! keys      names in a result folder
//! prose     numbers in sentences
//! accuracy  the convergence table of the condensed model
//! contact   the table of contact methods
//! effects   the table of costs of effects
//! shipped_cases  the table of shipped cases
//! ```

mod accuracy;
mod commands;
#[path = "../it/common/mod.rs"]
mod common;
mod contact;
mod effects;
mod keys;
mod pages;
mod pictures;
mod pointers;
mod printed;
mod prose;
mod shell;
mod shipped_cases;

/// The program that these tests run.
const PROGRAM: &str = env!("CARGO_BIN_EXE_fem-run");
