//! The stiffness matrix of a body, assembled in the order of elimination.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use fem_element::{QuadGeometry, mean_gradient};
use fem_material::ElasticModuli;
use fem_mesh::SphereMesh;

use crate::numbering::Numbering;

/// A body's matrices.
pub(crate) struct Assembly {
    /// Upper triangle of the stiffness without the ground, N/m.
    pub stiffness: SparseColMat<u32, f64>,
    /// Deviatoric share of the same entries, N/m.
    pub deviatoric: Vec<f64>,
    /// Lumped shares of the elements' volumes, m³.
    pub nodal_volumes: Vec<[f64; 4]>,
}

/// Degrees of freedom of an element, 0 to 7, by rising equation, and their equations.
struct ElementEquations {
    local: [usize; 8],
    equations: [u32; 8],
    /// How many of them are solved.
    n_solved: usize,
}

impl ElementEquations {
    fn new(quad: &[u32; 4], numbering: &Numbering) -> Self {
        let equation = |i: usize| numbering.equations[quad[i / 2] as usize][i % 2];
        let mut local: [usize; 8] = std::array::from_fn(|i| i);
        local.sort_unstable_by_key(|&i| equation(i));
        let equations = local.map(equation);
        // Fixed degrees of freedom and the ground have the highest numbers.
        let n_solved = equations.partition_point(|&e| (e as usize) < numbering.n_equations);
        Self { local, equations, n_solved }
    }

    /// Column by column the equations down to the diagonal, rising.
    fn columns(&self) -> impl Iterator<Item = (usize, &[u32])> {
        (0..self.n_solved).map(|j| (self.equations[j] as usize, &self.equations[..=j]))
    }
}

impl Assembly {
    /// Of a mesh with the given moduli.
    pub fn new(mesh: &SphereMesh, moduli: &ElasticModuli, numbering: &Numbering) -> Self {
        let elements: Vec<_> =
            mesh.quads().iter().map(|quad| ElementEquations::new(quad, numbering)).collect();
        let pattern = pattern(&elements, numbering.n_equations);
        let n_entries = pattern.row_idx().len();
        let (mut values, mut deviatoric) = (vec![0.0; n_entries], vec![0.0; n_entries]);
        let mut nodal_volumes = Vec::with_capacity(elements.len());
        let (bulk_modulus, shear_modulus) = (moduli.bulk_modulus(), moduli.shear_modulus());
        for (number, element) in elements.iter().enumerate() {
            let geometry = QuadGeometry::new(&mesh.corners(number));
            nodal_volumes.push(geometry.nodal_volumes);
            let matrix = mean_gradient(&geometry);
            for (j, (column, rows)) in element.columns().enumerate() {
                let mut place = pattern.col_range(column).start;
                for (i, &row) in rows.iter().enumerate() {
                    while pattern.row_idx()[place] < row {
                        place += 1;
                    }
                    let at = (element.local[i], element.local[j]);
                    let shear = shear_modulus * matrix.deviatoric[at];
                    values[place] += bulk_modulus * matrix.bulk[at] + shear;
                    deviatoric[place] += shear;
                }
            }
        }
        Self { stiffness: SparseColMat::new(pattern, values), deviatoric, nodal_volumes }
    }
}

/// Places of the entries: each column's equations once, rising.
fn pattern(elements: &[ElementEquations], n: usize) -> SymbolicSparseColMat<u32> {
    let mut ends = vec![0usize; n + 1];
    for (column, rows) in elements.iter().flat_map(ElementEquations::columns) {
        ends[column + 1] += rows.len();
    }
    for i in 0..n {
        ends[i + 1] += ends[i];
    }
    // Column by column, with repetitions; the start of a column moves to its end.
    let mut all = vec![0u32; ends[n]];
    for (column, rows) in elements.iter().flat_map(ElementEquations::columns) {
        all[ends[column]..][..rows.len()].copy_from_slice(rows);
        ends[column] += rows.len();
    }
    let mut starts = Vec::with_capacity(n + 1);
    let mut rows: Vec<u32> = Vec::with_capacity(n * 10);
    let mut begin = 0;
    for &end in &ends[..n] {
        starts.push(rows.len() as u32);
        let column = &mut all[begin..end];
        column.sort_unstable();
        let mut last = None;
        rows.extend(column.iter().copied().filter(|&row| last.replace(row) != Some(row)));
        begin = end;
    }
    starts.push(rows.len() as u32);
    SymbolicSparseColMat::new_checked(n, n, starts, None, rows)
}
