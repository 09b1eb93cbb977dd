//! Whether the meshes can carry a contact: the error that they foretell, and what helps.
//!
//! Contact time and peak force are off in proportion to the energy that elements cannot store
//! ([`BodyLoss`]), each body with its share in the compliance of the contact. Around the contact the
//! bodies become too stiff by it; under it errors of stress and of contact cancel in part. Measured on
//! meshes of any growth, graded, sheared, coarse in depth, fine at the pole only, and of sizes 1:20, with
//! 3 to 16 elements across the contact: the true error is 0.3 to 3 times what is foretold here. With
//! fewer than four the force swings by more than that with the place of the contact's edge in its element.

mod body;

use fem_case::engineering::show;
use fem_case::{Body, Scene, Shape};
use fem_mesh::SphereMesh;

use self::body::{BodyLoss, Loss, longest_edge, middle};
use crate::plan::Plan;

/// Relative error of the contact time over the energy lost around and under the contact. Measured:
/// 0.3 to 0.7, and -0.1 to 0.2.
const TIME_OVER_LOSS: [f64; 2] = [0.5, 0.1];
/// The same of the peak force. Measured: 0.6 to 0.9, and 0.1 to 0.6.
const FORCE_OVER_LOSS: [f64; 2] = [0.8, 0.4];
/// What defaults keep below: an error that is foretold above this is worth a word.
const LARGEST_ERROR: f64 = 0.015;
/// Fewer elements across the contact radius cost more than about 1 % of the force.
const FEWEST_ELEMENTS: f64 = 3.5;
/// Fewer do not resolve it: no error is foretold of them.
const NO_ELEMENTS: f64 = 1.0;
/// Meshes that are made here and not told how to grow keep below [`LARGEST_ERROR`] with so many.
const ENOUGH_ELEMENTS: f64 = 4.5;
/// An error that is foretold above this is no number: elements lose more than half of the contact's energy.
const LARGEST_TOLD: f64 = 0.5;
/// Elements across the contact that are advised where there are none: their companions tell less than 1 %.
const ADVISED: f64 = 5.5;
/// A length is advised that brings the error to this share of the largest.
const SHARE_OF_ADVICE: f64 = 0.5;

/// The errors that meshes foretell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Resolution {
    /// Of the contact time, over it.
    pub contact_time: f64,
    /// Of the peak force, over it.
    pub peak_force: f64,
    /// Contact radius over the longest edge of a surface in the contact.
    pub elements: f64,
    /// Where most of it comes from.
    source: Source,
}

/// A part of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Source {
    side: usize,
    is_under: bool,
    /// The element that loses most there.
    element: usize,
    /// What it adds to the error of the force.
    error: f64,
}

/// What a warning is about.
pub(crate) struct Given<'a> {
    /// How the meshes were chosen.
    pub plan: &'a Plan,
    /// Of the contact, m.
    pub contact_radius: f64,
    /// Length of the elements that the tolerance needs, where companions tell it, m.
    pub needed: Option<f64>,
}

impl Resolution {
    /// Of meshes in a contact of this radius, m; none of rigid bodies, or of a radius that is no length.
    pub fn of(
        scene: &Scene,
        meshes: [Option<&SphereMesh>; 2],
        contact_radius: f64,
    ) -> Option<Self> {
        if !(contact_radius > 0.0 && contact_radius.is_finite()) {
            return None;
        }
        let moduli =
            scene.bodies().each_ref().map(|body| body.material().map(|m| *m.instantaneous()));
        let shares = scene.compliance_shares();
        let elements = contact_radius / longest_contact_edge(meshes, contact_radius)?;
        let none = Source { side: 0, is_under: false, element: 0, error: f64::NEG_INFINITY };
        let mut sum = Self { contact_time: 0.0, peak_force: 0.0, elements, source: none };
        for (side, mesh) in meshes.into_iter().enumerate() {
            let (Some(mesh), Some(moduli)) = (mesh, moduli[side]) else { continue };
            let losses = BodyLoss::of(mesh, moduli.poissons_ratio(), contact_radius);
            for (is_under, Loss { energy, worst }) in [(false, losses.around), (true, losses.under)]
            {
                let lost = energy * shares[side];
                let (time, force) = (
                    TIME_OVER_LOSS[usize::from(is_under)] * lost,
                    FORCE_OVER_LOSS[usize::from(is_under)] * lost,
                );
                let source = Source { side, is_under, element: worst.0, error: force };
                sum.contact_time += time;
                sum.peak_force += force;
                if force > sum.source.error {
                    sum.source = source;
                }
            }
        }
        Some(sum)
    }

    /// Whether the contact is narrower than an element.
    pub fn is_none_at_all(&self) -> bool {
        self.elements < NO_ELEMENTS
    }

    /// What a user should know of a mesh whose elements are wider than the contact, whose radius is this, m.
    fn unresolved(&self, scene: &Scene, contact_radius: f64) -> String {
        let body = &scene.bodies()[self.source.side];
        let size = show(contact_radius / ADVISED, "m");
        let advice = match is_made_here(body) {
            true => format!("use a mesh.contact_element_size of {size} or less, or leave it out"),
            false => format!(
                "use a mesh of {} with edges of {size} there, or leave body.{}.sphere.mesh out",
                body.name(),
                self.source.side
            ),
        };
        format!(
            "the mesh does not resolve the contact, whose radius spans {:.2} elements: contact time and peak force \
             may be off by half and more; {advice}",
            self.elements
        )
    }

    /// Whether there is nothing to be known. What is no number is above every limit.
    fn is_fine(&self) -> bool {
        let largest = self.contact_time.max(self.peak_force);
        largest <= LARGEST_ERROR && self.elements >= FEWEST_ELEMENTS
    }

    /// What the warning says contact time and peak force are off by, as shares; at least.
    pub fn stated(&self) -> Option<[f64; 2]> {
        let told = |error: f64| if error <= LARGEST_TOLD { error } else { LARGEST_TOLD };
        match self.is_none_at_all() {
            true => Some([LARGEST_TOLD; 2]),
            false => (!self.is_fine()).then(|| [self.contact_time, self.peak_force].map(told)),
        }
    }

    /// What a user should know of it.
    pub fn warning(
        &self,
        scene: &Scene,
        meshes: [Option<&SphereMesh>; 2],
        given: &Given,
    ) -> Option<String> {
        let mesh = meshes[self.source.side].filter(|_| !self.is_fine())?;
        if self.is_none_at_all() {
            return Some(self.unresolved(scene, given.contact_radius));
        }
        let body = &scene.bodies()[self.source.side];
        let corners = mesh.corners(self.source.element);
        let [r, y] = middle(&corners);
        // The error falls with the square of the size.
        let largest = self.contact_time.max(self.peak_force);
        let by_error = (SHARE_OF_ADVICE * LARGEST_ERROR / largest).sqrt();
        let shrink = by_error.min(self.elements / FEWEST_ELEMENTS);
        let edge = longest_edge(&corners);
        let advice = match is_made_here(body) {
            true => self.advice(given, r.hypot(y), shrink),
            false => format!(
                "use a mesh of {} with edges of {} there and finer everywhere by the same share, or \
                 leave body.{}.sphere.mesh out",
                body.name(),
                show(shrink * edge, "m"),
                self.source.side
            ),
        };
        let place = if self.source.is_under { "under" } else { "around" };
        Some(format!(
            "the mesh is too coarse {place} the contact, whose radius spans {:.1} elements: contact time \
             off by {}, peak force by {}, most by {} (element {} at r = {}, depth \
             {}, has edges of {}); {advice}",
            self.elements,
            about(self.contact_time),
            about(self.peak_force),
            body.name(),
            self.source.element,
            show(r, "m"),
            show(y.abs(), "m"),
            show(edge, "m"),
        ))
    }

    /// What helps a mesh that is made here, whose worst element is so far from the pole, m.
    fn advice(&self, given: &Given, distance: f64, shrink: f64) -> String {
        let &Given { plan, contact_radius, needed } = given;
        if distance > plan.refined_radius && plan.growth.is_some() {
            return "leave mesh.growth out, or lower it".to_string();
        }
        if distance > plan.refined_radius && plan.refined_radius < contact_radius {
            return format!(
                "use a mesh.refined_radius of {} or more",
                show(1.2 * contact_radius, "m")
            );
        }
        let size = shrink * plan.contact_element_size;
        let size = show(needed.map_or(size, |needed| needed.min(size)), "m");
        format!("use a mesh.contact_element_size of {size} or less")
    }
}

/// Whether there is nothing to be known of the meshes of a plan in a contact of this radius (m), without a look at each
/// element: they are made here, square cells grow from a block that holds the contact, and they are enough.
pub(crate) fn known_as_fine(
    scene: &Scene,
    plan: &Plan,
    meshes: [Option<&SphereMesh>; 2],
    contact_radius: f64,
) -> bool {
    let is_made_so = scene.bodies().iter().all(is_made_here)
        && plan.growth.is_none()
        && plan.refined_radius >= contact_radius;
    is_made_so
        && longest_contact_edge(meshes, contact_radius)
            .is_some_and(|edge| contact_radius >= ENOUGH_ELEMENTS * edge)
}

/// "about 5.5 %".
fn about(error: f64) -> String {
    match error <= LARGEST_TOLD {
        true => format!("about {:.1} %", 100.0 * error),
        // So is what is no number.
        false => "more than half".to_string(),
    }
}

/// Length of the longest surface edge that begins in a contact of this radius (m), of both bodies, m.
pub(crate) fn longest_contact_edge(
    meshes: [Option<&SphereMesh>; 2],
    contact_radius: f64,
) -> Option<f64> {
    let edges = meshes.into_iter().flatten().flat_map(|mesh| {
        let ends = mesh.surface().windows(2).map(|ends| [ends[0], ends[1]]);
        let ends = ends.map(|ends| ends.map(|node| mesh.nodes()[node as usize]));
        // The first one of each mesh is always in it.
        let is_in = move |(k, [p, _]): &(usize, [[f64; 2]; 2])| *k == 0 || p[0] < contact_radius;
        ends.enumerate().take_while(is_in).map(|(_, [p, q])| (q[0] - p[0]).hypot(q[1] - p[1]))
    });
    edges.reduce(f64::max)
}

/// Whether a body's mesh is made here, and not read from a file.
fn is_made_here(body: &Body) -> bool {
    !matches!(body.shape(), Shape::Sphere { mesh: Some(_), .. })
}

#[cfg(test)]
mod tests;
