//! Geometry of several elements, as the kernels of small strain read it.

use fem_element::QuadGeometry;

/// Geometry of as many elements as a kernel treats together, a lane each.
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
    /// Lanes without stiffness.
    pub const EMPTY: Self = Self {
        gradient_r: [[0.0; N]; 3],
        gradient_y: [[0.0; N]; 3],
        hoop: [[0.0; N]; 4],
        hourglass: [[0.0; N]; 3],
        hourglass_stiffness: [[0.0; N]; 3],
    };

    /// Puts an element in a lane, its corners in the given order.
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
