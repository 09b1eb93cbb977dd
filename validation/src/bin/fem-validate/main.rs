//! The program `fem-validate [NAME…]`: evaluates the claims of a folder and reports which hold.

#![allow(clippy::disallowed_methods, reason = "a program has the clock")]

mod files;

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use comfy_table::CellAlignment::Left;
use fem_case::engineering::show;
use fem_command::{
    Failure, Interrupt, ItemProgress, Origin, OwnedFileKind, ResultFolder, headed, one_line,
    parse_count, print, run_job, shown, table, thread_pool,
};
use fem_validate::{
    Claim, ClaimError, ClaimResult, Observer, ResultCache, Section, evaluate, hard_scenes,
    has_hard_scenes, load_claims, markdown, pictures,
};
use rayon::prelude::*;

use files::{MADE_FROM, PAGE_FILE, write_files};

/// Identifies the Markdown tables of this command.
const TABLE: OwnedFileKind = OwnedFileKind {
    what: "table",
    extension: "md",
    marker: "<!-- Written by `fem-validate",
    option: "--table or --scenes",
};

/// Check the program against theory, other programs and measurements
///
/// Evaluates the claims of a folder, all or those named, prints a table and writes a self-contained page
/// with pictures. Exit status 1 if a claim fails.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    /// Claims to evaluate, by the names of their folders [default: all]
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Folder of the claims
    #[arg(long, value_name = "DIR", default_value = "validation")]
    claims: PathBuf,
    /// Folder for the page, the table and the pictures
    #[arg(long, value_name = "DIR", default_value = "runs/validation")]
    out: PathBuf,
    /// Replace the result of a case or of another command
    #[arg(long)]
    force: bool,
    /// Also write the table as Markdown, and the pictures into images next to it; for all claims only
    ///
    /// An existing file is replaced only if it is such a table.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Also write the hard scenes as Markdown; with the claim that has them
    ///
    /// An existing file is replaced only if it is such a table.
    #[arg(long, value_name = "FILE")]
    scenes: Option<PathBuf>,
    /// Number of threads [default: one per processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = parse_count)]
    threads: Option<NonZeroUsize>,
    /// List the claims and evaluate none
    #[arg(long)]
    list: bool,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

fn main() -> ExitCode {
    run_job(|| execute(&Arguments::parse())).into()
}

/// The progress of claims, which are timed by its clock.
struct Progress {
    items: ItemProgress,
    started: Instant,
}

impl Observer for Progress {
    fn clock(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    fn is_interrupted(&self) -> bool {
        self.items.is_stopped()
    }
}

fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let claims = load_claims(&arguments.claims, &arguments.names).map_err(refused)?;
    if claims.is_empty() {
        let place = shown(&arguments.claims);
        let message = format!("{place}: none of its folders has a claim.toml");
        return Err(Failure::bad_input(message).with_help(
            "run it in the source folder of fem-run, or name the folder of the claims with --claims",
        ));
    }
    if arguments.list {
        return print(&listing(&claims));
    }
    if arguments.table.is_some() && !arguments.names.is_empty() {
        return Err(Failure::bad_input("--table is for all claims: leave the names out"));
    }
    if arguments.scenes.is_some() && !claims.iter().any(has_hard_scenes) {
        return Err(Failure::bad_input("--scenes: none of the named claims has hard scenes")
            .with_help("name the claim: fem-validate hard --scenes FILE"));
    }
    for path in arguments.table.iter().chain(&arguments.scenes) {
        TABLE.check(path)?;
    }
    let origin = Origin::of_digest("validate", MADE_FROM.to_string());
    let longest_name = ".summary.json.XXXXXX.tmp";
    let folder = ResultFolder::claim(&arguments.out, longest_name, origin, arguments.force)?;
    let interrupt = Interrupt::listen();
    let results = run(&claims, arguments, &interrupt)?;
    let is_complete = results.len() == claims.len();
    write_files(folder.path(), &results, claims.len())?;
    let place = folder.publish(true)?;
    if let Some(path) = arguments.table.as_ref().filter(|_| is_complete) {
        write_table(path, &results)?;
    }
    if let Some(path) = arguments.scenes.as_ref().filter(|_| is_complete) {
        write_text(path, &hard_scenes(&results))?;
    }
    if !arguments.quiet {
        print(&report(&results, &place))?;
    }
    conclude(&results, claims.len())
}

fn refused(error: ClaimError) -> Failure {
    match error {
        ClaimError::Case(error) => error.into(),
        ClaimError::Unreadable { .. } => Failure::bad_input(error.to_string()).with_help(
            "the claims are the folders of `validation` in the source of fem-run; run it there, or \
             name another folder with --claims",
        ),
        error => Failure::bad_input(one_line(&error.to_string())),
    }
}

/// Returns the results of the claims that were not interrupted.
fn run(
    claims: &[Claim],
    arguments: &Arguments,
    interrupt: &Interrupt,
) -> Result<Vec<ClaimResult>, Failure> {
    let pool = thread_pool(arguments.threads)?;
    let items = ItemProgress::new(interrupt.clone(), "claims", claims.len(), arguments.quiet);
    let progress = Progress { items, started: Instant::now() };
    let cache = ResultCache::default();
    let results = pool.install(|| {
        let evaluated = claims.par_iter().map(|claim| {
            let result = evaluate(claim, &cache, &progress);
            if !progress.is_interrupted() {
                let verdict = if result.passed() { "pass" } else { "FAIL" };
                let seconds = show(result.cost.seconds, "s");
                progress.items.finish_item(&format!("{verdict}  {}  {seconds}", result.claim.name));
            }
            result
        });
        evaluated.collect::<Vec<_>>()
    });
    progress.items.finish();
    let is_whole =
        |result: &ClaimResult| !matches!(result.error, Some(fem_validate::StudyError::Interrupted));
    Ok(results.into_iter().filter(is_whole).collect())
}

fn write_table(path: &Path, results: &[ClaimResult]) -> Result<(), Failure> {
    write_text(path, &markdown(results))?;
    for (name, figure) in pictures(results) {
        write_text(&path.with_file_name(name), &figure.svg)?;
    }
    Ok(())
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    let made = path.parent().map_or(Ok(()), fs::create_dir_all);
    made.and_then(|()| fs::write(path, text))
        .map_err(|error| Failure::failed(format!("{}: {error}", path.display())))
}

fn listing(claims: &[Claim]) -> String {
    let rows = claims.iter().map(|claim| {
        [claim.name.clone(), claim.section.heading().to_string(), claim.title.clone()]
    });
    table(&[Left, Left, Left], rows)
}

/// Returns all checks by section, and where the page is.
fn report(results: &[ClaimResult], place: &Path) -> String {
    let mut text = String::new();
    for section in Section::ALL {
        let claims: Vec<_> =
            results.iter().filter(|result| result.claim.section == section).collect();
        if claims.is_empty() {
            continue;
        }
        let header = "claim|quantity|>reference|>ours|>difference|>tolerance|verdict";
        text += &format!("{}\n\n", section.heading());
        text += &headed(header, claims.into_iter().flat_map(rows));
        text += "\n";
    }
    let n_checks: usize = results.iter().map(|result| result.checks.len()).sum();
    let n_failed = results.iter().flat_map(|result| &result.checks).filter(|c| !c.passed).count();
    let plural = if results.len() == 1 { "" } else { "s" };
    text += &format!("{} claim{plural}, {n_checks} checks, {n_failed} failed\n", results.len());
    text + &format!("Page: {}\n", shown(&place.join(PAGE_FILE)))
}

fn rows(result: &ClaimResult) -> Vec<[String; 7]> {
    let name = result.claim.name.clone();
    if let Some(error) = &result.error {
        let mut row = [const { String::new() }; 7];
        (row[0], row[1], row[6]) = (name, one_line(&error.to_string()), "FAIL".into());
        return vec![row];
    }
    let row = |(k, check): (usize, &fem_validate::CheckResult)| {
        [
            if k == 0 { name.clone() } else { String::new() },
            check.check.label.clone(),
            check.check.reference_text(),
            check.measured_text(),
            check.difference_text(),
            check.check.tolerance_text(),
            check.verdict().to_string(),
        ]
    };
    result.checks.iter().enumerate().map(row).collect()
}

/// Returns success, or which claims failed, or that the evaluation was interrupted.
fn conclude(results: &[ClaimResult], n_claims: usize) -> Result<(), Failure> {
    let failed: Vec<&str> = results
        .iter()
        .filter(|result| !result.passed())
        .map(|result| result.claim.name.as_str())
        .collect();
    if results.len() < n_claims {
        let message = format!("interrupted: {} of {n_claims} claims are done", results.len());
        return Err(Failure::interrupted(message).with_help("the page shows them"));
    }
    if failed.is_empty() {
        return Ok(());
    }
    let message = format!("{} of {n_claims} claims fail: {}", failed.len(), failed.join(", "));
    Err(Failure::failed(message).with_help(
        "likely cause: a formula or a default has changed; the page shows the differences. Run one claim \
         with `fem-validate NAME`",
    ))
}
