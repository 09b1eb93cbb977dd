//! How quantities are measured: one study a file.

mod balances;
mod condensed_explicit;
mod contact_patch;
mod convergence;
mod critical_step;
mod error_bars;
mod finite_strain;
mod hard;
mod hertz_field;
mod invariance;
mod paper;
mod pressed_sphere;
mod relaxing;
mod sections;
mod soft_contours;
mod soft_random;
mod summary;
mod surface_slip;
mod uniform_stress;
mod vibration;
mod vibration_loss;
mod viscoelastic;

use crate::error::StudyError;
use crate::findings::Findings;
use crate::laboratory::Laboratory;

/// Measures the quantities of a claim.
pub(crate) type Study = fn(&Laboratory) -> Result<Findings, StudyError>;

/// All studies by the names that claims call them.
const STUDIES: &[(&str, Study)] = &[
    ("balances", balances::study),
    ("condensed_explicit", condensed_explicit::study),
    ("contact_patch", contact_patch::study),
    ("convergence", convergence::study),
    ("critical_step", critical_step::study),
    ("error_bars", error_bars::study),
    ("finite_strain", finite_strain::study),
    ("hard", hard::study),
    ("hard_random", hard::random_study),
    ("hertz_field", hertz_field::study),
    ("invariance", invariance::study),
    ("paper_contact_stress", paper::contact_stress::study),
    ("paper_contact_time", paper::contact_time::study),
    ("paper_contours", paper::contours::study),
    ("paper_pairings", paper::pairings::study),
    ("paper_restitution", paper::restitution::study),
    ("paper_solid", paper::solid::study),
    ("paper_velocities", paper::velocities::study),
    ("pressed_sphere", pressed_sphere::study),
    ("soft_contours", soft_contours::study),
    ("soft_random", soft_random::study),
    ("summary", summary::study),
    ("surface_slip", surface_slip::study),
    ("uniform_stress", uniform_stress::study),
    ("vibration", vibration::study),
    ("vibration_loss", vibration_loss::study),
    ("viscoelastic", viscoelastic::study),
];

/// The names that claims can call.
pub fn study_names() -> impl Iterator<Item = &'static str> {
    STUDIES.iter().map(|(name, _)| *name)
}

/// The study of a name.
///
/// # Errors
/// No such study: which there are.
pub(crate) fn find_study(name: &str) -> Result<Study, String> {
    let found = STUDIES.iter().find(|(known, _)| *known == name);
    found.map(|(_, study)| *study).ok_or_else(|| {
        let known = study_names().collect::<Vec<_>>().join(", ");
        format!("there is no study `{name}`; the studies are {known}")
    })
}
