//! Elements that lie anywhere, in blocks of four lanes.

use fem_element::QuadGeometry;

use super::lanes::LANES;
use super::shape::Shape;

/// Four elements.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(crate) struct Block {
    pub corners: [[u32; LANES]; 4],
    pub shape: Shape<LANES>,
}

/// Elements of a body. Every corner number is below `n_nodes`, which lets
/// the kernels index without a check.
#[derive(Debug, Clone)]
pub(crate) struct Blocks {
    blocks: Vec<Block>,
    n_nodes: usize,
}

impl Blocks {
    /// Packs integrated elements, quads of so many nodes. Lane l takes the l-th stretch of the
    /// elements, so that the lanes of a block share no node and their sums do
    /// not wait for each other. Empty lanes have no stiffness and point at
    /// node 0.
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

    /// The blocks, after a check that nodal fields are long enough for them.
    #[inline(always)]
    pub fn checked(&self, field_lengths: &[usize]) -> &[Block] {
        assert!(field_lengths.iter().all(|&length| length >= self.n_nodes));
        &self.blocks
    }
}
