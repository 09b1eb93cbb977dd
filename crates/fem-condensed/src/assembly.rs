//! The stiffness matrix of a body, assembled in the order of elimination.

use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use fem_element::{QuadGeometry, mean_gradient};
use fem_material::ElasticModuli;
use fem_mesh::SphereMesh;

use crate::numbering::Numbering;

/// A body's matrices.
pub(crate) struct Assembly {
    /// Upper triangle of the stiffness, N/m.
    pub stiffness: SparseColMat<u32, f64>,
    /// Lumped shares of the elements' volumes, m³.
    pub nodal_volumes: Vec<[f64; 4]>,
}

/// Entry of the upper triangle.
#[derive(Clone, Copy, Default)]
struct Entry {
    row: u32,
    column: u32,
    value: f64,
}

/// Equations of an element's eight degrees of freedom.
pub(crate) fn equations_of(quad: &[u32; 4], numbering: &Numbering) -> [u32; 8] {
    std::array::from_fn(|i| numbering.equations[quad[i / 2] as usize][i % 2])
}

impl Assembly {
    /// Of a mesh with the given moduli.
    pub fn new(mesh: &SphereMesh, moduli: &ElasticModuli, numbering: &Numbering) -> Self {
        let mut entries = Vec::with_capacity(36 * mesh.quads().len());
        let mut nodal_volumes = Vec::with_capacity(mesh.quads().len());
        for (element, quad) in mesh.quads().iter().enumerate() {
            let geometry = QuadGeometry::new(&mesh.corners(element));
            let matrix =
                mean_gradient(&geometry).combine(moduli.bulk_modulus(), moduli.shear_modulus());
            nodal_volumes.push(geometry.nodal_volumes);
            let equations = equations_of(quad, numbering);
            for i in 0..8 {
                for j in 0..=i {
                    let (row, column) =
                        (equations[i].min(equations[j]), equations[i].max(equations[j]));
                    if (column as usize) < numbering.n_equations {
                        entries.push(Entry { row, column, value: matrix[(i, j)] });
                    }
                }
            }
        }
        let stiffness = compress(entries, numbering.n_equations);
        Self { stiffness, nodal_volumes }
    }
}

/// Sorts by column and row, sums what falls on the same place in the order of the elements.
fn compress(entries: Vec<Entry>, n: usize) -> SparseColMat<u32, f64> {
    let by_row = counting_sort(&entries, n, |entry| entry.row);
    let sorted = counting_sort(&by_row, n, |entry| entry.column);
    let mut starts = vec![0u32; n + 1];
    let (mut rows, mut values) = (Vec::with_capacity(n * 10), Vec::<f64>::with_capacity(n * 10));
    let mut last = None;
    for entry in sorted {
        if last == Some((entry.row, entry.column)) {
            if let Some(value) = values.last_mut() {
                *value += entry.value;
            }
        } else {
            rows.push(entry.row);
            values.push(entry.value);
            starts[entry.column as usize + 1] += 1;
            last = Some((entry.row, entry.column));
        }
    }
    for i in 0..n {
        starts[i + 1] += starts[i];
    }
    SparseColMat::new(SymbolicSparseColMat::new_checked(n, n, starts, None, rows), values)
}

/// Stable.
fn counting_sort(entries: &[Entry], n: usize, key: impl Fn(&Entry) -> u32) -> Vec<Entry> {
    let mut places = vec![0usize; n + 1];
    for entry in entries {
        places[key(entry) as usize + 1] += 1;
    }
    for i in 0..n {
        places[i + 1] += places[i];
    }
    let mut sorted = vec![Entry::default(); entries.len()];
    for entry in entries {
        let place = &mut places[key(entry) as usize];
        sorted[*place] = *entry;
        *place += 1;
    }
    sorted
}
