//! Cost estimate of a member before it runs: an order of magnitude, by which members are distributed.

use fem_case::CaseFile;

/// Seconds per element update on one core of 3 GHz, with one or two Prony terms.
const SECONDS_AN_UPDATE: f64 = 8e-9;
/// Seconds per member with condensed bodies, which share their factors with others.
const SECONDS_OF_CONDENSED: f64 = 0.1;
/// Seconds per member without a mesh.
const SECONDS_WITHOUT_MESH: f64 = 2e-3;

/// Returns the estimated seconds of a member on one core of 3 GHz, for a resolved case and its number of
/// element updates.
pub(super) fn seconds(case: &CaseFile, updates: u64) -> f64 {
    let is_condensed = case.model.as_ref().is_some_and(|model| model.condensed.is_some());
    let least = if is_condensed { SECONDS_OF_CONDENSED } else { SECONDS_WITHOUT_MESH };
    least + SECONDS_AN_UPDATE * updates as f64
}
