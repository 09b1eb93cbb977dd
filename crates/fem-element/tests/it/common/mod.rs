//! A patch of distorted elements, and dense algebra on it.

#![allow(dead_code, reason = "each test file uses its share")]

use fem_element::{ElementMatrix, ElementStiffness, QuadGeometry, b_bar, mean_gradient};
use nalgebra::{DMatrix, DVector};

/// ν = 0.244, moduli in units of Young's.
pub const BULK: f64 = 1.0 / (3.0 * (1.0 - 2.0 * 0.244));
pub const SHEAR: f64 = 1.0 / (2.0 * 1.244);

/// A quad without any symmetry.
pub const DISTORTED: [[f64; 2]; 4] = [[1.0, 0.1], [2.3, -0.2], [2.0, 1.4], [0.8, 1.1]];

/// Element matrices from the corners.
pub type Kind = fn(&[[f64; 2]; 4]) -> ElementStiffness;

/// Both kinds of element.
pub const KINDS: [(&str, Kind); 2] =
    [("mean gradient", |corners| mean_gradient(&QuadGeometry::new(corners))), ("b_bar", b_bar)];

/// Numbers in −1/2 .. 1/2 without pattern: the golden ratio's multiples.
pub fn noise(k: usize) -> f64 {
    (k as f64 * 0.618_033_988_749_895 + 0.29).fract() - 0.5
}

/// `n` × `n` elements over r0 ..= r0 + 1, 0 ≤ y ≤ 1, inner nodes displaced.
pub struct Patch {
    pub n: usize,
    pub nodes: Vec<[f64; 2]>,
    pub quads: Vec<[usize; 4]>,
}

impl Patch {
    pub fn new(r0: f64, n: usize) -> Self {
        let mut nodes = Vec::new();
        for i in 0..=n {
            for j in 0..=n {
                let inside = (1..n).contains(&i) && (1..n).contains(&j);
                let draw = if inside { 0.5 / n as f64 } else { 0.0 };
                let k = nodes.len();
                nodes.push([
                    r0 + i as f64 / n as f64 + draw * noise(2 * k),
                    j as f64 / n as f64 + draw * noise(2 * k + 1),
                ]);
            }
        }
        let number = |i: usize, j: usize| i * (n + 1) + j;
        let quads = (0..n * n)
            .map(|e| {
                let (i, j) = (e / n, e % n);
                [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
            })
            .collect();
        Self { n, nodes, quads }
    }

    pub fn corners(&self, element: usize) -> [[f64; 2]; 4] {
        self.quads[element].map(|node| self.nodes[node])
    }

    pub fn is_inside(&self, node: usize) -> bool {
        let (i, j) = (node / (self.n + 1), node % (self.n + 1));
        (1..self.n).contains(&i) && (1..self.n).contains(&j)
    }

    pub fn on_axis(&self, node: usize) -> bool {
        self.nodes[node][0] == 0.0
    }

    /// The degrees of freedom that are not held on the axis.
    pub fn free(&self) -> Vec<usize> {
        let is_free = |i: &usize| i % 2 == 1 || !self.on_axis(i / 2);
        (0..2 * self.nodes.len()).filter(is_free).collect()
    }

    pub fn assemble(&self, element: impl Fn(&[[f64; 2]; 4]) -> ElementMatrix) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(2 * self.nodes.len(), 2 * self.nodes.len());
        for (e, quad) in self.quads.iter().enumerate() {
            let part = element(&self.corners(e));
            for i in 0..8 {
                for j in 0..8 {
                    let (row, column) = (2 * quad[i / 2] + i % 2, 2 * quad[j / 2] + j % 2);
                    matrix[(row, column)] += part[(i, j)];
                }
            }
        }
        matrix
    }

    /// Displacements (u_r, u_y) of a field of (r, y), degrees of freedom in order.
    pub fn field(&self, field: impl Fn([f64; 2]) -> [f64; 2]) -> DVector<f64> {
        DVector::from_iterator(2 * self.nodes.len(), self.nodes.iter().flat_map(|&p| field(p)))
    }
}

/// Rows and columns of the degrees of freedom that `keep` names.
pub fn restricted(matrix: &DMatrix<f64>, keep: &[usize]) -> DMatrix<f64> {
    matrix.select_rows(keep).select_columns(keep)
}
