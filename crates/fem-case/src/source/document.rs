//! A case's texts (the file and its overrides) merged into one tree that knows the origin of each key and value. A case
//! that is made in code has no text, and one that is edited in code has keys without a text.
//!
//! All texts share one line of byte offsets: the file begins at 0, and each other text one byte after the end of the
//! text before it. A span in the merged tree thus names its text as well.

use std::ops::Range;

use toml::de::DeTable;
use toml::{Spanned, Table};

use crate::error::CaseError;
use crate::library;
use crate::source::error_recovery::KeyRepair;
use crate::source::key_origins::{KeyOrigin, KeyOrigins};
use crate::source::overrides::{self, Assignment, OverrideError};
use crate::source::toml_syntax::{first_line, other_format, syntax_help};

/// One text and its position in the common offsets.
#[derive(Clone, Debug)]
struct Source {
    name: String,
    text: String,
    start: usize,
    /// Its rank among the texts that override each other: 0 for the file.
    turn: usize,
}

/// Values of another file that go into the tree; their spans count from its beginning.
pub(crate) struct Insertions<'s, 't> {
    pub(crate) name: &'s str,
    pub(crate) text: &'s str,
    pub(crate) assignments: Vec<Assignment<'t>>,
}

/// The texts of a case, none if it is made in code, and the origins of its keys.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    sources: Vec<Source>,
    origins: KeyOrigins,
}

impl Document {
    /// Parses `text`, applies the overrides, left to right, then the insertions, and then the repairs of
    /// [`error_recovery`](crate::source::error_recovery). Keys that the texts lack come from the library's materials
    /// that the bodies name.
    ///
    /// Returns the document and the merged tree as a deserializer.
    pub(crate) fn parse<'t>(
        name: &str,
        text: &'t str,
        overrides: &'t [String],
        insertions: Option<Insertions<'_, 't>>,
        repairs: &'t [KeyRepair],
    ) -> Result<(Document, Spanned<DeTable<'t>>), CaseError> {
        let mut document = Document { sources: Vec::new(), origins: KeyOrigins::default() };
        document.add(name.to_string(), text, 0);
        let mut tree = DeTable::parse(text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            let (line, help) = match other_format(name, text) {
                Some(help) => (span.clone(), help.to_string()),
                None => syntax_help(text, span.start),
            };
            // An open quote or bracket is reported where the next line begins.
            let span = if (line.start..=line.end).contains(&span.start) { span } else { line };
            document.error_in(0, span, first_line(error.message())).with_help(help)
        })?;
        overrides::expand_choices(tree.get_mut());
        for (index, text) in overrides.iter().enumerate() {
            let name = format!("--set {}=…", overrides::key_text(text));
            let start = document.add(name, text, index + 1);
            let applied = overrides::parse(text, start)
                .and_then(|assignment| overrides::apply(tree.get_mut(), assignment));
            applied.map_err(|error| document.override_error(error))?;
        }
        if let Some(Insertions { name, text, assignments }) = insertions {
            let start = document.add(name.to_string(), text, overrides.len() + 1);
            for assignment in assignments {
                overrides::apply(tree.get_mut(), assignment.shifted(start))
                    .map_err(|error| document.override_error(error))?;
            }
        }
        for KeyRepair { path, value } in repairs {
            overrides::repair(tree.get_mut(), path, value.as_deref());
        }
        if library::underlay(tree.get_mut(), document.next_start()) {
            document.add("materials library".to_string(), library::TEXT, 0);
        }
        document.origins = KeyOrigins::of_text(tree.get_ref());
        Ok((document, tree))
    }

    /// Creates the document of a case that is made in code.
    pub(crate) fn of_code(tree: &Table) -> Document {
        Document { sources: Vec::new(), origins: KeyOrigins::of_code(tree) }
    }

    /// Returns the document after an edit in code that made `before` into `after`.
    pub(crate) fn edited(&self, before: &Table, after: &Table) -> Document {
        Document { sources: self.sources.clone(), origins: self.origins.edited(before, after) }
    }

    /// Adds a text and returns its start.
    fn add(&mut self, name: String, text: &str, turn: usize) -> usize {
        let start = self.next_start();
        self.sources.push(Source { name, text: text.to_string(), start, turn });
        start
    }

    fn next_start(&self) -> usize {
        self.sources.last().map_or(0, |last| last.start + last.text.len() + 1)
    }

    /// Returns whether the case gives a value at this path.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.origins.get(path).is_some()
    }

    /// Returns the paths of all keys that the case gives.
    pub(crate) fn paths(&self) -> impl Iterator<Item = &str> {
        self.origins.paths()
    }

    /// Returns the paths of all arrays in the texts.
    pub(crate) fn arrays(&self) -> &[String] {
        self.origins.arrays()
    }

    /// Returns the one to blame of several keys that contradict each other: the first of those that the last edit, or
    /// else the last override, gave; or else `default`.
    pub(crate) fn blamed<'p>(&self, default: &'p str, others: &[&'p str]) -> &'p str {
        let later = |best: &'p str, other: &&'p str| {
            if self.turn_of(other) > self.turn_of(best) { other } else { best }
        };
        others.iter().fold(default, later)
    }

    /// Returns the turn of the override or edit that gave a value, 0 for the file itself.
    pub(crate) fn turn_of(&self, path: &str) -> usize {
        match self.origins.get(path) {
            Some(KeyOrigin::Text { value, .. }) => self.sources[self.source_at(value.start)].turn,
            Some(KeyOrigin::Code { edit }) => self.sources.len() + edit,
            None => 0,
        }
    }

    /// Creates an error that points at the value of the key at `path`, or, if it is absent, at the nearest table
    /// around it. A key without a text is named instead.
    pub(crate) fn error_at(&self, path: &str, message: impl Into<String>) -> CaseError {
        match self.origins.nearest(path) {
            Some(KeyOrigin::Text { value, .. }) => {
                self.error_on(value.clone(), message).about(path)
            }
            None if !self.sources.is_empty() => self.error_in(0, 0..0, message).about(path),
            _ => CaseError::new(path, message).about(path),
        }
    }

    /// Creates an error at a span of the common offsets.
    pub(crate) fn error_on(&self, span: Range<usize>, message: impl Into<String>) -> CaseError {
        let index = self.source_at(span.start);
        let start = self.sources[index].start;
        self.error_in(index, span.start - start..span.end.saturating_sub(start), message)
    }

    fn override_error(&self, error: OverrideError) -> CaseError {
        self.error_on(error.span, error.message).with_help(error.help)
    }

    /// Returns the text at a span of the common offsets.
    pub(crate) fn text_on(&self, span: &Range<usize>) -> &str {
        let Source { text, start, .. } = &self.sources[self.source_at(span.start)];
        text.get(span.start - start..span.end.saturating_sub(*start)).unwrap_or("")
    }

    /// Returns the text of the value at a path, which is empty if no text gives it.
    pub(crate) fn value_text(&self, path: &str) -> &str {
        match self.origins.get(path) {
            Some(KeyOrigin::Text { value, .. }) => self.text_on(value),
            _ => "",
        }
    }

    fn source_at(&self, offset: usize) -> usize {
        self.sources.partition_point(|source| source.start <= offset).saturating_sub(1)
    }

    fn error_in(&self, source: usize, span: Range<usize>, message: impl Into<String>) -> CaseError {
        let Source { name, text, .. } = &self.sources[source];
        CaseError::new(name, message).at(text, span)
    }

    /// Returns the path whose value, or else whose key, has this span; the deepest of several.
    pub(crate) fn path_of(&self, span: &Range<usize>) -> Option<&str> {
        self.origins.path_of(span)
    }
}
