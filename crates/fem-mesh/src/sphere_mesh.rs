//! Nodes, quads and boundary curves of the meridian of a sphere, of a half-space or of a plate.

/// The side of the plane y = 0 on which a body lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Body in y ≤ 0.
    Below,
    /// Body in y ≥ 0.
    Above,
}

/// Quadrilateral mesh of the meridian half disc of a sphere, or of a quarter disc of a half-space,
/// which is a sphere of infinite radius, or of a half strip of a plate, which has that radius, too.
///
/// The contact pole is the origin; all nodes have r ≥ 0. Quads are listed
/// counter-clockwise in (r, y). The mesh of a half-space ends at a far boundary, beyond which the
/// body continues; that of a plate has one where the plate continues or is held.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereMesh {
    radius: f64,
    nodes: Vec<[f64; 2]>,
    quads: Vec<[u32; 4]>,
    axis: Vec<u32>,
    surface: Vec<u32>,
    far_boundary: Vec<u32>,
    thickness: Option<f64>,
}

impl SphereMesh {
    pub(crate) fn from_parts(
        radius: f64,
        nodes: Vec<[f64; 2]>,
        quads: Vec<[u32; 4]>,
        axis: Vec<u32>,
        surface: Vec<u32>,
        far_boundary: Vec<u32>,
    ) -> Self {
        Self { radius, nodes, quads, axis, surface, far_boundary, thickness: None }
    }

    /// Returns this flat body as a plate of this thickness, m.
    pub(crate) fn with_thickness(self, thickness: f64) -> Self {
        Self { thickness: Some(thickness), ..self }
    }

    /// Replaces each node position (r, y), m.
    pub(crate) fn move_nodes(&mut self, place: impl Fn([f64; 2]) -> [f64; 2]) {
        self.nodes.iter_mut().for_each(|node| *node = place(*node));
    }

    /// Returns the radius of the sphere, m; infinite for a half-space and for a plate.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns whether the body is flat: a half-space or a plate.
    pub fn is_half_space(&self) -> bool {
        self.radius.is_infinite()
    }

    /// Returns the thickness of a plate, m; `None` for other bodies.
    pub fn thickness(&self) -> Option<f64> {
        self.thickness
    }

    /// Returns the node positions (r, y), m.
    pub fn nodes(&self) -> &[[f64; 2]] {
        &self.nodes
    }

    /// Returns the node numbers of each element, counter-clockwise.
    pub fn quads(&self) -> &[[u32; 4]] {
        &self.quads
    }

    /// Returns the nodes with r = 0, from the contact pole to the far pole, or to a half-space's far boundary.
    pub fn axis(&self) -> &[u32] {
        &self.axis
    }

    /// Returns the nodes on the sphere's surface, from the contact pole to the far pole,
    /// both included; for a half-space those of its plane, out to the far boundary.
    pub fn surface(&self) -> &[u32] {
        &self.surface
    }

    /// Returns the nodes where the mesh of a half-space ends, from the axis to the surface, both included; none
    /// for a sphere. Those of a plate are the bonded far face and the rim beyond which it continues.
    pub fn far_boundary(&self) -> &[u32] {
        &self.far_boundary
    }

    /// Returns the distance from the contact pole beyond which the body continues, m; `None` for a body that ends.
    pub fn far_radius(&self) -> Option<f64> {
        let end = self.far_boundary.last()?;
        let is_open = self.surface.last() == Some(end);
        is_open.then(|| self.nodes[*end as usize][0])
    }

    /// Returns the corner positions of an element, (r, y) in m.
    #[inline]
    pub fn corners(&self, element: usize) -> [[f64; 2]; 4] {
        self.quads[element].map(|node| self.nodes[node as usize])
    }

    /// Returns the side of the plane y = 0 on which the body lies.
    pub fn side(&self) -> Side {
        let far_end = self.axis[self.axis.len() - 1] as usize;
        if self.nodes[far_end][1] > 0.0 { Side::Above } else { Side::Below }
    }

    /// Moves this body to the given side of the plane y = 0.
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
