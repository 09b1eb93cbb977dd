//! Errors of a case, for the page.

use fem_case::CaseError;
use serde::Serialize;

/// An error of a case, its position, and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CaseFault {
    /// The error, in one sentence.
    pub message: String,
    /// The allowed values, or what to do.
    pub help: Option<String>,
    /// The dotted path of the key.
    pub key: Option<String>,
    /// Line in the text, from 1; with `column`.
    pub line: Option<usize>,
    /// Column in characters, from 1.
    pub column: Option<usize>,
    /// The whole error as plain text, with the line of the case.
    pub text: String,
    /// Further errors in the same case.
    pub others: Vec<CaseFault>,
}

impl From<CaseError> for CaseFault {
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
