//! The elements of a body by the equations of their corners.

use fem_mesh::SphereMesh;

use crate::numbering::Numbering;

/// Lower triangle of an element's matrix, row by row; degrees of freedom u_r, u_y corner by corner.
pub(crate) type Lower = [f64; 36];

/// Equations of an element's degrees of freedom; those from the number of equations on are the ground's or
/// fixed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementEquations {
    pub equations: [u32; 8],
}

impl ElementEquations {
    /// Of all elements.
    pub fn of_mesh(mesh: &SphereMesh, numbering: &Numbering) -> Vec<Self> {
        let of_corner = |node: u32| numbering.equations[node as usize];
        let of_quad = |quad: &[u32; 4]| {
            let equations = std::array::from_fn(|i| of_corner(quad[i / 2])[i % 2]);
            Self { equations }
        };
        mesh.quads().iter().map(of_quad).collect()
    }

    /// Those of so many equations.
    pub fn solved(&self, n_equations: usize) -> impl Iterator<Item = u32> {
        self.equations.into_iter().filter(move |&equation| (equation as usize) < n_equations)
    }
}
