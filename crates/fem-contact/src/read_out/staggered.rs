//! Radius and pressure where the nodes of two surfaces lie between each other at the edge.
//!
//! Forces at the nodes of either surface then depend on the nodes of the other, too: read at one surface the
//! radius is off by up to 0.1 elements, to the other side than at the other surface. Their mean is not.

/// The surfaces' elements differ by at least and at most so much, as those of meshes do that are staggered by
/// half an element with 3 to 50 of them across the contact.
const RATIOS: std::ops::Range<f64> = 1.005..1.2;
/// The mean is too small by this share of an element: measured on elastic spheres at every quarter of
/// an element, 3.5 to 8 across the radius; single readings scatter by 0.016.
const EDGE: f64 = 0.025;

/// Whether segments of these lengths (m) are of staggered meshes; a rigid surface has none.
pub fn are_staggered(lengths: [Option<f64>; 2]) -> bool {
    let [Some(a), Some(b)] = lengths else { return false };
    RATIOS.contains(&(a.max(b) / a.min(b)))
}

/// The radius (m) of what it is read as at the nodes of either surface, whose segments have these lengths, m.
pub fn staggered_radius(readings: [f64; 2], lengths: [f64; 2]) -> f64 {
    let [radius, length] = [readings, lengths].map(|[a, b]| 0.5 * (a + b));
    if radius > 0.0 { radius + EDGE * length } else { radius }
}
