//! Claims about this program's results, each compared with an independent reference.
//!
//! ```text
//! validation/NAME/claim.toml ─ Claim ─ study ─────────────── Findings ─ checks ─ ClaimResult
//!   what is claimed, cases,            one file in studies/   measured            page, table
//!   references, tolerances             runs the cases         quantities
//! ```
//!
//! A [`Claim`] is data: the cases, and for each quantity a reference with its source and a
//! tolerance with its reason. How quantities are measured is code: the claim names one of the
//! [`studies`](study_names). A [`Laboratory`] runs cases on all cores, each once.
//! [`evaluate`] makes a [`ClaimResult`] of a claim; [`page`], [`markdown`] and [`hard_scenes`] show many.

mod check;
mod claim;
mod claim_file;
mod error;
mod findings;
mod laboratory;
mod pages;
mod pulse;
mod run;
mod studies;

pub use check::{Check, CheckResult, Kind, Tolerance};
pub use claim::{Claim, RunFile, Section};
pub use claim_file::load_claims;
pub use error::{ClaimError, StudyError};
pub use findings::{Figure, Findings, Table};
pub use laboratory::{ClaimResult, Laboratory, Observer, ResultCache, StudyCost, evaluate};
pub use pages::{hard_scenes, has_hard_scenes, markdown, page, pictures};
pub use pulse::Pulse;
pub use run::{ExplicitRun, Run};
pub use studies::study_names;
