//! Relaxation of a material from a data sheet: moduli over frequency or time become a Prony series.
//!
//! ```text
//! crate::measured::ModulusTable ─ found ─┬─ series: non-negative least squares
//!                                        └─ stored: relaxation.json and the table of a case
//! ```

mod found;
mod series;
mod stored;

pub use found::{FoundRelaxation, RelaxationSettings};
pub use series::{FittedSeries, FittedTerm, fit_series};
