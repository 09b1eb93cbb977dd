//! The files of a run in its result folder.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use fem::Simulation;
use fem::results::{HISTORY_FILE, SUMMARY_FILE, Summary, history_csv, write_snapshots};
use fem_case::Keep;
use fem_collision::Collision;

use crate::failure::Failure;
use crate::stopwatch::Stopwatch;

/// The longest name of a file to come, the writer's temporary ending included.
pub fn longest_name(stem: &str) -> String {
    format!(".{stem}_99999_mid-compression.vtu.XXXXXX.tmp")
}

/// Writes the files of a result that are to be kept, the summary last.
pub fn write_result(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
    stopwatch: &Stopwatch,
    keep: Keep,
) -> Result<Summary, Failure> {
    let fault = |error: &dyn std::error::Error| {
        Failure::failed(format!("the result cannot be written: {error}")).with_help(
            "nothing was kept of this run; is the disk full? An older result is where it was",
        )
    };
    let mut files = vec![SUMMARY_FILE.to_string()];
    let mut left_out = Vec::new();
    if keep == Keep::All {
        let file = File::create(folder.join(HISTORY_FILE)).map_err(|error| fault(&error))?;
        history_csv(BufWriter::new(file), simulation.case().scene(), &collision.history)
            .map_err(|error| fault(&error))?;
        files.push(HISTORY_FILE.to_string());
        let (vtk_files, missing) =
            write_snapshots(folder, stem, simulation, collision).map_err(|error| fault(&error))?;
        files.extend(vtk_files);
        left_out = missing;
    }
    let mut warnings = simulation.warnings(collision);
    warnings.extend(left_out);
    let summary = Summary::of(simulation, collision, stopwatch.spent(), warnings, files);
    let mut text = serde_json::to_string_pretty(&summary).map_err(|error| fault(&error))?;
    text.push('\n');
    std::fs::write(folder.join(SUMMARY_FILE), text).map_err(|error| fault(&error))?;
    Ok(summary)
}
