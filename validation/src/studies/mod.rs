//! The studies that measure the quantities of claims, by the names that claims call them.

mod condensed_explicit;
mod convergence;
mod finite_strain;
mod flow;
mod hard;
mod hertz_field;
mod mechanics;
mod order;
mod pair_law;
mod paper;
mod pressed_sphere;
mod random_scenes;
mod relaxing;
mod sections;
mod summary;
mod surface_slip;
mod surface_stress;
mod vibration;
mod vibration_loss;
mod viscoelastic;

use crate::{Findings, Laboratory, StudyError};

pub(crate) type Study = fn(&Laboratory) -> Result<Findings, StudyError>;

const STUDIES: &[(&str, Study)] = &[
    ("balances", mechanics::balances::study),
    ("condensed_explicit", condensed_explicit::study),
    ("contact_patch", mechanics::contact_patch::study),
    ("convergence", convergence::study),
    ("critical_step", mechanics::critical_step::study),
    ("error_bars", random_scenes::error_bars_study),
    ("finite_strain", finite_strain::laws::study),
    ("flow", flow::study),
    ("hard", hard::study),
    ("hard_random", random_scenes::model_differences_study),
    ("hertz_field", hertz_field::study),
    ("invariance", mechanics::invariance::study),
    ("pair_law", pair_law::study),
    ("paper_contact_stress", paper::contact_stress::study),
    ("paper_contact_time", paper::contact_time::study),
    ("paper_contours", paper::contours::study),
    ("paper_pairings", paper::pairings::study),
    ("paper_restitution", paper::restitution::study),
    ("paper_solid", paper::solid::study),
    ("paper_velocities", paper::velocities::study),
    ("pressed_sphere", pressed_sphere::study),
    ("soft_contours", finite_strain::contours::study),
    ("soft_random", random_scenes::soft_scenes_study),
    ("summary", summary::study),
    ("surface_slip", surface_slip::study),
    ("surface_stress", surface_stress::study),
    ("uniform_stress", mechanics::uniform_stress::study),
    ("vibration", vibration::study),
    ("vibration_loss", vibration_loss::study),
    ("viscoelastic", viscoelastic::study),
];

/// Returns the names of all studies.
pub fn study_names() -> impl Iterator<Item = &'static str> {
    STUDIES.iter().map(|(name, _)| *name)
}

pub(crate) fn find_study(name: &str) -> Result<Study, String> {
    let found = STUDIES.iter().find(|(known, _)| *known == name);
    found.map(|(_, study)| *study).ok_or_else(|| {
        let known = study_names().collect::<Vec<_>>().join(", ");
        format!("there is no study `{name}`; the studies are {known}")
    })
}
