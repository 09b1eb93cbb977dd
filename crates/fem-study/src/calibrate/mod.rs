//! Calibration: a Prony series of a material from measured restitutions, and what they leave open.
//!
//! ```text
//! fault ─── target ─────── pair_model ── experiment ─┬─ calibration ─┬─ warnings ─ numbers
//! settings  what relaxes   restitutions  a pair and  │  weights      ├─ relaxation
//!           speed_span     of a series   its speeds  │               └─ curves
//!           mesh, Hertz                              maxwell
//! ```
//!
//! The case gives bodies and instantaneous moduli. Each pair of bodies has one model for all of its
//! speeds; `crate::fit::spectrum` finds the weights.

mod calibration;
mod curves;
mod experiment;
mod fault;
mod maxwell;
mod numbers;
mod pair_model;
mod relaxation;
mod settings;
mod speed_span;
mod target;
mod warnings;

pub use calibration::Calibration;
pub use curves::{Abscissa, RestitutionCurves};
pub use experiment::Experiment;
pub use fault::CalibrationFault;
pub use maxwell::{Beyond, Maxwell};
pub use numbers::{
    CalibrationNumbers, CombinationNumbers, ExponentNumbers, MaxwellNumbers, PairNumbers,
    RangeNumbers, TermNumbers,
};
pub use settings::{CalibrationModel, SettingNames, Settings};
pub use speed_span::SpeedDoubt;
pub use target::Target;

pub use crate::fit::spectrum::SpectrumFit;
