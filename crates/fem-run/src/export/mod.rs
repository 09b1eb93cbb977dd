//! An export as `fem-run export` shows it.

mod curves;
mod pairs;

pub use curves::export_text;
pub use pairs::{pairs_csv, pairs_json, pairs_text};
