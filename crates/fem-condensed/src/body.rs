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
//!
//! A half-space is held where it ends and has infinite mass: nothing moves it, C = C_pin.

use faer::sparse::SymbolicSparseColMat;
use faer::{ColRef, Mat};
use fem_material::Material;
use fem_mesh::{Side, SphereMesh, lump_mass};

use crate::assembly::Assembly;
use crate::dense::{cholesky, invert_lower};
use crate::error::CondensedError;
use crate::factor::Factor;
use crate::numbering::{FIXED, Numbering};

/// A body's mesh, factor and contact compliance; instantaneous moduli.
#[derive(Debug)]
pub(crate) struct CondensedBody {
    pub mesh: SphereMesh,
    pub numbering: Numbering,
    pub factor: Factor,
    /// Places of the stiffness' upper triangle, without the ground.
    pub pattern: SymbolicSparseColMat<u32>,
    /// The deviatoric stiffness there, N/m.
    pub deviatoric: Vec<f64>,
    /// Lumped masses of the nodes, kg.
    pub nodal_mass: Vec<f64>,
    /// Mass of each equation, the ground's last, kg.
    pub mass_of_equation: Vec<f64>,
    /// Whether an equation, the ground's last, is along the axis.
    pub is_axial: Vec<bool>,
    /// kg; infinite for a half-space.
    pub mass: f64,
    /// +1 if inward is +y, for the upper body, −1 for the lower.
    pub inward: f64,
    /// Displacements under the inertia of a unit acceleration, m/(m/s²).
    inertia_response: Vec<f64>,
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
        material: &Material,
        contact_nodes: &[u32],
    ) -> Result<Self, CondensedError> {
        let numbering = Numbering::new(&mesh, contact_nodes)?;
        let moduli = *material.instantaneous();
        let assembly = Assembly::new(&mesh, &moduli, &numbering);
        let factor = Factor::new(&assembly.stiffness)?;
        let (pattern, _) = assembly.stiffness.into_parts();
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
        let mass = match mesh.is_half_space() {
            true => f64::INFINITY,
            false => nodal_mass.iter().sum(),
        };
        let inward = match mesh.side() {
            Side::Above => 1.0,
            Side::Below => -1.0,
        };
        let mut body = Self {
            mesh,
            numbering,
            factor,
            pattern,
            deviatoric: assembly.deviatoric,
            nodal_mass,
            mass_of_equation,
            is_axial,
            mass,
            inward,
            inertia_response: Vec::new(),
            compliance: Mat::new(),
            compliance_factor: Mat::new(),
        };
        body.inertia_response = body.respond_to_inertia();
        body.compliance = body.condense();
        body.compliance_factor =
            cholesky(&body.compliance).ok_or(CondensedError::NotPositiveDefinite)?;
        Ok(body)
    }

    /// w over all equations, K⁻¹M1.
    fn respond_to_inertia(&self) -> Vec<f64> {
        let n = self.numbering.n_equations;
        if self.mass.is_infinite() {
            return vec![0.0; n];
        }
        let mut response = Mat::from_fn(n, 1, |i, _| self.mass * self.inertia_share(i));
        self.factor.solve(response.as_mut());
        response.col(0).iter().copied().collect()
    }

    fn condense(&self) -> Mat<f64> {
        let (n_contact, first) = (self.numbering.n_contact, self.numbering.first_contact());
        let (w, m) = (&self.inertia_response, self.mass);
        let inverse = invert_lower(&self.factor.trailing(n_contact));
        let pinned = inverse.transpose() * &inverse;
        if m.is_infinite() {
            return pinned;
        }
        let weighted: f64 = w.iter().enumerate().map(|(i, w)| m * self.inertia_share(i) * w).sum();
        Mat::from_fn(n_contact, n_contact, |i, j| {
            pinned[(i, j)] - (w[first + i] + w[first + j]) / m + weighted / (m * m)
        })
    }

    /// Displacements under balanced loads at the contact nodes (the ground's row last, m), combined
    /// so that they are orthonormal in the stiffness: K⁻¹B̂ L_c⁻ᵀ, one a contact node.
    pub fn orthonormal_answers(&self) -> Mat<f64> {
        let (n, n_contact) = (self.numbering.n_equations, self.numbering.n_contact);
        let loads = invert_lower(&self.compliance_factor).transpose().to_owned();
        // Loads at the last equations leave nothing to do for the forward substitution.
        let last = invert_lower(&self.factor.trailing(n_contact)) * &loads;
        let mut answers = Mat::zeros(n + 1, n_contact);
        answers.subrows_mut(n - n_contact, n_contact).copy_from(last);
        self.factor.solve_transposed(answers.as_mut().subrows_mut(0, n));
        let totals: Vec<f64> = loads.col_iter().map(|column| column.iter().sum()).collect();
        for (answer, total) in answers.as_mut().col_iter_mut().zip(totals) {
            for (value, w) in answer.iter_mut().zip(&self.inertia_response) {
                *value = self.inward * (*value - w * total / self.mass);
            }
        }
        answers
    }

    /// Inward forces at the contact nodes, a case a column, with the inertia that balances them, N.
    pub fn balanced_load(&self, forces: &Mat<f64>) -> Mat<f64> {
        let (n, first) = (self.numbering.n_equations, self.numbering.first_contact());
        let totals: Vec<f64> = forces.col_iter().map(|column| column.iter().sum()).collect();
        Mat::from_fn(n + 1, forces.ncols(), |i, j| {
            let applied = match i.checked_sub(first) {
                Some(k) if k < forces.nrows() => forces[(k, j)],
                _ => 0.0,
            };
            self.inward * (applied - totals[j] * self.inertia_share(i))
        })
    }

    /// Share of an equation in the inertia along the axis.
    fn inertia_share(&self, equation: usize) -> f64 {
        if self.is_axial[equation] { self.mass_of_equation[equation] / self.mass } else { 0.0 }
    }

    /// Solves for balanced loads (N) in place; the ground stays at 0, m.
    pub fn solve_balanced(&self, loads: &mut Mat<f64>) {
        let n = self.numbering.n_equations;
        loads.as_mut().row_mut(n).fill(0.0);
        self.factor.solve(loads.as_mut().subrows_mut(0, n));
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

    /// Nodal displacements (u_r, u_y) of a field given by equations, m.
    pub fn nodal_field(&self, field: ColRef<'_, f64>) -> Vec<[f64; 2]> {
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
    use fem_material::ElasticModuli;
    use fem_mesh::HalfDisc;

    use super::*;

    fn unit_sphere(size: f64, n_contact: usize, side: Side) -> CondensedBody {
        let moduli = ElasticModuli::from_youngs_modulus_poissons_ratio(2.488, 0.244).unwrap();
        let material = Material::new(1.0, moduli, None).unwrap();
        let mesh =
            HalfDisc { radius: 1.0, contact_element_size: size, refined_radius: 0.4, growth: None }
                .build()
                .unwrap()
                .on_side(side);
        let contact = mesh.surface()[..n_contact].to_vec();
        CondensedBody::new(mesh, &material, &contact).unwrap()
    }

    /// The trailing block of the factor gives what full solutions give.
    #[test]
    fn compliance_is_that_of_full_solutions() {
        for side in [Side::Above, Side::Below] {
            let body = unit_sphere(0.1, 5, side);
            let loads = body.balanced_load(&Mat::identity(5, 5));
            let mut fields = loads.clone();
            body.solve_balanced(&mut fields);
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
            // And combined: C L_c⁻ᵀ = L_c.
            let mut answers = body.orthonormal_answers();
            body.remove_mean_motion(&mut answers);
            for i in 0..5 {
                for j in 0..5 {
                    let error =
                        body.inward * answers[(first + i, j)] - body.compliance_factor[(i, j)];
                    assert!(error.abs() < 1e-11 * body.compliance_factor[(0, 0)], "{error:e}");
                }
            }
        }
    }

    /// Balanced loads ask nothing of the hold: the forces of the solution are the loads, the
    /// ground's among them.
    #[test]
    fn the_hold_carries_nothing() {
        let body = unit_sphere(0.1, 4, Side::Above);
        let loads = body.balanced_load(&Mat::from_fn(4, 1, |i, _| [1.0, -0.3, 0.2, 0.7][i]));
        let total: f64 =
            (0..loads.nrows()).filter(|&i| body.is_axial[i]).map(|i| loads[(i, 0)]).sum();
        assert!(total.abs() < 1e-14);
    }
}
