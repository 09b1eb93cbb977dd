//! A material of the library, for a page to choose.

use fem_case::library::{materials, table_text};
use serde::Serialize;

/// A material of the library.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LibraryEntry {
    /// Without `lib:`.
    pub name: &'static str,
    /// What it is, in words.
    pub title: &'static str,
    /// Where its numbers are from.
    pub source: &'static str,
    /// Where they hold, and how far they scatter.
    pub range: &'static str,
    /// Its table in a case, as TOML; relaxation comes last.
    pub text: String,
}

impl LibraryEntry {
    /// All of them, by name.
    pub fn all() -> Vec<Self> {
        let entry = |(name, material): (&'static String, &'static fem_case::library::Material)| {
            let text = table_text(name)?;
            let (title, source, range) = (&material.title, &material.source, &material.range);
            Some(Self { name, title, source, range, text })
        };
        materials().iter().filter_map(entry).collect()
    }
}
