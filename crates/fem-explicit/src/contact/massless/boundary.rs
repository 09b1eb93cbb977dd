//! The massless nodes of one body, and the elements around them.

use fem_collision::BodyInput;
use fem_element::{ElementMatrix, QuadGeometry};
use fem_mesh::SphereMesh;

use crate::error::ModelError;
use crate::part::{Field, MotionMut};
use crate::stress::{Collapse, SmallStrainStress, small_strain};

/// The boundary of a body that deforms.
#[derive(Debug)]
pub(super) struct Boundary {
    /// Massless nodes, from the axis outward.
    pub nodes: Vec<u32>,
    /// Their distances from the axis, m.
    pub radii: Vec<f64>,
    /// For each massless node, a node next to it that has mass.
    neighbours: Vec<u32>,
    quads: Vec<[u32; 4]>,
    geometries: Vec<QuadGeometry>,
    /// Stress of these elements alone.
    stress: Box<dyn SmallStrainStress>,
    /// All nodes of these elements.
    touched: Vec<u32>,
    n_nodes: usize,
}

impl Boundary {
    /// Takes the massless nodes of a body; `None` for a rigid body.
    ///
    /// # Errors
    /// No corner of an element has mass.
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

    /// Returns the number of nodes of the whole body.
    pub fn n_nodes(&self) -> usize {
        self.n_nodes
    }

    /// Takes the time step, s.
    pub fn set_time_step(&mut self, time_step: f64) {
        self.stress.set_time_step(time_step);
    }

    /// Returns its elements and their stiffness against what a step adds at its end.
    pub fn elements(&self) -> impl Iterator<Item = (&[u32; 4], ElementMatrix)> {
        let pairs = self.quads.iter().zip(&self.geometries);
        pairs.map(|(quad, geometry)| (quad, self.stress.stiffness_of_step(geometry)))
    }

    /// Overwrites the forces (N) of its elements on their nodes; forces at other nodes stay.
    ///
    /// # Errors
    /// An element has collapsed, which does not happen at small strain.
    pub fn update_forces(
        &self,
        motion: &MotionMut<'_>,
        forces: &mut Field,
    ) -> Result<(), Collapse> {
        self.touched.iter().for_each(|&node| forces[node as usize] = [0.0; 2]);
        self.stress.subtract_forces(&motion.as_motion(), motion.stress_history, forces)
    }

    /// Moves a node by a further displacement (m) in a step that has been taken, given the inverse of its time, 1/s.
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

    /// Returns the nodes whose forces [`Boundary::hand_over`] changes.
    pub fn pushed_nodes(&self) -> Vec<u32> {
        [&self.nodes[..], &self.neighbours].concat()
    }

    /// Moves the forces (N) at massless nodes, which are rounding errors of their balance, to their neighbours, so that the
    /// forces on both bodies stay opposite and equal.
    pub fn hand_over(&self, forces: &mut Field) {
        for (&node, &neighbour) in self.nodes.iter().zip(&self.neighbours) {
            let [r, y] = std::mem::take(&mut forces[node as usize]);
            forces[neighbour as usize][0] += r;
            forces[neighbour as usize][1] += y;
        }
    }
}

/// Returns the nearest node with mass that shares an element with a massless node.
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
