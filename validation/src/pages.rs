//! Pages of results: a self-contained HTML file, and tables in Markdown.

use std::fmt::Write;

use askama::Template;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::{Claim, ClaimResult, Figure, Section};

/// The study whose tables the page shows.
const HARD: &str = "hard";

/// Returns the figures of all claims with their addresses relative to the Markdown page.
pub fn pictures(results: &[ClaimResult]) -> impl Iterator<Item = (String, &Figure)> {
    results.iter().flat_map(pictures_of)
}

fn pictures_of(result: &ClaimResult) -> impl Iterator<Item = (String, &Figure)> {
    let name = move |figure: &Figure| format!("images/{}_{}.svg", result.claim.name, figure.name);
    result.findings.figures.iter().map(move |figure| (name(figure), figure))
}

/// Returns a Markdown page with one table per section, one row per check, and the figures. It has no times and
/// names no machine, so it changes only with the results.
pub fn markdown(results: &[ClaimResult]) -> String {
    let mut text = String::from(
        "<!-- Written by `fem-validate --table validation/claims.md`; not by hand. -->\n\
         # Claims and their results\n\n\
         Each claim is a folder in this directory with cases, references with their \
         sources, and tolerances with their reasons. `fem-validate` runs all claims and writes a \
         page with the figures; the same command writes this table.\n\n\
         The *kind* of a reference shows how independent it is: **analytic**, a closed form or a \
         limit; **published**, a published number; **cross-code**, a result of another program; \
         **regression**, an earlier result of this program.\n",
    );
    for section in Section::ALL {
        let mut claims = results.iter().filter(|result| result.claim.section == section).peekable();
        if claims.peek().is_none() {
            continue;
        }
        let _ = write!(
            text,
            "\n## {}\n\n| claim | quantity | kind | reference | ours | difference | tolerance \
             | verdict |\n|---|---|---|---|---|---|---|---|\n",
            section.heading()
        );
        for result in claims {
            rows(&mut text, result);
        }
    }
    for (heading, is_paper) in [("The paper's figures", true), ("Other figures", false)] {
        let of = |result: &&ClaimResult| (result.claim.section == Section::Paper) == is_paper;
        let mut figures = results.iter().filter(of).flat_map(pictures_of).peekable();
        if figures.peek().is_some() {
            let _ = write!(text, "\n## {heading}\n");
        }
        for (address, figure) in figures {
            let caption = cell(&figure.caption);
            let name = figure.name.replace('_', " ");
            let _ = write!(text, "\n![{name}]({address})\n\n{caption}\n");
        }
    }
    text
}

/// Whether the page on hard scenes shows a claim.
pub fn has_hard_scenes(claim: &Claim) -> bool {
    claim.study == HARD
}

/// Returns a Markdown page of every hard scene with every model, one table per axis.
pub fn hard_scenes(results: &[ClaimResult]) -> String {
    let hard = results.iter().filter(|result| has_hard_scenes(&result.claim));
    let tables = hard.flat_map(|result| &result.findings.tables);
    let mut text = String::from(
        "<!-- Written by `fem-validate hard --scenes validation/hard/scenes.md`; not by hand. -->\n\
         # Hard scenes\n\n\
         Each axis goes from one extreme to the other, with every model: the result, or the reason why there is \
         none. [claim.toml](claim.toml) and the files beside it list the scenes, their references and the expected \
         warnings.\n\n\
         *Δe*, *ΔT/T*, *ΔF/F* and *Δp/p* (peak pressure) are differences from the reference of a run, if it has one. *Growth* is the \
         largest growth of the bodies' energy above the initial energy and the work done on them, over the initial energy; \
         *momentum* is the largest drift over Σ m|v|; *cost* is the number of element updates over the estimated one. For a \
         bouncing ball e is the product of all bounces. *Warns* are the warnings of a run, and *refused* is the message of a \
         rejected or stopped one; both are shortened here.\n",
    );
    for table in tables {
        let rule = vec!["---"; table.header.len()].join("|");
        let header = table.header.join(" | ");
        let _ = write!(text, "\n{}\n\n| {header} |\n|{rule}|\n", cell(&table.caption));
        for row in &table.rows {
            let cells: Vec<String> = row.iter().map(|text| cell(text)).collect();
            let _ = writeln!(text, "| {} |", cells.join(" | "));
        }
    }
    text
}

fn rows(text: &mut String, result: &ClaimResult) {
    let name = &result.claim.name;
    let link = format!("[{name}]({name}/claim.toml)");
    if let Some(error) = &result.error {
        let error = error.to_string().replace('\n', " ");
        let _ = writeln!(text, "| {link} | {} | | | | | | FAIL |", cell(&error));
    }
    for (k, check) in result.checks.iter().enumerate() {
        let cells = [
            if k == 0 { link.clone() } else { String::new() },
            cell(&check.check.label),
            check.check.kind.to_string(),
            check.check.reference_text(),
            check.measured_text(),
            check.difference_text(),
            check.check.tolerance_text(),
            check.verdict().to_string(),
        ];
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
}

fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

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
