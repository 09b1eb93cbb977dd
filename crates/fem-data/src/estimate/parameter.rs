//! Parameters of laws as callers write them: `a = 0.2 ms`, `n = 0.65`.

use fem_case::{UnitError, parse_quantity};
use fem_laws::{LawFamily, LawParameter, ParameterRole};

/// An error in the name or the value of a parameter.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// The law has no parameter with this key.
    #[error("{law} has no parameter {key:?}")]
    Unknown {
        /// Name of the law.
        law: &'static str,
        /// The key as it was written.
        key: String,
        /// The keys of the law.
        known: Vec<&'static str>,
    },
    /// The law has no loss.
    #[error("{law} loses nothing: it has no parameter to find")]
    Lossless {
        /// Name of the law.
        law: &'static str,
    },
    /// The text is no number with a unit.
    #[error("{key}: {text:?}: {error}")]
    NotANumber {
        /// Key of the parameter.
        key: &'static str,
        /// The value as it was written.
        text: String,
        /// Description of the error.
        error: UnitError,
    },
    /// The unit has another dimension.
    #[error("{key}: {text:?} is of another dimension")]
    OtherDimension {
        /// Key of the parameter.
        key: &'static str,
        /// The value as it was written.
        text: String,
        /// SI unit of the parameter; empty for a plain number.
        unit: &'static str,
    },
    /// The value is out of range.
    #[error("{key}: the value is {value:?}")]
    OutOfRange {
        /// Key of the parameter.
        key: &'static str,
        /// Value of the parameter, SI.
        value: f64,
        /// Description of a valid value.
        allowed: String,
    },
}

impl ParameterError {
    /// Returns a description of the allowed values.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unknown { known, .. } => Some(format!("its parameters are {}", known.join(", "))),
            Self::OtherDimension { key, unit: "", .. } => {
                Some(format!("{key} is a plain number; bare numbers are SI"))
            }
            Self::OtherDimension { key, unit, .. } => {
                Some(format!("{key} is in {unit}; bare numbers are SI"))
            }
            Self::OutOfRange { allowed, .. } => Some(allowed.clone()),
            Self::Lossless { .. } | Self::NotANumber { .. } => None,
        }
    }
}

/// Returns the index of a law's parameter.
///
/// # Errors
/// The law has no parameter with this key.
pub fn find_parameter(family: LawFamily, key: &str) -> Result<usize, ParameterError> {
    let key = key.trim();
    let known = || family.parameters().iter().map(|parameter| parameter.key);
    known().position(|found| found == key).ok_or_else(|| ParameterError::Unknown {
        law: family.name(),
        key: key.to_string(),
        known: known().collect(),
    })
}

/// Returns the index of the parameter that determines a law's loss.
///
/// # Errors
/// A law without a loss.
pub fn loss_parameter(family: LawFamily) -> Result<usize, ParameterError> {
    family.loss_parameter().ok_or(ParameterError::Lossless { law: family.name() })
}

/// Parses a value with or without its unit; returns it in SI.
///
/// # Errors
/// The text is no number, has another dimension, or is out of range.
///
/// ```
/// use fem_data::estimate::parse_value;
/// use fem_laws::LawFamily;
///
/// let dissipation_time = &LawFamily::KuwabaraKono.parameters()[0];
/// assert_eq!(parse_value(dissipation_time, "0.2 ms")?, 2e-4);
///
/// let error = parse_value(dissipation_time, "1 kg").unwrap_err();
/// assert_eq!(error.to_string(), "a: \"1 kg\" is of another dimension");
/// assert_eq!(error.help().unwrap(), "a is in s; bare numbers are SI");
/// # Ok::<(), fem_data::estimate::ParameterError>(())
/// ```
pub fn parse_value(parameter: &LawParameter, text: &str) -> Result<f64, ParameterError> {
    let LawParameter { key, unit, dimension: [m, kg, s], .. } = *parameter;
    let text = text.trim().trim_matches(['"', '\'']);
    let (value, dimension) = parse_quantity(text).map_err(|error| {
        let text = text.to_string();
        ParameterError::NotANumber { key, text, error }
    })?;
    if dimension.0 != [0; 4] && dimension.0 != [m, kg, s, 0] {
        return Err(ParameterError::OtherDimension { key, text: text.to_string(), unit });
    }
    check_value(parameter, value)?;
    Ok(value)
}

/// Checks the range of a value, SI.
///
/// # Errors
/// The value is out of range; the error says what is allowed.
pub fn check_value(parameter: &LawParameter, value: f64) -> Result<(), ParameterError> {
    let LawParameter { key, role, limits: (low, high), .. } = *parameter;
    let is_allowed = value >= low && value <= high && value.is_finite();
    if is_allowed && (role == ParameterRole::Number || value > 0.0) {
        return Ok(());
    }
    let allowed = match role {
        ParameterRole::Number => format!("it must be from {low} to {high}"),
        _ => "it must be greater than 0".to_string(),
    };
    Err(ParameterError::OutOfRange { key, value, allowed })
}
