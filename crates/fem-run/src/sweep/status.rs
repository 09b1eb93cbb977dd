//! `fem-run sweep --status FOLDER`: the progress of a sweep, read from its folder alone.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use comfy_table::CellAlignment::{Left, Right};
use fem::results::PROGRAM;
use serde::Deserialize;
use serde::Deserializer;
use serde::de::{Error, IgnoredAny};

use super::folder::{MANIFEST_FILE, SweepFolder};
use super::member_store::ShardFilter;
use crate::forecast::estimated_time;
use crate::text::{Failure, one_line, shown, table};

/// The keys of `sweep.json` that are read.
#[derive(Deserialize)]
struct Manifest {
    program: String,
    case: String,
    members: Vec<ManifestMember>,
}

#[derive(Deserialize)]
struct ManifestMember {
    #[serde(deserialize_with = "digest")]
    member: u64,
    #[serde(rename = "values")]
    _values: IgnoredAny,
}

/// Reads an identity as a number, which takes less memory than text.
fn digest<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
    u64::from_str_radix(&String::deserialize(from)?, 16).map_err(D::Error::custom)
}

/// Returns the progress of the sweep in a folder.
pub fn status(folder: &Path) -> Result<String, Failure> {
    let place = folder.join(MANIFEST_FILE);
    let name = shown(folder);
    let refuse = |found: String| {
        let help = "name the folder of a sweep, such as fem-run sweep --status runs/sweep_speed";
        Failure::bad_input(format!("{name}: {found}")).with_help(help)
    };
    let file = File::open(&place).map_err(|error| refuse(format!("{MANIFEST_FILE}: {error}")))?;
    let mark = serde_json::from_reader::<_, Manifest>(BufReader::new(file));
    let mark = mark.ok().filter(|mark| mark.program == PROGRAM);
    let mark = mark.ok_or_else(|| refuse(format!("{MANIFEST_FILE} is not that of a sweep")))?;

    let there = SweepFolder::at(folder, ShardFilter::All);
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
        ["failed", &n_failed.to_string()].map(String::from),
        ["left", &n_left.to_string()].map(String::from),
        ["time spent", &format!("{} on one core", estimated_time(spent))].map(String::from),
    ];
    if n_left > 0 && n_done > 0 {
        let left = spent / n_done as f64 * n_left as f64;
        let left = format!("{} on one core, if the others take as long", estimated_time(left));
        rows.push(["time left", &left].map(String::from));
    }
    let case = one_line(&mark.case);
    Ok(format!("{name}: a sweep of {case}\n\n{}", table(&[Left, Right], rows)))
}
