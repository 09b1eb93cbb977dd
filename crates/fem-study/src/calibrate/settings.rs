//! Settings of a calibration.

use fem_case::schema::ActsOn;

/// Settings of a calibration; a setting that is `None` follows from the data or the case.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The model that computes a collision; by default condensed elements, or Ting's model for a plate that bends.
    pub model: Option<CalibrationModel>,
    /// The material that is calibrated, if the bodies have two; the other one keeps its relaxation.
    pub material: Option<String>,
    /// The moduli that relax; by default those of the case, or all.
    pub acts_on: Option<ActsOn>,
    /// Terms of the series, at least 1.
    pub n_terms: usize,
    /// Relaxation times of the first and the last term, s; the others are evenly spaced in the logarithm. By default a
    /// tenth of the shortest contact time and ten times the longest.
    pub times: Option<(f64, f64)>,
    /// Regularisation λ ≥ 0: a weight of 1 costs as much as this error of a restitution. By default the uncertainty of
    /// the data, or 0.001.
    pub regularisation: Option<f64>,
    /// Confidence level of the ranges, in (0, 1).
    pub confidence: f64,
    /// Whether data far from the curve count little ([`fem_data::estimate::Robustness`]).
    pub is_robust: bool,
    /// Whether the measured relaxation of the case is prior knowledge: its weights move within their uncertainties. The
    /// relaxation times are then those of the case, no data are weighted down, and the regularisation is 0 by default.
    pub uses_prior: bool,
}

impl Default for Settings {
    /// Returns settings for four terms, the model of the bodies and ranges of 95 %.
    fn default() -> Self {
        Self {
            model: None,
            material: None,
            acts_on: None,
            n_terms: 4,
            times: None,
            regularisation: None,
            confidence: 0.95,
            is_robust: false,
            uses_prior: false,
        }
    }
}

/// The model that computes the restitutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CalibrationModel {
    /// Finite elements condensed to their contact.
    Condensed,
    /// Ting's half-spaces with the spheres' finite size.
    Ting,
}

impl CalibrationModel {
    /// Returns the name of the model.
    pub fn word(self) -> &'static str {
        match self {
            Self::Condensed => "condensed",
            Self::Ting => "ting",
        }
    }
}

/// The caller's names of the settings that messages suggest to change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SettingNames {
    /// Name of [`Settings::n_terms`].
    pub terms: &'static str,
    /// Name of [`Settings::times`].
    pub times: &'static str,
    /// Name of the uncertainty of all restitutions.
    pub uncertainty: &'static str,
    /// Name of [`Settings::model`].
    pub model: &'static str,
}

impl Default for SettingNames {
    /// Returns the names of the fields.
    fn default() -> Self {
        Self { terms: "n_terms", times: "times", uncertainty: "an uncertainty", model: "model" }
    }
}
