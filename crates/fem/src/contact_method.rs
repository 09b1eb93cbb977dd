//! How springs keep the surfaces of explicit elements apart: what a case says, and what else decides.

use fem_case::{ContactMethod, Scene, Switch};

use crate::effects::SurfaceSlip;

/// As the case names it, or a boundary without mass: it gains no energy whatever the stiffness, and does not
/// ring (docs/contact.md). Surfaces that slip turn as they deform: their springs are no linear function of
/// the motion, and pull at nodes with mass.
pub(crate) fn asked_for(scene: &Scene) -> ContactMethod {
    match scene.contact_method().unwrap_or(ContactMethod::Massless) {
        ContactMethod::Massless if SurfaceSlip::is_on(scene) => ContactMethod::Penalty,
        method => method,
    }
}

/// As it is computed at small strain. A boundary without mass is in balance with forces of displacements;
/// bulk viscosity pulls by velocities.
pub(crate) fn contact_method(scene: &Scene) -> ContactMethod {
    match asked_for(scene) {
        ContactMethod::Massless if !massless_is_possible(scene) => ContactMethod::Penalty,
        method => method,
    }
}

/// Whether the surface nodes of a scene can be without mass, at small strain.
pub(crate) fn massless_is_possible(scene: &Scene) -> bool {
    !SurfaceSlip::is_on(scene) && scene.effects().bulk_viscosity != Some(Switch::On)
}

/// What is said of a method that a case names and its scene does not allow.
pub(crate) fn unread(scene: &Scene) -> Option<String> {
    scene.contact_method().filter(|named| *named != contact_method(scene))?;
    let why = match SurfaceSlip::is_on(scene) {
        true => "where surfaces slip, whose springs turn with them",
        false => "beside bulk viscosity, which pulls at nodes by their velocities",
    };
    Some(format!("contact.method = \"massless\" has no effect {why}: \"penalty\" is taken"))
}
