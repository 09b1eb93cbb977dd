//! What `fem-run calibrate` does beside the command line: data to pairs of bodies, each pair to a
//! model that is factored once, and the found series to text, numbers, a picture and a table to
//! paste.

mod experiment;
mod faults;
mod maxwell;
mod numbers;
mod picture;
mod report;
mod verdict;

use std::path::Path;

use fem::measured::MeasuredPairs;
use fem_fit::spectrum::SpectrumFit;
use fem_material::{ActsOn, PronyTerm};

pub use experiment::{Experiment, ModelName, Target};
pub use faults::unused_model;
pub use maxwell::Maxwell;
pub use numbers::{calibration_numbers, relaxation_table};
pub use picture::calibration_picture;
pub use report::calibration_text;
pub use verdict::warnings;

/// All that was found.
pub struct Calibrated<'a> {
    pub case: &'a Path,
    pub measured: &'a MeasuredPairs,
    pub experiments: &'a [Experiment],
    pub target: &'a Target,
    pub model: ModelName,
    /// λ, in units of e.
    pub regularisation: f64,
    pub confidence: f64,
    /// Relaxation times of the terms, s.
    pub times: &'a [f64],
    pub fit: &'a SpectrumFit,
    /// The single Maxwell term of weight 1 with the measured mean.
    pub maxwell: &'a Maxwell,
    pub warnings: &'a [String],
}

impl Calibrated<'_> {
    /// The terms that are not zero.
    pub fn terms(&self) -> Vec<PronyTerm> {
        terms(self.times, &self.fit.weights)
    }

    /// `all` or `shear`.
    pub fn acts_on(&self) -> &'static str {
        match self.target.acts_on {
            ActsOn::All => "all",
            ActsOn::Shear => "shear",
        }
    }

    /// Contact times of the data without relaxation, shortest and longest, s.
    pub fn contact_times(&self) -> (f64, f64) {
        ends(self.experiments.iter().flat_map(|experiment| experiment.contact_times.iter()))
    }

    /// Speeds of the data, m/s.
    pub fn speeds(&self) -> (f64, f64) {
        ends(self.experiments.iter().flat_map(|experiment| experiment.speeds.iter()))
    }
}

/// Weights this small are rounding.
const LEAST_WEIGHT: f64 = 1e-9;

/// Terms of times and weights; those without weight are left out.
pub fn terms(times: &[f64], weights: &[f64]) -> Vec<PronyTerm> {
    let both = times.iter().zip(weights).filter(|(_, weight)| **weight > LEAST_WEIGHT);
    both.map(|(&relaxation_time, &weight)| PronyTerm { weight, relaxation_time }).collect()
}

/// Least and largest.
pub fn ends<'v>(values: impl IntoIterator<Item = &'v f64>) -> (f64, f64) {
    let start = (f64::INFINITY, 0.0f64);
    values.into_iter().fold(start, |(low, high), value| (low.min(*value), high.max(*value)))
}
