//! Commands about contact laws and measured data.

pub mod calibrate;
mod calibration_text;
pub mod cradle;
pub mod export;
mod export_text;
mod failures;
pub mod fit;
mod fit_text;
mod friction;
pub mod invert;
