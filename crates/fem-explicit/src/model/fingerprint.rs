//! The fingerprint of a model, by which a restart state is recognised: a number that differs where the meshes, masses,
//! materials, forces, contact, approach or step of two models do, or the version of this crate.
//!
//! Numbers enter by their bits, forces and contacts of the caller by their Debug text; what that text does not show
//! does not enter. The fingerprint is computed once per run and costs a pass over the nodes.

use std::any::Any;
use std::fmt::{self, Debug, Write};

use super::ExplicitBodies;
use crate::body::Body;
use crate::contact::{Contact, Massless, Springs};

/// A digest of words, each of which is mixed in after a rotation and followed by a product with an odd number. It is
/// the same on every machine.
struct Digest(u64);

/// 2⁶⁴ over the golden ratio.
const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

impl Digest {
    fn take(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(23) ^ word).wrapping_mul(FACTOR);
    }

    fn take_numbers<'a>(&mut self, numbers: impl IntoIterator<Item = &'a f64>) {
        numbers.into_iter().for_each(|number| self.take(number.to_bits()));
    }

    fn take_text(&mut self, what: impl Debug) {
        // A digest takes all text.
        let _ = write!(self, "{what:?}");
    }
}

impl Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.bytes().for_each(|byte| self.take(u64::from(byte)));
        Ok(())
    }
}

/// The smallest number of sixteen digits.
const SMALLEST: u64 = 1_000_000_000_000_000;

/// Returns the fingerprint of a model.
pub(crate) fn fingerprint(model: &ExplicitBodies) -> u64 {
    let mut digest = Digest(0);
    digest.take_text(env!("CARGO_PKG_VERSION"));
    let approach = model.approach();
    digest.take_numbers(&approach.velocities());
    digest.take_numbers(&[approach.gap(), model.time_step()]);
    model.bodies().iter().for_each(|body| take_body(&mut digest, body));
    take_contact(&mut digest, model.contact());
    // Always sixteen digits, so that restart states of one size take the same space as text.
    SMALLEST + digest.0 % (9 * SMALLEST)
}

fn take_body(digest: &mut Digest, body: &Body) {
    digest.take(body.n_nodes() as u64);
    if let Some(mesh) = body.mesh() {
        digest.take_numbers(mesh.nodes().as_flattened());
        mesh.quads().as_flattened().iter().for_each(|&node| digest.take(u64::from(node)));
    }
    digest.take_numbers(&body.nodal_mass);
    digest.take_text(body.material());
    if let Some(stress) = body.stress.as_ref().filter(|_| body.finite_strain().is_some()) {
        digest.take_text(&stress.part);
    }
    digest.take_text(&body.node_forces);
    if body.held {
        digest.take_text("held");
    }
}

fn take_contact(digest: &mut Digest, contact: &dyn Contact) {
    let region = contact.candidate_region();
    digest.take_numbers(&[region.radius]);
    digest.take(region.n_points as u64);
    let any = contact as &dyn Any;
    let massless = any.downcast_ref::<Massless>();
    let Some(springs): Option<&Springs> = any.downcast_ref().or(massless.map(Massless::springs))
    else {
        return digest.take_text(contact);
    };
    match (massless.is_some(), springs.slipping().is_some()) {
        (true, true) => digest.take_text("massless, slipping"),
        (true, false) => digest.take_text("massless"),
        (false, true) => digest.take_text("slipping"),
        (false, false) => {}
    }
    for point in springs.interface().points() {
        digest.take_numbers(&[point.radius, point.area, point.initial_gap, point.stiffness]);
        for projection in &point.projections {
            projection.nodes.iter().for_each(|&node| digest.take(u64::from(node)));
            digest.take_numbers(&projection.shape);
        }
    }
}
