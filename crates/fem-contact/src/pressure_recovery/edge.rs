//! Recovery of the contact radius.

use super::{ContactEnforcement, cells};

/// Less pressure than this share of that at the node before belongs to a node that the contact has just
/// reached and tells nothing of the edge.
const FAINT: f64 = LAYER[0][0];

/// The edge as every mesh has it, on the scale of an element: of the ratio of the pressures at the
/// outermost two nodes (the first) follows how far outside of the outermost the pressure falls to zero,
/// in elements, with springs (the second) and without overlap (the third); and by how much the ratio of
/// the pressures at the next two nodes is above that of an ellipse that ends there (the fourth).
///
/// Measured on elastic spheres and a wall at every place of the edge between nodes, 7 to 16 elements across
/// the radius, against the radius that 64 give at the same instant; single readings scatter by 0.01.
const LAYER: [[f64; 4]; 14] = [
    [0.08, -0.274, -0.230, -0.018],
    [0.12, -0.221, -0.185, -0.020],
    [0.16, -0.175, -0.138, -0.022],
    [0.20, -0.122, -0.089, -0.0225],
    [0.25, -0.053, -0.024, -0.0225],
    [0.30, 0.022, 0.045, -0.021],
    [0.35, 0.100, 0.118, -0.018],
    [0.40, 0.186, 0.196, -0.0135],
    [0.45, 0.280, 0.281, -0.0085],
    [0.50, 0.382, 0.372, -0.0025],
    [0.55, 0.494, 0.472, 0.0045],
    [0.60, 0.608, 0.573, 0.0075],
    [0.65, 0.718, 0.709, 0.0095],
    [0.70, 0.810, 0.810, 0.020],
];

/// How much nearer the edge is, in elements, for each unit that the pressure inside of it falls off less
/// steeply than that of an ellipse, times the ratio at the edge. Measured where moduli relax by e⁻² within
/// the contact: 3.3 of 8 elements across the radius, 2.5 of 16, 4.4 without overlap.
const STEEPNESS: f64 = 2.3;
/// No correction is larger than this, in elements.
const LARGEST_CORRECTION: f64 = 0.5;
/// Share of the first element that the contact covers as long as only the axis node has a force.
const FIRST: f64 = 0.5;

/// Radius (m) at which the pressure falls to zero, of pressures at nodes from the axis outward
/// (r in m, p in Pa); 0 without contact.
pub fn contact_radius(
    nodes: impl Iterator<Item = (f64, f64)> + Clone,
    barrier: ContactEnforcement,
) -> f64 {
    let mut last = None;
    let mut window = [None; 3];
    for cell in cells(nodes) {
        let before = window[2].map_or(0.0, |cell: super::Cell| cell.pressure);
        if cell.pressure > 0.0 && cell.pressure >= FAINT * before {
            last = Some((cell, window));
        }
        window = [window[1], window[2], Some(cell)];
    }
    let Some((outermost, [third, second, first])) = last else { return 0.0 };
    let Some(first) = first else {
        return FIRST * outermost.neighbours[1].unwrap_or(0.0);
    };
    let width = outermost.radius - first.radius;
    let ratio = outermost.pressure / first.pressure;
    if ratio.is_nan() {
        return ratio;
    }
    let [offset, steeper] = layer(ratio, barrier);
    let ellipse = outermost.radius + offset * width;
    let correction = match (second, third) {
        (Some(second), Some(_)) if second.pressure > 0.0 => {
            let [inner, outer] = [second, first].map(|cell| ellipse.powi(2) - cell.weight().square);
            let fall = first.pressure / second.pressure / (outer / inner).sqrt() - 1.0;
            STEEPNESS * ratio.min(1.0) * (fall - steeper)
        }
        _ => 0.0,
    };
    ellipse - width * correction.clamp(-LARGEST_CORRECTION, LARGEST_CORRECTION)
}

/// Of the ratio at the edge the place of the edge, and what the ratio inside of it is above an ellipse's.
fn layer(ratio: f64, barrier: ContactEnforcement) -> [f64; 2] {
    let outer = LAYER.partition_point(|row| row[0] < ratio).clamp(1, LAYER.len() - 1);
    let [from, to] = [&LAYER[outer - 1], &LAYER[outer]];
    let share = ((ratio - from[0]) / (to[0] - from[0])).clamp(0.0, 1.0);
    let column = match barrier {
        ContactEnforcement::Springs => 1,
        ContactEnforcement::Rigid => 2,
    };
    [column, 3].map(|k: usize| from[k] + share * (to[k] - from[k]))
}
