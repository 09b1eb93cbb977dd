//! How springs keep the surfaces of explicit elements apart: what a case says, and what else decides.

use fem_case::{ContactMethod, Scene, Switch};

use crate::effects::SurfaceSlip;

/// Returns the contact method of the case. The default is a massless boundary, which gains no energy at any
/// penalty stiffness and does not ring (docs/contact.md).
pub(crate) fn asked_for(scene: &Scene) -> ContactMethod {
    scene.contact_method().unwrap_or(ContactMethod::Massless)
}

/// Returns the contact method at small strain.
pub fn contact_method(scene: &Scene) -> ContactMethod {
    match asked_for(scene) {
        ContactMethod::Massless if !massless_is_possible(scene) => ContactMethod::Penalty,
        ContactMethod::NodeToSurface if SurfaceSlip::is_on(scene) => ContactMethod::Penalty,
        method => method,
    }
}

/// Whether the surface nodes of a scene can be without mass, at small strain.
pub(crate) fn massless_is_possible(scene: &Scene) -> bool {
    scene.effects().bulk_viscosity != Some(Switch::On)
}

/// Returns a warning if the case names a method that the scene does not allow, at large or small strain.
pub fn unread(scene: &Scene, is_at_finite_strain: bool) -> Option<String> {
    if is_at_finite_strain {
        let word = scene.contact_method()?.word();
        return Some(format!(
            "contact.method = \"{word}\" has no effect at finite strain: springs between the surfaces where they have \
             moved to are taken"
        ));
    }
    let named = scene.contact_method().filter(|named| *named != contact_method(scene))?;
    let why = match named {
        ContactMethod::NodeToSurface => "where surfaces slip, with which its springs do not turn",
        _ => "beside bulk viscosity, which pulls at nodes by their velocities",
    };
    let word = named.word();
    Some(format!("contact.method = \"{word}\" has no effect {why}: \"penalty\" is taken"))
}
