//! A fit as `fem-run fit` shows it.

mod ranking;
mod report;

pub use ranking::{ranking_csv, ranking_text};
pub use report::fit_text;
