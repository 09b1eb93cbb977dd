//! Staggered meshes: the nodes of one body lie between those of the other at the edge of the contact.
//!
//! The force that linear elements carry swings with the place of the contact's edge between two nodes, with
//! the period of one element and by some (3/8)(h/a)² of it: a body is too stiff where the edge is at
//! a node, and too compliant between. Two meshes that are half an element apart there,
//!
//! ```math
//! h_\pm = \frac{a}{a/h \pm \tfrac14},
//! ```
//!
//! swing against each other: measured over all phases at a/h = 4 to 5, the swing falls from 1.0 to 0.14 % of
//! the force (docs/contact.md). Springs at points of both surfaces see that. Nodes that touch exactly follow
//! one of the meshes, and bodies of one size and stuff are computed as one: neither is staggered.

use fem_case::{Body, CondensedOptions, ModelChoice, Scene, Shape};

/// Elements by which the meshes differ across the contact, to each side.
const QUARTER: f64 = 0.25;

/// The body with the smaller elements of a scene whose meshes are staggered.
pub(crate) fn finer_body(scene: &Scene) -> Option<usize> {
    // Elements that a case names stay as they are.
    let is_open = scene.mesh().contact_element_size.is_none();
    let is_asked_for = scene.mesh().staggered.unwrap_or(is_open);
    if is_asked_for { smaller(scene) } else { None }
}

/// Of a scene that allows for it the smaller body, whose mesh has fewer rings, or the softer one of two of
/// one size.
fn smaller(scene: &Scene) -> Option<usize> {
    let between_points = match scene.model() {
        ModelChoice::Fem => true,
        ModelChoice::Condensed(CondensedOptions { penalty_springs, .. }) => *penalty_springs,
        _ => false,
    };
    if !between_points || !scene.bodies().iter().all(is_made_here) {
        return None;
    }
    let radii = scene.bodies().each_ref().map(|body| body.diameter().unwrap_or(f64::INFINITY));
    let shares = scene.compliance_shares();
    let order = radii[0].total_cmp(&radii[1]).then(shares[1].total_cmp(&shares[0]));
    match order {
        std::cmp::Ordering::Less => Some(0),
        std::cmp::Ordering::Equal => None,
        std::cmp::Ordering::Greater => Some(1),
    }
}

/// Whether a body's mesh is made here.
fn is_made_here(body: &Body) -> bool {
    matches!(body.shape(), Shape::Sphere { mesh: None, .. } | Shape::HalfSpace { .. })
}

/// Lengths of the elements of both bodies (m) about a length, one body's being the smaller, in a contact of
/// this radius, m.
pub(crate) fn staggered(length: f64, contact_radius: f64, finer: usize) -> [f64; 2] {
    let across = contact_radius / length;
    [0, 1].map(|side| {
        let more = if side == finer { QUARTER } else { -QUARTER };
        contact_radius / (across + more)
    })
}
