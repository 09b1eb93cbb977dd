//! Warnings about a bouncing ball.

use fem_collision::{Bounce, Ending, StaticContact};

use crate::effects::percent;
use crate::estimate::LARGE_STRAIN;
use crate::rejection::Rejection;

/// Restitution above which a ball does not come to rest.
const RESTITUTION_WITHOUT_REST: f64 = 1.0 - 1e-4;

/// Returns the warnings for these contacts, this ending, and the largest bound on the influence of
/// vibrations with the number of its contact.
pub(super) fn of(bounces: &[Bounce], ending: &Ending, phase: Option<(usize, f64)>) -> Vec<String> {
    let n = bounces.len();
    let mut said = Vec::new();
    if *ending == Ending::AtRest {
        said.push(format!(
            "the ball comes to rest: after {n} contact{} it does not leave again",
            if n == 1 { "" } else { "s" }
        ));
    }
    let least = bounces.iter().map(|bounce| bounce.restitution).fold(f64::INFINITY, f64::min);
    if *ending == Ending::Parted && n > 1 && least > RESTITUTION_WITHOUT_REST {
        said.push(format!(
            "the ball never rests by the losses of the run, which are almost none (no restitution is below {least:.6}); the run \
             ends after the {n} contacts of stop.bounces"
        ));
    }
    if let Some((contact, bound)) = phase {
        said.push(format!(
            "vibrations that a contact has left may change the restitution of contact {contact} by up \
             to {bound:.1e}: each contact is computed as if the bodies had come to rest before"
        ));
    }
    said
}

/// Warns of a static contact that is not small compared with the effective radius (m).
pub(super) fn too_large(contact: &StaticContact, effective_radius: f64) -> Option<String> {
    let share = contact.contact_radius? / effective_radius;
    (share > LARGE_STRAIN).then(|| {
        format!(
            "at rest the contact radius is {} of the effective radius; above {} the small-strain \
             model is not accurate",
            percent(share),
            percent(LARGE_STRAIN)
        )
    })
}

/// Warns of bodies without equilibrium modulus, after a number of contacts.
pub(super) fn sinks(n_contacts: usize) -> String {
    format!(
        "the ball sinks: after {n_contacts} contact{} it does not leave again, and a body without equilibrium \
         modulus flows under the weight without limit",
        if n_contacts == 1 { "" } else { "s" }
    )
}

/// Warns of a static contact that could not be computed.
pub(super) fn unknown(rejection: &Rejection) -> String {
    format!("the contact of the ball at rest could not be computed: {rejection}")
}
