//! `fem-run report FOLDER...`: the page of a result, or of several beside each other.

use std::path::PathBuf;

use fem_report::report::{REPORT_FILE, StoredResult, comparison_page, report_page};

use crate::failure::Failure;
use crate::own_file::OwnFile;
use crate::standard_output;

/// By what a page is known.
const PAGE: OwnFile = OwnFile {
    what: "page",
    extension: "html",
    mark: "<meta name=\"generator\" content=\"fem-run\">",
    option: "--out",
};

/// Write the page of a result, or compare several on one
///
/// One folder gets its report.html, as its run has written it or would have. Of several folders one page
/// has curves over each other, the differences of their numbers from the first and where their cases
/// differ.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// Result folders of runs
    #[arg(value_name = "FOLDER", required = true)]
    folders: Vec<PathBuf>,
    /// The page, - for standard output [default: FOLDER/report.html; of several folders comparison.html]
    ///
    /// An existing file is replaced only if it is such a page.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

/// Writes a page and says where it is.
pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let records = StoredResult::read_all(&arguments.folders)?;
    let (text, usual) = match (records.as_slice(), arguments.folders.as_slice()) {
        ([record], [folder]) => (report_page(record)?, folder.join(REPORT_FILE)),
        _ => (comparison_page(&records)?, PathBuf::from("comparison.html")),
    };
    let path = arguments.out.clone().unwrap_or(usual);
    match PAGE.write(&path, &text)? {
        Some(written) if !arguments.quiet => standard_output::print(&written),
        _ => Ok(()),
    }
}
