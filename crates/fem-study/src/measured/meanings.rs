//! What columns of tables are read for.

use super::pair_table::DIAMETERS;
use super::restitution_columns::{CONTACT_TIMES, RESTITUTIONS, SPEEDS, UNCERTAINTIES};

/// Of a cradle's trials.
const ANGLES: [&str; 4] = ["alpha", "beta", "alpha_uncertainty", "beta_uncertainty"];

/// All names that a column can be given, without units; of those that mean the same the first is first.
pub(super) fn meanings() -> Vec<&'static str> {
    let diameters = DIAMETERS.map(|[name, _]| name);
    let all: [&[&str]; 6] =
        [&SPEEDS, &RESTITUTIONS, &UNCERTAINTIES, &CONTACT_TIMES, &diameters, &ANGLES];
    all.concat()
}
