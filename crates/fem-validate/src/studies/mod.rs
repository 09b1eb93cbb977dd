//! How quantities are measured: one study a file.

mod convergence;
mod summary;
mod viscoelastic;

use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::Laboratory;

/// Measures the quantities of a claim.
pub(crate) type Study = fn(&Laboratory) -> Result<Findings, StudyError>;

/// All studies by the names that claims call them.
const STUDIES: &[(&str, Study)] = &[
    ("convergence", convergence::study),
    ("summary", summary::study),
    ("viscoelastic", viscoelastic::study),
];

/// The names that claims can call.
pub fn study_names() -> impl Iterator<Item = &'static str> {
    STUDIES.iter().map(|(name, _)| *name)
}

pub(crate) fn find_study(name: &str) -> Option<Study> {
    STUDIES.iter().find(|(known, _)| *known == name).map(|(_, study)| *study)
}
