//! Figures of merit of a mesh.

use crate::sphere_mesh::SphereMesh;

/// Quality of a mesh, over all of its elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// Smallest scaled Jacobian: sine of the sharpest corner, 1 for a
    /// rectangle, 0 for a degenerate and negative for an inverted corner.
    pub min_scaled_jacobian: f64,
    /// Element of the smallest scaled Jacobian.
    pub worst_element: usize,
    /// Largest ratio of the longest to the shortest edge of an element.
    pub max_aspect_ratio: f64,
    /// Shortest edge, m.
    pub min_edge: f64,
    /// Longest edge, m.
    pub max_edge: f64,
}

impl Quality {
    /// Measures a mesh.
    pub fn of(mesh: &SphereMesh) -> Self {
        Self::of_quads(mesh.nodes(), mesh.quads())
    }

    pub(crate) fn of_quads(nodes: &[[f64; 2]], quads: &[[u32; 4]]) -> Self {
        let mut quality = Self {
            min_scaled_jacobian: f64::INFINITY,
            worst_element: 0,
            max_aspect_ratio: 1.0,
            min_edge: f64::INFINITY,
            max_edge: 0.0,
        };
        for (element, quad) in quads.iter().enumerate() {
            let corners = quad.map(|node| nodes[node as usize]);
            let edges: [[f64; 2]; 4] = std::array::from_fn(|a| {
                let (p, q) = (corners[a], corners[(a + 1) % 4]);
                [q[0] - p[0], q[1] - p[1]]
            });
            let lengths = edges.map(|[dr, dy]| dr.hypot(dy));
            let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
            let longest = lengths.iter().copied().fold(0.0, f64::max);
            quality.min_edge = quality.min_edge.min(shortest);
            quality.max_edge = quality.max_edge.max(longest);
            quality.max_aspect_ratio = quality.max_aspect_ratio.max(longest / shortest);
            for a in 0..4 {
                let (p, q) = (edges[(a + 3) % 4], edges[a]);
                let sine = (p[0] * q[1] - p[1] * q[0]) / (lengths[(a + 3) % 4] * lengths[a]);
                // A collapsed edge gives NaN, which counts as degenerate.
                let sine = if sine.is_nan() { 0.0 } else { sine };
                if sine < quality.min_scaled_jacobian {
                    quality.min_scaled_jacobian = sine;
                    quality.worst_element = element;
                }
            }
        }
        quality
    }
}
