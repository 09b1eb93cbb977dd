//! The elements of a body, as the kernels of small strain read them.

use fem_element::QuadGeometry;

use super::rows::Rows;
use crate::lanes::LANES;

/// The elements of a body: those that lie in rows, and the others.
#[derive(Debug, Clone)]
pub(crate) struct PackedElements {
    pub rows: Rows,
    pub others: GatheredBlocks,
}

impl PackedElements {
    /// Packs integrated elements, quads on nodes with numbers below `n_nodes`.
    pub fn pack(n_nodes: usize, quads: &[[u32; 4]], geometries: &[QuadGeometry]) -> Self {
        let (rows, others) = Rows::pack(n_nodes, quads, geometries);
        let others = others.iter().map(|&element| (quads[element], &geometries[element]));
        Self { rows, others: GatheredBlocks::pack(n_nodes, others) }
    }
}

/// Four elements that lie anywhere.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(crate) struct Block {
    pub corners: [[u32; LANES]; 4],
    pub shape: Shape<LANES>,
}

/// Elements that lie anywhere, in blocks of four. Every corner number is below `n_nodes`, so that kernels index without a
/// check.
#[derive(Debug, Clone)]
pub(crate) struct GatheredBlocks {
    blocks: Vec<Block>,
    n_nodes: usize,
}

impl GatheredBlocks {
    /// Packs integrated elements, quads on nodes with numbers below `n_nodes`. Lane l takes the l-th part of the
    /// elements, so that the lanes of a block share no node and their sums do not wait for each other. Empty lanes have
    /// no stiffness and point at node 0.
    pub fn pack<'a>(
        n_nodes: usize,
        elements: impl ExactSizeIterator<Item = ([u32; 4], &'a QuadGeometry)>,
    ) -> Self {
        let empty = Block { corners: [[0; LANES]; 4], shape: Shape::EMPTY };
        let n_blocks = elements.len().div_ceil(LANES);
        let mut blocks = vec![empty; n_blocks];
        for (element, (quad, geometry)) in elements.enumerate() {
            let (block, lane) = (&mut blocks[element % n_blocks], element / n_blocks);
            for a in 0..4 {
                assert!(
                    (quad[a] as usize) < n_nodes,
                    "an element names a node that the mesh does not have"
                );
                block.corners[a][lane] = quad[a];
            }
            block.shape.put(lane, geometry, [0, 1, 2, 3]);
        }
        Self { blocks, n_nodes }
    }

    /// Returns the blocks, after a check that nodal fields are long enough for them.
    #[inline(always)]
    pub fn checked(&self, field_lengths: &[usize]) -> &[Block] {
        assert!(field_lengths.iter().all(|&length| length >= self.n_nodes));
        &self.blocks
    }
}

/// Geometry of the elements that a kernel treats together, one per lane.
///
/// Gradients are scaled by the square root of the element's volume: strains
/// come out as ε √V, and the same gradients turn stresses of that scale into
/// forces. Gradients and hourglass shapes sum to zero over the corners, so those
/// of corner 3 are left out and displacements are taken relative to it: a rigid
/// translation gives exactly no force.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(crate) struct Shape<const N: usize> {
    pub gradient_r: [[f64; N]; 3],
    pub gradient_y: [[f64; N]; 3],
    pub hoop: [[f64; N]; 4],
    pub hourglass: [[f64; N]; 3],
    /// k_rr, k_yy, k_ry for unit shear modulus, m.
    pub hourglass_stiffness: [[f64; N]; 3],
}

impl<const N: usize> Shape<N> {
    /// Empty lanes, without stiffness.
    pub const EMPTY: Self = Self {
        gradient_r: [[0.0; N]; 3],
        gradient_y: [[0.0; N]; 3],
        hoop: [[0.0; N]; 4],
        hourglass: [[0.0; N]; 3],
        hourglass_stiffness: [[0.0; N]; 3],
    };

    /// Puts an element into a lane, with its corners in the given order.
    pub fn put(&mut self, lane: usize, geometry: &QuadGeometry, corners: [usize; 4]) {
        let scale = geometry.volume.sqrt();
        for (a, corner) in corners.into_iter().enumerate() {
            self.hoop[a][lane] = scale * geometry.hoop[corner];
        }
        let stiffness = geometry.hourglass_stiffness();
        for (a, corner) in corners.into_iter().take(3).enumerate() {
            self.gradient_r[a][lane] = scale * geometry.gradient_r[corner];
            self.gradient_y[a][lane] = scale * geometry.gradient_y[corner];
            self.hourglass[a][lane] = geometry.hourglass[corner];
            self.hourglass_stiffness[a][lane] = stiffness[a];
        }
    }
}
