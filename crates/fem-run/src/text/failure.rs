//! Failures: why the program ends with a status other than 0, and how that is printed.
//!
//! A terminal shows the source line with colours; elsewhere the same is plain text that begins with `error:
//! FILE:LINE:COLUMN: `.

use std::fmt;
use std::io::{IsTerminal, Write, stderr};
use std::ops::Range;
use std::process::ExitCode;

use fem_case::CaseError;
use fem_report::report::ReportError;
use miette::{Diagnostic, LabeledSpan, MietteHandlerOpts, NamedSource, ReportHandler, SourceCode};
use textwrap::{WordSeparator, WordSplitter};

/// Exit statuses other than 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The run failed.
    Failed = 1,
    /// Bad input; nothing was written.
    BadInput = 2,
    /// Interrupted by a signal.
    Interrupted = 130,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        ExitCode::from(status as u8)
    }
}

/// The reason why the program ends without success.
#[derive(Debug)]
pub struct Failure {
    status: Status,
    message: String,
    help: Option<String>,
    /// The whole failure as plain text.
    plain: String,
    place: Option<Box<Place>>,
    /// The case error that it comes from.
    case: Option<Box<CaseError>>,
    /// Further errors in the same input.
    others: Vec<Failure>,
}

/// A span of a case file or of an override.
#[derive(Debug)]
struct Place {
    source: NamedSource<String>,
    span: Range<usize>,
    label: Option<String>,
}

impl Failure {
    /// Creates a failure for bad input without a line of a case.
    pub fn bad_input(message: impl Into<String>) -> Self {
        Self::new(Status::BadInput, message.into())
    }

    /// Creates a failure for valid input.
    pub fn failed(message: impl Into<String>) -> Self {
        Self::new(Status::Failed, message.into())
    }

    /// Creates the failure of a run that was stopped from outside.
    pub fn interrupted(message: impl Into<String>) -> Self {
        Self::new(Status::Interrupted, message.into())
    }

    fn new(status: Status, message: String) -> Self {
        Self {
            status,
            plain: message.clone(),
            message,
            help: None,
            place: None,
            case: None,
            others: Vec::new(),
        }
    }

    /// Sets the suggested fix, which replaces an earlier one.
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        let shown = |help: &str| format!("\n  help: {}", help.replace('\n', "\n        "));
        if let Some(before) = self.help.take() {
            self.plain = self.plain.replacen(&shown(&before), "", 1);
        }
        let help = help.into();
        self.plain += &shown(&help);
        self.help = Some(help);
        self
    }

    /// Sets the suggested fix, if there is one.
    pub fn with_help_if(self, help: Option<impl Into<String>>) -> Self {
        match help {
            Some(help) => self.with_help(help),
            None => self,
        }
    }

    /// Returns the whole failure as plain text, as it is printed to a pipe after `error: `.
    pub fn text(&self) -> String {
        let others = self.others.iter().map(|other| format!("\nerror: {}", other.text()));
        self.plain.clone() + &others.collect::<String>()
    }

    /// Returns the suggested fix.
    pub fn advice(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// Returns the case error that it comes from, with file, position and key.
    pub fn case_error(&self) -> Option<&CaseError> {
        self.case.as_deref()
    }

    /// Returns the exit status.
    pub fn status(&self) -> Status {
        self.status
    }

    /// Prints the failure to stderr.
    pub fn print(&self) {
        let mut stderr = stderr();
        // A closed stderr is no reason to end.
        let _ = if stderr.is_terminal() {
            writeln!(stderr, "{}", OnTerminal(self))
        } else {
            writeln!(stderr, "error: {}", self.plain)
        };
        self.others.iter().for_each(Self::print);
    }
}

impl From<CaseError> for Failure {
    fn from(mut error: CaseError) -> Self {
        let others = error.take_others().into_iter().map(Self::from).collect();
        let place = Place::of(&error).map(Box::new);
        let (message, plain) = (error.message(), error.to_string());
        let message = if place.is_some() {
            message.to_string()
        } else {
            let position = plain.find(&format!(": {message}")).unwrap_or(plain.len());
            format!("{}: {message}", &plain[..position])
        };
        Self {
            status: Status::BadInput,
            message: tame(&message),
            help: error.help().map(tame),
            plain,
            place,
            case: Some(Box::new(error)),
            others,
        }
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error.help() {
            Some(help) => Self::bad_input(error.to_string()).with_help(help),
            None => Self::failed(error.to_string()),
        }
    }
}

impl Place {
    /// Returns the span of an error, unless its line is too long to show.
    fn of(error: &CaseError) -> Option<Self> {
        const LONGEST_LINE: usize = 200;
        let (text, span) = (error.source_text()?, error.span()?);
        let text = tame(text);
        if text.lines().any(|line| line.len() > LONGEST_LINE) {
            return None;
        }
        let label = error.label().filter(|label| !label.is_empty()).unwrap_or("here");
        let source = NamedSource::new(tame(error.source_name()), text);
        Some(Self { source, span, label: Some(label.to_string()) })
    }
}

/// Replaces control characters, keeping the number of bytes: a terminal must not obey a file.
fn tame(text: &str) -> String {
    let mut tame = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\r' => tame.push(' '),
            '\n' | '\t' => tame.push(c),
            _ if c.is_control() => tame.extend(std::iter::repeat_n('?', c.len_utf8())),
            _ => tame.push(c),
        }
    }
    tame
}

/// The failure as a terminal shows it.
struct OnTerminal<'a>(&'a Failure);

impl fmt::Display for OnTerminal<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Lines break only at spaces, since units contain slashes and hyphens.
        let options = MietteHandlerOpts::new()
            .word_separator(WordSeparator::AsciiSpace)
            .word_splitter(WordSplitter::NoHyphenation)
            .break_words(false);
        options.build().debug(self.0, f)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

impl Diagnostic for Failure {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.place.as_ref().map(|place| &place.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.place.as_ref().map(|place| {
            let Range { start, end } = place.span.clone();
            let label = LabeledSpan::new(place.label.clone(), start, end - start);
            Box::new(std::iter::once(label)) as Box<dyn Iterator<Item = LabeledSpan>>
        })
    }
}
