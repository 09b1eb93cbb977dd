//! The files of a run in its result folder.
//!
//! On a full disk the snapshots are given up first, then the history, then the summary. Space for the summary
//! is reserved before everything else, since it is written last, when all files are known.

use std::fs;
use std::io;
use std::path::Path;

use fem::results::{
    CONTACT_FILE, DENT_FILE, HISTORY_FILE, HistoryColumns, PROBES_FILE, SUMMARY_FILE, Summary,
    contact_csv, dent_csv, has_contact, history_columns, history_csv, probes_csv, write_snapshots,
};
use fem::{ComputedCollision, Simulation};
use fem_case::Keep;
use fem_case::engineering::Unit;
use fem_collision::{Collision, SnapshotInstant};
use fem_report::report::{REPORT_FILE, StoredResult, report_page};
use fem_report::section_view::{DrawnField, contour_of_frames, half_width, mirrored, sections};

use super::whole_file::{cause, write_streamed, write_whole};
use super::{Origin, ResultFolder};
use crate::{progress::stopwatch::Stopwatch, text::Failure};

const RESERVE_FILE: &str = ".fem-run-room";
/// Bytes by which a summary may grow once all files are known.
const RESERVE: usize = 16 << 10;

/// Returns the longest name of a file to come, including the temporary suffix.
pub fn longest_name(stem: &str) -> String {
    format!(".{stem}_99999_mid-compression.vtu.XXXXXX.tmp")
}

pub struct WrittenResult {
    /// The summary with the names of the written files; none if nothing could be written.
    pub summary: Summary,
    pub text: String,
    pub fault: Option<Failure>,
}

/// Writes the result folder that `fem-run CASE --out FOLDER` would write, with file names from `stem`.
/// `force` allows it to replace any other result.
pub fn save(
    folder: &Path,
    stem: &str,
    computed: &ComputedCollision,
    stopwatch: &Stopwatch,
    force: bool,
) -> Result<(), Failure> {
    let identity = computed.simulation.identity()?;
    let origin = Origin::of_digest("run", identity.case);
    let place = ResultFolder::claim(folder, &longest_name(stem), origin, force)?;
    let written = write_result(&place, stem, computed, stopwatch, Keep::All, &[]);
    if !written.summary.files.is_empty() {
        place.publish(written.fault.is_none())?;
    }
    written.fault.map_or(Ok(()), Err)
}

/// Writes the files of a result that `keep` asks for, in addition to the files `others` that exist already.
pub fn write_result(
    place: &ResultFolder,
    stem: &str,
    computed: &ComputedCollision,
    stopwatch: &Stopwatch,
    keep: Keep,
    others: &[&str],
) -> WrittenResult {
    let ComputedCollision { simulation, collision, .. } = computed;
    let folder = place.path();
    let files = [SUMMARY_FILE].iter().chain(others).map(ToString::to_string).collect();
    let mut summary = stopwatch.summary(computed, files);
    summary.source = place.source();
    let mut missing = None;
    let mut history = HistoryColumns::new();
    if keep == Keep::All {
        history = history_columns(simulation.case().scene(), &collision.history);
        let written = reserve_space(folder, &summary)
            .and_then(|()| write_tables(folder, simulation, (collision, &history), &mut summary))
            .and_then(|()| write_fields(folder, stem, simulation, collision, &mut summary));
        missing = written.err();
        let _ = fs::remove_file(folder.join(RESERVE_FILE));
        let spent = stopwatch.spent();
        (summary.cost.wall_s, summary.cost.peak_memory_bytes) =
            (spent.wall_s, spent.peak_memory_bytes);
    }
    summary.warnings.extend(missing.clone());
    let wants_report = simulation.case().scene().wants_report();
    if keep == Keep::All && missing.is_none() && wants_report {
        summary.files.push(REPORT_FILE.to_string());
    }
    let text = match json_text(&summary) {
        Ok(text) => text,
        Err(error) => return nothing_written(summary, String::new(), &error),
    };
    let (text, missing) = match summary.files.iter().any(|file| file == REPORT_FILE) {
        true => with_report(folder, &mut summary, text, history),
        false => (text, missing),
    };
    if let Err(error) = write_whole(&folder.join(SUMMARY_FILE), folder, text.as_bytes()) {
        return nothing_written(summary, text, &error);
    }
    let fault = missing.map(|missing| {
        let kept = summary.files.join(", ");
        Failure::failed(missing).with_help(format!("kept: {kept}"))
    });
    WrittenResult { summary, text, fault }
}

/// Writes the report page of a result whose other files exist and whose summary has this text. If the page
/// cannot be written, the summary says so.
fn with_report(
    folder: &Path,
    summary: &mut Summary,
    text: String,
    history: HistoryColumns,
) -> (String, Option<String>) {
    let write = || -> Result<(), Box<dyn std::error::Error>> {
        let page = report_page(&StoredResult::of(folder, &text, history.into())?)?;
        Ok(write_whole(&folder.join(REPORT_FILE), folder, page.as_bytes())?)
    };
    match write() {
        Ok(()) => (text, None),
        Err(error) => {
            let missing = format!("{REPORT_FILE} cannot be written: {}", cause(&*error));
            summary.files.retain(|file| file != REPORT_FILE);
            summary.warnings.push(missing.clone());
            (json_text(summary).unwrap_or(text), Some(missing))
        }
    }
}

fn nothing_written(
    mut summary: Summary,
    text: String,
    error: &(dyn std::error::Error + 'static),
) -> WrittenResult {
    summary.files.clear();
    let fault = Failure::failed(format!("the result cannot be written: {}", cause(error)))
        .with_help("nothing was kept of this run, and an older result is unchanged");
    WrittenResult { summary, text, fault: Some(fault) }
}

fn json_text(summary: &Summary) -> serde_json::Result<String> {
    let mut text = serde_json::to_string_pretty(summary)?;
    text.push('\n');
    Ok(text)
}

/// Reserves space for the summary; if there is none, no other file is tried.
fn reserve_space(folder: &Path, summary: &Summary) -> Result<(), String> {
    let n_bytes = json_text(summary).map_or(0, |text| text.len()) + RESERVE;
    fs::write(folder.join(RESERVE_FILE), vec![b' '; n_bytes]).map_err(|error| {
        format!("{HISTORY_FILE} and the snapshots cannot be written: {}", cause(&error))
    })
}

/// Writes the history, and the tables of what the run has: probes, dents and the contact at the snapshots.
fn write_tables(
    folder: &Path,
    simulation: &Simulation,
    (collision, history): (&Collision, &HistoryColumns),
    summary: &mut Summary,
) -> Result<(), String> {
    type Write<'a> = &'a dyn Fn(&mut dyn io::Write) -> io::Result<()>;
    let probes = &simulation.request().probes;
    let tables: [(&str, bool, Write<'_>); 4] = [
        (HISTORY_FILE, true, &|file| history_csv(file, history)),
        (PROBES_FILE, !probes.is_empty(), &|file| Ok(probes_csv(file, probes, &collision.probes)?)),
        (DENT_FILE, collision.unloaded.is_some(), &|file| {
            Ok(dent_csv(file, simulation, collision)?)
        }),
        (CONTACT_FILE, has_contact(collision), &|file| {
            Ok(contact_csv(file, simulation, collision)?)
        }),
    ];
    for (name, _, write) in tables.into_iter().filter(|(_, is_there, _)| *is_there) {
        write_streamed(&folder.join(name), folder, write).map_err(|error| {
            format!("{name} and the snapshots cannot be written: {}", cause(&error))
        })?;
        summary.files.push(name.to_string());
    }
    Ok(())
}

/// Writes all snapshots, or none.
fn write_fields(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
    summary: &mut Summary,
) -> Result<(), String> {
    let written = write_snapshots(folder, stem, simulation, collision)
        .map_err(|error| format!("the snapshots cannot be written: {}", cause(&error)))
        .and_then(|files| Ok((files, write_failure_figure(folder, stem, simulation, collision)?)));
    let ((files, left_out), picture) =
        written.inspect_err(|_| remove_snapshots(folder, stem, &summary.files))?;
    summary.files.extend(files.into_iter().chain(picture));
    summary.warnings.extend(left_out);
    Ok(())
}

/// Removes the snapshots that were written before one failed. The files `others` stay.
fn remove_snapshots(folder: &Path, stem: &str, others: &[String]) {
    let (many, one) = (format!("{stem}_"), format!("{stem}."));
    for entry in fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok) {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_snapshot = name.starts_with(&many) || name.starts_with(&one);
        if is_snapshot && !others.iter().any(|other| *other == name) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Writes the picture of the last valid state of a failed run, `<stem>_last-sound.svg`, and returns its name;
/// `None` if there is no such state or no body has elements.
fn write_failure_figure(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
) -> Result<Option<String>, String> {
    let Some(svg) = failure_figure(simulation, collision) else { return Ok(None) };
    let name = format!("{stem}_{}.svg", SnapshotInstant::LastValid.name());
    write_whole(&folder.join(&name), folder, svg.as_bytes())
        .map_err(|error| format!("{name} cannot be written: {}", cause(&error)))?;
    Ok(Some(name))
}

fn failure_figure(simulation: &Simulation, collision: &Collision) -> Option<String> {
    let snapshot = collision.snapshot(SnapshotInstant::LastValid)?;
    let near = half_width(collision.max_contact_radius.unwrap_or(0.0), snapshot.approach)?;
    let both = sections(simulation, snapshot)?;
    let time = Unit::fitting(snapshot.time, "s").with_digits(4);
    let title = format!("last valid state, {}", time.show(snapshot.time));
    let field = DrawnField::AXIAL_STRESS;
    Some(mirrored(contour_of_frames(field, vec![both], vec![title], near, |_, _, _| None)).svg())
}
