//! The graded half disc.
//!
//! The half disc of radius R, contact pole at z = 0, is the image of the
//! quarter plane Re ζ ≥ 0, Im ζ ≥ 0 under the conformal map
//!
//! ```math
//! z = \frac{2 R \zeta}{1 + \zeta}, \qquad z = (\text{depth}) + i\,r .
//! ```
//!
//! The real axis becomes the axis of the sphere, the imaginary axis its
//! surface, ζ = ∞ the far pole, and ζ → 1/ζ turns the sphere end for end. So a
//! mesh of the quarter plane that grows geometrically from ζ = 0 becomes a mesh
//! of the half disc whose cells keep their angles, whose size is in proportion
//! to the distance from the contact, and whose boundary nodes lie on the true
//! arc:
//!
//! * a block of m × m cells of equal size at ζ = 0, its free corner drawn in; with an `edge`, of more and uneven columns (`contact_edge`);
//! * rings of as many cells as the outline of the block has, radii in geometric progression;
//! * the image of such a block around ζ = ∞.
//!
//! Between the blocks the angular and (logarithmic) radial deviation of a
//! block's outline from a circle fades as a power of the radius (`rings`).

use crate::error::MeshError;
use crate::rings::{Block, Ring, Station, default_growth, fade, quad};
use crate::sphere_mesh::SphereMesh;

/// Parameters of the graded half disc; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfDisc {
    /// Radius of the sphere.
    pub radius: f64,
    /// Edge length of the elements at the contact pole.
    pub contact_element_size: f64,
    /// Half-width of the block of equal elements at the contact pole.
    pub refined_radius: f64,
    /// Ratio of the radii of successive rings; `None` for the one that makes
    /// their cells square, 1 + π/(4 m).
    pub growth: Option<f64>,
    /// Expected radius of a contact whose pressure is uniform up to its edge, for which the columns of the block are more, and
    /// narrow at the edge; `None` for square elements.
    pub edge: Option<f64>,
}

/// |ζ| where the far block begins: half of the sphere lies on either side of 1.
const FAR_BLOCK: f64 = 1.0;

/// Counts and radii in the quarter plane.
struct Layout {
    /// Cells of either block.
    block: Block,
    n_rings: usize,
    /// Half-width of the near block in ζ.
    near: f64,
    /// Inverse half-width of the far block in ζ.
    far: f64,
}

impl HalfDisc {
    /// Returns the number of elements that [`HalfDisc::build`] makes.
    ///
    /// # Errors
    /// The errors are those of [`HalfDisc::build`].
    pub fn n_elements(&self) -> Result<usize, MeshError> {
        let layout = self.layout()?;
        Ok(2 * layout.block.n_cells() + layout.block.around() * layout.n_rings)
    }

    /// Makes the mesh, body in y ≥ 0, contact pole at the origin.
    ///
    /// # Errors
    /// Lengths that are not positive and finite, elements or a fine block too
    /// large for the sphere, a growth outside of (1, 2], more elements than
    /// can be numbered.
    pub fn build(&self) -> Result<SphereMesh, MeshError> {
        let layout = self.layout()?;
        let (block, n_rings) = (layout.block, layout.n_rings);
        let around = block.around();
        let mut nodes = Vec::new();
        let mut quads = Vec::new();

        // Near block.
        nodes.extend(block.nodes().map(|at| {
            let [x, y] = block.place(at);
            self.image([layout.near * x, layout.near * y])
        }));
        let near_block = |i: usize, j: usize| block.node([i, j]) as u32;
        quads.extend(block.cells().map(|[i, j]| quad(&near_block, i, j)));

        // Rings between the blocks; station k runs from the axis to the surface.
        let first_ring = nodes.len();
        let stations = Station::all(block);
        for ring in 1..n_rings {
            let ring = layout.ring(ring);
            nodes.extend(stations.iter().map(|station| self.image(ring.point(station))));
        }
        // Far block, in 1/ζ; its outline is the last ring.
        let first_far = nodes.len();
        nodes.extend(block.nodes().map(|at| {
            let [x, y] = block.place(at);
            self.far_image([x / layout.far, y / layout.far])
        }));
        let far_block = |i: usize, j: usize| (first_far + block.node([i, j])) as u32;
        let ring_node = |ring: usize, k: usize| {
            let [i, j] = block.outline(k);
            match ring {
                0 => near_block(i, j),
                _ if ring == n_rings => far_block(i, j),
                _ => (first_ring + (ring - 1) * (around + 1) + k) as u32,
            }
        };
        for ring in 0..n_rings {
            quads.extend((0..around).map(|k| quad(&ring_node, ring, k)));
        }
        // ζ → 1/ζ turns the block around: keep the quads counter-clockwise.
        quads.extend(block.cells().map(|[i, j]| {
            let [a, b, c, d] = quad(&far_block, i, j);
            [a, d, c, b]
        }));

        let axis = (0..=block.rows)
            .map(|i| near_block(i, 0))
            .chain((1..n_rings).map(|ring| ring_node(ring, 0)))
            .chain((0..=block.rows).rev().map(|i| far_block(i, 0)))
            .collect();
        let surface = (0..=block.columns)
            .map(|j| near_block(0, j))
            .chain((1..n_rings).map(|ring| ring_node(ring, around)))
            .chain((0..=block.columns).rev().map(|j| far_block(0, j)))
            .collect();
        let mesh = SphereMesh::from_parts(self.radius, nodes, quads, axis, surface, Vec::new());
        Ok(mesh.narrowed_at(self.edge, self.refined_radius))
    }

    fn layout(&self) -> Result<Layout, MeshError> {
        let &HalfDisc { radius, contact_element_size: size, refined_radius, growth, .. } = self;
        for (name, value) in
            [("radius", radius), ("contact element size", size), ("refined radius", refined_radius)]
        {
            if !(value > 0.0 && value.is_finite()) {
                return Err(MeshError::Length { name, value });
            }
        }
        if size > radius / 4.0 {
            return Err(MeshError::ElementSize { size, radius });
        }
        if refined_radius > radius * (1.0 + 1e-12) {
            return Err(MeshError::RefinedRadius { refined_radius, radius });
        }
        if let Some(growth) = growth
            && !(growth > 1.0 && growth <= 2.0)
        {
            return Err(MeshError::Growth(growth));
        }
        // A block of fewer than two cells a side has no free corner to draw in.
        let m = (refined_radius / size * (1.0 - 1e-12)).ceil().max(2.0);
        let near = m * size / (2.0 * radius);
        let growth = growth.unwrap_or(default_growth(m));
        let far = FAR_BLOCK.max(near * growth);
        let n_rings = ((far / near).ln() / growth.ln()).round().max(1.0);
        let n_elements = 2.0 * m * (m + n_rings);
        if n_elements > f64::from(u32::MAX / 2) {
            return Err(MeshError::TooLarge(n_elements));
        }
        Ok(Layout {
            block: Block::new(m, self.edge.is_some()),
            n_rings: n_rings as usize,
            near,
            far,
        })
    }

    /// Returns (r, y) of ζ = x + i y.
    fn image(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let scale = 2.0 * self.radius / ((1.0 + x) * (1.0 + x) + y * y);
        [scale * y, scale * (x * (1.0 + x) + y * y)]
    }

    /// Returns (r, y) of ζ with 1/ζ = x − i y.
    fn far_image(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let scale = 2.0 * self.radius / ((1.0 + x) * (1.0 + x) + y * y);
        [scale * y, scale * (1.0 + x)]
    }
}

impl Layout {
    fn ring(&self, ring: usize) -> Ring {
        let length = (self.far / self.near).ln();
        let x = length * ring as f64 / self.n_rings as f64;
        let fade = |x: f64| fade(x, length);
        Ring { near: self.near, log_radius: x, near_share: fade(x), far_share: fade(length - x) }
    }
}
