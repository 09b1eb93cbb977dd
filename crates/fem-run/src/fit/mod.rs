//! A fit as `fem-run fit` shows it.

mod picture;
mod ranking;
mod report;

pub use picture::{fit_picture, histories_picture};
pub use ranking::{ranking_csv, ranking_text};
pub use report::fit_text;
