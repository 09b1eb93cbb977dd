//! How springs keep the surfaces of explicit elements apart: what a case says, and what else decides.

use fem_case::{ContactMethod, ModelChoice, Scene, Switch};

use crate::effects::{FiniteStrain, SurfaceSlip};
use crate::estimate::Estimate;

/// As the case names it, or a boundary without mass: it gains no energy whatever the stiffness, and does not
/// ring (docs/contact.md).
pub(crate) fn asked_for(scene: &Scene) -> ContactMethod {
    scene.contact_method().unwrap_or(ContactMethod::Massless)
}

/// As it is computed. At finite strain surfaces that move have springs of their own, at points as those of the
/// penalty; a boundary without mass is in balance with forces of displacements, and bulk viscosity pulls by
/// velocities; springs at nodes do not turn with surfaces that slip.
pub(crate) fn contact_method(scene: &Scene, estimate: &Estimate) -> ContactMethod {
    match asked_for(scene) {
        _ if is_moved(scene, estimate) => ContactMethod::Penalty,
        ContactMethod::Massless if !massless_is_possible(scene) => ContactMethod::Penalty,
        ContactMethod::NodeToSurface if SurfaceSlip::is_on(scene) => ContactMethod::Penalty,
        method => method,
    }
}

/// Whether contact is between surfaces that have moved: explicit elements at finite strain.
fn is_moved(scene: &Scene, estimate: &Estimate) -> bool {
    let is_explicit = *scene.model() == ModelChoice::Fem;
    is_explicit && FiniteStrain::laws(scene, estimate) != [None; 2]
}

/// Whether the surface nodes of a scene can be without mass, at small strain.
pub(crate) fn massless_is_possible(scene: &Scene) -> bool {
    scene.effects().bulk_viscosity != Some(Switch::On)
}

/// What is said of a method that a case names and its scene does not allow.
pub(crate) fn unread(scene: &Scene, estimate: &Estimate) -> Option<String> {
    let computed = contact_method(scene, estimate);
    let named = scene.contact_method().filter(|named| *named != computed)?;
    let why = match named {
        _ if is_moved(scene, estimate) => {
            "at finite strain, where surfaces that move have springs of their own"
        }
        ContactMethod::NodeToSurface => "where surfaces slip, with which its springs do not turn",
        _ => "beside bulk viscosity, which pulls at nodes by their velocities",
    };
    let word = named.word();
    Some(format!("contact.method = \"{word}\" has no effect {why}: \"penalty\" is taken"))
}
