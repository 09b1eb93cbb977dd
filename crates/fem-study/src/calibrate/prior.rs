//! A measured relaxation of the case as prior knowledge of a calibration.
//!
//! The file of `fem-run relaxation` has the standard uncertainty u of the loss modulus for each measured decade. The weights w may move
//! within it: each decade adds a residual (L(w)/L(w₀) − 1)/u to the least squares, with L the loss of the series at that frequency and
//! w₀ the weights of the file. Beyond the band the series may go on, as a run assumes for its error bar: terms with the weights 0 ± m/√3,
//! where m is the mean weight per decade of the last two measured decades. A weight that nothing determines has the standard deviation
//! 1/√12 of evenly spread values between 0 and 1 about that of the file.
//!
//! Limits: the uncertainties of the decades are taken as independent, and the instantaneous modulus is that of the case.

use std::f64::consts::TAU;

use fem_case::schema::RelaxationTable;
use fem_case::{Case, MeasuredBand};
use fem_simulation::results::SeriesTail;
use nalgebra::{DMatrix, DVector};

use super::target::Target;
use fem_data::estimate::spectrum::WeightPrior;
use fem_data::estimate::spectrum::bounded::Linear;

/// The smallest relative uncertainty of a loss: instruments have none below.
const MIN_UNCERTAINTY: f64 = 1e-3;

/// The series of the case with what its file says about the weights.
#[derive(Clone, Debug)]
pub struct Prior {
    /// Relaxation times of the terms at the temperature of the case, s, rising.
    pub times: Vec<f64>,
    /// The measured frequencies at that temperature, Hz.
    pub band: [f64; 2],
    /// The table of the case without its terms.
    pub(super) table: RelaxationTable,
    /// What its file says of the data, with the law of the shift.
    pub(super) measured: MeasuredBand,
    /// Weights of the file, 0 beyond the measured band, and their uncertainties.
    pub(super) of_weights: WeightPrior,
}

impl Prior {
    /// Returns the prior of the calibrated material for contacts from the shortest to the longest time (s); `None` if its relaxation has no
    /// measured band with uncertainties, or is one of other moduli.
    pub(super) fn of(case: &Case, target: &Target, contacts: (f64, f64)) -> Option<Self> {
        let side = target.sides.iter().position(|is_it| *is_it)?;
        let body = &case.scene().bodies()[side];
        let (material, measured) = (body.material()?, body.measured()?);
        let band = measured.frequencies?;
        if measured.loss_uncertainty.is_empty() {
            return None;
        }
        let frequencies =
            [SeriesTail::frequencies(contacts.1)[0], SeriesTail::frequencies(contacts.0)[1]];
        let tail = SeriesTail::of(material, frequencies, band)?;
        let series = material.relaxation().filter(|series| series.acts_on() == target.acts_on)?;
        // Times, weights, and how uncertain a weight is by itself.
        let own = series.terms().iter();
        let own = own.map(|term| (term.relaxation_time, term.weight, 12f64.sqrt().recip()));
        let tail = tail.faster.iter().chain(&tail.slower);
        let tail = tail.filter(|(most, _)| *most > 0.0);
        let tail = tail.map(|(most, time)| (*time, 0.0, most / 3f64.sqrt()));
        let mut terms: Vec<(f64, f64, f64)> = own.chain(tail).collect();
        terms.sort_by(|a, b| a.0.total_cmp(&b.0));
        let n = terms.len();
        let mut rows: Vec<(Vec<f64>, f64)> = Vec::new();
        for (frequency, uncertainty) in &measured.loss_uncertainty {
            let loss = |time: f64| {
                let x = TAU * frequency * time;
                x / (1.0 + x * x)
            };
            let whole: f64 = terms.iter().map(|(time, weight, _)| weight * loss(*time)).sum();
            let scale = whole * uncertainty.max(MIN_UNCERTAINTY);
            if scale > 0.0 {
                let row = terms.iter().map(|(time, ..)| loss(*time) / scale).collect();
                rows.push((row, whole / scale));
            }
        }
        for (k, (_, weight, uncertainty)) in terms.iter().enumerate() {
            let row = (0..n).map(|j| if j == k { uncertainty.recip() } else { 0.0 }).collect();
            rows.push((row, weight / uncertainty));
        }
        let table = case.file().material.get(&target.material)?.relaxation.as_ref()?;
        Some(Self {
            times: terms.iter().map(|term| term.0).collect(),
            band,
            table: RelaxationTable {
                reference_temperature: table.reference_temperature.clone(),
                shift: table.shift.clone(),
                ..RelaxationTable::new(target.acts_on.into(), [])
            },
            measured: measured.clone(),
            of_weights: WeightPrior {
                weights: terms.iter().map(|term| term.1).collect(),
                rows: Linear {
                    a: DMatrix::from_fn(rows.len(), n, |i, k| rows[i].0[k]),
                    b: DVector::from_iterator(rows.len(), rows.iter().map(|row| row.1)),
                },
            },
        })
    }
}
