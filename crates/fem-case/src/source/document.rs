//! A case's texts (the file and its overrides) merged into one tree that knows where each key
//! and value came from. A case that is made in code has no text, one that is edited in code has
//! keys that stand in none.
//!
//! All texts share one line of byte offsets: the file begins at 0, each override one byte after
//! the end of the text before it. A span in the merged tree thus names its text as well.

use std::ops::Range;

use toml::de::DeTable;
use toml::{Spanned, Table};

use crate::error::CaseError;
use crate::library;
use crate::source::error_recovery::Repair;
use crate::source::overrides::{self, Assignment};
use crate::source::source_spans::{Position, Positions};
use crate::source::toml_text::first_line;

/// One text, and where it begins on the common line of offsets.
#[derive(Clone, Debug)]
struct Source {
    name: String,
    text: String,
    start: usize,
    /// When it was given: the file 0, then what overrides it.
    turn: usize,
}

/// Values of another file that go into the tree; their spans count from its beginning.
pub(crate) struct Insertions<'s, 't> {
    pub(crate) name: &'s str,
    pub(crate) text: &'s str,
    pub(crate) assignments: Vec<Assignment<'t>>,
}

/// The texts of a case, none if it is made in code, and the positions of its keys.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    sources: Vec<Source>,
    positions: Positions,
}

impl Document {
    /// Parses `text`, applies the overrides, left to right, and then the insertions; under all of it
    /// lie the materials of the library that bodies name. Repairs are for a reader that looks for
    /// more faults.
    ///
    /// Returns the document and the merged tree as a deserializer.
    pub(crate) fn parse<'t>(
        name: &str,
        text: &'t str,
        overrides: &'t [String],
        insertions: Option<Insertions<'_, 't>>,
        repairs: &'t [Repair],
    ) -> Result<(Document, Spanned<DeTable<'t>>), CaseError> {
        let file = Source { name: name.to_string(), text: text.to_string(), start: 0, turn: 0 };
        let mut document = Document { sources: vec![file], positions: Positions::default() };
        let mut tree = DeTable::parse(text).map_err(|error| {
            document
                .error_in(0, error.span().unwrap_or(0..0), first_line(error.message()))
                .with_help(
                    "the file must be TOML: one `key = value` a line; a value with a unit is a \
                 string in quotes, \"22.2 mm\"",
                )
        })?;
        overrides::expand_choices(tree.get_mut());
        for (index, text) in overrides.iter().enumerate() {
            let previous = &document.sources[index];
            document.sources.push(Source {
                name: format!("--set {}=…", overrides::key_text(text)),
                text: text.clone(),
                start: previous.start + previous.text.len() + 1,
                turn: index + 1,
            });
            let start = document.sources[index + 1].start;
            let fail = |fault: overrides::Fault| {
                document.error_on(fault.span, fault.message).with_help(fault.help)
            };
            let assignment = overrides::parse(text, start).map_err(fail)?;
            overrides::apply(tree.get_mut(), assignment).map_err(fail)?;
        }
        if let Some(Insertions { name, text, assignments }) = insertions {
            let previous = &document.sources[overrides.len()];
            let start = previous.start + previous.text.len() + 1;
            let (name, turn) = (name.to_string(), overrides.len() + 1);
            let source = Source { name, text: text.to_string(), start, turn };
            document.sources.push(source);
            for assignment in assignments {
                overrides::apply(tree.get_mut(), assignment.shifted(start)).map_err(|fault| {
                    document.error_on(fault.span, fault.message).with_help(fault.help)
                })?;
            }
        }
        for Repair { path, value } in repairs {
            overrides::mend(tree.get_mut(), path, value.as_deref());
        }
        let start = document.sources.last().map_or(0, |last| last.start + last.text.len() + 1);
        if library::underlay(tree.get_mut(), start) {
            let (name, text) = ("materials library".to_string(), library::TEXT.to_string());
            document.sources.push(Source { name, text, start, turn: 0 });
        }
        document.positions = Positions::of_text(tree.get_ref());
        Ok((document, tree))
    }

    /// Of a case that is made in code.
    pub(crate) fn of_code(tree: &Table) -> Document {
        Document { sources: Vec::new(), positions: Positions::of_code(tree) }
    }

    /// After an edit in code that made `before` into `after`.
    pub(crate) fn edited(&self, before: &Table, after: &Table) -> Document {
        let positions = self.positions.edited(before, after);
        Document { sources: self.sources.clone(), positions }
    }

    /// Whether the case gives a value at this path.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.positions.get(path).is_some()
    }

    /// The paths of all arrays in the texts.
    pub(crate) fn arrays(&self) -> &[String] {
        self.positions.arrays()
    }

    /// Which of several keys that contradict each other is to blame: the first of those that the
    /// last edit or else the last override among them gave, or else `default`.
    pub(crate) fn blamed<'p>(&self, default: &'p str, others: &[&'p str]) -> &'p str {
        let turn_of = |path: &str| match self.positions.get(path) {
            Some(Position::Text { value, .. }) => self.sources[self.source_at(value.start)].turn,
            Some(Position::Code { edit }) => self.sources.len() + edit,
            None => 0,
        };
        let later = |best: &'p str, other: &&'p str| {
            if turn_of(other) > turn_of(best) { other } else { best }
        };
        others.iter().fold(default, later)
    }

    /// An error that points at the value of the key at `path`, or, if it is absent, at the
    /// nearest table around it; named by the key where that stands in no text.
    pub(crate) fn error_at(&self, path: &str, message: impl Into<String>) -> CaseError {
        match self.positions.nearest(path) {
            Some(Position::Text { value, .. }) => self.error_on(value.clone(), message).about(path),
            None if !self.sources.is_empty() => self.error_in(0, 0..0, message).about(path),
            _ => CaseError::new(path, message).about(path),
        }
    }

    /// An error at a span of the common line of offsets.
    pub(crate) fn error_on(&self, span: Range<usize>, message: impl Into<String>) -> CaseError {
        let index = self.source_at(span.start);
        let start = self.sources[index].start;
        self.error_in(index, span.start - start..span.end.saturating_sub(start), message)
    }

    /// The text at a span of the common line of offsets.
    pub(crate) fn text_on(&self, span: &Range<usize>) -> &str {
        let Source { text, start, .. } = &self.sources[self.source_at(span.start)];
        text.get(span.start - start..span.end.saturating_sub(*start)).unwrap_or("")
    }

    fn source_at(&self, offset: usize) -> usize {
        self.sources.partition_point(|source| source.start <= offset).saturating_sub(1)
    }

    fn error_in(&self, source: usize, span: Range<usize>, message: impl Into<String>) -> CaseError {
        let Source { name, text, .. } = &self.sources[source];
        CaseError::new(name, message).at(text, span)
    }

    /// The path whose value or else key has this span; the deepest if several have.
    pub(crate) fn path_of(&self, span: &Range<usize>) -> Option<&str> {
        self.positions.path_of(span)
    }
}
