//! From the members' folders to table and picture.

use fem::sweep::{Member, Row, SWEEP_FILE, sweep_csv};
use fem_case::Sweep;

use super::folder::{PICTURE_FILE, SweepFolder};
use super::picture::picture;
use super::picture_data::Choice;
use crate::failure::Failure;

/// Keys of a summary that no row needs.
const UNREAD: [&str; 4] = ["case", "effects", "models_considered", "files"];

/// Writes table and picture of what is there and returns the rows.
///
/// Another process may finish a member after this one has looked, and write its table before this
/// one does. Whoever looks again after writing and finds no more than it wrote is the last.
///
/// # Errors
/// The file system.
pub fn collect(
    sweep: &Sweep,
    members: &[Member],
    folder: &SweepFolder,
    choice: &Choice,
) -> Result<Vec<Row>, Failure> {
    let fault = |name: &str, error: &dyn std::fmt::Display| {
        let message = format!("{} cannot be written: {error}", folder.path().join(name).display());
        Failure::failed(message)
            .with_help("the members that were computed are kept; the same command goes on")
    };
    let mut rows = read(sweep, members, folder);
    loop {
        let mut text = Vec::new();
        let keys = sweep.axes.iter().map(|axis| axis.key.as_str());
        sweep_csv(&mut text, keys, &rows).map_err(|error| fault(SWEEP_FILE, &error))?;
        folder.write(SWEEP_FILE, &text).map_err(|error| fault(SWEEP_FILE, &error))?;
        match picture(sweep, &rows, choice) {
            Some(svg) => folder
                .write(PICTURE_FILE, svg.as_bytes())
                .map_err(|error| fault(PICTURE_FILE, &error))?,
            None => folder.remove(PICTURE_FILE),
        }
        let found = read(sweep, members, folder);
        if found.len() <= rows.len() {
            return Ok(rows);
        }
        rows = found;
    }
}

fn read(sweep: &Sweep, members: &[Member], folder: &SweepFolder) -> Vec<Row> {
    let row = |member: &Member| {
        let mut summary = folder.summary(&member.identity)?;
        // What neither table nor picture nor report reads is most of a summary: a sweep may be large.
        if let Some(keys) = summary.as_object_mut() {
            keys.retain(|key, _| !UNREAD.contains(&key.as_str()));
        }
        Some(Row::new(member, sweep.values(member.index), summary))
    };
    members.iter().filter_map(row).collect()
}
