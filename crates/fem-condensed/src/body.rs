//! A body condensed to its contact nodes.
//!
//! The free body is held at its far pole (K becomes positive definite) and loaded at the contact
//! nodes; its own inertia balances the loads:
//!
//! ```math
//! \hat B = B - M\mathbf 1\,\mathbf r^T/m, \qquad
//! C = \hat B^T K^{-1}\hat B = C_{pin} - \frac{\mathbf r\mathbf w^T + \mathbf w\mathbf r^T}{m}
//! + \mathbf r\mathbf r^T\,\frac{\mathbf 1^TM\,K^{-1}M\mathbf 1}{m^2}, \qquad
//! \mathbf w = B^TK^{-1}M\mathbf 1, \quad \mathbf r = B^T\mathbf 1 .
//! ```
//!
//! B holds unit forces along the axis, inward, so r = 1; a balanced load asks nothing of the hold,
//! and B̂ᵀ takes the mean motion out of the displacements. C (m/N) is the inward displacement of the
//! contact nodes relative to the mass centre. With the contact unknowns last in the factor,
//! C_pin = (L₂₂L₂₂ᵀ)⁻¹, L₂₂ the trailing block: no solution with a right-hand side a node.

use faer::Mat;
use fem_element::{QuadGeometry, mean_gradient};
use fem_material::{ElasticModuli, Material};
use fem_mesh::{Side, SphereMesh, lump_mass};

use crate::CondensedError;
use crate::assembly::{Assembly, equations_of};
use crate::dense::{cholesky, invert_lower};
use crate::factor::Factor;
use crate::numbering::{FIXED, Numbering};

/// A sphere's mesh, factor and contact compliance; instantaneous moduli.
#[derive(Debug)]
pub(crate) struct CondensedBody {
    pub mesh: SphereMesh,
    pub material: Material,
    pub numbering: Numbering,
    pub factor: Factor,
    /// Lumped masses of the nodes, kg.
    pub nodal_mass: Vec<f64>,
    /// Mass of each equation, the ground's last, kg.
    pub mass_of_equation: Vec<f64>,
    /// Whether an equation, the ground's last, is along the axis.
    pub is_axial: Vec<bool>,
    pub mass: f64,
    /// +1 if inward is +y, for the upper body, −1 for the lower.
    pub inward: f64,
    /// Contact compliance, m/N.
    pub compliance: Mat<f64>,
    /// Its lower Cholesky factor.
    pub compliance_factor: Mat<f64>,
}

impl CondensedBody {
    /// Factors the stiffness and condenses it to the given surface nodes.
    ///
    /// # Errors
    /// A stiffness without factor, missing memory.
    pub fn new(
        mesh: SphereMesh,
        material: Material,
        contact_nodes: &[u32],
    ) -> Result<Self, CondensedError> {
        let numbering = Numbering::new(&mesh, contact_nodes)?;
        let moduli = *material.instantaneous();
        let assembly = Assembly::new(&mesh, &moduli, &numbering);
        let factor = Factor::new(&assembly.stiffness)?;
        let nodal_mass = lump_mass(&mesh, material.density(), &assembly.nodal_volumes);
        let n = numbering.n_equations;
        let (mut mass_of_equation, mut is_axial) = (vec![0.0; n + 1], vec![false; n + 1]);
        for (equations, mass) in numbering.equations.iter().zip(&nodal_mass) {
            for (component, &equation) in equations.iter().enumerate() {
                if equation != FIXED {
                    mass_of_equation[equation as usize] = *mass;
                    is_axial[equation as usize] = component == 1;
                }
            }
        }
        let mass = nodal_mass.iter().sum();
        let inward = match mesh.side() {
            Side::Above => 1.0,
            Side::Below => -1.0,
        };
        let mut body = Self {
            mesh,
            material,
            numbering,
            factor,
            nodal_mass,
            mass_of_equation,
            is_axial,
            mass,
            inward,
            compliance: Mat::new(),
            compliance_factor: Mat::new(),
        };
        body.compliance = body.condense()?;
        body.compliance_factor =
            cholesky(&body.compliance).ok_or(CondensedError::NotPositiveDefinite)?;
        Ok(body)
    }

    fn condense(&self) -> Result<Mat<f64>, CondensedError> {
        let (n, n_contact) = (self.numbering.n_equations, self.numbering.n_contact);
        let axial_mass = |equation: usize| {
            if self.is_axial[equation] { self.mass_of_equation[equation] } else { 0.0 }
        };
        let mut response = Mat::from_fn(n, 1, |i, _| axial_mass(i));
        self.factor.solve(response.as_mut())?;
        let weighted: f64 = (0..n).map(|i| axial_mass(i) * response[(i, 0)]).sum();
        let first = self.numbering.first_contact();
        let inverse = invert_lower(&self.factor.trailing(n_contact));
        let pinned = inverse.transpose() * &inverse;
        let w = |i: usize| response[(first + i, 0)];
        let m = self.mass;
        Ok(Mat::from_fn(n_contact, n_contact, |i, j| {
            pinned[(i, j)] - (w(i) + w(j)) / m + weighted / (m * m)
        }))
    }

    /// Balanced unit loads at the contact nodes, inward, one a column; the ground's row last, N.
    pub fn balanced_loads(&self) -> Mat<f64> {
        let (n, first) = (self.numbering.n_equations, self.numbering.first_contact());
        Mat::from_fn(n + 1, self.numbering.n_contact, |i, j| {
            let applied = if i == first + j { 1.0 } else { 0.0 };
            self.inward * (applied - self.inertia_share(i))
        })
    }

    /// Inward forces at the contact nodes with the inertia that balances them, N.
    pub fn balanced_load(&self, forces: &[f64]) -> Mat<f64> {
        let (n, first) = (self.numbering.n_equations, self.numbering.first_contact());
        let total: f64 = forces.iter().sum();
        Mat::from_fn(n + 1, 1, |i, _| {
            let applied = i.checked_sub(first).and_then(|k| forces.get(k)).copied().unwrap_or(0.0);
            self.inward * (applied - total * self.inertia_share(i))
        })
    }

    /// Share of an equation in the inertia along the axis.
    fn inertia_share(&self, equation: usize) -> f64 {
        if self.is_axial[equation] { self.mass_of_equation[equation] / self.mass } else { 0.0 }
    }

    /// Solves for balanced loads (N) in place; the ground stays at 0, m.
    ///
    /// # Errors
    /// Missing memory.
    pub fn solve_balanced(&self, loads: &mut Mat<f64>) -> Result<(), CondensedError> {
        let n = self.numbering.n_equations;
        for column in 0..loads.ncols() {
            loads[(n, column)] = 0.0;
        }
        self.factor.solve(loads.as_mut().subrows_mut(0, n))
    }

    /// Subtracts the mass-weighted mean axial motion of each column, m.
    pub fn remove_mean_motion(&self, fields: &mut Mat<f64>) {
        for mut column in fields.as_mut().col_iter_mut() {
            let equations = || self.is_axial.iter().zip(&self.mass_of_equation).enumerate();
            let sum: f64 = equations()
                .filter(|(_, (axial, _))| **axial)
                .map(|(i, (_, m))| m * column[i])
                .sum();
            let mean = sum / self.mass;
            for (i, _) in equations().filter(|(_, (axial, _))| **axial) {
                column[i] -= mean;
            }
        }
    }

    /// Product of the deviatoric stiffness with fields, ground's row included, N.
    pub fn apply_deviatoric(&self, fields: &Mat<f64>) -> Mat<f64> {
        let moduli: &ElasticModuli = self.material.instantaneous();
        let n_columns = fields.ncols();
        // Equations of an element are scattered: work on rows that lie together.
        let rows = fields.nrows();
        let (mut input, mut output) = (vec![0.0; rows * n_columns], vec![0.0; rows * n_columns]);
        for j in 0..n_columns {
            for i in 0..rows {
                input[i * n_columns + j] = fields[(i, j)];
            }
        }
        for (element, quad) in self.mesh.quads().iter().enumerate() {
            let geometry = QuadGeometry::new(&self.mesh.corners(element));
            let matrix = mean_gradient(&geometry).deviatoric * moduli.shear_modulus();
            let equations = equations_of(quad, &self.numbering);
            for (a, &row) in equations.iter().enumerate() {
                if row == FIXED {
                    continue;
                }
                let target = &mut output[row as usize * n_columns..][..n_columns];
                for (b, &column) in equations.iter().enumerate() {
                    if column == FIXED {
                        continue;
                    }
                    let (factor, source) =
                        (matrix[(a, b)], &input[column as usize * n_columns..][..n_columns]);
                    for (target, source) in target.iter_mut().zip(source) {
                        *target += factor * source;
                    }
                }
            }
        }
        Mat::from_fn(rows, n_columns, |i, j| output[i * n_columns + j])
    }

    /// Nodal displacements (u_r, u_y) of a field given by equations, m.
    pub fn nodal_field(&self, field: &[f64]) -> Vec<[f64; 2]> {
        let value = |equation: u32| if equation == FIXED { 0.0 } else { field[equation as usize] };
        self.numbering.equations.iter().map(|equations| equations.map(value)).collect()
    }

    /// Bytes of the factor.
    pub fn bytes(&self) -> usize {
        self.factor.bytes()
    }
}

#[cfg(test)]
mod tests {
    use fem_mesh::HalfDisc;

    use super::*;

    pub(crate) fn unit_sphere(size: f64, n_contact: usize) -> CondensedBody {
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(2.488, 0.244).unwrap();
        let material = Material::new(1.0, moduli, None).unwrap();
        let mesh =
            HalfDisc { radius: 1.0, contact_element_size: size, refined_radius: 0.4, growth: None }
                .build()
                .unwrap();
        let contact = mesh.surface()[..n_contact].to_vec();
        CondensedBody::new(mesh, material, &contact).unwrap()
    }

    /// The trailing block of the factor gives what full solutions give.
    #[test]
    fn compliance_is_that_of_full_solutions() {
        for side in [Side::Above, Side::Below] {
            let body = unit_sphere(0.1, 5);
            let (mesh, material) = (body.mesh.clone().on_side(side), body.material.clone());
            let contact = mesh.surface()[..5].to_vec();
            let body = CondensedBody::new(mesh, material, &contact).unwrap();
            let loads = body.balanced_loads();
            let mut fields = loads.clone();
            body.solve_balanced(&mut fields).unwrap();
            let full = loads.transpose() * &fields;
            for i in 0..5 {
                for j in 0..5 {
                    // Rounding times the condition of the stiffness, 1e4.
                    let error = (full[(i, j)] - body.compliance[(i, j)]).abs();
                    assert!(error < 1e-11 * body.compliance[(0, 0)], "{error:e}");
                }
            }
            // The same once more, as displacements relative to the mass centre.
            body.remove_mean_motion(&mut fields);
            let first = body.numbering.first_contact();
            let inward = body.inward * fields[(first + 1, 3)];
            assert!((inward - body.compliance[(1, 3)]).abs() < 1e-11 * body.compliance[(0, 0)]);
        }
    }

    /// Balanced loads ask nothing of the hold: the forces of the solution are the loads, the
    /// ground's among them.
    #[test]
    fn the_hold_carries_nothing() {
        let body = unit_sphere(0.1, 4);
        let loads = body.balanced_load(&[1.0, -0.3, 0.2, 0.7]);
        let total: f64 =
            (0..loads.nrows()).filter(|&i| body.is_axial[i]).map(|i| loads[(i, 0)]).sum();
        assert!(total.abs() < 1e-14);
    }
}
