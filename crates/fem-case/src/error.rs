//! The error of this crate: a fault of a case, its position, and the allowed values.

use std::fmt;
use std::ops::Range;

use crate::source::toml_syntax::join;

/// An error in a case file, in an override of it, or in a case made in code.
///
/// It displays as a block of plain text: position and message, the line with the faulty text underlined, and help. The
/// accessors serve other renderings. A value that code gave has no line; its key is shown instead.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.block())]
pub struct CaseError {
    source_name: String,
    message: String,
    help: Option<String>,
    key: Option<String>,
    place: Option<Box<Place>>,
    more: Box<More>,
}

/// Rarely used parts, boxed so that the error type stays small.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct More {
    /// A key that is missing in the table that the error is about.
    missing: Option<String>,
    others: Vec<CaseError>,
}

/// A span of a source text.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Place {
    text: String,
    span: Range<usize>,
    label: String,
}

impl CaseError {
    /// Creates an error about a source as a whole, such as a missing file.
    pub fn new(source_name: impl Into<String>, message: impl Into<String>) -> Self {
        CaseError {
            source_name: source_name.into(),
            message: message.into(),
            help: None,
            key: None,
            place: None,
            more: Box::default(),
        }
    }

    /// Adds the allowed values, or what to do.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Sets the key that the error is about, as a dotted path.
    pub(crate) fn about(mut self, key: &str) -> Self {
        self.key = Some(key.to_string());
        self
    }

    /// Sets the key that is missing in the table that the error is about.
    pub(crate) fn lacking(mut self, key: &str) -> Self {
        self.more.missing = Some(key.to_string());
        self
    }

    /// Returns the first of these errors with the others attached; `None` if there are none.
    pub(crate) fn joined(errors: Vec<CaseError>) -> Option<Self> {
        let mut errors = errors.into_iter();
        let mut first = errors.next()?;
        first.more.others = errors.collect();
        Some(first)
    }

    /// Returns the key that needs another value: the one that the error is about, or that is missing there.
    pub(crate) fn wanted(&self) -> Option<String> {
        match (&self.key, &self.more.missing) {
            (Some(table), Some(missing)) => Some(join(table, missing)),
            (None, Some(missing)) => Some(missing.clone()),
            (key, None) => key.clone(),
        }
    }

    /// Points the error at the bytes `span` of `text`; a span that does not fit is trimmed.
    pub(crate) fn at(mut self, text: &str, span: Range<usize>) -> Self {
        let boundary = |mut index: usize| {
            index = index.min(text.len());
            while !text.is_char_boundary(index) {
                index -= 1;
            }
            index
        };
        let start = boundary(span.start);
        let span = start..boundary(span.end).max(start);
        self.place = Some(Box::new(Place { text: text.to_string(), span, label: String::new() }));
        self
    }

    /// Adds a short label beside the underlined text.
    pub(crate) fn labelled(mut self, label: &str) -> Self {
        if let Some(place) = &mut self.place {
            place.label = label.to_string();
        }
        self
    }

    /// Returns the file as it was named, the override `--set body.0.approach_speed=…`, or the key that code gave,
    /// `body.0.approach_speed`.
    pub fn source_name(&self) -> &str {
        &self.source_name
    }

    /// Returns the dotted path of the key that the error is about, given or missing; `None` if it is about the text as
    /// such.
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    /// Returns further errors of the same case; there are none if code made the case.
    pub fn others(&self) -> &[CaseError] {
        &self.more.others
    }

    /// Removes and returns [`CaseError::others`].
    pub fn take_others(&mut self) -> Vec<CaseError> {
        std::mem::take(&mut self.more.others)
    }

    /// Returns the message: what was found.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Returns the allowed values, or the suggested fix.
    pub fn help(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// Returns the whole text of the source, if the error points into it.
    pub fn source_text(&self) -> Option<&str> {
        self.place.as_ref().map(|place| place.text.as_str())
    }

    /// Returns the faulty bytes of the source text.
    pub fn span(&self) -> Option<Range<usize>> {
        self.place.as_ref().map(|place| place.span.clone())
    }

    /// Returns the label of the faulty bytes ("unknown key"); it may be empty.
    pub fn label(&self) -> Option<&str> {
        self.place.as_ref().map(|place| place.label.as_str())
    }

    /// Returns the line of the first faulty character, from 1.
    pub fn line(&self) -> Option<usize> {
        self.place.as_ref().map(|place| place.line_and_column().0)
    }

    /// Returns the column of the first faulty character, from 1, in characters.
    pub fn column(&self) -> Option<usize> {
        self.place.as_ref().map(|place| place.line_and_column().1)
    }

    fn block(&self) -> String {
        let mut block = self.source_name.clone();
        if let Some(place) = &self.place {
            let (line, column) = place.line_and_column();
            block += &format!(":{line}:{column}");
        }
        block += &format!(": {}", self.message);
        if let Some(place) = &self.place {
            block += &format!("\n{place}");
        }
        if let Some(help) = &self.help {
            block += &format!("\n  help: {help}");
        }
        for other in &self.more.others {
            block += &format!("\n{other}");
        }
        // A case file may contain control sequences that a terminal must not execute.
        block.replace(|c: char| c.is_control() && c != '\n', "\u{fffd}")
    }
}

impl Place {
    fn line_start(&self) -> usize {
        self.text[..self.span.start].rfind('\n').map_or(0, |newline| newline + 1)
    }

    fn line_and_column(&self) -> (usize, usize) {
        let line = 1 + self.text[..self.span.start].matches('\n').count();
        let column = 1 + self.text[self.line_start()..self.span.start].chars().count();
        (line, column)
    }
}

impl fmt::Display for Place {
    /// Writes the line, and carets under the faulty text as far as it lies in that line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const LONGEST_LINE: usize = 160;
        let (number, column) = self.line_and_column();
        let start = self.line_start();
        let line = self.text[start..].lines().next().unwrap_or("");
        let number = number.to_string();
        let gutter = " ".repeat(number.len());
        write!(f, "{gutter} |\n{number} | ")?;
        if line.chars().count() > LONGEST_LINE {
            return write!(f, "(a line of {} characters)", line.chars().count());
        }
        let end = self.span.end.clamp(self.span.start, (start + line.len()).max(self.span.start));
        let width = self.text[self.span.start..end].chars().count().max(1);
        let indent = " ".repeat(column - 1);
        let label = if self.label.is_empty() { String::new() } else { format!(" {}", self.label) };
        let shown = line.replace('\t', " ");
        write!(f, "{shown}\n{gutter} | {indent}{}{label}", "^".repeat(width))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn case_error_displays_source_marker_label_and_help() {
        let text = "# µ\n\tsphere = { diameter = \"22.2 kg\" }\n";
        let start = text.find("\"22").unwrap();
        let error = CaseError::new("a.toml", "\"22.2 kg\" is a mass")
            .at(text, start..start + 9)
            .labelled("a mass")
            .with_help("write a length");
        assert_eq!((error.line(), error.column()), (Some(2), Some(24)));
        let expected = "a.toml:2:24: \"22.2 kg\" is a mass\n  |\n2 |  sphere = { diameter = \
                        \"22.2 kg\" }\n  |                        ^^^^^^^^^ a mass\n  help: write a \
                        length";
        assert_eq!(error.to_string(), expected);
    }

    #[test]
    fn case_error_trims_spans_outside_the_text() {
        let text = "µ = 1\r\nb";
        for start in 0..12 {
            for end in 0..12 {
                let error = CaseError::new("x", "m").at(text, start..end);
                assert!(error.span().unwrap().end <= text.len());
                assert!(error.to_string().starts_with("x:"));
            }
        }
    }

    #[test]
    fn control_characters_do_not_reach_the_terminal() {
        let error = CaseError::new("x", "\u{1b}[31m").at("\u{1b}[2J\u{7}", 0..1);
        assert!(!error.to_string().contains(['\u{1b}', '\u{7}']));
    }
}
