//! Nodes, quads and boundary curves of a sphere's meridian.

/// On which side of the plane y = 0 a body lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Body in y ≤ 0.
    Below,
    /// Body in y ≥ 0.
    Above,
}

/// Quadrilateral mesh of the meridian half disc of a sphere.
///
/// The contact pole is the origin; all nodes have r ≥ 0. Quads are listed
/// counter-clockwise in (r, y).
#[derive(Debug, Clone, PartialEq)]
pub struct SphereMesh {
    radius: f64,
    nodes: Vec<[f64; 2]>,
    quads: Vec<[u32; 4]>,
    axis: Vec<u32>,
    surface: Vec<u32>,
}

impl SphereMesh {
    pub(crate) fn from_parts(
        radius: f64,
        nodes: Vec<[f64; 2]>,
        quads: Vec<[u32; 4]>,
        axis: Vec<u32>,
        surface: Vec<u32>,
    ) -> Self {
        Self { radius, nodes, quads, axis, surface }
    }

    /// Radius of the sphere, m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Node positions (r, y), m.
    pub fn nodes(&self) -> &[[f64; 2]] {
        &self.nodes
    }

    /// Node numbers of each element, counter-clockwise.
    pub fn quads(&self) -> &[[u32; 4]] {
        &self.quads
    }

    /// Nodes with r = 0, from the contact pole to the far pole.
    pub fn axis(&self) -> &[u32] {
        &self.axis
    }

    /// Nodes on the sphere's surface, from the contact pole to the far pole,
    /// both included.
    pub fn surface(&self) -> &[u32] {
        &self.surface
    }

    /// Corner positions of an element, (r, y) in m.
    #[inline]
    pub fn corners(&self, element: usize) -> [[f64; 2]; 4] {
        self.quads[element].map(|node| self.nodes[node as usize])
    }

    /// The side of the plane y = 0 on which the body lies.
    pub fn side(&self) -> Side {
        let far_pole = self.surface[self.surface.len() - 1] as usize;
        if self.nodes[far_pole][1] > 0.0 { Side::Above } else { Side::Below }
    }

    /// This body on the given side of the plane y = 0.
    pub fn on_side(mut self, side: Side) -> Self {
        if self.side() != side {
            for node in &mut self.nodes {
                node[1] = -node[1];
            }
            for quad in &mut self.quads {
                quad.reverse();
            }
        }
        self
    }
}
