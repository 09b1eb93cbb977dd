//! Forces of the deviatoric stiffness.

use faer::Mat;
use fem_element::{QuadGeometry, mean_gradient};

use crate::condensation::condensed_body::CondensedBody;
use crate::condensation::numbering::ElementEquations;

/// Number of columns that are multiplied at a time.
const COLUMNS_AT_A_TIME: usize = 8;

impl CondensedBody {
    /// Multiplies fields by the deviatoric stiffness, including the row of the fixed degree of freedom, N.
    pub fn apply_deviatoric(&self, fields: &Mat<f64>) -> Mat<f64> {
        let n = self.numbering.n_equations;
        let elements = ElementEquations::of_mesh(&self.mesh, &self.numbering);
        let matrices: Vec<_> = (0..elements.len())
            .map(|number| mean_gradient(&QuadGeometry::new(&self.mesh.corners(number))).deviatoric)
            .collect();
        let mut forces = Mat::zeros(n + 1, fields.ncols());
        // Equations of an element are scattered over the rows: the columns of a chunk lie together there.
        let (mut input, mut output) =
            (vec![[0.0; COLUMNS_AT_A_TIME]; n], vec![[0.0; COLUMNS_AT_A_TIME]; n]);
        for start in (0..fields.ncols()).step_by(COLUMNS_AT_A_TIME) {
            let columns = start..(start + COLUMNS_AT_A_TIME).min(fields.ncols());
            for (k, j) in columns.clone().enumerate() {
                // A translation causes no force, so fields are taken relative to the fixed degree of freedom.
                let ground = fields[(n, j)];
                for (i, row) in input.iter_mut().enumerate() {
                    row[k] = fields[(i, j)] - if self.is_axial[i] { ground } else { 0.0 };
                }
            }
            output.fill([0.0; COLUMNS_AT_A_TIME]);
            for (element, matrix) in elements.iter().zip(&matrices) {
                let solved = || element.equations.into_iter().enumerate();
                for (j, from) in solved() {
                    let Some(from) = input.get(from as usize).copied() else { continue };
                    for (i, to) in solved() {
                        let Some(to) = output.get_mut(to as usize) else { continue };
                        let value = self.shear_modulus * matrix[(i, j)];
                        to.iter_mut().zip(from).for_each(|(to, from)| *to += value * from);
                    }
                }
            }
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
