//! What is wrong with a case, for whoever wrote it.

use fem_case::CaseError;
use serde::Serialize;

/// What is wrong with a case, where, and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fault {
    /// What was found.
    pub message: String,
    /// What is allowed, or what to do.
    pub help: Option<String>,
    /// The dotted path of the key that it is about.
    pub key: Option<String>,
    /// Of the text, from 1; with `column`.
    pub line: Option<usize>,
    /// In characters, from 1.
    pub column: Option<usize>,
    /// All of it as plain text, with the line of the case and what in it is at fault.
    pub text: String,
    /// What else is wrong with the same case.
    pub others: Vec<Fault>,
}

impl From<CaseError> for Fault {
    fn from(mut error: CaseError) -> Self {
        let others = error.take_others().into_iter().map(Self::from).collect();
        Self {
            others,
            message: error.message().to_string(),
            help: error.help().map(String::from),
            key: error.key().map(String::from),
            line: error.line(),
            column: error.column(),
            text: error.to_string(),
        }
    }
}
