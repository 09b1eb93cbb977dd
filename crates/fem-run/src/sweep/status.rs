//! `fem-run sweep --status FOLDER`: how far a sweep is, told by its folder alone.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use comfy_table::CellAlignment::{Left, Right};
use fem::results::PROGRAM;
use serde::Deserialize;
use serde::Deserializer;
use serde::de::{Error, IgnoredAny};

use super::duration::duration;
use super::folder::{MARK_FILE, SweepFolder};
use super::packs::Whose;
use crate::failure::Failure;
use crate::standard_output::one_line;
use crate::tables::table;

/// What is read of `sweep.json`.
#[derive(Deserialize)]
struct Mark {
    program: String,
    case: String,
    members: Vec<MarkedMember>,
}

#[derive(Deserialize)]
struct MarkedMember {
    #[serde(deserialize_with = "digest")]
    member: u64,
    #[serde(rename = "values")]
    _values: IgnoredAny,
}

/// An identity as a number: of a million members less than their names.
fn digest<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
    u64::from_str_radix(&String::deserialize(from)?, 16).map_err(D::Error::custom)
}

/// How far the sweep in a folder is.
///
/// # Errors
/// A folder that holds no sweep.
pub fn status(folder: &Path) -> Result<String, Failure> {
    let place = folder.join(MARK_FILE);
    let name = one_line(&folder.display().to_string());
    let refuse = |found: String| {
        let help = "name the folder of a sweep, such as fem-run sweep --status runs/sweep_speed";
        Failure::bad_input(format!("{name}: {found}")).with_help(help)
    };
    let file = File::open(&place).map_err(|error| refuse(format!("{MARK_FILE}: {error}")))?;
    let mark = serde_json::from_reader::<_, Mark>(BufReader::new(file));
    let mark = mark.ok().filter(|mark| mark.program == PROGRAM);
    let mark = mark.ok_or_else(|| refuse(format!("{MARK_FILE} is not a sweep's")))?;

    let there = SweepFolder::at(folder, Whose::All);
    let (mut n_done, mut n_failed, mut spent) = (0_usize, 0_usize, 0.0);
    let identities = mark.members.iter().map(|member| format!("{:016x}", member.member));
    for summary in there.summaries(identities).flatten() {
        n_done += 1;
        n_failed += usize::from(summary["complete"] == false);
        spent += summary["cost"]["wall_s"].as_f64().unwrap_or(0.0);
    }
    let n_left = mark.members.len() - n_done;
    let mut rows = vec![
        ["members", &mark.members.len().to_string()].map(String::from),
        ["done", &n_done.to_string()].map(String::from),
        ["of those failed", &n_failed.to_string()].map(String::from),
        ["left", &n_left.to_string()].map(String::from),
        ["spent", &format!("{} of one core", duration(spent))].map(String::from),
    ];
    if n_left > 0 && n_done > 0 {
        let left = spent / n_done as f64 * n_left as f64;
        let left = format!("{} of one core, if the others take as long", duration(left));
        rows.push(["left to spend", &left].map(String::from));
    }
    let case = one_line(&mark.case);
    Ok(format!("{name}: a sweep of {case}\n\n{}", table(&[Left, Right], rows)))
}
