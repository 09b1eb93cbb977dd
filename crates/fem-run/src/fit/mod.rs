//! A fit as `fem-run fit` shows it.

mod picture;
mod report;

pub use picture::{fit_picture, histories_picture};
pub use report::fit_text;
