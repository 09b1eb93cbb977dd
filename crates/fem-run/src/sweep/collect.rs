//! From the members' folders to table and picture.

use fem_case::Sweep;
use serde_json::Value;

use super::folder::{PICTURE_FILE, SweepFolder, TABLE_FILE};
use super::member::Member;
use super::picture::picture;
use super::picture_data::Choice;
use super::table_file::table;
use crate::failure::Failure;

/// A member that has been computed.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its place in the sweep.
    pub index: usize,
    /// Its name in `members/`.
    pub identity: String,
    /// Its summary.
    pub summary: Value,
}

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
    let mut rows = read(members, folder);
    loop {
        let text = table(sweep, &rows).map_err(|error| fault(TABLE_FILE, &error))?;
        folder.write(TABLE_FILE, &text).map_err(|error| fault(TABLE_FILE, &error))?;
        match picture(sweep, members, &rows, choice) {
            Some(svg) => folder
                .write(PICTURE_FILE, svg.as_bytes())
                .map_err(|error| fault(PICTURE_FILE, &error))?,
            None => folder.remove(PICTURE_FILE),
        }
        let found = read(members, folder);
        if found.len() <= rows.len() {
            return Ok(rows);
        }
        rows = found;
    }
}

fn read(members: &[Member], folder: &SweepFolder) -> Vec<Row> {
    let row = |member: &Member| {
        let summary = folder.summary(&member.identity)?;
        Some(Row { index: member.index, identity: member.identity.clone(), summary })
    };
    members.iter().filter_map(row).collect()
}
