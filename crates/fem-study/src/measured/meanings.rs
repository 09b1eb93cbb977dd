//! The roles that columns of tables can have.

use super::pair_table::DIAMETERS;
use super::restitution_columns::{CONTACT_TIMES, RESTITUTIONS, SPEEDS, UNCERTAINTIES};

/// Columns of the trials of a cradle.
const ANGLES: [&str; 4] = ["alpha", "beta", "alpha_uncertainty", "beta_uncertainty"];

/// Returns all names that a column may have, without units; among synonyms the preferred name comes first.
pub(super) fn meanings() -> Vec<&'static str> {
    let diameters = DIAMETERS.map(|[name, _]| name);
    let all: [&[&str]; 6] =
        [&SPEEDS, &RESTITUTIONS, &UNCERTAINTIES, &CONTACT_TIMES, &diameters, &ANGLES];
    all.concat()
}
