//! The order in which a body's degrees of freedom are eliminated.
//!
//! u_r is fixed on the axis. u_y of the far pole, the ground, is fixed too, which makes the stiffness of a free body
//! positive definite. A half-space is fixed at its far boundary instead, and has no ground. The interior comes first,
//! by nested dissection ([`Dissection`]), then u_r of the contact nodes, last their u_y from the axis outward. So the
//! trailing block of the Cholesky factor is sufficient for contact.

use crate::condensation::dissection::Dissection;
use fem_mesh::SphereMesh;

/// Equation number of a fixed degree of freedom.
pub(crate) const FIXED: u32 = u32::MAX;

/// Equation numbers of the degrees of freedom.
#[derive(Debug, Clone)]
pub(crate) struct Numbering {
    /// Equations of (u_r, u_y) of each node, or [`FIXED`]. The fixed ground, if any, is the last
    /// equation.
    pub equations: Vec<[u32; 2]>,
    /// Number of equations without the ground.
    pub n_equations: usize,
    pub n_contact: usize,
    /// End of each set of equations that are eliminated together; the last set is that of the contact.
    pub ends: Vec<usize>,
}

impl Numbering {
    /// Numbers the equations of a mesh, with u_y of the given surface nodes last.
    pub fn new(mesh: &SphereMesh, contact_nodes: &[u32]) -> Self {
        let n_nodes = mesh.nodes().len();
        let mut equations = vec![[0; 2]; n_nodes];
        for &node in mesh.axis() {
            equations[node as usize][0] = FIXED;
        }
        let ground = mesh.axis()[mesh.axis().len() - 1] as usize;
        equations[ground][1] = FIXED;
        for &node in mesh.far_boundary() {
            equations[node as usize] = [FIXED; 2];
        }
        let mut is_contact = vec![false; n_nodes];
        for &node in contact_nodes {
            is_contact[node as usize] = true;
        }
        let interior = Dissection::new(mesh, |node| !is_contact[node]);
        let mut n_equations = 0;
        let mut number = |node: u32, component: usize| {
            let equation = &mut equations[node as usize][component];
            if *equation != FIXED {
                *equation = n_equations;
                n_equations += 1;
            }
            n_equations as usize
        };
        let mut ends = Vec::with_capacity(interior.ends.len() + 1);
        let mut nodes = interior.nodes.iter();
        let mut end = 0;
        let starts = [0].iter().chain(&interior.ends);
        for (start, stop) in starts.zip(&interior.ends) {
            for &node in nodes.by_ref().take(stop - start) {
                end = number(node, 0).max(number(node, 1));
            }
            ends.push(end);
        }
        for component in 0..2 {
            for &node in contact_nodes {
                end = number(node, component);
            }
        }
        ends.push(end);
        // Sets of fixed degrees of freedom are empty.
        ends.dedup();
        if ends.first() == Some(&0) {
            ends.remove(0);
        }
        if !mesh.is_half_space() {
            equations[ground][1] = n_equations;
        }
        let n_equations = n_equations as usize;
        Self { equations, n_equations, n_contact: contact_nodes.len(), ends }
    }

    /// Returns the first equation of the contact unknowns.
    pub fn first_contact(&self) -> usize {
        self.n_equations - self.n_contact
    }
}

/// Lower triangle of an element's matrix, row by row; degrees of freedom u_r, u_y corner by corner.
pub(crate) type Lower = [f64; 36];

/// Equations of an element's degrees of freedom. Values from the number of equations on are the ground or fixed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementEquations {
    pub equations: [u32; 8],
}

impl ElementEquations {
    /// Returns the equations of all elements.
    pub fn of_mesh(mesh: &SphereMesh, numbering: &Numbering) -> Vec<Self> {
        let of_corner = |node: u32| numbering.equations[node as usize];
        let of_quad = |quad: &[u32; 4]| {
            let equations = std::array::from_fn(|i| of_corner(quad[i / 2])[i % 2]);
            Self { equations }
        };
        mesh.quads().iter().map(of_quad).collect()
    }

    /// Returns the equations that are not fixed.
    pub fn solved(&self, n_equations: usize) -> impl Iterator<Item = u32> {
        self.equations.into_iter().filter(move |&equation| (equation as usize) < n_equations)
    }
}
