//! Calibration: a Prony series of a material from measured restitutions, and what they leave undetermined.
//!
//! ```text
//! fault ─── target ─────── pair_model ── experiment ─┬─ calibration ─┬─ warnings ─ stored_calibration
//! settings  relaxing       restitutions  a pair and  │  weights      └─ curves
//!           material       of a series   its speeds  │
//!           speed_span                               maxwell
//!           mesh, Hertz
//! ```
//!
//! The case gives bodies and instantaneous moduli. Each pair of bodies has one model for all of its
//! speeds; `fem_data::estimate::spectrum` finds the weights. A measured relaxation of the case may be its prior knowledge (`prior`).

mod calibration;
mod curves;
mod experiment;
mod fault;
mod flow;
mod maxwell;
mod pair_model;
mod prior;
mod settings;
mod speed_span;
mod stored_calibration;
mod target;
mod warnings;

pub use calibration::Calibration;
pub use curves::{Abscissa, RestitutionCurves};
pub use experiment::Experiment;
pub use fault::CalibrationFault;
pub use flow::FlowFit;
pub use maxwell::{Beyond, Maxwell};
pub use prior::Prior;
pub use settings::{CalibrationModel, SettingNames, Settings};
pub use speed_span::SpeedDoubt;
pub use target::Target;

pub use fem_data::estimate::spectrum::SpectrumFit;
