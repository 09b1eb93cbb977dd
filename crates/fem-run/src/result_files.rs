//! The files of a run in its result folder.
//!
//! A disk that fills takes the snapshots first, then the history, then the summary: room for that is
//! taken before all else, and it is written last, when all files are known.

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;

use fem::Simulation;
use fem::results::{
    CONTACT_FILE, HISTORY_FILE, PROBES_FILE, SUMMARY_FILE, Summary, contact_csv, has_contact,
    history_csv, probes_csv, write_snapshots,
};
use fem_case::Keep;
use fem_collision::Collision;

use crate::failure::Failure;
use fem_report::report::{REPORT_FILE, StoredResult, report_page};

use crate::failure_figure::write_failure_figure;
use crate::stopwatch::Stopwatch;
use crate::whole_file::write_whole;

/// Keeps room for the summary.
const ROOM_FILE: &str = ".fem-run-room";
/// By how much a summary can grow when all files are known, bytes.
const ROOM: usize = 16 << 10;

/// The longest name of a file to come, the writer's temporary ending included.
pub fn longest_name(stem: &str) -> String {
    format!(".{stem}_99999_mid-compression.vtu.XXXXXX.tmp")
}

/// What was written of a result.
pub struct Written {
    /// With the names of the files that there are; none if nothing could be written.
    pub summary: Summary,
    /// As it is in its file.
    pub text: String,
    /// What could not be written.
    pub fault: Option<Failure>,
}

/// Writes the files of a result that are to be kept, beside `others` that are there.
pub fn write_result(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
    stopwatch: &Stopwatch,
    keep: Keep,
    others: &[&str],
) -> Written {
    let warnings = simulation.warnings(collision);
    let files = [SUMMARY_FILE].iter().chain(others).map(ToString::to_string).collect();
    let mut summary = Summary::of(simulation, collision, stopwatch.spent(), warnings, files);
    let mut missing = None;
    if keep == Keep::All {
        let written = take_room(folder, &summary)
            .and_then(|()| write_tables(folder, simulation, collision, &mut summary))
            .and_then(|()| write_fields(folder, stem, simulation, collision, &mut summary));
        missing = written.err();
        let _ = fs::remove_file(folder.join(ROOM_FILE));
        let spent = stopwatch.spent();
        (summary.cost.wall_s, summary.cost.peak_memory_bytes) = (spent.wall, spent.peak_memory);
    }
    summary.warnings.extend(missing.clone());
    let wants_report = simulation.case().scene().wants_report();
    if keep == Keep::All && missing.is_none() && wants_report {
        summary.files.push(REPORT_FILE.to_string());
    }
    let text = match text_of(&summary) {
        Ok(text) => text,
        Err(error) => return nothing_kept(summary, String::new(), &error),
    };
    let (text, missing) = match summary.files.iter().any(|file| file == REPORT_FILE) {
        true => with_page(folder, &mut summary, text),
        false => (text, missing),
    };
    if let Err(error) = write_whole(&folder.join(SUMMARY_FILE), folder, text.as_bytes()) {
        return nothing_kept(summary, text, &error);
    }
    let fault = missing.map(|missing| {
        let kept = summary.files.join(", ");
        Failure::failed(missing).with_help(format!("kept: {kept}; is the disk full?"))
    });
    Written { summary, text, fault }
}

/// Writes the page of a result whose files are there and whose summary is this text; if that cannot be,
/// the summary has to do without and says so.
fn with_page(folder: &Path, summary: &mut Summary, text: String) -> (String, Option<String>) {
    let write = || -> Result<(), Box<dyn std::error::Error>> {
        let page = report_page(&StoredResult::of(folder, &text)?)?;
        Ok(write_whole(&folder.join(REPORT_FILE), folder, page.as_bytes())?)
    };
    match write() {
        Ok(()) => (text, None),
        Err(error) => {
            let missing = format!("{REPORT_FILE} cannot be written: {error}");
            summary.files.retain(|file| file != REPORT_FILE);
            summary.warnings.push(missing.clone());
            (text_of(summary).unwrap_or(text), Some(missing))
        }
    }
}

fn nothing_kept(mut summary: Summary, text: String, error: &dyn std::error::Error) -> Written {
    summary.files.clear();
    let fault = Failure::failed(format!("the result cannot be written: {error}")).with_help(
        "nothing was kept of this run; is the disk full? An older result is where it was",
    );
    Written { summary, text, fault: Some(fault) }
}

fn text_of(summary: &Summary) -> serde_json::Result<String> {
    let mut text = serde_json::to_string_pretty(summary)?;
    text.push('\n');
    Ok(text)
}

/// No room for more than a summary: then nothing else is tried.
fn take_room(folder: &Path, summary: &Summary) -> Result<(), String> {
    let n_bytes = text_of(summary).map_or(0, |text| text.len()) + ROOM;
    let path = folder.join(ROOM_FILE);
    fs::write(&path, vec![b' '; n_bytes])
        .map_err(|error| format!("{HISTORY_FILE} and the snapshots cannot be written: {error}"))
}

/// Tables: the history, what probes saw of a run that has some, and the contact at the snapshots of models that
/// have them.
fn write_tables(
    folder: &Path,
    simulation: &Simulation,
    collision: &Collision,
    summary: &mut Summary,
) -> Result<(), String> {
    write_table(folder, HISTORY_FILE, summary, |file| {
        Ok(history_csv(file, simulation.case().scene(), &collision.history)?)
    })?;
    let probes = &simulation.want().probes;
    if !probes.is_empty() {
        write_table(folder, PROBES_FILE, summary, |file| {
            Ok(probes_csv(file, probes, &collision.probes)?)
        })?;
    }
    if has_contact(collision) {
        write_table(folder, CONTACT_FILE, summary, |file| {
            Ok(contact_csv(file, simulation, collision)?)
        })?;
    }
    Ok(())
}

/// A table, whole or not at all.
fn write_table(
    folder: &Path,
    name: &str,
    summary: &mut Summary,
    write: impl FnOnce(BufWriter<File>) -> Result<(), Box<dyn std::error::Error>>,
) -> Result<(), String> {
    let path = folder.join(name);
    let file = File::create(&path).map_err(Into::into);
    file.and_then(|file| write(BufWriter::new(file))).map_err(|error| {
        let _ = fs::remove_file(&path);
        format!("{name} and the snapshots cannot be written: {error}")
    })?;
    summary.files.push(name.to_string());
    Ok(())
}

/// The snapshots: all of them, or none.
fn write_fields(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
    summary: &mut Summary,
) -> Result<(), String> {
    let written = write_snapshots(folder, stem, simulation, collision)
        .map_err(|error| format!("the snapshots cannot be written: {error}"))
        .and_then(|files| Ok((files, write_failure_figure(folder, stem, simulation, collision)?)));
    let ((files, left_out), picture) =
        written.inspect_err(|_| remove_snapshots(folder, stem, &summary.files))?;
    summary.files.extend(files.into_iter().chain(picture));
    summary.warnings.extend(left_out);
    Ok(())
}

/// Those that were written before one could not be; `others` stay, whatever the stem.
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
