//! How springs keep the surfaces of explicit elements apart: what a case says, and what else decides.

use fem_case::{ContactMethod, Scene, Switch};

/// As the case names it, or a boundary without mass: it gains no energy whatever the stiffness, and does not
/// ring (docs/contact.md).
pub(crate) fn asked_for(scene: &Scene) -> ContactMethod {
    scene.contact_method().unwrap_or(ContactMethod::Massless)
}

/// As it is computed. A boundary without mass is in balance with forces of displacements; bulk viscosity
/// pulls by velocities.
pub(crate) fn contact_method(scene: &Scene) -> ContactMethod {
    match asked_for(scene) {
        ContactMethod::Massless if scene.effects().bulk_viscosity == Some(Switch::On) => {
            ContactMethod::Penalty
        }
        method => method,
    }
}
