//! The graded quarter disc: the meridian of a half-space, out to a distance.
//!
//! The half disc of a sphere is a conformal image of this quarter plane (`half_disc`). Here the map is left out, and so is
//! the block at infinity:
//!
//! * a block of m × m cells of equal size at the contact, its free corner drawn in; with an `edge`, of more and uneven columns (`contact_edge`);
//! * rings of as many cells as the outline of the block has, radii in geometric progression;
//! * the last ring, a circle: the far boundary, beyond which the half-space goes on.
//!
//! Cells keep their shape and are in proportion to the distance from the contact, so the number of
//! elements grows with the logarithm of the far radius alone.

use crate::error::MeshError;
use crate::rings::{Block, Ring, Station, default_growth, fade, quad};
use crate::sphere_mesh::SphereMesh;

/// Parameters of the graded quarter disc; lengths in m.
///
/// ```
/// use fem_mesh::QuarterDisc;
///
/// let block = |far_radius| QuarterDisc {
///     far_radius,
///     contact_element_size: 10e-6,
///     refined_radius: 0.1e-3,
///     growth: None,
///     edge: None,
/// };
/// let (near, far) = (block(0.1), block(100.0));
/// assert!(far.n_elements()? < 3 * near.n_elements()?);
/// assert!(near.build()?.is_half_space());
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuarterDisc {
    /// Distance of the far boundary from the contact pole.
    pub far_radius: f64,
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

/// Numbers of cells and radii of the mesh.
struct Layout {
    block: Block,
    n_rings: usize,
    /// Half-width of the block, m.
    near: f64,
}

impl QuarterDisc {
    /// Returns the number of elements that [`QuarterDisc::build`] makes.
    ///
    /// # Errors
    /// The errors are those of [`QuarterDisc::build`].
    pub fn n_elements(&self) -> Result<usize, MeshError> {
        let layout = self.layout()?;
        Ok(layout.block.n_cells() + layout.block.around() * layout.n_rings)
    }

    /// Makes the mesh, body in y ≥ 0, contact pole at the origin.
    ///
    /// # Errors
    /// Lengths that are not positive and finite, a far radius below twice the fine block's
    /// half-width, a growth outside of (1, 2], more elements than can be numbered.
    pub fn build(&self) -> Result<SphereMesh, MeshError> {
        let layout = self.layout()?;
        let (block, n_rings) = (layout.block, layout.n_rings);
        let around = block.around();
        let (mut nodes, mut quads) = (Vec::new(), Vec::new());
        // The quarter plane's axis is that of the body: (depth, r) → (r, y).
        let place = |[depth, r]: [f64; 2]| [r, depth];

        nodes.extend(block.nodes().map(|at| {
            let [x, y] = block.place(at);
            place([layout.near * x, layout.near * y])
        }));
        let block_node = |i: usize, j: usize| block.node([i, j]) as u32;
        quads.extend(block.cells().map(|[i, j]| quad(&block_node, i, j)));

        // Rings; station k runs from the axis to the surface.
        let first_ring = nodes.len();
        let stations = Station::all(block);
        for ring in 1..=n_rings {
            let ring = self.ring(&layout, ring);
            nodes.extend(stations.iter().map(|station| place(ring.point(station))));
        }
        let ring_node = |ring: usize, k: usize| match ring {
            0 => block.node(block.outline(k)) as u32,
            _ => (first_ring + (ring - 1) * (around + 1) + k) as u32,
        };
        for ring in 0..n_rings {
            quads.extend((0..around).map(|k| quad(&ring_node, ring, k)));
        }

        let rings = || 1..=n_rings;
        let axis = (0..=block.rows)
            .map(|i| block_node(i, 0))
            .chain(rings().map(|ring| ring_node(ring, 0)));
        let surface = (0..=block.columns)
            .map(|j| block_node(0, j))
            .chain(rings().map(|ring| ring_node(ring, around)));
        let (axis, surface) = (axis.collect(), surface.collect());
        let far_boundary = (0..=around).map(|k| ring_node(n_rings, k)).collect();
        let mesh = SphereMesh::from_parts(f64::INFINITY, nodes, quads, axis, surface, far_boundary);
        Ok(mesh.narrowed_at(self.edge, self.refined_radius))
    }

    fn layout(&self) -> Result<Layout, MeshError> {
        let &QuarterDisc { far_radius, contact_element_size: size, refined_radius, growth, .. } =
            self;
        for (name, value) in [
            ("far radius", far_radius),
            ("contact element size", size),
            ("refined radius", refined_radius),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(MeshError::Length { name, value });
            }
        }
        if let Some(growth) = growth
            && !(growth > 1.0 && growth <= 2.0)
        {
            return Err(MeshError::Growth(growth));
        }
        // A block of fewer than two cells a side has no free corner to draw in.
        let m = (refined_radius / size * (1.0 - 1e-12)).ceil().max(2.0);
        let near = m * size;
        if far_radius < 2.0 * near {
            return Err(MeshError::FarRadius { far_radius, refined_radius: near });
        }
        let growth = growth.unwrap_or(default_growth(m));
        let n_rings = ((far_radius / near).ln() / growth.ln()).round().max(1.0);
        let n_elements = m * (m + 2.0 * n_rings);
        if n_elements > f64::from(u32::MAX / 2) {
            return Err(MeshError::TooLarge(n_elements));
        }
        Ok(Layout { block: Block::new(m, self.edge.is_some()), n_rings: n_rings as usize, near })
    }

    fn ring(&self, layout: &Layout, ring: usize) -> Ring {
        let length = (self.far_radius / layout.near).ln();
        let x = length * ring as f64 / layout.n_rings as f64;
        Ring { near: layout.near, log_radius: x, near_share: fade(x, length), far_share: 0.0 }
    }
}
