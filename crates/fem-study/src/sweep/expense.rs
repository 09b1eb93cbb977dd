//! What a member takes, before it runs: an order of magnitude, by which members are shared out.

use fem_case::CaseFile;

/// Seconds of an update of an element on one core of 3 GHz, a Prony term or two with it.
const SECONDS_AN_UPDATE: f64 = 8e-9;
/// Seconds of a member of condensed bodies, which shares its factor with others.
const SECONDS_OF_CONDENSED: f64 = 0.1;
/// Seconds of a member without a mesh.
const SECONDS_WITHOUT_MESH: f64 = 2e-3;

/// Seconds that a member takes on one core of 3 GHz; `updates` of elements are to come, of a case that is
/// resolved.
pub(super) fn seconds(case: &CaseFile, updates: u64) -> f64 {
    let is_condensed = case.model.as_ref().is_some_and(|model| model.condensed.is_some());
    let least = if is_condensed { SECONDS_OF_CONDENSED } else { SECONDS_WITHOUT_MESH };
    least + SECONDS_AN_UPDATE * updates as f64
}
