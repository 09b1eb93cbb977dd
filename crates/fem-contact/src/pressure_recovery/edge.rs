//! Recovery of the contact radius.

use super::{ContactEnforcement, nodal_means};

/// A node with less than this share of the pressure at the node before has just entered the contact, and is not
/// used for the edge.
const FAINT_PRESSURE_RATIO: f64 = EDGE_BY_PRESSURE_RATIO[0][0];

/// The edge of the contact on the scale of an element. Columns: ratio of the pressures at the outermost two
/// nodes; distance of the edge from the outermost node in elements, with springs and without overlap; excess of
/// the ratio of the pressures at the next two nodes over that of an ellipse with this edge.
///
/// Measured on elastic spheres and a wall for all places of the edge between nodes, with 7 to 16 elements per
/// radius, against the radius with 64 at the same instant; single values scatter by 0.01.
const EDGE_BY_PRESSURE_RATIO: [[f64; 4]; 14] = [
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

/// Correction of the edge for profiles that are not ellipses, in elements per unit of the excess ratio, times the
/// ratio at the edge. Measured where moduli relax by e⁻² within the contact: 3.3 with 8 elements per radius, 2.5
/// with 16, 4.4 without overlap.
const EDGE_PER_STEEPNESS: f64 = 2.3;
/// Upper limit on that correction, in elements.
const MAX_CORRECTION: f64 = 0.5;
/// Share of the first element that is in contact as long as only the axis node has a force.
const FIRST_ELEMENT_SHARE: f64 = 0.5;

/// Returns the radius (m) at which the pressure falls to zero, for mean pressures at nodes from the axis outward
/// (r in m, p in Pa); 0 without contact.
pub fn contact_radius(
    nodes: impl Iterator<Item = (f64, f64)> + Clone,
    enforcement: ContactEnforcement,
) -> f64 {
    let mut last = None;
    let mut window = [None; 3];
    for cell in nodal_means(nodes) {
        let before = window[2].map_or(0.0, |cell: super::NodalMean| cell.pressure);
        if cell.pressure > 0.0 && cell.pressure >= FAINT_PRESSURE_RATIO * before {
            last = Some((cell, window));
        }
        window = [window[1], window[2], Some(cell)];
    }
    let Some((outermost, [third, second, first])) = last else { return 0.0 };
    let Some(first) = first else {
        return FIRST_ELEMENT_SHARE * outermost.neighbours[1].unwrap_or(0.0);
    };
    let width = outermost.radius - first.radius;
    let ratio = outermost.pressure / first.pressure;
    if ratio.is_nan() {
        return ratio;
    }
    let [offset, steeper] = layer(ratio, enforcement);
    let ellipse = outermost.radius + offset * width;
    let correction = match (second, third) {
        (Some(second), Some(_)) if second.pressure > 0.0 => {
            let [inner, outer] =
                [second, first].map(|cell| ellipse.powi(2) - cell.hat_moments().square);
            let fall = first.pressure / second.pressure / (outer / inner).sqrt() - 1.0;
            EDGE_PER_STEEPNESS * ratio.min(1.0) * (fall - steeper)
        }
        _ => 0.0,
    };
    ellipse - width * correction.clamp(-MAX_CORRECTION, MAX_CORRECTION)
}

/// Interpolates the table: distance of the edge from the outermost node, and excess of the ratio inside of it.
fn layer(ratio: f64, enforcement: ContactEnforcement) -> [f64; 2] {
    let outer = EDGE_BY_PRESSURE_RATIO
        .partition_point(|row| row[0] < ratio)
        .clamp(1, EDGE_BY_PRESSURE_RATIO.len() - 1);
    let [from, to] = [&EDGE_BY_PRESSURE_RATIO[outer - 1], &EDGE_BY_PRESSURE_RATIO[outer]];
    let share = ((ratio - from[0]) / (to[0] - from[0])).clamp(0.0, 1.0);
    let column = match enforcement {
        ContactEnforcement::Springs => 1,
        ContactEnforcement::Rigid => 2,
    };
    [column, 3].map(|k: usize| from[k] + share * (to[k] - from[k]))
}
