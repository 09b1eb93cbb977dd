//! The order in which a body's degrees of freedom are eliminated.
//!
//! Fixed is u_r on the axis; u_y of the far pole, the ground, is held and not eliminated, which makes
//! the stiffness of a free body positive definite. A half-space is held at its far boundary instead, and
//! has no ground. The interior comes first, by nested dissection ([`Dissection`]); then u_r of the contact
//! nodes; last their u_y, from the axis outward, so that the trailing block of the Cholesky factor is all
//! that contact needs.

use fem_mesh::SphereMesh;

use crate::band::Profile;
use crate::dissection::{Dissection, Place, places};
use crate::elements::ElementEquations;

/// Half-width of a band, in equations, up to which it takes less time than fronts.
const NARROW: usize = 128;

/// Marks a degree of freedom that does not move.
pub(crate) const FIXED: u32 = u32::MAX;

/// Equation numbers of the degrees of freedom.
#[derive(Debug, Clone)]
pub(crate) struct Numbering {
    /// Equations of (u_r, u_y) of each node, or [`FIXED`]; the ground comes after all equations, if there
    /// is one.
    pub equations: Vec<[u32; 2]>,
    /// Equations that are solved, the ground not counted.
    pub n_equations: usize,
    pub n_contact: usize,
    pub order: Order,
}

/// How equations are eliminated.
#[derive(Debug, Clone)]
pub(crate) enum Order {
    /// Those of the interior as a band, with those of the contact nodes as its border.
    Band(Profile),
    /// Where each set of equations ends that are eliminated together; the last one is the contact's.
    Fronts(Vec<usize>),
}

impl Numbering {
    /// With u_y of the given surface nodes last.
    pub fn new(mesh: &SphereMesh, contact_nodes: &[u32]) -> Self {
        let mut is_contact = vec![false; mesh.nodes().len()];
        for &node in contact_nodes {
            is_contact[node as usize] = true;
        }
        let places = places(mesh, |node| !is_contact[node]);
        let rings = by_number(&by_number(&places, |place| place.along), |place| place.ring);
        let rings: Vec<u32> = rings.iter().map(|place| place.node).collect();
        let all = rings.len();
        let (equations, ends) = number(mesh, contact_nodes, &rings, &[all]);
        let n_equations = ends.last().copied().unwrap_or(0);
        // The ends of the interior and of u_r and u_y of the contact.
        let n_border = n_equations - if ends.len() > 1 { ends[0] } else { 0 };
        let elements = ElementEquations::of_mesh(mesh, &equations);
        let profile = Profile::new(&elements, n_equations, n_border);
        let n_contact = contact_nodes.len();
        if profile.half_width <= NARROW {
            return Self { equations, n_equations, n_contact, order: Order::Band(profile) };
        }
        let Dissection { nodes, ends } = Dissection::new(places);
        let (equations, ends) = number(mesh, contact_nodes, &nodes, &ends);
        Self { equations, n_equations, n_contact, order: Order::Fronts(ends) }
    }

    /// First equation of the contact unknowns.
    pub fn first_contact(&self) -> usize {
        self.n_equations - self.n_contact
    }
}

/// Places in the order of a number, those of one number as they were; there are about as many numbers as places
/// at most.
fn by_number(places: &[Place], number: impl Fn(&Place) -> i64) -> Vec<Place> {
    let least = places.iter().map(&number).min().unwrap_or(0);
    let mut starts = Vec::new();
    for place in places {
        let own = (number(place) - least) as usize;
        if own >= starts.len() {
            starts.resize(own + 1, 0);
        }
        starts[own] += 1;
    }
    let mut start = 0;
    for count in &mut starts {
        (start, *count) = (start + *count, start);
    }
    let mut sorted = places.to_vec();
    for place in places {
        let to = &mut starts[(number(place) - least) as usize];
        sorted[*to] = *place;
        *to += 1;
    }
    sorted
}

/// Equations of (u_r, u_y) of each node, of interior nodes in this order and of the contact nodes after them; and
/// where each set ends, of interior nodes that end at these places and of the contact.
fn number(
    mesh: &SphereMesh,
    contact_nodes: &[u32],
    interior: &[u32],
    interior_ends: &[usize],
) -> (Vec<[u32; 2]>, Vec<usize>) {
    let mut equations = vec![[0; 2]; mesh.nodes().len()];
    for &node in mesh.axis() {
        equations[node as usize][0] = FIXED;
    }
    let ground = mesh.axis()[mesh.axis().len() - 1] as usize;
    equations[ground][1] = FIXED;
    for &node in mesh.far_boundary() {
        equations[node as usize] = [FIXED; 2];
    }
    let mut n_equations = 0;
    let mut number = |node: u32, component: usize| {
        let equation = &mut equations[node as usize][component];
        if *equation != FIXED {
            *equation = n_equations;
            n_equations += 1;
        }
        n_equations as usize
    };
    let mut ends = Vec::with_capacity(interior_ends.len() + 1);
    let mut nodes = interior.iter();
    let mut end = 0;
    let starts = [0].iter().chain(interior_ends);
    for (start, stop) in starts.zip(interior_ends) {
        for &node in nodes.by_ref().take(stop - start) {
            end = number(node, 0).max(number(node, 1));
        }
        ends.push(end);
    }
    for component in 0..2 {
        for &node in contact_nodes {
            end = number(node, component);
        }
    }
    ends.push(end);
    // What is fixed makes no set of its own.
    ends.dedup();
    if ends.first() == Some(&0) {
        ends.remove(0);
    }
    if !mesh.is_half_space() {
        equations[ground][1] = n_equations;
    }
    (equations, ends)
}

#[cfg(test)]
mod tests {
    use fem_mesh::HalfDisc;

    use super::*;

    /// Rings of 2 m + 1 nodes leave a band of 2 (2 m + 1) equations and those of one node more; long ones are
    /// eliminated in pieces.
    #[test]
    fn meshes_of_short_rings_are_bands() {
        for m in [2, 7, 12, 30, 40] {
            let (contact_element_size, refined_radius) = (0.3 / f64::from(m), 0.3);
            let disc = HalfDisc { radius: 1.0, contact_element_size, refined_radius, growth: None };
            let mesh = disc.build().unwrap();
            let contact = mesh.surface()[..=m as usize].to_vec();
            let expected = 2 * (2 * m as usize + 1) + 4;
            match Numbering::new(&mesh, &contact).order {
                Order::Band(profile) => {
                    assert!(profile.half_width <= expected, "{m} {}", profile.half_width);
                }
                Order::Fronts(_) => assert!(expected > NARROW, "{m}"),
            }
        }
    }
}
