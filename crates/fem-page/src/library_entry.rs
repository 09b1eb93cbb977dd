//! Materials of the library, for the page to choose.

use fem_case::library::{materials, table_text};
use serde::Serialize;

/// A material of the library.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LibraryEntry {
    /// Name, without `lib:`.
    pub name: &'static str,
    /// Title for the list of materials.
    pub title: &'static str,
    /// Source of the numbers.
    pub source: &'static str,
    /// Range of validity, and scatter.
    pub range: &'static str,
    /// Its table in a case, as TOML; relaxation comes last.
    pub text: String,
}

impl LibraryEntry {
    /// Returns all materials, by name.
    pub fn all() -> Vec<Self> {
        let entry = |(name, material): (&'static String, &'static fem_case::library::Material)| {
            let text = table_text(name)?;
            let (title, source, range) = (&material.title, &material.source, &material.range);
            Some(Self { name, title, source, range, text })
        };
        materials().iter().filter_map(entry).collect()
    }
}
