//! The order in which a body's degrees of freedom are eliminated.
//!
//! Fixed is u_r on the axis; u_y of the far pole, the ground, is held and not eliminated, which makes
//! the stiffness of a free body positive definite. A half-space is held at its far boundary instead, and
//! has no ground. The interior comes first,
//! in the order of approximate minimum degree (Amestoy, Davis & Duff 1996) of the graph of nodes;
//! then u_r of the contact nodes; last their u_y, from the axis outward, so that the trailing block
//! of the Cholesky factor is all that contact needs.

use dyn_stack::{MemBuffer, MemStack};
use faer::dyn_stack;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use fem_mesh::SphereMesh;

use crate::error::CondensedError;

/// Marks a degree of freedom that does not move.
pub(crate) const FIXED: u32 = u32::MAX;

/// Equation numbers of the degrees of freedom.
#[derive(Debug, Clone)]
pub(crate) struct Numbering {
    /// Equations of (u_r, u_y) of each node, or [`FIXED`]; the ground comes after all equations, if there
    /// is one.
    pub equations: Vec<[u32; 2]>,
    /// Equations that are solved, the ground not counted.
    pub n_equations: usize,
    pub n_contact: usize,
}

impl Numbering {
    /// With u_y of the given surface nodes last.
    ///
    /// # Errors
    /// Memory for the ordering is missing.
    pub fn new(mesh: &SphereMesh, contact_nodes: &[u32]) -> Result<Self, CondensedError> {
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
        let mut interior = vec![0; n_nodes];
        for &node in contact_nodes {
            interior[node as usize] = FIXED;
        }
        let mut order = eliminate_interior(mesh, &mut interior)?;
        order.extend(contact_nodes.iter().map(|&node| [node, 0]));
        order.extend(contact_nodes.iter().map(|&node| [node, 1]));
        let mut n_equations = 0;
        for [node, component] in order {
            let equation = &mut equations[node as usize][component as usize];
            if *equation != FIXED {
                *equation = n_equations;
                n_equations += 1;
            }
        }
        if !mesh.is_half_space() {
            equations[ground][1] = n_equations;
        }
        Ok(Self { equations, n_equations: n_equations as usize, n_contact: contact_nodes.len() })
    }

    /// First equation of the contact unknowns.
    pub fn first_contact(&self) -> usize {
        self.n_equations - self.n_contact
    }
}

/// (node, component) of all nodes that are not marked, in the order of elimination. `local` is
/// overwritten by the numbers of the unmarked nodes in their graph.
fn eliminate_interior(
    mesh: &SphereMesh,
    local: &mut [u32],
) -> Result<Vec<[u32; 2]>, CondensedError> {
    let mut nodes = Vec::with_capacity(local.len());
    for (node, number) in local.iter_mut().enumerate() {
        if *number != FIXED {
            *number = nodes.len() as u32;
            nodes.push(node as u32);
        }
    }
    let n = nodes.len();
    // Every pair of corners once an element: an interior edge comes twice, which does no harm.
    let mut pairs = Vec::with_capacity(6 * mesh.quads().len());
    for quad in mesh.quads() {
        let corners = quad.map(|node| local[node as usize]);
        for i in 0..4 {
            for j in 0..i {
                let (a, b) = (corners[i].min(corners[j]), corners[i].max(corners[j]));
                if b != FIXED {
                    pairs.push((b, a));
                }
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    let mut starts = vec![0u32; n + 1];
    for &(column, _) in &pairs {
        starts[column as usize + 1] += 1;
    }
    for i in 0..n {
        starts[i + 1] += starts[i];
    }
    let rows: Vec<u32> = pairs.into_iter().map(|(_, row)| row).collect();
    let graph = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &rows);
    let (mut order, mut inverse) = (vec![0u32; n], vec![0u32; n]);
    let request = amd::order_maybe_unsorted_scratch::<u32>(n, rows.len());
    let mut memory = MemBuffer::try_new(request).map_err(|_| CondensedError::OutOfMemory)?;
    amd::order_maybe_unsorted(
        &mut order,
        &mut inverse,
        graph,
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(|_| CondensedError::OutOfMemory)?;
    Ok(order.into_iter().flat_map(|k| [[nodes[k as usize], 0], [nodes[k as usize], 1]]).collect())
}
