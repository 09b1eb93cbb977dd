//! A law and its fitted parameters, read back from `fit.json`.

use fem_case::Case;
use fem_case::schema::End;
use fem_laws::{EndRule, LawFamily};
use serde::Deserialize;

use super::chosen_law::ChosenLaw;
use super::law_fault::LawFault;
use crate::fit::Model;
use crate::measured::DataError;

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

/// The confidence band of a fitted restitution over the speed.
#[derive(Clone, Debug, PartialEq)]
pub struct RestitutionBand {
    /// Its confidence level, such as 0.95.
    pub confidence: f64,
    /// Rows of speed (m/s), restitution, and the lower and the upper end of the band.
    pub rows: Vec<[f64; 4]>,
}

impl RestitutionBand {
    /// Names of the columns of [`RestitutionBand::csv`].
    pub const COLUMNS: [&'static str; 4] =
        ["speed_m_s", "restitution", "restitution_low", "restitution_high"];

    /// Returns the largest distance of an end of the band from the restitution.
    pub fn widest(&self) -> f64 {
        let widths = self.rows.iter().map(|[_, e, low, high]| (e - low).max(high - e));
        widths.fold(0.0, f64::max)
    }

    /// Returns the band as a table.
    pub fn csv(&self) -> String {
        let rows = self.rows.iter().map(|row| row.map(|cell| format!("{cell:?}")).join(",") + "\n");
        Self::COLUMNS.join(",") + "\n" + &rows.collect::<String>()
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
}

/// Restitutions of laws, the fitted one first, and the band of the fitted one at some speeds.
#[derive(Deserialize)]
struct CurveKeys {
    speed_m_s: Vec<f64>,
    laws: Vec<LawKeys>,
    band: Vec<Option<(f64, f64)>>,
}

#[derive(Deserialize)]
struct LawKeys {
    restitution: Vec<Option<f64>>,
}

impl CurveKeys {
    fn rows(&self) -> Vec<[f64; 4]> {
        let fitted = self.laws.first().map_or(&[][..], |law| &law.restitution);
        let all = self.speed_m_s.iter().zip(fitted).zip(&self.band);
        all.filter_map(|((speed, e), band)| {
            let (low, high) = (*band)?;
            Some([*speed, (*e)?, low, high])
        })
        .collect()
    }
}

#[derive(Deserialize)]
struct ParameterKeys {
    key: String,
    value: f64,
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
        let rows = keys.curves.rows();
        let Keys { data, speeds_m_s: speeds, scatter, warnings, confidence, .. } = keys;
        let band = (!rows.is_empty()).then_some(RestitutionBand { confidence, rows });
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
