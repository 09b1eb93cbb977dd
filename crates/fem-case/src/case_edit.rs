//! A case with one number changed.

use std::path::Path;

use crate::case::Case;
use crate::error::CaseError;

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
}
