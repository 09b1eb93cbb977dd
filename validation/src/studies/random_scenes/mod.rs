//! Random scenes: the comparison of models, and whether results are within their error bars and tolerances.
//!
//! ```text
//! linear_scenes ─┬─ model_differences   explicit elements, condensed bodies and Ting's model
//!                └─ error_bars          errors against extrapolated limits
//! soft_scenes                           errors at finite strain against finer meshes
//! ```
//!
//! A scene consists of overrides of the claim's `[run.base]`, drawn by [`Random`].

mod error_bars;
mod linear_scenes;
mod model_differences;
mod soft_scenes;

use fem::error::BarParts;
use fem_case::{Case, CaseError};
use fem_collision::QuantityOfInterest;
use rayon::prelude::*;
use serde::Deserialize;

use crate::{Findings, Laboratory, RunFile, StudyError, Table};

pub use error_bars::study as error_bars_study;
pub use model_differences::study as model_differences_study;
pub use soft_scenes::study as soft_scenes_study;

/// A generator of random numbers: SplitMix64, Steele et al. 2014.
pub(in crate::studies) struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }

    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    /// Returns the numbers below `n`, shuffled (Fisher & Yates).
    pub fn order(&mut self, n: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..n).collect();
        for k in (1..n).rev() {
            order.swap(k, (self.next() * (k + 1) as f64) as usize);
        }
        order
    }

    /// Returns a power of ten whose exponent lies in a range.
    fn decades(&mut self, from: f64, to: f64) -> f64 {
        10f64.powf(self.within(from, to))
    }
}

/// Parameters of the studies of error bars.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    seed: u64,
    scenes: usize,
    /// Scenes that need more element updates on the finest mesh that is run are skipped.
    element_updates: f64,
}

/// Loads the case of a scene: the claim's `[run.base]` with these overrides.
fn load(laboratory: &Laboratory, set: &[String]) -> Result<Result<Case, CaseError>, StudyError> {
    let claim = laboratory.claim();
    let base = claim.runs.get("base").ok_or_else(|| {
        StudyError::parameters("the claim has no [run.base], which the study needs")
    })?;
    let file = RunFile { case: base.case.clone(), set: [&base.set[..], set].concat() };
    Ok(claim.load_case(&file))
}

/// Computes `n` scenes in the order in which they are drawn. Scenes without a result are skipped; at most
/// `most_rounds` times `n` scenes are drawn.
fn computed<T: Send>(
    n: usize,
    most_rounds: usize,
    mut draw: impl FnMut() -> Vec<String>,
    compute: impl Fn(&[String]) -> Result<Option<T>, StudyError> + Sync,
) -> Result<Vec<T>, StudyError> {
    let mut all = Vec::new();
    for _ in 0..most_rounds {
        let sets: Vec<Vec<String>> = (0..n).map(|_| draw()).collect();
        let results = sets.par_iter().map(|set| compute(set));
        all.extend(results.collect::<Result<Vec<_>, _>>()?.into_iter().flatten());
        all.truncate(n);
        if all.len() == n {
            break;
        }
    }
    Ok(all)
}

struct Trial {
    scene: String,
    numbers: Vec<NumberTrial>,
}

/// The error of a quantity of interest and its error bar: of the restitution absolute, of all others relative.
#[derive(Clone, Copy)]
struct NumberTrial {
    quantity: QuantityOfInterest,
    /// With its sign.
    error: f64,
    bar: f64,
    /// Uncertainty of the reference that the error is measured from.
    reference_uncertainty: f64,
}

/// A trial and the parts of its error bars.
type Parted = (Trial, Vec<BarParts>);

impl NumberTrial {
    fn share(&self) -> f64 {
        self.error.abs() / (self.bar + self.reference_uncertainty)
    }

    /// Returns the bar over the error, or over the uncertainty of the reference if that is larger.
    fn width(&self) -> f64 {
        self.bar / self.error.abs().max(self.reference_uncertainty)
    }

    /// Whether the error is within the default tolerance; approach and contact radius have none.
    fn is_met(&self) -> bool {
        let tolerance = fem::tolerance_of(&fem_case::defaults::accuracy(), self.quantity);
        tolerance.is_none_or(|most| self.error.abs() <= most + self.reference_uncertainty)
    }
}

impl Trial {
    /// Whether all quantities are there; a contact without an end has neither time nor bars.
    fn is_whole(&self) -> bool {
        self.numbers.len() == QuantityOfInterest::ALL.len()
    }

    /// Returns the largest error over its bar and the uncertainty of the reference.
    fn share(&self) -> f64 {
        let shares = self.numbers.iter().map(NumberTrial::share);
        shares.fold(0.0, fem_collision::nan_aware_max_abs)
    }

    fn is_met(&self) -> bool {
        self.numbers.iter().all(NumberTrial::is_met)
    }
}

/// Adds the table of the scenes with the largest errors over their bars, at most `n`.
fn tabulate(findings: &mut Findings, caption: String, mut trials: Vec<&Trial>, n: usize) {
    trials.sort_by(|a, b| b.share().total_cmp(&a.share()));
    let rows = trials.iter().take(n).map(|trial| {
        let numbers = trial.numbers.iter();
        let cells =
            numbers.map(|NumberTrial { error, bar, .. }| format!("{error:+.1e} ± {bar:.1e}"));
        let first = [trial.scene.clone(), format!("{:.2}", trial.share())];
        first.into_iter().chain(cells).collect()
    });
    let header = ["scene", "over the bar", "e", "T", "F", "approach", "a", "p0"];
    let header = header.map(String::from).to_vec();
    findings.tables.push(Table { caption, header, rows: rows.collect() });
}

/// Returns the value below which a share of the values lies; NaN without values.
fn quantile(values: impl IntoIterator<Item = f64>, share: f64) -> f64 {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    let k = (share * values.len() as f64) as usize;
    values.get(k.min(values.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
}

/// Tabulates the constants of the error estimate with those that these trials need.
fn tabulate_constants(findings: &mut Findings, trials: &[&[Parted]]) {
    findings.tabulate(
        "Constants of the error estimate (crates/fem-simulation/src/error/calibration.rs). The edge constant needed is that \
         with which the bars of 98 % of these scenes hold.",
        ["constants", "quantity", "covered", "median bar", "bar over error", "edge constant", "edge constant needed"],
        calibration_rows(trials),
    );
}

/// Returns the edge constant, times (a/h)², with which a bar would hold.
fn edge_needed(number: &NumberTrial, parts: &BarParts) -> f64 {
    let BarParts { reference_error, safety_factor, across, scatter, moved_mass, .. } = *parts;
    let known =
        safety_factor * reference_error + scatter + moved_mass + number.reference_uncertainty;
    (number.error.abs() - known).max(0.0) * across * across
}

/// Returns, for each row of constants and each quantity, how often the bars hold, how wide they are, the edge constant and
/// the one that is needed.
fn calibration_rows(trials: &[&[Parted]]) -> Vec<[String; 7]> {
    let all = trials.iter().copied().flatten();
    let all: Vec<(&NumberTrial, &BarParts)> =
        all.flat_map(|(trial, parts)| trial.numbers.iter().zip(parts)).collect();
    let mut names: Vec<&str> = all.iter().map(|(_, parts)| parts.constants).collect();
    names.sort_unstable();
    names.dedup();
    let keys = names.into_iter().flat_map(|name| QuantityOfInterest::ALL.map(|key| (name, key)));
    let row = |(name, quantity): (&str, QuantityOfInterest)| {
        let of = |of: fn(&NumberTrial, &BarParts) -> f64| {
            let same = all
                .iter()
                .filter(|(number, parts)| parts.constants == name && number.quantity == quantity);
            same.map(|(number, parts)| of(number, parts)).collect::<Vec<f64>>()
        };
        let shares = of(|number, _| number.share());
        let edges = of(|_, parts| parts.edge * parts.across.max(1.0).powi(2));
        [
            name.to_string(),
            quantity.key().to_string(),
            format!("{} of {}", shares.iter().filter(|it| **it <= 1.0).count(), shares.len()),
            format!("{:.1e}", quantile(of(|number, _| number.bar), 0.5)),
            format!("{:.1}", quantile(of(|number, _| number.width()), 0.5)),
            format!("{:.3}", quantile(edges, 0.5)),
            format!("{:.3}", quantile(of(edge_needed), 0.98)),
        ]
    };
    keys.map(row).collect()
}
