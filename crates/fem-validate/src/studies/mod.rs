//! How quantities are measured: one study a file.

mod convergence;
mod paper;
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
    ("paper_contact_stress", paper::contact_stress::study),
    ("paper_contact_time", paper::contact_time::study),
    ("paper_contours", paper::contours::study),
    ("paper_pairings", paper::pairings::study),
    ("paper_restitution", paper::restitution::study),
    ("paper_solid", paper::solid::study),
    ("paper_velocities", paper::velocities::study),
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
