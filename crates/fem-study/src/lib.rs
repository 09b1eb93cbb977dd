//! Many collisions: sweeps over a case's keys, calibration of materials and contact laws from measured
//! restitutions, and accuracy studies.
//!
//! ```text
//! sweep      a case at many values of its keys
//! measured   data from tables and text, with the place of every fault
//! records    bounce times of a ball as they are measured
//! fit        least squares over contact laws, Prony series, DEM codes, Newton's cradle
//! laws       contact laws by their parameters: fitted, inverted, exported
//! calibrate  relaxation of a material from restitutions
//! relaxation relaxation of a material from moduli over frequency or time
//! accuracy   a scene computed in many ways: error against time
//! ```

pub mod accuracy;
pub mod calibrate;
pub mod fit;
pub mod laws;
pub mod measured;
#[cfg(feature = "csv")]
pub mod records;
#[cfg(feature = "csv")]
pub mod relaxation;
pub mod sweep;
