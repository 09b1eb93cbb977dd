//! Elements in blocks of four lanes, as the kernels read them.

use fem_element::QuadGeometry;

use super::lanes::LANES;

/// One number of each element of a block.
type Numbers = [f64; LANES];

/// Geometry of four elements.
///
/// Gradients are scaled by the square root of the element's volume: strains
/// come out as ε √V, and the same gradients turn stresses of that scale into
/// forces. Gradients and hourglass shapes sum to zero over the corners, so those
/// of corner 3 are left out and displacements are taken relative to it: a rigid
/// translation gives exactly no force.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(crate) struct Block {
    pub corners: [[u32; LANES]; 4],
    pub gradient_r: [Numbers; 3],
    pub gradient_y: [Numbers; 3],
    pub hoop: [Numbers; 4],
    pub hourglass: [Numbers; 3],
    /// k_rr, k_yy, k_ry for unit shear modulus, m.
    pub hourglass_stiffness: [Numbers; 3],
}

/// The elements of a body. Every corner number is below `n_nodes`, which lets
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
    pub fn pack(n_nodes: usize, quads: &[[u32; 4]], geometries: &[QuadGeometry]) -> Self {
        assert!(
            quads.iter().flatten().all(|&node| (node as usize) < n_nodes),
            "an element names a node that the mesh does not have"
        );
        let empty = Block {
            corners: [[0; LANES]; 4],
            gradient_r: [[0.0; LANES]; 3],
            gradient_y: [[0.0; LANES]; 3],
            hoop: [[0.0; LANES]; 4],
            hourglass: [[0.0; LANES]; 3],
            hourglass_stiffness: [[0.0; LANES]; 3],
        };
        let n_elements = geometries.len();
        let n_blocks = n_elements.div_ceil(LANES);
        let mut blocks = vec![empty; n_blocks];
        for (element, geometry) in geometries.iter().enumerate() {
            let scale = geometry.volume.sqrt();
            let (block, lane) = (&mut blocks[element % n_blocks], element / n_blocks);
            for a in 0..4 {
                block.corners[a][lane] = quads[element][a];
                block.hoop[a][lane] = scale * geometry.hoop[a];
            }
            let stiffness = geometry.hourglass_stiffness();
            for a in 0..3 {
                block.gradient_r[a][lane] = scale * geometry.gradient_r[a];
                block.gradient_y[a][lane] = scale * geometry.gradient_y[a];
                block.hourglass[a][lane] = geometry.hourglass[a];
                block.hourglass_stiffness[a][lane] = stiffness[a];
            }
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
