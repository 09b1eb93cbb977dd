//! Relaxation of a material from a data sheet: moduli over frequency or time become a Prony series.
//!
//! ```text
//! crate::table::ModulusTable ─ found ─┬─ superposition: blocks of temperatures to a master curve, by joint least squares
//!                                     ├─ series: non-negative least squares
//!                                     └─ stored: relaxation.json and the table of a case
//! ```

mod determination;
mod found;
mod joint;
mod reduced;
mod series;
mod stored;
mod superposition;

pub use found::{FoundRelaxation, RelaxationSettings};
pub use reduced::reduced_series;
pub use series::{FittedSeries, FittedTerm, fit_series};
pub use stored::{shift_toml, toml_key};
pub use superposition::{Block, FittedShift, Superposition};
