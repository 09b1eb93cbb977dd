//! A case with one number changed.

use std::path::Path;

use crate::case::Case;
use crate::error::CaseError;
use crate::scene::UncertainInput;

impl Case {
    /// Returns this case with another number, SI, at a dotted key. An uncertainty at the key is lost.
    ///
    /// # Errors
    /// A number that the case does not allow there.
    pub fn with_number(&self, key: &str, value: f64) -> Result<Case, CaseError> {
        let text = self.file().to_toml();
        let text = text.map_err(|error| CaseError::new("the case", error.to_string()))?;
        Case::parse("the case", &text, Path::new("."), &[format!("{key}={value:e}")])
    }

    /// Returns the changes of numbers y by an uncertain input x ± u (JCGM 100:2008, 5.1.2),
    ///
    /// ```math
    /// \tfrac12 y(x+u) - \tfrac12 y(x-u),
    /// ```
    ///
    /// or the change to one side if the other one is out of range. `changes` returns the changes of the numbers from those of this case
    /// to those of another one; `None` if it does so to both sides.
    pub fn change_by(
        &self,
        input: &UncertainInput,
        changes: impl Fn(&Case) -> Option<Vec<f64>>,
    ) -> Option<Vec<f64>> {
        let at = |value: f64| changes(&self.with_number(&input.key, value).ok()?);
        central_change(|side| at(input.value + side * input.uncertainty))
    }
}

/// Returns half of the difference of numbers at side 1 and at side −1, or the change to one side if there is none at the other;
/// `None` if there is none at either.
pub fn central_change(changes: impl Fn(f64) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
    match [1.0, -1.0].map(changes) {
        [Some(above), Some(below)] => Some(half_difference(&above, &below)),
        [Some(above), None] => Some(above),
        [None, Some(below)] => Some(below.iter().map(|change| -change).collect()),
        [None, None] => None,
    }
}

/// Returns half of the difference of numbers at both sides.
pub fn half_difference(above: &[f64], below: &[f64]) -> Vec<f64> {
    above.iter().zip(below).map(|(above, below)| 0.5 * (above - below)).collect()
}
