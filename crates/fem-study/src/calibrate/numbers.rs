//! `calibrate.json`: a calibration as numbers.

use crate::fit::spectrum::{Combination, Range};
use fem_case::schema::ActsOn;
use serde::Serialize;

use super::calibration::Calibration;
use super::experiment::Experiment;
use super::maxwell::Beyond;

/// A calibration as it is kept, SI.
#[derive(Clone, Debug, Serialize)]
pub struct CalibrationNumbers {
    /// The case, as the caller calls it.
    pub case: String,
    /// Name of the data.
    pub data: String,
    /// The model that computed the restitutions.
    pub model: &'static str,
    /// The material whose series it is.
    pub material: String,
    /// Which of its moduli relax.
    pub acts_on: ActsOn,
    /// Number of measured points.
    pub points: usize,
    /// The pairs of bodies.
    pub pairs: Vec<PairNumbers>,
    /// Without relaxation, shortest and longest.
    pub contact_times_s: (f64, f64),
    /// The regularisation λ.
    pub regularisation: f64,
    /// Level of the ranges.
    pub confidence: f64,
    /// By their relaxation times.
    pub terms: Vec<TermNumbers>,
    /// Sum of the weights, Σ g.
    pub weight_sum: RangeNumbers,
    /// Initial decay rate Σ g/τ.
    pub initial_decay_rate_1_s: RangeNumbers,
    /// Viscous time Σ g τ.
    pub viscous_time_s: RangeNumbers,
    /// Combinations of weights, the best determined first.
    pub combinations: Vec<CombinationNumbers>,
    /// Number of combinations that the data determine.
    pub combinations_determined: usize,
    /// Root mean square error, √(Σ (e − ê)²/N).
    pub rms: f64,
    /// Standard error of a restitution, as the ranges assume it.
    pub error: f64,
    /// Misfit over the uncertainties.
    pub misfit: Option<f64>,
    /// Data less weights that are neither 0 nor spare.
    pub degrees_of_freedom: usize,
    /// Collisions of all data that were computed.
    pub evaluations: usize,
    /// The single term of weight 1 with the measured mean.
    pub maxwell: MaxwellNumbers,
    /// Scatter of repeats.
    pub pure_error: Option<f64>,
    /// p of 1 − e ∝ v^p of the data.
    pub loss_exponent_of_speed: Option<ExponentNumbers>,
    /// Warnings for the reader.
    pub warnings: Vec<String>,
}

/// One pair of bodies.
#[derive(Clone, Debug, Serialize)]
pub struct PairNumbers {
    /// Diameters of the lower and the upper body; a wall has none.
    pub diameters_m: [Option<f64>; 2],
    /// Number of measured points.
    pub points: usize,
    /// Elements across the radius of the smallest contact.
    pub elements_across_smallest_contact: Option<f64>,
    /// Elements across the radius of the largest contact.
    pub elements_across_largest_contact: Option<f64>,
}

/// One term of the series.
#[derive(Clone, Debug, Serialize)]
pub struct TermNumbers {
    /// Relaxation time τ.
    pub relaxation_time_s: f64,
    /// The weight g.
    pub weight: f64,
    /// Least and largest, all others free.
    pub range: (f64, f64),
    /// Share of the weight that the data determine.
    pub share_of_data: f64,
}

/// A number and what it can be.
#[derive(Clone, Debug, Serialize)]
pub struct RangeNumbers {
    /// The best value.
    pub value: f64,
    /// Least and largest.
    pub range: (f64, f64),
}

/// A combination of weights.
#[derive(Clone, Debug, Serialize)]
pub struct CombinationNumbers {
    /// Coefficients of the weights.
    pub coefficients: Vec<f64>,
    /// Singular value of the combination: the sensitivity of the data to it.
    pub singular_value: f64,
    /// The best value.
    pub value: f64,
    /// None if it is not seen.
    pub standard_error: Option<f64>,
    /// Whether the data determine it.
    pub determined: bool,
}

/// The single term of weight 1.
#[derive(Clone, Debug, Serialize)]
pub struct MaxwellNumbers {
    /// Relaxation time τ.
    pub relaxation_time_s: f64,
    /// Where τ is if it is only an end of the search.
    pub beyond_search: Option<&'static str>,
    /// Root mean square error, √(Σ (e − ê)²/N).
    pub rms: f64,
}

/// An exponent of the data.
#[derive(Clone, Debug, Serialize)]
pub struct ExponentNumbers {
    /// The best value.
    pub value: f64,
    /// None of two points.
    pub standard_error: Option<f64>,
}

impl Calibration {
    /// Returns the stored form of it; `case` is what the case is called, `warnings` are those of
    /// [`Calibration::warnings`].
    pub fn numbers(&self, case: &str, warnings: Vec<String>) -> CalibrationNumbers {
        let fit = &self.fit;
        let [total, rate, time] = &fit.moments;
        let exponent = self.loss_exponent();
        CalibrationNumbers {
            case: case.to_string(),
            data: self.measured.data.name.clone(),
            model: self.model.word(),
            material: self.target.material.clone(),
            acts_on: self.acts_on(),
            points: self.measured.data.points.len(),
            pairs: self.experiments.iter().map(pair).collect(),
            contact_times_s: self.contact_times(),
            regularisation: self.regularisation,
            confidence: self.confidence,
            terms: (0..self.times.len()).map(|k| self.term(k)).collect(),
            weight_sum: range(total),
            initial_decay_rate_1_s: range(rate),
            viscous_time_s: range(time),
            combinations: fit.resolution.combinations.iter().map(combination).collect(),
            combinations_determined: fit.resolution.n_determined(),
            rms: fit.rms,
            error: fit.error,
            misfit: fit.misfit,
            degrees_of_freedom: fit.degrees_of_freedom,
            evaluations: fit.n_evaluations,
            maxwell: MaxwellNumbers {
                relaxation_time_s: self.maxwell.time,
                beyond_search: self.maxwell.beyond.map(Beyond::word),
                rms: self.maxwell.rms,
            },
            pure_error: fit.pure_error.map(|pure| pure.error),
            loss_exponent_of_speed: exponent.map(|exponent| ExponentNumbers {
                value: exponent.value,
                standard_error: exponent.standard_error,
            }),
            warnings,
        }
    }

    fn term(&self, k: usize) -> TermNumbers {
        let range = &self.fit.weight_ranges[k];
        TermNumbers {
            relaxation_time_s: self.times[k],
            weight: self.fit.weights[k],
            range: (range.low, range.high),
            share_of_data: self.fit.resolution.shares[k],
        }
    }
}

fn pair(experiment: &Experiment) -> PairNumbers {
    PairNumbers {
        diameters_m: experiment.diameters,
        points: experiment.points.len(),
        elements_across_smallest_contact: experiment.elements_across.map(|across| across.0),
        elements_across_largest_contact: experiment.elements_across.map(|across| across.1),
    }
}

fn range(range: &Range) -> RangeNumbers {
    RangeNumbers { value: range.value, range: (range.low, range.high) }
}

fn combination(combination: &Combination) -> CombinationNumbers {
    CombinationNumbers {
        coefficients: combination.coefficients.clone(),
        singular_value: combination.singular_value,
        value: combination.value,
        standard_error: Some(combination.standard_error).filter(|error| error.is_finite()),
        determined: combination.is_determined,
    }
}
