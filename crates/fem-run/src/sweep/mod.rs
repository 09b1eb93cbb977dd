//! `fem-run sweep`: many members of one case, side by side in one folder.
//!
//! ```text
//! fem::sweep ─ runner ──── member folders ─ collect ─ table (sweep.csv)
//! members,     progress,   members/ID/       rows      picture (sweep.svg)
//! threads      keeping     renamed into place
//! ```
//!
//! `slurm` writes a script that has shards computed by a batch system, `status` says how far they are.
//!
//! The file system is all that processes share. A member is known by what it computes, so the
//! same command goes on where another one stopped, and shards of a batch system fill one folder.
//! Table and picture are made from what is in `members/` alone, by whoever finishes one: the same
//! bytes whatever the order.

mod board;
mod checking;
mod collect;
mod duration;
mod expected;
mod folder;
mod mark;
mod packs;
mod report;
mod runner;
mod shard;
mod slurm;
mod status;
pub mod warnings;

pub use checking::Checking;
pub use collect::{Collected, Collector};
pub use expected::Expected;
pub use folder::SweepFolder;
pub use mark::Mark;
pub use packs::Whose;
pub use report::{announce, conclude, report};
pub use runner::{Job, run_members};
pub use shard::Shard;
pub use slurm::{Batch, SlurmOptions};
pub use status::status;
