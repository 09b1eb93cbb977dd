//! Forces of the deviatoric stiffness.

use faer::Mat;
use faer::sparse::SymbolicSparseColMat;

use crate::body::CondensedBody;

/// Columns that are multiplied at a time.
const CHUNK: usize = 8;

impl CondensedBody {
    /// Product of the deviatoric stiffness with fields, ground's row included, N.
    pub fn apply_deviatoric(&self, fields: &Mat<f64>) -> Mat<f64> {
        let n = self.numbering.n_equations;
        let mut forces = Mat::zeros(n + 1, fields.ncols());
        // Entries are scattered over the rows: the columns of a chunk lie together there.
        let (mut input, mut output) = (vec![[0.0; CHUNK]; n], vec![[0.0; CHUNK]; n]);
        for start in (0..fields.ncols()).step_by(CHUNK) {
            let columns = start..(start + CHUNK).min(fields.ncols());
            for (k, j) in columns.clone().enumerate() {
                // A translation costs no force, so fields are taken relative to the ground.
                let ground = fields[(n, j)];
                for (i, row) in input.iter_mut().enumerate() {
                    row[k] = fields[(i, j)] - if self.is_axial[i] { ground } else { 0.0 };
                }
            }
            multiply(&self.pattern, &self.deviatoric, &input, &mut output);
            for (k, j) in columns.enumerate() {
                let mut axial = 0.0;
                for (i, row) in output.iter().enumerate() {
                    forces[(i, j)] = row[k];
                    axial += if self.is_axial[i] { row[k] } else { 0.0 };
                }
                forces[(n, j)] = -axial;
            }
        }
        forces
    }
}

/// Product of a symmetric matrix, given by its upper triangle, with a chunk of columns.
fn multiply(
    pattern: &SymbolicSparseColMat<u32>,
    values: &[f64],
    input: &[[f64; CHUNK]],
    output: &mut [[f64; CHUNK]],
) {
    for column in 0..input.len() {
        let entries = pattern.col_range(column);
        let (own, mut sum) = (input[column], [0.0; CHUNK]);
        for (&row, &value) in pattern.row_idx()[entries.clone()].iter().zip(&values[entries]) {
            let row = row as usize;
            if row == column {
                (0..CHUNK).for_each(|k| sum[k] += value * own[k]);
            } else {
                let (target, source) = (&mut output[row], &input[row]);
                for k in 0..CHUNK {
                    target[k] += value * own[k];
                    sum[k] += value * source[k];
                }
            }
        }
        output[column] = sum;
    }
}
