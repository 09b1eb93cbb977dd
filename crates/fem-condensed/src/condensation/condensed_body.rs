//! A body condensed to its contact nodes.
//!
//! The free body is fixed at its far pole, so that K is positive definite, and loaded at the contact
//! nodes. Its own inertia balances the loads:
//!
//! ```math
//! \hat B = B - M\mathbf 1\,\mathbf r^T/m, \qquad
//! C = \hat B^T K^{-1}\hat B = C_{pin} - \frac{\mathbf r\mathbf w^T + \mathbf w\mathbf r^T}{m}
//! + \mathbf r\mathbf r^T\,\frac{\mathbf 1^TM\,K^{-1}M\mathbf 1}{m^2}, \qquad
//! \mathbf w = B^TK^{-1}M\mathbf 1, \quad \mathbf r = B^T\mathbf 1 .
//! ```
//!
//! The columns of B are inward unit forces along the axis, so r = 1. A balanced load causes no reaction at the fixed
//! node, and B̂ᵀ removes the mean motion from the displacements. C (m/N) is the inward displacement of the
//! contact nodes relative to the mass centre. With the contact unknowns last in the factor,
//! C_pin = (L₂₂L₂₂ᵀ)⁻¹, where L₂₂ is the trailing block, so that no solution per node is needed. Further,
//! w = L₂₂⁻ᵀ y₂ and 1ᵀMK⁻¹M1 = yᵀy with L y = M1. So the elimination alone gives C, and the factor is kept only for
//! displacements.
//!
//! A half-space is fixed at its far boundary and has infinite mass: C = C_pin.

use std::sync::OnceLock;

use faer::{ColRef, Mat};
use fem_element::{QuadGeometry, mean_gradient_stiffness, nodal_volumes};
use fem_material::Material;
use fem_mesh::{Side, SphereMesh, lump_mass};

use crate::condensation::dense::{cholesky, invert_lower};
use crate::condensation::factor::{Elimination, Factor};
use crate::condensation::numbering::ElementEquations;
use crate::condensation::numbering::{FIXED, Numbering};
use crate::error::CondensedError;

/// A body's mesh, factor and contact compliance; instantaneous moduli.
#[derive(Debug)]
pub(crate) struct CondensedBody {
    pub mesh: SphereMesh,
    pub numbering: Numbering,
    solver: OnceLock<BodySolver>,
    bulk_modulus: f64,
    /// Instantaneous shear modulus, Pa.
    pub shear_modulus: f64,
    /// Lumped masses of the nodes, kg.
    pub nodal_mass: Vec<f64>,
    /// Mass of each equation, that of the fixed degree of freedom last, kg.
    pub mass_of_equation: Vec<f64>,
    /// Whether an equation is along the axis, that of the fixed degree of freedom last.
    pub is_axial: Vec<bool>,
    /// Total mass, kg; infinite for a half-space.
    pub mass: f64,
    /// +1 if inward is +y, for the upper body, −1 for the lower.
    pub inward: f64,
    /// Contact compliance, m/N.
    pub compliance: Mat<f64>,
    /// Its lower Cholesky factor.
    pub compliance_factor: Mat<f64>,
}

/// Data for the displacements of the whole body.
#[derive(Debug)]
pub(crate) struct BodySolver {
    pub factor: Factor,
    /// Displacements under the inertia of a unit acceleration, m/(m/s²).
    inertia_response: Vec<f64>,
}

impl CondensedBody {
    /// Eliminates all but the given surface nodes. Without `keeps_factor` the elimination is repeated when
    /// displacements are requested.
    ///
    /// # Errors
    /// A stiffness without factor, missing memory.
    pub fn new(
        mesh: SphereMesh,
        material: &Material,
        contact_nodes: &[u32],
        keeps_factor: bool,
    ) -> Result<Self, CondensedError> {
        let numbering = Numbering::new(&mesh, contact_nodes);
        let moduli = material.instantaneous();
        let (bulk_modulus, shear_modulus) = (moduli.bulk_modulus(), moduli.shear_modulus());
        let nodal_volumes: Vec<_> =
            (0..mesh.quads().len()).map(|number| nodal_volumes(&mesh.corners(number))).collect();
        let nodal_mass = lump_mass(&mesh, material.density(), &nodal_volumes);
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
            solver: OnceLock::new(),
            bulk_modulus,
            shear_modulus,
            nodal_mass,
            mass_of_equation,
            is_axial,
            mass,
            inward,
            compliance: Mat::new(),
            compliance_factor: Mat::new(),
        };
        let Elimination { factor, trailing, forward } = body.eliminate(keeps_factor)?;
        body.compliance = body.condense(&trailing, &forward);
        if let Some(factor) = factor {
            body.solver = OnceLock::from(BodySolver::new(factor, forward));
        }
        body.compliance_factor =
            cholesky(&body.compliance).ok_or(CondensedError::NotPositiveDefinite)?;
        Ok(body)
    }

    /// Eliminates with the inertia of a unit acceleration as right-hand side; a half-space has none.
    fn eliminate(&self, keeps_factor: bool) -> Result<Elimination, CondensedError> {
        let n = self.numbering.n_equations;
        let inertia = match self.mass.is_infinite() {
            true => vec![0.0; n],
            false => (0..n).map(|i| self.mass * self.inertia_share(i)).collect(),
        };
        let elements = ElementEquations::of_mesh(&self.mesh, &self.numbering);
        let matrix = |number: usize| {
            let geometry = QuadGeometry::new(&self.mesh.corners(number));
            mean_gradient_stiffness(&geometry, self.bulk_modulus, self.shear_modulus)
        };
        let (ends, n_contact) = (&self.numbering.ends, self.numbering.n_contact);
        Elimination::new(ends, &elements, matrix, inertia, n_contact, keeps_factor)
    }

    /// Returns the data for displacements of the whole body, computed at the first request.
    ///
    /// # Errors
    /// Returns an error if there is not enough memory.
    pub fn solver(&self) -> Result<&BodySolver, CondensedError> {
        if let Some(solver) = self.solver.get() {
            return Ok(solver);
        }
        let Elimination { factor, forward, .. } = self.eliminate(true)?;
        let factor = factor.ok_or(CondensedError::OutOfMemory)?;
        Ok(self.solver.get_or_init(|| BodySolver::new(factor, forward)))
    }

    fn condense(&self, trailing: &Mat<f64>, forward: &[f64]) -> Mat<f64> {
        let (n_contact, first) = (self.numbering.n_contact, self.numbering.first_contact());
        let m = self.mass;
        let inverse = invert_lower(trailing);
        let pinned = inverse.transpose() * &inverse;
        if m.is_infinite() {
            return pinned;
        }
        let of_contact = Mat::from_fn(n_contact, 1, |i, _| forward[first + i]);
        let w = inverse.transpose() * of_contact;
        let weighted: f64 = forward.iter().map(|y| y * y).sum();
        Mat::from_fn(n_contact, n_contact, |i, j| {
            pinned[(i, j)] - (w[(i, 0)] + w[(j, 0)]) / m + weighted / (m * m)
        })
    }

    /// Returns displacements K⁻¹B̂ L_c⁻ᵀ under balanced loads at the contact nodes, one column per contact node,
    /// which are orthonormal in the stiffness; the fixed degree of freedom comes last.
    ///
    /// # Errors
    /// Returns an error if there is not enough memory.
    pub fn orthonormal_responses(&self) -> Result<Mat<f64>, CondensedError> {
        let (n, n_contact) = (self.numbering.n_equations, self.numbering.n_contact);
        let BodySolver { factor, inertia_response } = self.solver()?;
        let loads = invert_lower(&self.compliance_factor).transpose().to_owned();
        let mut answers = Mat::zeros(n + 1, n_contact);
        answers.subrows_mut(n - n_contact, n_contact).copy_from(&loads);
        factor.solve(answers.as_mut().subrows_mut(0, n));
        let totals: Vec<f64> = loads.col_iter().map(|column| column.iter().sum()).collect();
        for (answer, total) in answers.as_mut().col_iter_mut().zip(totals) {
            for (value, w) in answer.iter_mut().zip(inertia_response) {
                *value = self.inward * (*value - w * total / self.mass);
            }
        }
        Ok(answers)
    }

    /// Returns the load of inward forces at the contact nodes (one case per column) and the balancing inertia, N.
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

    /// Returns the share of an equation in the inertia along the axis.
    fn inertia_share(&self, equation: usize) -> f64 {
        if self.is_axial[equation] { self.mass_of_equation[equation] / self.mass } else { 0.0 }
    }

    /// Solves for the displacements (m) under balanced loads (N) in place; the fixed degree of freedom stays at 0.
    ///
    /// # Errors
    /// Returns an error if there is not enough memory.
    pub fn solve_balanced(&self, loads: &mut Mat<f64>) -> Result<(), CondensedError> {
        let n = self.numbering.n_equations;
        loads.as_mut().row_mut(n).fill(0.0);
        self.solver()?.factor.solve(loads.as_mut().subrows_mut(0, n));
        Ok(())
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

    /// Returns nodal displacements (u_r, u_y) of a field given by equations, m.
    pub fn nodal_field(&self, field: ColRef<'_, f64>) -> Vec<[f64; 2]> {
        let value = |equation: u32| if equation == FIXED { 0.0 } else { field[equation as usize] };
        self.numbering.equations.iter().map(|equations| equations.map(value)).collect()
    }

    /// Returns the size of the factor in bytes, if it is kept.
    pub fn bytes(&self) -> usize {
        self.solver.get().map_or(0, |solver| solver.factor.bytes())
    }
}

impl BodySolver {
    /// Creates the solver from a factor and y of L y = M1.
    fn new(factor: Factor, forward: Vec<f64>) -> Self {
        let mut response = Mat::from_fn(forward.len(), 1, |i, _| forward[i]);
        factor.solve_transposed(response.as_mut());
        Self { factor, inertia_response: response.col(0).iter().copied().collect() }
    }
}
