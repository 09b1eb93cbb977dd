//! `fem-run report FOLDER...`: the page of a result, or of several beside each other.

use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::page::{REPORT_FILE, Record, comparison, page};
use crate::standard_output::{self, one_line};
use crate::whole_file::write_whole;

/// By what a page of this program is known.
const MARK: &str = "<meta name=\"generator\" content=\"fem-run\">";
/// Bytes of a page within which its mark is.
const HEAD: usize = 400;

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
    /// The page [default: FOLDER/report.html; of several folders comparison.html]
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
    let records = Record::read_all(&arguments.folders)?;
    let (text, usual) = match (records.as_slice(), arguments.folders.as_slice()) {
        ([record], [folder]) => (page(record)?, folder.join(REPORT_FILE)),
        _ => (comparison(&records)?, PathBuf::from("comparison.html")),
    };
    let path = arguments.out.clone().unwrap_or(usual);
    write(&path, &text)?;
    if arguments.quiet {
        return Ok(());
    }
    standard_output::print(&format!("Page: {}\n", one_line(&path.display().to_string())))
}

/// Writes a page where none of someone else's is.
fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let shown = one_line(&path.display().to_string());
    if path.exists() {
        let old = std::fs::read(path).unwrap_or_default();
        let head = String::from_utf8_lossy(&old[..old.len().min(HEAD)]);
        if !head.contains(MARK) {
            let message = format!("{shown}: this is no page of fem-run, and is not replaced");
            return Err(Failure::bad_input(message).with_help("name another file with --out"));
        }
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    write_whole(path, folder.unwrap_or(Path::new(".")), text.as_bytes()).map_err(|error| {
        Failure::bad_input(format!("{shown}: {error}"))
            .with_help("name a file in a folder that you may write to with --out")
    })
}
