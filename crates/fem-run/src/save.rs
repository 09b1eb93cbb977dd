//! The result folder of a collision that is in memory.

use std::path::Path;

use fem::{Identity, Simulation};
use fem_case::Keep;
use fem_collision::Collision;

use crate::failure::Failure;
use crate::result_files::{longest_name, write_result};
use crate::result_folder::{Replaces, ResultFolder};
use crate::stopwatch::Stopwatch;

/// Writes the folder that `fem-run CASE --out FOLDER` would leave; results are named after `stem`. The result of
/// another case is replaced if `force` says so.
///
/// # Errors
/// A place that cannot be written, or that holds something else.
pub fn save(
    folder: &Path,
    stem: &str,
    simulation: &Simulation,
    collision: &Collision,
    stopwatch: &Stopwatch,
    force: bool,
) -> Result<(), Failure> {
    let identity = Identity::of(simulation.case())?;
    let replaces = Replaces::only(&identity.case, force);
    let place = ResultFolder::claim(folder, &longest_name(stem), replaces)?;
    let written =
        write_result(place.path(), stem, simulation, collision, stopwatch, Keep::All, &[]);
    if !written.summary.files.is_empty() {
        place.publish(written.fault.is_none())?;
    }
    written.fault.map_or(Ok(()), Err)
}
