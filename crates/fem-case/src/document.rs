//! A case's texts (the file and its overrides) merged into one tree that knows where each key
//! and value came from.
//!
//! All texts share one line of byte offsets: the file begins at 0, each override one byte after
//! the end of the text before it. A span in the merged tree thus names its text as well.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::CaseError;
use crate::key_path::{join, quote_key};
use crate::overrides::{self, Assignment};
use crate::toml_text::first_line;

/// One text, and where it begins on the common line of offsets.
#[derive(Clone, Debug)]
struct Source {
    name: String,
    text: String,
    start: usize,
}

/// Where a key and its value stand on the common line of offsets.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Position {
    key: Range<usize>,
    value: Range<usize>,
}

/// Values of another file that go into the tree; their spans count from its beginning.
pub(crate) struct Insertions<'s, 't> {
    pub(crate) name: &'s str,
    pub(crate) text: &'s str,
    pub(crate) assignments: Vec<Assignment<'t>>,
}

/// The texts of a case and the positions of its keys, by dotted path (`body.0.sphere.diameter`).
#[derive(Clone, Debug)]
pub(crate) struct Document {
    sources: Vec<Source>,
    positions: BTreeMap<String, Position>,
    arrays: Vec<String>,
}

impl Document {
    /// Parses `text`, applies the overrides, left to right, and then the insertions.
    ///
    /// Returns the document and the merged tree as a deserializer.
    pub(crate) fn parse<'t>(
        name: &str,
        text: &'t str,
        overrides: &'t [String],
        insertions: Option<Insertions<'_, 't>>,
    ) -> Result<(Document, Spanned<DeTable<'t>>), CaseError> {
        let file = Source { name: name.to_string(), text: text.to_string(), start: 0 };
        let mut document =
            Document { sources: vec![file], positions: BTreeMap::new(), arrays: Vec::new() };
        let mut tree = DeTable::parse(text).map_err(|error| {
            document
                .error_in(0, error.span().unwrap_or(0..0), first_line(error.message()))
                .with_help(
                    "the file must be TOML: one `key = value` a line; a value with a unit is a \
                 string in quotes, \"22.2 mm\"",
                )
        })?;
        for (index, text) in overrides.iter().enumerate() {
            let previous = &document.sources[index];
            document.sources.push(Source {
                name: format!("--set {}=…", overrides::key_text(text)),
                text: text.clone(),
                start: previous.start + previous.text.len() + 1,
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
            let source = Source { name: name.to_string(), text: text.to_string(), start };
            document.sources.push(source);
            for assignment in assignments {
                overrides::apply(tree.get_mut(), assignment.shifted(start)).map_err(|fault| {
                    document.error_on(fault.span, fault.message).with_help(fault.help)
                })?;
            }
        }
        for (key, value) in tree.get_ref() {
            document.record(quote_key(key.get_ref()), key.span(), value);
        }
        Ok((document, tree))
    }

    fn record(&mut self, path: String, key: Range<usize>, value: &Spanned<DeValue<'_>>) {
        match value.get_ref() {
            DeValue::Table(table) => {
                for (key, value) in table {
                    self.record(join(&path, &quote_key(key.get_ref())), key.span(), value);
                }
            }
            DeValue::Array(array) => {
                self.arrays.push(path.clone());
                for (index, value) in array.iter().enumerate() {
                    self.record(join(&path, &index.to_string()), value.span(), value);
                }
            }
            _ => {}
        }
        self.positions.insert(path, Position { key, value: value.span() });
    }

    /// Whether the case gives a value at this path.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.positions.contains_key(path)
    }

    /// The paths of all arrays.
    pub(crate) fn arrays(&self) -> &[String] {
        &self.arrays
    }

    /// Which of several keys that contradict each other is to blame: the first of those that the
    /// last override among them gave, or else `default`.
    pub(crate) fn blamed<'p>(&self, default: &'p str, others: &[&'p str]) -> &'p str {
        let source_of = |path: &str| {
            let position = self.positions.get(path);
            position.map_or(0, |position| self.source_at(position.value.start))
        };
        let later = |best: &'p str, other: &&'p str| {
            if source_of(other) > source_of(best) { other } else { best }
        };
        others.iter().fold(default, later)
    }

    /// An error that points at the value of the key at `path`, or, if it is absent, at the
    /// nearest table around it.
    pub(crate) fn error_at(&self, path: &str, message: impl Into<String>) -> CaseError {
        let mut path = path;
        loop {
            if let Some(position) = self.positions.get(path) {
                return self.error_on(position.value.clone(), message);
            }
            match path.rfind('.') {
                Some(dot) => path = &path[..dot],
                None => return self.error_in(0, 0..0, message),
            }
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
        let deepest = |is_match: &dyn Fn(&Position) -> bool| {
            let found = self.positions.iter().filter(|(_, position)| is_match(position));
            found.map(|(path, _)| path.as_str()).max_by_key(|path| path.matches('.').count())
        };
        deepest(&|position| position.value == *span)
            .or_else(|| deepest(&|position| position.key == *span))
    }
}
