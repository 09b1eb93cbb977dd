//! The nodes without mass of one body, and the elements that pull at them.

use fem_collision::BodyInput;
use fem_element::{ElementMatrix, QuadGeometry};
use fem_mesh::SphereMesh;

use crate::error::ModelError;
use crate::part::{Field, MotionMut};
use crate::stress::{Collapse, SmallStrainStress, small_strain};

/// The boundary of a body that deforms.
#[derive(Debug)]
pub(super) struct Boundary {
    /// Nodes without mass, from the axis outward.
    pub nodes: Vec<u32>,
    /// Their distances from the axis, m.
    pub radii: Vec<f64>,
    /// Of each a node next to it that has mass.
    neighbours: Vec<u32>,
    quads: Vec<[u32; 4]>,
    geometries: Vec<QuadGeometry>,
    /// Of these elements alone.
    stress: Box<dyn SmallStrainStress>,
    /// All nodes of theirs.
    touched: Vec<u32>,
    n_nodes: usize,
}

impl Boundary {
    /// Of a body whose nodes without mass are these; `None` of a rigid one.
    ///
    /// # Errors
    /// An element none of whose corners has mass.
    pub fn new(body: &BodyInput, mut nodes: Vec<u32>) -> Result<Option<Self>, ModelError> {
        let (Some(mesh), Some(material)) = (body.mesh(), body.material()) else { return Ok(None) };
        let radius = |node: u32| mesh.nodes()[node as usize][0];
        nodes.sort_by(|&a, &b| radius(a).total_cmp(&radius(b)));
        nodes.dedup();
        let elements: Vec<_> = (0..mesh.quads().len())
            .filter(|&element| mesh.quads()[element].iter().any(|node| nodes.contains(node)))
            .collect();
        let quads: Vec<_> = elements.iter().map(|&element| mesh.quads()[element]).collect();
        let geometries: Vec<_> =
            elements.iter().map(|&element| QuadGeometry::new(&mesh.corners(element))).collect();
        let bare = |quad: &[u32; 4]| quad.iter().all(|node| nodes.contains(node));
        if let Some(k) = quads.iter().position(bare) {
            return Err(ModelError::NoInterior { element: elements[k] });
        }
        let stress = small_strain(mesh.nodes().len(), &quads, &geometries, material);
        let neighbours = nodes.iter().map(|&node| neighbour(mesh, &quads, &nodes, node)).collect();
        let mut touched = quads.concat();
        touched.sort_unstable();
        touched.dedup();
        let radii = nodes.iter().map(|&node| radius(node)).collect();
        let n_nodes = mesh.nodes().len();
        Ok(Some(Self { nodes, radii, neighbours, quads, geometries, stress, touched, n_nodes }))
    }

    /// Nodes of the whole body.
    pub fn n_nodes(&self) -> usize {
        self.n_nodes
    }

    /// Told the time step, s.
    pub fn set_time_step(&mut self, time_step: f64) {
        self.stress.set_time_step(time_step);
    }

    /// Returns its elements and their stiffness against what a step adds at its end.
    pub fn elements(&self) -> impl Iterator<Item = (&[u32; 4], ElementMatrix)> {
        let pairs = self.quads.iter().zip(&self.geometries);
        pairs.map(|(quad, geometry)| (quad, self.stress.stiffness_of_step(geometry)))
    }

    /// Overwrites the forces (N) of its elements on their nodes, those of no other node.
    ///
    /// # Errors
    /// An element has collapsed, which none does whose stress is a linear function of the motion.
    pub fn update_forces(
        &self,
        motion: &MotionMut<'_>,
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        self.touched.iter().for_each(|&node| forces[node as usize] = [0.0; 2]);
        self.stress.subtract_forces(&motion.as_motion(), motion.stress_history, forces)
    }

    /// Moves a node by so much more (m) in a step (s) that is done.
    pub fn shift(
        &self,
        motion: &mut MotionMut<'_>,
        node: u32,
        change: [f64; 2],
        inverse_step: f64,
    ) {
        let node = node as usize;
        for (axis, change) in change.into_iter().enumerate() {
            motion.displacement[node][axis] += change;
            motion.velocity[node][axis] += change * inverse_step;
        }
        self.stress.shift(node, change, motion.stress_history);
    }

    /// Those that [`Boundary::hand_over`] changes.
    pub fn pushed_nodes(&self) -> Vec<u32> {
        [&self.nodes[..], &self.neighbours].concat()
    }

    /// What rounding leaves of the balance of a node without mass acts on its neighbour: forces (N) of
    /// both bodies stay opposite and equal.
    pub fn hand_over(&self, forces: &mut Field) {
        for (&node, &neighbour) in self.nodes.iter().zip(&self.neighbours) {
            let [r, y] = std::mem::take(&mut forces[node as usize]);
            forces[neighbour as usize][0] += r;
            forces[neighbour as usize][1] += y;
        }
    }
}

/// The nearest node that has mass, of those that share an element with one that has none.
fn neighbour(mesh: &SphereMesh, quads: &[[u32; 4]], massless: &[u32], node: u32) -> u32 {
    let place = |node: u32| mesh.nodes()[node as usize];
    let [r, y] = place(node);
    let distance = |other: u32| (place(other)[0] - r).hypot(place(other)[1] - y);
    let around = quads.iter().filter(|quad| quad.contains(&node)).flatten().copied();
    around
        .filter(|other| !massless.contains(other))
        .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
        .unwrap_or(node)
}
