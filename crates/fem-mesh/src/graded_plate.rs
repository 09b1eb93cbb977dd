//! The graded plate: the meridian of a plate that is struck in its middle.
//!
//! The half strip of thickness h, contact pole at z = 0, is the image of the quarter plane Re ζ ≥ 0, Im ζ ≥ 0 under the
//! conformal map
//!
//! ```math
//! z = \frac{2h}\pi\arcsin\zeta, \qquad z = (\text{depth}) + i\,r .
//! ```
//!
//! The imaginary axis becomes the struck face, the real axis up to ζ = 1 the axis, and beyond it the other face. So a mesh of the
//! quarter plane as that of a half-space (`quarter_disc`) has cells that grow from the contact to the thickness and keep their
//! angles:
//!
//! * a block of m × m cells of equal size at the contact, its free corner drawn in; with an `edge`, of more and uneven columns (`contact_edge`);
//! * rings of as many cells as the outline of the block has, radii in geometric progression, to |ζ| = 1, where the corner of axis and far face is;
//! * rings beyond, of constant width once they are as wide as the waves in the plate allow, which end in the straight rim.

use std::f64::consts::{FRAC_PI_2, LN_2};

use crate::error::MeshError;
use crate::rings::{Block, Ring, Station, default_growth, fade, quad};
use crate::sphere_mesh::SphereMesh;

/// Least radius of a plate over its thickness: nearer to the axis the cells at the rim would be skewed.
const MIN_RADIUS: f64 = 1.5;
/// Largest half-width of the block over the thickness: beyond it few cells are left between the contact and the far face.
const MAX_BLOCK: f64 = 0.4;
/// Ratio of the widths of successive rings beyond the corner of axis and far face.
const WIDENING: f64 = 1.15;

/// Parameters of the graded plate; lengths in m.
///
/// ```
/// use fem_mesh::GradedPlate;
///
/// let plate = GradedPlate {
///     thickness: 5e-3,
///     radius: 0.06,
///     has_held_rim: true,
///     is_bonded: false,
///     contact_element_size: 30e-6,
///     refined_radius: 0.3e-3,
///     growth: None,
///     ring_width: 2e-3,
///     edge: None,
/// };
/// assert!(plate.n_elements()? < 3000);
/// assert_eq!(plate.build()?.far_boundary().len(), 21);
/// # Ok::<(), fem_mesh::MeshError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradedPlate {
    /// Thickness of the plate.
    pub thickness: f64,
    /// Distance of the rim from the axis.
    pub radius: f64,
    /// Whether the rim is part of the far boundary, which keeps its velocity.
    pub has_held_rim: bool,
    /// Whether the far face is part of the far boundary.
    pub is_bonded: bool,
    /// Edge length of the elements at the contact pole.
    pub contact_element_size: f64,
    /// Half-width of the block of equal elements at the contact pole.
    pub refined_radius: f64,
    /// Ratio of the radii of successive rings up to the far face; `None` for the one that makes
    /// their cells square, 1 + π/(4 m).
    pub growth: Option<f64>,
    /// Largest width of a ring.
    pub ring_width: f64,
    /// Expected radius of a contact whose pressure is uniform up to its edge, for which the columns of the block are more, and
    /// narrow at the edge; `None` for square elements.
    pub edge: Option<f64>,
}

/// Numbers of cells, and the rings.
struct Layout {
    block: Block,
    /// Half-width of the block in ζ.
    near: f64,
    /// Number of rings up to |ζ| = 1.
    n_inner: usize,
    /// ln |ζ| of the rings beyond, as if they were circles.
    outer: Vec<f64>,
}

impl GradedPlate {
    /// Returns the number of elements that [`GradedPlate::build`] makes.
    ///
    /// # Errors
    /// The errors are those of [`GradedPlate::build`].
    pub fn n_elements(&self) -> Result<usize, MeshError> {
        let layout = self.layout()?;
        let n_rings = layout.n_inner + layout.outer.len();
        Ok(layout.block.n_cells() + layout.block.around() * n_rings)
    }

    /// Makes the mesh, body in y ≥ 0, contact pole at the origin.
    ///
    /// # Errors
    /// Lengths that are not positive and finite, a fine block too large for the thickness, a radius below 1.5 thicknesses, a
    /// growth outside of (1, 2], more elements than can be numbered.
    pub fn build(&self) -> Result<SphereMesh, MeshError> {
        let layout = self.layout()?;
        let (block, n_inner) = (layout.block, layout.n_inner);
        let around = block.around();
        let n_rings = n_inner + layout.outer.len();
        let (mut nodes, mut quads) = (Vec::new(), Vec::new());

        nodes.extend(block.nodes().map(|at| {
            let [x, y] = block.place(at);
            self.place(arcsine([layout.near * x, layout.near * y]))
        }));
        let block_node = |i: usize, j: usize| block.node([i, j]) as u32;
        quads.extend(block.cells().map(|[i, j]| quad(&block_node, i, j)));

        // Rings; station k runs from the axis, or the far face, to the struck face.
        let first_ring = nodes.len();
        let stations = Station::all(block);
        let length = -layout.near.ln();
        for ring in 1..=n_inner {
            let x = length * ring as f64 / n_inner as f64;
            let near_share = if ring == n_inner { 0.0 } else { fade(x, length) };
            let ring = Ring { near: layout.near, log_radius: x, near_share, far_share: 0.0 };
            nodes.extend(stations.iter().map(|station| self.place(arcsine(ring.point(station)))));
        }
        // |ζ| = 1 but for rounding.
        nodes[first_ring + (n_inner - 1) * (around + 1)] = [0.0, self.thickness];
        for (k, &log_radius) in layout.outer.iter().enumerate() {
            let straight = (k + 1) as f64 / layout.outer.len() as f64;
            nodes.extend(stations.iter().map(|station| {
                self.place(outer_point(log_radius, station.depth_angle(), straight))
            }));
        }
        let ring_node = |ring: usize, k: usize| match ring {
            0 => block.node(block.outline(k)) as u32,
            _ => (first_ring + (ring - 1) * (around + 1) + k) as u32,
        };
        for ring in 0..n_rings {
            quads.extend((0..around).map(|k| quad(&ring_node, ring, k)));
        }

        let axis = (0..=block.rows)
            .map(|i| block_node(i, 0))
            .chain((1..=n_inner).map(|ring| ring_node(ring, 0)));
        let surface = (0..=block.columns)
            .map(|j| block_node(0, j))
            .chain((1..=n_rings).map(|ring| ring_node(ring, around)));
        let (axis, surface) = (axis.collect(), surface.collect());
        let far_face = (n_inner..=n_rings).map(|ring| ring_node(ring, 0));
        let mut far_boundary: Vec<u32> = far_face.filter(|_| self.is_bonded).collect();
        if self.has_held_rim {
            far_boundary
                .extend((usize::from(self.is_bonded)..=around).map(|k| ring_node(n_rings, k)));
        }
        let mesh = SphereMesh::from_parts(f64::INFINITY, nodes, quads, axis, surface, far_boundary);
        Ok(mesh.with_thickness(self.thickness).narrowed_at(self.edge, self.refined_radius))
    }

    /// Returns (r, y) of arcsin ζ.
    fn place(&self, [depth, r]: [f64; 2]) -> [f64; 2] {
        let scale = self.thickness / FRAC_PI_2;
        [scale * r, if depth == FRAC_PI_2 { self.thickness } else { scale * depth }]
    }

    fn layout(&self) -> Result<Layout, MeshError> {
        let &GradedPlate { thickness, radius, contact_element_size: size, .. } = self;
        for (name, value) in [
            ("thickness", thickness),
            ("plate radius", radius),
            ("contact element size", size),
            ("refined radius", self.refined_radius),
            ("ring width", self.ring_width),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(MeshError::Length { name, value });
            }
        }
        if let Some(growth) = self.growth
            && !(growth > 1.0 && growth <= 2.0)
        {
            return Err(MeshError::Growth(growth));
        }
        // A block of fewer than two cells a side has no free corner to draw in.
        let m = (self.refined_radius / size * (1.0 - 1e-12)).ceil().max(2.0);
        if m * size > MAX_BLOCK * thickness {
            return Err(MeshError::ThinPlate { thickness, least: m * size / MAX_BLOCK });
        }
        if radius < MIN_RADIUS * thickness {
            return Err(MeshError::NarrowPlate { radius, least: MIN_RADIUS * thickness });
        }
        let near = FRAC_PI_2 * m * size / thickness;
        let growth = self.growth.unwrap_or(default_growth(m));
        let n_inner = (-near.ln() / growth.ln()).round().max(1.0);
        let widest = FRAC_PI_2 * self.ring_width / thickness;
        // At the rim r = (2h/π)(ln |ζ| + ln 2).
        let end = FRAC_PI_2 * radius / thickness - LN_2;
        let n_outer = end / growth.ln().min(widest);
        let n_elements = m * (m + 2.0 * (n_inner + n_outer));
        if n_elements > f64::from(u32::MAX / 2) {
            return Err(MeshError::TooLarge(n_elements));
        }
        let mut outer = Vec::new();
        let (mut width, mut at) = (growth.ln(), 0.0);
        while at < end {
            at += width.min(widest);
            outer.push(at);
            width *= WIDENING;
        }
        // The last ring is the rim.
        let stretch = end / at;
        outer.iter_mut().for_each(|at| *at *= stretch);
        Ok(Layout {
            block: Block::new(m, self.edge.is_some()),
            near,
            n_inner: n_inner as usize,
            outer,
        })
    }
}

/// Returns arcsin ζ of the quarter plane, real part first (Hull, Fairgrieve & Tang 1997, *ACM Trans. Math. Softw.* 23, 299).
fn arcsine([a, b]: [f64; 2]) -> [f64; 2] {
    if b == 0.0 && a <= 1.0 {
        return [a.asin(), 0.0];
    }
    let (beyond, before) = ((a + 1.0).hypot(b), (a - 1.0).hypot(b));
    let half = match a < 1.0 {
        true => b * b / (before + (1.0 - a)),
        false => before + (a - 1.0),
    };
    let excess = 0.5 * (b * b / (beyond + (a + 1.0)) + half);
    let real = if b == 0.0 { FRAC_PI_2 } else { (a / (1.0 + excess)).min(1.0).asin() };
    [real, (excess + (excess * (excess + 2.0)).sqrt()).ln_1p()]
}

/// Returns arcsin ζ at ln |ζ| > 0 and the depth that a far ring has at this station, blended by a share into that straight ring.
fn outer_point(log_radius: f64, depth: f64, straight: f64) -> [f64; 2] {
    /// ln |ζ| beyond which both are the same to rounding.
    const FAR: f64 = 20.0;
    let far = [depth, log_radius + LN_2];
    if log_radius > FAR {
        return far;
    }
    let (radius, angle) = (log_radius.exp(), FRAC_PI_2 - depth);
    // The faces stay straight.
    let near = match depth {
        0.0 => arcsine([0.0, radius]),
        FRAC_PI_2 => arcsine([radius, 0.0]),
        _ => arcsine([radius * angle.cos(), radius * angle.sin()]),
    };
    let blended = |i: usize| near[i] + straight * (far[i] - near[i]);
    let is_on_face = depth == 0.0 || depth == FRAC_PI_2;
    [if is_on_face { depth } else { blended(0) }, blended(1)]
}
