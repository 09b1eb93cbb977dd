//! What a model is known by to a memory of one of its runs: a number that differs where the meshes,
//! masses, materials, forces, contact, approach or step of two models do, or the version that computes
//! them.
//!
//! Numbers enter by their bits, forces and contacts that the caller made by their Debug text: what that
//! does not show is not known. It is made once a run, and costs a pass over the nodes.

use std::any::Any;
use std::fmt::{self, Debug, Write};

use fem_contact::{ContactInterface, SlippingInterface};

use crate::body::Body;
use crate::contact::{Contact, Massless};
use crate::model::Model;

/// What takes words, one after the other: rotated, mixed in, multiplied by an odd number. The same on
/// every machine.
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

/// A number of sixteen digits.
const SMALLEST: u64 = 1_000_000_000_000_000;

/// The fingerprint of a model.
pub(crate) fn fingerprint(model: &Model) -> u64 {
    let mut digest = Digest(0);
    digest.take_text(env!("CARGO_PKG_VERSION"));
    let approach = model.approach();
    digest.take_numbers(&approach.velocities());
    digest.take_numbers(&[approach.gap(), model.time_step()]);
    model.bodies().iter().for_each(|body| take_body(&mut digest, body));
    take_contact(&mut digest, model.contact());
    // Always sixteen digits: memories of one size take the same room as text.
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
    if let Some(stress) = body.stress.as_ref().filter(|stress| stress.part.changes_stiffness()) {
        digest.take_text(&stress.part);
    }
    digest.take_text(&body.node_forces);
    if body.held {
        digest.take_text("held");
    }
}

fn take_contact(digest: &mut Digest, contact: &dyn Contact) {
    let searched = contact.searched();
    digest.take_numbers(&[searched.radius]);
    digest.take(searched.n_points as u64);
    let contact_of_any_kind = contact as &dyn Any;
    let interface = if let Some(slipping) = contact_of_any_kind.downcast_ref::<SlippingInterface>()
    {
        digest.take_text("slipping");
        Some(slipping.interface())
    } else if let Some(massless) = contact_of_any_kind.downcast_ref::<Massless>() {
        digest.take_text(if massless.slips() { "massless, slipping" } else { "massless" });
        Some(massless.interface())
    } else {
        contact_of_any_kind.downcast_ref()
    };
    let Some(interface): Option<&ContactInterface> = interface else {
        return digest.take_text(contact);
    };
    for point in interface.points() {
        digest.take_numbers(&[point.radius, point.area, point.initial_gap, point.stiffness]);
        for foot in &point.feet {
            foot.nodes.iter().for_each(|&node| digest.take(u64::from(node)));
            digest.take_numbers(&foot.shape);
        }
    }
}
