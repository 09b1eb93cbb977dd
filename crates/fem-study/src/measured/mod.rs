//! Measured data: restitutions from text with names and units, with the place of every error.
//!
//! ```text
//! quantity          20 cm ± 1 mm
//! data_error ─┬─ restitutions ─ pairs ──────── e(v) of one pair of bodies, or of several
//!             │
//!             └─ column_roles ─ table ─┬────── restitution_table
//!                speed_cm_s     CSV    ├────── cradle_trials
//!                                      ├────── moduli: storage and loss over frequency (temperature_blocks)
//!                                      └────── number_columns: long records
//! ```
//!
//! Callers pass texts and their names; nothing is opened here. Tables need the feature `csv`.

#[cfg(feature = "csv")]
mod column_roles;
#[cfg(feature = "csv")]
mod cradle_trials;
#[cfg(feature = "csv")]
mod csv_dialect;
mod data_error;
#[cfg(feature = "csv")]
mod library_data;
#[cfg(feature = "csv")]
mod moduli;
#[cfg(feature = "csv")]
mod number_columns;
mod pairs;
mod quantity;
#[cfg(feature = "csv")]
mod restitution_table;
mod restitutions;
#[cfg(feature = "csv")]
mod rows;
#[cfg(feature = "csv")]
mod table;
#[cfg(feature = "csv")]
mod temperature_blocks;

#[cfg(feature = "csv")]
pub use cradle_trials::cradle_trials;
#[cfg(feature = "csv")]
pub use csv_dialect::decode;
pub use data_error::DataError;
#[cfg(feature = "csv")]
pub use library_data::{is_of_library, library_table};
#[cfg(feature = "csv")]
pub use moduli::{Modulus, ModulusPoint, ModulusTable, TestKind};
#[cfg(feature = "csv")]
pub use number_columns::{NumberColumn, NumberColumns};
pub use pairs::{MeasuredPair, MeasuredPairs};
pub use quantity::{Kind, NotMeasured, parse_measured};
pub(crate) use restitutions::ACCEPTED_BOUNDS;
pub use restitutions::{MAX_UNCERTAINTY, Restitutions, UncertaintyError, UnevenUncertainties};
#[cfg(feature = "csv")]
pub use rows::rows_below;
#[cfg(feature = "csv")]
pub use table::Table;

pub use crate::fit::Point;
