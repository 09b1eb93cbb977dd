//! A calibration as `fem-run calibrate` shows it.

mod failures;
mod report;

pub use report::calibration_text;
