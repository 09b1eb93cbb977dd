//! Contact at the nodes of one surface, without overlap.
//!
//! Where two meshes match, each pair of nodes is a point. Where they do not, the coarser surface
//! gives the points and the finer one is interpolated linearly, so that no pressure is asked for
//! that the points could not tell apart. A force at a point acts on both bodies: on a node of one,
//! shared between two nodes of the other.

use fem_mesh::segment_measures;

use crate::{ContactError, ContactPoint, Surface};

/// Points at the nodes out to `candidate_radius` (m), from the axis outward, their areas the loads
/// of unit pressure; `gap` (m) separates the poles. The second value is the side whose nodes they
/// are (0 lower, 1 upper).
///
/// # Errors
/// Two walls; a radius that is not positive and finite.
pub fn nodal_points(
    surfaces: [&Surface; 2],
    gap: f64,
    candidate_radius: f64,
) -> Result<(Vec<ContactPoint>, usize), ContactError> {
    if surfaces.iter().all(|surface| surface.is_wall()) {
        return Err(ContactError::TwoWalls);
    }
    if !(candidate_radius > 0.0 && candidate_radius.is_finite()) {
        let (name, value) = ("candidate radius", candidate_radius);
        return Err(ContactError::NotPositive { name, value });
    }
    let n_nodes = surfaces.map(|surface| {
        if surface.is_wall() { usize::MAX } else { surface.nodes_within(candidate_radius).len() }
    });
    let side = usize::from(n_nodes[1] < n_nodes[0]);
    let radii = &surfaces[side].radii;
    let limit = candidate_radius.min(surfaces[1 - side].extent());
    let n = radii.partition_point(|&r| r <= limit * (1.0 + 1e-12));
    let points = (0..n).map(|k| {
        let radius = radii[k];
        let share = |other: Option<usize>, own: usize| match other {
            Some(other) => segment_measures([radii[other], 0.0], [radii[own], 0.0])[1],
            None => 0.0,
        };
        let outer = (k + 1 < radii.len()).then_some(k + 1);
        ContactPoint {
            radius,
            area: share(k.checked_sub(1), k) + share(outer, k),
            initial_gap: gap + surfaces[0].depth(radius) + surfaces[1].depth(radius),
            stiffness: f64::INFINITY,
            feet: std::array::from_fn(|body| surfaces[body].foot(surfaces[body].locate(radius))),
        }
    });
    Ok((points.collect(), side))
}
