//! Many collisions: sweeps over a case's keys, calibration of materials and contact laws from measured
//! restitutions, and accuracy studies.
//!
//! ```text
//! sweep      a case at many values of its keys
//! laws       contact laws by their parameters: fitted, inverted, exported
//! calibrate  relaxation of a material from restitutions
//! accuracy   a scene computed in many ways: error against time
//! ```

pub mod accuracy;
pub mod calibrate;
pub mod laws;
pub mod sweep;
