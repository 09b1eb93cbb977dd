//! A law and its fitted parameters, read back from `fit.json`.

use std::collections::BTreeMap;

use fem_case::schema::End;
use fem_case::{Case, UncertainInput};
use fem_laws::{EndRule, LawFamily};
use serde::Deserialize;

use super::chosen_law::{ChosenLaw, model_of};
use super::law_fault::LawFault;
use fem_data::estimate::{self, Model, Point, Problem};
use fem_data::table::DataError;

/// Largest relative difference of two numbers of equal bodies, which were written and read.
const SAME: f64 = 1e-9;

/// A fitted law of the bodies of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredFit {
    /// Name of the data that the law was fitted to.
    pub data: String,
    /// Slowest and fastest speed of these data, m/s.
    pub speeds: (f64, f64),
    /// Root mean square of the residuals of e.
    pub scatter: f64,
    /// The bodies under the law.
    pub model: Model,
    /// Values of all of its parameters, SI.
    pub values: Vec<f64>,
    /// Warnings about the fit.
    pub warnings: Vec<String>,
    /// The confidence band of the restitution; `None` without degrees of freedom.
    pub band: Option<RestitutionBand>,
}

/// The confidence band of a fitted restitution over the speed, for the bodies of an export.
#[derive(Clone, Debug, PartialEq)]
pub struct RestitutionBand {
    /// Its confidence level, such as 0.95.
    pub confidence: f64,
    /// Keys of the uncertain inputs of the fit.
    pub inputs: Vec<String>,
    /// The band at some speeds.
    pub rows: Vec<BandRow>,
}

/// The confidence band at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct BandRow {
    /// Approach speed, m/s.
    pub speed: f64,
    /// Restitution of the fitted law at this speed.
    pub restitution: f64,
    /// Lower and upper end of the band.
    pub ends: [f64; 2],
    /// Half of the width of the band by the data alone.
    pub by_data: f64,
    /// Change of the restitution by the standard uncertainty of each input.
    pub by_inputs: Vec<f64>,
}

impl RestitutionBand {
    /// Returns the largest distance of an end of the band from the restitution.
    pub fn widest(&self) -> f64 {
        let width =
            |row: &BandRow| (row.restitution - row.ends[0]).max(row.ends[1] - row.restitution);
        self.rows.iter().map(width).fold(0.0, f64::max)
    }

    /// Returns the band as a table, with the parts of the data and of each uncertain input.
    pub fn csv(&self) -> String {
        let columns = "speed_m_s,restitution,restitution_low,restitution_high,half_width_by_data";
        let by_input = self.inputs.iter().map(|key| format!(",change_by_{key}"));
        let header = columns.to_string() + &by_input.collect::<String>() + "\n";
        let line = |row: &BandRow| {
            let BandRow { speed, restitution, ends: [low, high], by_data, by_inputs } = row;
            let cells = [speed, restitution, low, high, by_data].into_iter().chain(by_inputs);
            cells.map(|cell| format!("{cell:?}")).collect::<Vec<_>>().join(",") + "\n"
        };
        header + &self.rows.iter().map(line).collect::<String>()
    }
}

/// The keys of `fit.json` that are read.
#[derive(Deserialize)]
struct Keys {
    data: String,
    law: String,
    end: String,
    speeds_m_s: (f64, f64),
    scatter: f64,
    parameters: Vec<ParameterKeys>,
    bodies: [f64; 3],
    warnings: Vec<String>,
    confidence: f64,
    curves: CurveKeys,
    covariance: Option<Vec<Vec<f64>>>,
    quantile: Option<f64>,
    inputs: Vec<InputKeys>,
}

/// The speeds at which the band is stated.
#[derive(Deserialize)]
struct CurveKeys {
    speed_m_s: Vec<f64>,
}

/// An uncertain input of the case of the fit, and the changes of the fitted parameters, SI, by its uncertainty.
#[derive(Deserialize)]
struct InputKeys {
    key: String,
    value: f64,
    uncertainty: f64,
    changes: BTreeMap<String, Option<f64>>,
}

#[derive(Deserialize)]
struct ParameterKeys {
    key: String,
    value: f64,
    free: bool,
}

impl Keys {
    /// Returns the band of e(v) for a case and its bodies under the law: that of the data, and the changes by each uncertain input of
    /// the fit, added as squares. An input that the case has, too, changes the bodies and the parameters, and otherwise
    /// the parameters alone. `None` without degrees of freedom.
    fn band(&self, case: &Case, model: &Model) -> Option<RestitutionBand> {
        let (covariance, quantile) = (self.covariance.as_ref()?, self.quantile?);
        let values: Vec<f64> = self.parameters.iter().map(|one| one.value).collect();
        let free = self.parameters.iter().filter(|one| one.free);
        let free: Vec<&str> = free.map(|one| one.key.as_str()).collect();
        let middle = [Point::new((self.speeds_m_s.0 * self.speeds_m_s.1).sqrt(), 1.0)];
        let mut problem = Problem::new(model, &middle, &free).ok()?;
        problem.values.clone_from(&values);
        let changed: Vec<_> =
            self.inputs.iter().map(|input| input.changed(case, model, &self.parameters)).collect();
        let normal = estimate::quantile(self.confidence, None);
        let row = |&speed: &f64| {
            let e = |(model, values): &(Model, Vec<f64>)| {
                Some(model.outcome(values, speed).ok()?.restitution)
            };
            let restitution = model.outcome(&values, speed).ok()?.restitution;
            let by_data = problem.band_of(&values, (covariance, quantile), speed)?;
            let by_inputs: Option<Vec<f64>> =
                changed.iter().map(|changed| Some(e(changed.as_ref()?)? - restitution)).collect();
            let by_inputs = by_inputs?;
            let squares: f64 = by_inputs.iter().map(|change| change * change).sum();
            let half = by_data.hypot(normal * squares.sqrt());
            let ends = [(restitution - half).max(0.0), (restitution + half).min(1.0)];
            Some(BandRow { speed, restitution, ends, by_data, by_inputs })
        };
        let rows: Vec<BandRow> = self.curves.speed_m_s.iter().filter_map(row).collect();
        let inputs = self.inputs.iter().map(|input| input.key.clone()).collect();
        (!rows.is_empty()).then_some(RestitutionBand { confidence: self.confidence, inputs, rows })
    }
}

impl InputKeys {
    /// Returns bodies and parameters at the upper end of this input; `None` if the fit has none there.
    fn changed(
        &self,
        case: &Case,
        model: &Model,
        parameters: &[ParameterKeys],
    ) -> Option<(Model, Vec<f64>)> {
        let values = parameters.iter().map(|one| match self.changes.get(&one.key) {
            Some(change) => Some(one.value + (*change)?),
            None => Some(one.value),
        });
        let has_it = |own: &UncertainInput| own.key == self.key && own.value == self.value;
        let model = match case.scene().uncertain_inputs().iter().any(has_it) {
            true => {
                let case = case.with_number(&self.key, self.value + self.uncertainty).ok()?;
                model_of(case.scene(), model.family(), model.end_rule()).ok()?
            }
            false => model.clone(),
        };
        Some((model, values.collect::<Option<_>>()?))
    }
}

impl StoredFit {
    /// Reads the text of a `fit.json` for the bodies of a case; `name` stands for the file in messages.
    ///
    /// # Errors
    /// The text is not that of a fit, or the fit is one of other bodies.
    pub fn read(case: &Case, name: &str, text: &str) -> Result<Self, LawFault> {
        let refused = |message: &str, help: &str| DataError::new(name, message).with_help(help);
        let help =
            "name the folder of a fit or its fit.json: fem-run export CASE --fit runs/DATA_fit";
        let keys: Keys = serde_json::from_str(text)
            .map_err(|_| refused("this is not the result of a fit with this version", help))?;
        let (Some(family), Some(end)) =
            (LawFamily::from_name(&keys.law), End::from_word(&keys.end))
        else {
            return Err(refused("the fit names an unknown law or end of contact", help).into());
        };
        let given: Vec<(&str, f64)> =
            keys.parameters.iter().map(|one| (one.key.as_str(), one.value)).collect();
        let end = Some(EndRule::from(end)).filter(|_| family.end_rule().is_none());
        let model = ChosenLaw::of(case, family, &given, end)?.model().clone();
        let is_same = |(a, b): (&f64, f64)| (a - b).abs() <= SAME * b.abs();
        if !keys.bodies.iter().zip(bodies(&model)).all(is_same) {
            let help =
                "give the case of the fit; for other bodies fit again, or calibrate a material";
            return Err(
                refused("this fit is one of other bodies than those of the case", help).into()
            );
        }
        let values = keys.parameters.iter().map(|one| one.value).collect();
        let band = keys.band(case, &model);
        let Keys { data, speeds_m_s: speeds, scatter, warnings, .. } = keys;
        Ok(Self { data, speeds, scatter, model, values, warnings, band })
    }

    /// Returns the family of the law.
    pub fn family(&self) -> LawFamily {
        self.model.family()
    }
}

/// Returns effective mass (kg), effective radius (m) and contact modulus (Pa), by which a fit knows its bodies.
pub(super) fn bodies(model: &Model) -> [f64; 3] {
    let pair = model.pair();
    [pair.effective_mass(), pair.effective_radius(), pair.contact_modulus()]
}
