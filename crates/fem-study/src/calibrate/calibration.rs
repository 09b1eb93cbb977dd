//! The calibration: a Prony series of a material from measured restitutions.

use fem_case::{Case, ModelChoice};
use fem_data::estimate::spectrum::{
    Range, SpectrumFit, SpectrumProblem, SpeedExponent, SpeedPoint, moments, root_mean_square,
    speed_exponent,
};
use fem_data::estimate::{FitError, InputPart, Robustness, SPEED, quantile};
use fem_material::PronyTerm;
use rayon::prelude::*;

use super::experiment::{Experiment, chosen_model};
use super::fault::CalibrationFault;
use super::flow::FlowFit;
use super::maxwell::Maxwell;
use super::prior::Prior;
use super::settings::{CalibrationModel, Settings};
use super::speed_span::ends;
use super::target::Target;
use super::warnings::{LARGE_ERROR, LARGE_MISFIT, misses};
use fem_data::table::{DataError, MeasuredPairs};

/// Factor by which the relaxation times reach beyond the contact times. A term that is ten times slower or faster
/// loses a tenth; one beyond differs from it in its weight only.
const RELAXATION_OVER_CONTACT_TIMES: f64 = 10.0;
/// The regularisation λ of data without uncertainties.
const REGULARISATION: f64 = 1e-3;
/// Keys of a case's condensed model that a calibration replaces.
pub(super) const UNUSED_STEPS: &str = "model.condensed.steps";
/// Without uncertainties plastic flow explains data as well as a series if its rms error is that of the series times the first
/// factor, or below the second.
const AS_GOOD: f64 = 1.5;
const SMALL_ERROR: f64 = 0.002;
/// Smaller weights are rounding.
const MIN_WEIGHT: f64 = 1e-9;

/// A Prony series, the data that it was found from, and how well they determine it.
///
/// ```
/// use fem_case::schema::{BodyTable, MaterialTable};
/// use fem_case::{Case, CaseFile};
/// use fem_study::calibrate::{Calibration, CalibrationModel, Settings};
/// use fem_data::table::Restitutions;
///
/// let glass = MaterialTable::from_youngs_modulus_poissons_ratio("2390 kg/m^3", "63 GPa", 0.244);
/// let lower = BodyTable::sphere("lower", "22.2 mm", "glass").approaching("0.5 m/s");
/// let upper = BodyTable::sphere("upper", "15.9 mm", "glass");
/// let case = Case::of(CaseFile::of_bodies(lower, upper).with_material("glass", glass))?;
/// let measured = Restitutions::of("glass", &[(0.1, 0.915), (0.5, 0.925), (1.0, 0.93)]);
/// let settings =
///     Settings { model: Some(CalibrationModel::Ting), n_terms: 2, ..Settings::default() };
/// let found = Calibration::of(&case, measured.into(), &settings)?;
/// assert!(found.fit.rms < 0.005);
///
/// // The same case with the series that was found.
/// let series = found.relaxation();
/// let relaxing = case.edited(|file| {
///     if let Some(glass) = file.material.get_mut(&found.target.material) {
///         glass.relaxation = series;
///     }
/// })?;
/// assert!(relaxing.gives("material.glass.relaxation"));
/// # Ok::<(), fem_study::calibrate::CalibrationFault>(())
/// ```
#[derive(Debug)]
pub struct Calibration {
    /// The measured data.
    pub measured: MeasuredPairs,
    /// One experiment per pair of bodies, in their order.
    pub experiments: Vec<Experiment>,
    /// The material whose series it is.
    pub target: Target,
    /// The model that computed the restitutions.
    pub model: CalibrationModel,
    /// The regularisation λ, in units of e.
    pub regularisation: f64,
    /// Confidence level of the ranges.
    pub confidence: f64,
    /// Relaxation times of the terms, s.
    pub times: Vec<f64>,
    /// Weights, their ranges by the data alone, and which combinations are determined.
    pub fit: SpectrumFit,
    /// The measured relaxation of the case as prior knowledge.
    pub prior: Option<Prior>,
    /// Parts of uncertain inputs of the case in the errors of the weights and of the moments.
    pub inputs: Vec<InputPart>,
    /// The single Maxwell term of weight 1 with the measured mean.
    pub maxwell: Maxwell,
    /// The yield strength that explains the data as well; `None` if none does.
    pub flow: Option<FlowFit>,
    /// The keys of the case's own model that are ignored.
    pub unused_key: Option<String>,
}

impl Calibration {
    /// Names of the columns of [`Calibration::residuals`].
    pub const RESIDUAL_COLUMNS: [&'static str; 8] = [
        "diameter_1_m",
        "diameter_2_m",
        "speed_m_s",
        "restitution",
        "restitution_uncertainty",
        "fitted_restitution",
        "residual",
        "weight",
    ];

    /// Calibrates a material; the pairs of bodies are computed in parallel.
    ///
    /// # Errors
    /// The material, the data or the settings are invalid; plastic flow explains the data and no series does; no model supports the bodies at the sizes and speeds of the
    /// data; there are fewer data than terms without regularisation; a collision cannot be computed.
    pub fn of(
        case: &Case,
        measured: MeasuredPairs,
        settings: &Settings,
    ) -> Result<Self, CalibrationFault> {
        let target = Target::of(case, settings.material.as_deref(), settings.acts_on)?;
        let (model, measured) = chosen_model(case, measured, settings.model)?;
        let uncertainties = measured.uncertainties();
        let regularisation = settings.regularisation.unwrap_or_else(|| match settings.uses_prior {
            true => 0.0,
            false => uncertainties.as_deref().map_or(REGULARISATION, root_mean_square),
        });
        check(&measured, settings, regularisation)?;
        let of_case = |case: &Case| {
            let pairs = measured.pairs.par_iter();
            let made = pairs.map(|pair| Experiment::new(case, &measured, pair, &target, model));
            made.collect::<Result<Vec<_>, _>>()
        };
        let experiments = of_case(case)?;
        let contacts = ends(experiments.iter().flat_map(|experiment| &experiment.contact_times));
        let window = settings.times.unwrap_or((
            contacts.0 / RELAXATION_OVER_CONTACT_TIMES,
            contacts.1 * RELAXATION_OVER_CONTACT_TIMES,
        ));
        let prior_of = |case: &Case| Prior::of(case, &target, contacts);
        let prior = match (settings.uses_prior, &uncertainties) {
            (false, _) => None,
            (true, None) => return Err(CalibrationFault::NoUncertainties),
            (true, Some(_)) => Some(prior_of(case).ok_or_else(|| {
                let material = target.material.clone();
                CalibrationFault::NoPrior { material }
            })?),
        };
        let of_settings = || spaced(window, settings.n_terms);
        let times = prior.as_ref().map_or_else(of_settings, |prior| prior.times.clone());
        let wanted = measured.restitutions();
        let of_terms = |terms: &[PronyTerm]| restitutions(&experiments, terms, wanted.len());
        let problem = SpectrumProblem {
            restitutions: &|weights: &[f64]| of_terms(&terms(&times, weights)),
            measured: &wanted,
            collisions: &measured.collisions(),
            uncertainties: uncertainties.as_deref(),
            times: &times,
            regularisation,
            is_robust: settings.is_robust && prior.is_none(),
            prior: prior.as_ref().map(|prior| &prior.of_weights),
        };
        let fit = problem.fit(settings.confidence)?;
        let refit = |case: &Case| {
            let experiments = of_case(case).ok()?;
            let prior = if prior.is_some() { Some(prior_of(case)?) } else { None };
            let times = prior.as_ref().map_or(&times, |prior| &prior.times);
            if times.len() != problem.times.len() {
                return None;
            }
            let restitutions =
                |weights: &[f64]| restitutions(&experiments, &terms(times, weights), wanted.len());
            let prior = prior.as_ref().map(|prior| &prior.of_weights);
            let changed = SpectrumProblem { restitutions: &restitutions, prior, times, ..problem };
            let weights = changed.refit(&fit).ok()?;
            let changes: Vec<f64> =
                weights.iter().zip(&fit.weights).map(|(changed, own)| changed - own).collect();
            let moment = |moment: &Vec<f64>| moment.iter().zip(&changes).map(|(c, w)| c * w).sum();
            let moments = moments(problem.times).each_ref().map(moment);
            Some([changes, moments.to_vec()].concat())
        };
        let inputs = InputPart::of(case, times.len() + 3, &[SPEED], refit);
        let largest_rms = match misses(&fit) {
            true => LARGE_ERROR,
            false => (AS_GOOD * fit.rms).max(SMALL_ERROR),
        };
        let flow = FlowFit::of(case, &measured, settings.is_robust)?;
        let flow = flow.filter(|flow| flow.explains(LARGE_MISFIT, largest_rms));
        let maxwell = Maxwell::of_mean(&of_terms, &wanted, fit.robustness.as_ref(), contacts)?;
        let found = Self {
            target,
            model,
            regularisation,
            confidence: settings.confidence,
            unused_key: unused_key(case, model),
            fit,
            prior,
            inputs,
            maxwell,
            times,
            flow,
            experiments,
            measured,
        };
        match found.flow {
            Some(flow) if misses(&found.fit) => {
                let exponent = found.loss_exponent();
                let exponent = exponent.filter(|found| found.is_above(SpeedExponent::LIMIT));
                let exponent = exponent.map(|found| found.value);
                Err(CalibrationFault::Flow { flow, series_rms: found.fit.rms, exponent })
            }
            _ => Ok(found),
        }
    }

    /// Returns the terms that are not zero.
    pub fn terms(&self) -> Vec<PronyTerm> {
        terms(&self.times, &self.fit.weights)
    }

    /// Returns the terms of the measured relaxation alone; `None` without prior knowledge.
    pub fn prior_terms(&self) -> Option<Vec<PronyTerm>> {
        let prior = self.prior.as_ref()?;
        Some(terms(&prior.times, &prior.of_weights.weights))
    }

    /// Returns the shortest and the longest contact time of the data without relaxation, s.
    pub fn contact_times(&self) -> (f64, f64) {
        ends(self.experiments.iter().flat_map(|experiment| &experiment.contact_times))
    }

    /// Returns the range of a weight with the uncertain inputs of the case.
    pub fn weight_range(&self, k: usize) -> Range {
        self.widened(&self.fit.weight_ranges[k], k, 1.0)
    }

    /// Returns the ranges of Σ w, Σ w/τ (1/s) and Σ w τ (s) with the uncertain inputs of the case.
    pub fn moments(&self) -> [Range; 3] {
        let limits = moments(&self.times).map(|all| all.into_iter().fold(0.0, f64::max));
        let n = self.times.len();
        std::array::from_fn(|i| self.widened(&self.fit.moments[i], n + i, limits[i]))
    }

    fn widened(&self, range: &Range, result: usize, most: f64) -> Range {
        let quantile = quantile(self.confidence, None);
        range.widened(quantile * InputPart::sum(&self.inputs, result), (0.0, most))
    }

    /// Returns the weight of a point in a robust fit, else 1.
    pub fn weight(&self, point: usize) -> f64 {
        self.fit.robustness.as_ref().map_or(1.0, |robustness| robustness.weights[point])
    }

    /// Returns the exponent p of 1 − e ∝ v^p of the data without those that a robust fit weights down; `None` if each pair
    /// has one speed.
    pub fn loss_exponent(&self) -> Option<SpeedExponent> {
        let points = self.measured.data.points.iter().enumerate();
        let points = points.filter(|(k, _)| self.weight(*k) >= Robustness::FEW);
        let points = points.map(|(k, point)| SpeedPoint {
            pair: self.measured.pair_of(k),
            speed: point.speed,
            restitution: point.restitution,
        });
        speed_exponent(&points.collect::<Vec<_>>())
    }

    /// Returns data, restitutions of the best series and their differences, one row per point; SI.
    pub fn residuals(&self) -> impl Iterator<Item = [Option<f64>; 8]> {
        let points = self.measured.data.points.iter().zip(&self.fit.restitutions).enumerate();
        points.map(|(k, (point, fitted))| {
            let [first, second] = self.experiments[self.measured.pair_of(k)].diameters;
            [
                first,
                second,
                Some(point.speed),
                Some(point.restitution),
                point.restitution_uncertainty,
                Some(*fitted),
                Some(fitted - point.restitution),
                Some(self.weight(k)),
            ]
        })
    }
}

/// Rejects invalid settings before anything is computed.
fn check(
    measured: &MeasuredPairs,
    settings: &Settings,
    regularisation: f64,
) -> Result<(), CalibrationFault> {
    let n_free = if settings.uses_prior { 1 } else { settings.n_terms };
    let n_values = measured.data.points.len();
    if n_values == 0 {
        return Err(DataError::new(&measured.data.name, "there is no restitution").into());
    }
    if n_values < n_free && regularisation == 0.0 {
        let free = "the weights".to_string();
        return Err(FitError::TooFewData { n_values, n_free, free }.into());
    }
    if n_free == 0 {
        let (quantity, allowed) = ("the number of terms", "at least 1");
        return Err(FitError::OutOfRange { quantity, value: 0.0, allowed }.into());
    }
    if let Some((first, last)) = settings.times
        && !(first > 0.0 && first <= last && last.is_finite())
    {
        let (quantity, allowed) = ("the first relaxation time", "greater than 0, at most the last");
        return Err(FitError::OutOfRange { quantity, value: first, allowed }.into());
    }
    Ok(())
}

/// Returns the keys of the case's own model that are ignored: all of it, or the steps of the chosen one. A calibration by Ting's model has the
/// finite size of the spheres, as a case with `finite_size = true` does.
fn unused_key(case: &Case, chosen: CalibrationModel) -> Option<String> {
    let own = case.scene().model();
    if chosen == CalibrationModel::Ting
        && matches!(own, ModelChoice::Ting { finite_size: true, .. })
    {
        return None;
    }
    let model = own.path();
    let is_own = chosen == CalibrationModel::Condensed && model == "model.condensed";
    let key = if is_own { UNUSED_STEPS.to_string() } else { model };
    case.gives(&key).then_some(key)
}

/// Computes the restitutions of all points in the order of the data, the pairs in parallel.
fn restitutions(
    experiments: &[Experiment],
    terms: &[PronyTerm],
    n_points: usize,
) -> Result<Vec<f64>, FitError> {
    let of_pairs = experiments.par_iter().map(|experiment| experiment.restitutions(terms));
    let found: Vec<_> = of_pairs.collect::<Result<_, _>>()?;
    let mut restitutions = vec![0.0; n_points];
    for (experiment, found) in experiments.iter().zip(found) {
        for (point, restitution) in experiment.points.iter().zip(found) {
            restitutions[*point] = restitution;
        }
    }
    Ok(restitutions)
}

/// Returns the terms of these times and weights, without those of weight 0.
fn terms(times: &[f64], weights: &[f64]) -> Vec<PronyTerm> {
    let both = times.iter().zip(weights).filter(|(_, weight)| **weight > MIN_WEIGHT);
    both.map(|(&relaxation_time, &weight)| PronyTerm { weight, relaxation_time }).collect()
}

/// Returns values that are evenly spaced in the logarithm, including both ends; a single one lies in the middle.
fn spaced((first, last): (f64, f64), n: usize) -> Vec<f64> {
    let share = |k: usize| if n == 1 { 0.5 } else { k as f64 / (n - 1) as f64 };
    (0..n).map(|k| first * (last / first).powf(share(k))).collect()
}
