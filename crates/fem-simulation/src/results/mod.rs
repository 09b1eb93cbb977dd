//! The stored results of a collision: the summary, the CSV files, the snapshots, and the warnings.

pub(crate) mod diagnostics;
pub(crate) mod grouped_warnings;
mod input_uncertainty;
mod measured;
mod relaxation_band;
pub(crate) mod stop_advice;
mod uncertainty;

#[cfg(feature = "files")]
mod csv_files;
mod dent;
mod energy;
#[cfg(feature = "files")]
mod snapshots;
mod summarise;
mod summary;
mod tangential;

pub use crate::error::ElasticNull;
#[cfg(feature = "files")]
pub use csv_files::{
    CONTACT_FILE, DENT_FILE, HISTORY_FILE, HistoryColumns, PROBES_FILE, contact_csv, dent_csv,
    has_contact, history_columns, history_csv, probes_csv,
};
pub use dent::{DentProfile, DentSummary, dents};
pub use energy::{Accounts, Energy};
pub use fem_collision::{PROGRAM, Status, energy_key};
pub use measured::MeasuredSummary;
pub use relaxation_band::SeriesTail;
#[cfg(feature = "files")]
pub use snapshots::write_snapshots;
pub use summary::{
    AdhesionSummary, BodySummary, BounceSummary, CostSummary, EffectSummary, Parts, PerQuantity,
    PlateSummary, Quantities, RelaxationCoverage, RestSummary, SUMMARY_FILE, Side, Summary,
};
