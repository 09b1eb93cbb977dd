//! `fem-run sweep`: many members of one case, side by side in one folder.
//!
//! ```text
//! fem::sweep ─ runner ──── member folders ─ collect ─ table (sweep.csv)
//! members,     progress,   members/ID/       rows      figure (sweep.svg)
//! threads      keeping     renamed into place
//! ```
//!
//! `slurm` writes a script with which a batch system computes shards, `status` prints the progress.
//!
//! Processes share nothing but the file system. A member is identified by its input, so the same command
//! continues a stopped sweep, and shards on several machines fill one folder. Table and figure are made from
//! the content of `members/` alone, by every process that finishes: the same bytes in any order.

mod collect;
mod cost_estimate;
mod folder;
mod manifest;
mod member_store;
mod report;
mod runner;
mod shard;
mod slurm;
mod status;

pub use collect::Collector;
pub use cost_estimate::SweepCost;
pub use folder::SweepFolder;
pub use manifest::Manifest;
pub use member_store::ShardFilter;
pub use report::{announce, conclude, report, warning_lines};
pub use runner::{SweepJob, run_members};
pub use shard::Shard;
pub use slurm::{SlurmBatch, SlurmOptions};
pub use status::status;
