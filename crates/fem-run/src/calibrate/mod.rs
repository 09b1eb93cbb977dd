//! A calibration as `fem-run calibrate` shows it.

mod failures;
mod picture;
mod report;

pub use picture::calibration_picture;
pub use report::calibration_text;
