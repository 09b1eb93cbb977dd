//! The elements of a body, as the kernels of small strain go through them.

use fem_element::QuadGeometry;

use super::block::Blocks;
use super::rows::Rows;

/// Those that lie in rows, and the others.
#[derive(Debug, Clone)]
pub(crate) struct Elements {
    pub rows: Rows,
    pub others: Blocks,
}

impl Elements {
    /// Packs integrated elements, quads of so many nodes.
    pub fn pack(n_nodes: usize, quads: &[[u32; 4]], geometries: &[QuadGeometry]) -> Self {
        let (rows, others) = Rows::pack(n_nodes, quads, geometries);
        let others = others.iter().map(|&element| (quads[element], &geometries[element]));
        Self { rows, others: Blocks::pack(n_nodes, others) }
    }
}
