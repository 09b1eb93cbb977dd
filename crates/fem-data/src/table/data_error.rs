//! An error in measured data, with its place.

/// An error in data: what was found, in which line of which text, and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {message}", self.place())]
pub struct DataError {
    /// The name of the data, such as their file's name.
    pub source_name: String,
    /// Line of the text, from 1.
    pub line: Option<u64>,
    /// Name of the column.
    pub column: Option<String>,
    /// Description of the error.
    pub message: String,
    /// The allowed values, or the suggested fix.
    pub help: Option<String>,
}

impl DataError {
    /// Creates an error about the data as a whole.
    pub fn new(source_name: &str, message: impl std::fmt::Display) -> Self {
        Self {
            source_name: one_line(source_name),
            line: None,
            column: None,
            message: one_line(&message.to_string()),
            help: None,
        }
    }

    /// Adds the line.
    #[must_use]
    pub fn in_line(self, line: u64) -> Self {
        Self { line: Some(line), ..self }
    }

    /// Adds the column.
    #[must_use]
    pub fn in_column(self, column: &str) -> Self {
        Self { column: Some(one_line(column)), ..self }
    }

    /// Adds what is allowed, or what to do.
    #[must_use]
    pub fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// Returns the place as `e.csv:3`, or the name alone.
    pub fn place(&self) -> String {
        match self.line {
            Some(line) => format!("{}:{line}", self.source_name),
            None => self.source_name.clone(),
        }
    }
}

/// Replaces control characters, which a terminal would obey.
pub(super) fn one_line(text: &str) -> String {
    text.replace(char::is_control, "\u{fffd}")
}
