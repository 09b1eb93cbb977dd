//! The forces of the contact on the nodes that it can push.

use super::Contact;
use crate::part::Field;

/// Forces of the contact on the nodes of a body that it can push.
#[derive(Debug)]
pub(crate) struct PushedNodes {
    nodes: Vec<usize>,
    /// Their forces by the contact, N.
    forces: Vec<[f64; 2]>,
}

impl PushedNodes {
    /// Finds the nodes of a side, 0 lower, 1 upper.
    pub fn new(contact: &dyn Contact, side: usize) -> Self {
        let mut nodes: Vec<_> = contact.pushed_nodes(side);
        nodes.sort_unstable();
        nodes.dedup();
        let nodes: Vec<_> = nodes.into_iter().map(|node| node as usize).collect();
        Self { forces: vec![[0.0; 2]; nodes.len()], nodes }
    }

    /// Takes all forces before those of the contact are added.
    pub fn begin(&mut self, all: &Field) {
        for (force, &node) in self.forces.iter_mut().zip(&self.nodes) {
            *force = all[node];
        }
    }

    /// Takes all forces with those of the contact, and keeps the difference.
    pub fn end(&mut self, all: &Field) {
        for (force, &node) in self.forces.iter_mut().zip(&self.nodes) {
            *force = [all[node][0] - force[0], all[node][1] - force[1]];
        }
    }

    /// Returns the power of the forces at the velocities of the nodes, W.
    pub fn power(&self, velocity: &Field) -> f64 {
        let nodes = self.forces.iter().zip(&self.nodes);
        nodes
            .map(|(force, &node)| {
                let v = velocity[node];
                force[0] * v[0] + force[1] * v[1]
            })
            .sum()
    }

    /// Returns the sum of the forces along +y, N.
    pub fn resultant(&self) -> f64 {
        self.forces.iter().map(|force| force[1]).sum()
    }
}
