//! The page of results, a self-contained HTML file.

use askama::Template;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::claim::Section;
use crate::evaluate::ClaimResult;
use crate::findings::Figure;

#[derive(Template)]
#[template(path = "page.html")]
struct Page<'a> {
    version: &'a str,
    n_claims: usize,
    n_all: usize,
    n_checks: usize,
    failed: Vec<&'a ClaimResult>,
    sections: Vec<(&'static str, Vec<&'a ClaimResult>)>,
}

/// Returns the page as HTML; of `n_all` claims only those with a result were tested.
///
/// # Errors
/// The template cannot be rendered; no result causes that.
pub fn page(results: &[ClaimResult], n_all: usize, version: &str) -> Result<String, askama::Error> {
    let of = |section: Section| {
        let claims: Vec<_> = results.iter().filter(|r| r.claim.section == section).collect();
        (section.heading(), claims)
    };
    let page = Page {
        version,
        n_claims: results.len(),
        n_all,
        n_checks: results.iter().map(|result| result.checks.len()).sum(),
        failed: results.iter().filter(|result| !result.passed()).collect(),
        sections: Section::ALL.map(of).into_iter().filter(|(_, c)| !c.is_empty()).collect(),
    };
    page.render()
}

/// Returns a figure as the address of an image, so that its styles and names do not mix with those of the page.
fn data_address(figure: &Figure) -> String {
    format!("data:image/svg+xml;base64,{}", STANDARD.encode(&figure.svg))
}

/// Formats a time, such as `1.2 s` or `3 ms`.
fn seconds(value: &f64) -> String {
    fem_case::engineering::Unit::fitting(*value, "s").with_digits(2).show(*value)
}

/// Formats a count, large ones as `3.4e9`.
fn count(value: &u64) -> String {
    if *value < 10_000 { value.to_string() } else { format!("{:.1e}", *value as f64) }
}
