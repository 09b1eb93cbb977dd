//! What the documentation says is so: what it points at exists, the commands that it shows are
//! understood, what it shows as printed is what they print.
//!
//! ```text
//! pages     a page's blocks, code in its text, links
//! shell     the commands in a block
//! pointers  files, items and anchors
//! commands  that are understood
//! printed   that are run, and what they print and leave
//! keys      names in a result folder
//! prose     sizes that sentences name
//! accuracy  the table of what accuracy costs
//! contact   the table of ways to keep surfaces apart
//! effects   the table of what effects cost
//! shipped_cases  the table of the cases of the repository
//! ```

mod accuracy;
mod commands;
#[path = "../it/common/mod.rs"]
mod common;
mod contact;
mod effects;
mod keys;
mod pages;
mod pointers;
mod printed;
mod prose;
mod shell;
mod shipped_cases;
