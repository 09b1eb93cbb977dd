//! Elements in blocks of eight lanes, as the kernels read them.

use fem_element::QuadGeometry;
use fem_mesh::SphereMesh;

/// Elements that one pass of a kernel treats together.
pub(crate) const LANES: usize = 8;

/// One number of each element of a block.
pub(crate) type Lanes = [f64; LANES];

/// Geometry of eight elements.
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
    pub gradient_r: [Lanes; 3],
    pub gradient_y: [Lanes; 3],
    pub hoop: [Lanes; 4],
    pub hourglass: [Lanes; 3],
    /// k_rr, k_yy, k_ry for unit shear modulus, m.
    pub hourglass_stiffness: [Lanes; 3],
}

/// Packs the elements of a mesh. Empty lanes of the last block have no stiffness
/// and point at node 0.
pub(crate) fn pack_blocks(mesh: &SphereMesh) -> Vec<Block> {
    let empty = Block {
        corners: [[0; LANES]; 4],
        gradient_r: [[0.0; LANES]; 3],
        gradient_y: [[0.0; LANES]; 3],
        hoop: [[0.0; LANES]; 4],
        hourglass: [[0.0; LANES]; 3],
        hourglass_stiffness: [[0.0; LANES]; 3],
    };
    let n_elements = mesh.quads().len();
    let mut blocks = vec![empty; n_elements.div_ceil(LANES)];
    for element in 0..n_elements {
        let geometry = QuadGeometry::new(&mesh.corners(element));
        let scale = geometry.volume.sqrt();
        let (block, lane) = (&mut blocks[element / LANES], element % LANES);
        for a in 0..4 {
            block.corners[a][lane] = mesh.quads()[element][a];
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
    blocks
}
