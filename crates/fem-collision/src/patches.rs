//! Smooth fields from one value an element: superconvergent patch recovery.
//!
//! The value at a node is that of the linear field which fits the values at the centres of the
//! elements around best (Zienkiewicz & Zhu 1992): a weighted mean, whose weights depend on the mesh
//! alone.

use fem_mesh::SphereMesh;
use nalgebra::{Matrix3, Vector3};

/// The weights of each node's elements.
#[derive(Debug, Clone)]
pub(crate) struct Patches {
    /// First weight of each node, and the end of the last.
    starts: Vec<usize>,
    /// Element and its weight.
    weights: Vec<(u32, f64)>,
}

impl Patches {
    /// Fits the elements around each node of a mesh.
    pub fn new(mesh: &SphereMesh) -> Self {
        let n_nodes = mesh.nodes().len();
        let mut around: Vec<Vec<u32>> = vec![Vec::with_capacity(4); n_nodes];
        for (element, quad) in mesh.quads().iter().enumerate() {
            for &node in quad {
                around[node as usize].push(element as u32);
            }
        }
        let centres: Vec<[f64; 2]> = (0..mesh.quads().len())
            .map(|element| mesh.corners(element))
            .map(|corners| {
                [0, 1].map(|axis: usize| corners.map(|x| x[axis]).iter().sum::<f64>() / 4.0)
            })
            .collect();
        let mut on_boundary = vec![false; n_nodes];
        for &node in mesh.axis().iter().chain(mesh.surface()).chain(mesh.far_boundary()) {
            on_boundary[node as usize] = true;
        }
        let mut patches = Self { starts: vec![0], weights: Vec::with_capacity(5 * n_nodes) };
        let mut patch = Vec::new();
        for (node, &origin) in mesh.nodes().iter().enumerate() {
            patch.clone_from(&around[node]);
            if on_boundary[node] {
                // One element deep decides no gradient: take the next ring too.
                let corners =
                    around[node].iter().flat_map(|&element| mesh.quads()[element as usize]);
                patch.extend(corners.flat_map(|corner| around[corner as usize].iter().copied()));
                patch.sort_unstable();
                patch.dedup();
            }
            patches.add(origin, &patch, &centres);
        }
        patches
    }

    /// Weights for the value at `origin` of the linear field that fits a patch.
    fn add(&mut self, origin: [f64; 2], patch: &[u32], centres: &[[f64; 2]]) {
        let offset = |element: u32| {
            let [r, y] = centres[element as usize];
            [r - origin[0], y - origin[1]]
        };
        let square =
            patch.iter().map(|&e| offset(e)).fold(0.0, |s: f64, [r, y]| s.max(r * r + y * y));
        let size = square.sqrt();
        let basis = |element: u32| {
            let [r, y] = offset(element);
            Vector3::new(1.0, r / size, y / size)
        };
        let matrix: Matrix3<f64> = patch.iter().map(|&e| basis(e) * basis(e).transpose()).sum();
        // The first row of the inverse; the plain mean where no gradient is decided.
        let row = match matrix.cholesky() {
            Some(factor) => factor.solve(&Vector3::x()),
            None => Vector3::x() / patch.len() as f64,
        };
        self.weights.extend(patch.iter().map(|&element| (element, row.dot(&basis(element)))));
        self.starts.push(self.weights.len());
    }

    /// Elements around a node and their weights.
    pub fn weights(&self, node: usize) -> &[(u32, f64)] {
        &self.weights[self.starts[node]..self.starts[node + 1]]
    }

    /// Four components at every node from those of the elements.
    pub fn smooth(&self, cells: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let patches = self.starts.windows(2).map(|ends| &self.weights[ends[0]..ends[1]]);
        let points = patches.map(|weights| {
            let mut point = [0.0; 4];
            for &(element, weight) in weights {
                for (sum, value) in point.iter_mut().zip(cells[element as usize]) {
                    *sum += weight * value;
                }
            }
            point
        });
        points.collect()
    }
}

#[cfg(test)]
mod tests {
    use fem_mesh::{HalfDisc, Side};

    use super::*;

    #[test]
    fn linear_stress_is_recovered_exactly() {
        for side in [Side::Above, Side::Below] {
            let disc = HalfDisc {
                radius: 1.0,
                contact_element_size: 0.05,
                refined_radius: 0.2,
                growth: None,
            };
            let mesh = disc.build().unwrap().on_side(side);
            let stress = |[r, y]: [f64; 2]| {
                [1.0 + 2.0 * y - 3.0 * r, 0.5 - y + 4.0 * r, 1.0 + 2.0 * y - 3.0 * r, 0.7 * r]
            };
            let mean_of = |corners: [[f64; 2]; 4], axis: usize| {
                corners.iter().map(|corner| corner[axis]).sum::<f64>() / 4.0
            };
            let cells: Vec<_> = (0..mesh.quads().len())
                .map(|element| mesh.corners(element))
                .map(|corners| stress([mean_of(corners, 0), mean_of(corners, 1)]))
                .collect();
            for (node, point) in Patches::new(&mesh).smooth(&cells).into_iter().enumerate() {
                let exact = stress(mesh.nodes()[node]);
                for (value, exact) in point.into_iter().zip(exact) {
                    // Rounding of a fit over up to a dozen elements.
                    assert!((value - exact).abs() < 1e-13, "node {node}: {point:?}");
                }
            }
        }
    }
}
