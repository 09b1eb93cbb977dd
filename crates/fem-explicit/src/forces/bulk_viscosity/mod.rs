//! Bulk viscosity: a pressure against the rate at which an element is compressed, which spreads steep
//! fronts over some elements and keeps them from ringing.
//!
//! ```math
//! p = -\rho\, l\, \bigl[b_1 c_d\, (\dot\varepsilon_V - \bar{\dot\varepsilon}_V)
//! + b_2^2\, j\, \dot\varepsilon_V\bigr], \qquad
//! j = \min(\max(-l\, \dot\varepsilon_V, 0),\ j_{max})
//! ```
//!
//! with the dilatation rate ε̇_V = tr ε̇ of an element, the root l of its area, the speed c_d of
//! pressure waves, and the drop j of velocity across the element while it is compressed. The quadratic
//! term is that of von Neumann & Richtmyer (1950), here with its coefficient squared; it acts in
//! compression alone. The linear term is Landshoff's (1955) on the deviation of the rate from its mean around the
//! element: the mean over the corners of means of their elements, weighed by ρ l V,
//!
//! ```math
//! \bar{\dot\varepsilon}_e = \tfrac14 \sum_{i \in e}
//! \frac{\sum_{e' \ni i} w_{e'}\, \dot\varepsilon_{e'}}{\sum_{e' \ni i} w_{e'}}, \qquad w = \rho\, l\, V .
//! ```
//!
//! With the weights w this mean is a symmetric operator with eigenvalues 0 to 1 (each is a mean of means), so the
//! linear term never adds energy and damps no motion more than without the mean. It acts in compression and expansion,
//! since fronts ring in loading and in unloading; so the damping of small motion is a constant matrix. Without
//! viscosity a front of any size overshoots in a mesh. Elastic bodies have steep fronts and no shocks, and the linear
//! term damps them.
//!
//! Viscosity is not a property of the body: its pressure is not part of the stress in results. The energy that the
//! linear term takes from a smooth motion falls with l³ (with l if the mean were left out), that of the quadratic term
//! with l².
//!
//! The force takes the velocity of half a step before, so the element's damping enters the time step
//! ([`NodeForce::add_damping_bound`]), with j at its largest. j_max caps the viscosity there: it is less
//! beyond, never unstable. The force that acts in the next step is the part's first field of history;
//! the second is the work that was done against it,
//!
//! ```math
//! W_{n+1} - W_n = -\tfrac12 \Delta t\; v_{n+1/2} \cdot (f_n + f_{n+1}),
//! ```
//!
//! for r and for y at each node: exactly the energy that leapfrog loses in a step.

mod elements;

use std::fmt;

use fem_collision::Account;
use fem_element::QuadGeometry;
use fem_material::Material;
use fem_mesh::SphereMesh;
use multiversion::multiversion;

use super::NodeForce;
use crate::error::ModelError;
use crate::part::{Accounts, Field, Motion, NodalField, Part};
use elements::ViscousElements;

/// The coefficients b₁ and b₂ of bulk viscosity, both at least 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViscosityCoefficients {
    /// Linear coefficient b₁: the damping ratio of the highest mode of a bar's element.
    pub linear: f64,
    /// Quadratic coefficient b₂, which enters as its square.
    pub quadratic: f64,
}

impl Default for ViscosityCoefficients {
    /// Returns 0.06 and 1.2, the usual values of impact codes (Abaqus; LS-DYNA gives the square, 1.5). After eighty
    /// elements a front is five elements wide and overshoots by 5 %, instead of 25 % without viscosity.
    fn default() -> Self {
        Self { linear: 0.06, quadratic: 1.2 }
    }
}

/// Artificial viscosity of the elements of a sphere, as a force on its nodes.
pub struct BulkViscosity {
    elements: ViscousElements,
    coefficients: ViscosityCoefficients,
    /// Cap j_max of the velocity drop, m/s.
    largest_drop: f64,
    /// Bound of the damping at each node, N s/m; empty once the model is built.
    damping_bound: Vec<f64>,
}

impl BulkViscosity {
    /// Takes the elements of a sphere. `largest_drop` is the drop of velocity (m/s) across an element up to which
    /// viscosity grows; with the speed of approach no element is compressed faster before waves meet.
    ///
    /// # Errors
    /// A coefficient or the drop is negative or not finite.
    pub fn new(
        mesh: &SphereMesh,
        material: &Material,
        coefficients: ViscosityCoefficients,
        largest_drop: f64,
    ) -> Result<Self, ModelError> {
        let ViscosityCoefficients { linear, quadratic } = coefficients;
        for (name, value) in [
            ("linear bulk viscosity", linear),
            ("quadratic bulk viscosity", quadratic),
            ("largest drop of velocity", largest_drop),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(ModelError::Setting { name, value, allowed: "at least 0 and finite" });
            }
        }
        Ok(Self::of_quads(mesh.nodes(), mesh.quads(), material, coefficients, largest_drop))
    }

    /// Takes quads and nodes (r, y), m.
    fn of_quads(
        nodes: &[[f64; 2]],
        quads: &[[u32; 4]],
        material: &Material,
        coefficients: ViscosityCoefficients,
        largest_drop: f64,
    ) -> Self {
        let ViscosityCoefficients { linear, quadratic } = coefficients;
        let speeds = [linear * material.dilatational_wave_speed(), quadratic * quadratic];
        let largest_speed = speeds[0] + speeds[1] * largest_drop;
        let density = material.density();
        let mut damping_bound = vec![0.0; nodes.len()];
        let mut elements = ViscousElements::new(nodes.len(), quads.len(), speeds, largest_drop);
        for (element, quad) in quads.iter().enumerate() {
            let corners = quad.map(|node| nodes[node as usize]);
            let geometry = QuadGeometry::new(&corners);
            let length = area(&corners).sqrt();
            elements.put(element, quad, &geometry, [density * length, length]);
            let masses = geometry.nodal_volumes.map(|volume| density * volume);
            let viscosity = density * length * largest_speed;
            let rate = viscosity * geometry.volume * inverse_mass(&corners, &geometry, &masses);
            for (&node, mass) in quad.iter().zip(masses) {
                damping_bound[node as usize] += rate * mass;
            }
        }
        Self { elements, coefficients, largest_drop, damping_bound }
    }
}

/// Returns Σ b²/m (1/(m² kg)) with the dilatation b of unit displacements and the lumped masses (kg) of the corners
/// that move. Times a bulk viscosity and the volume it is the decay rate of the one motion that is damped in an
/// element.
fn inverse_mass(corners: &[[f64; 2]; 4], geometry: &QuadGeometry, masses: &[f64; 4]) -> f64 {
    let of_corner = |a: usize| {
        let radial = geometry.gradient_r[a] + geometry.hoop[a];
        let moves = f64::from(corners[a][0] != 0.0);
        (moves * radial * radial + geometry.gradient_y[a].powi(2)) / masses[a]
    };
    (0..4).map(of_corner).sum()
}

/// Returns the area (m²) of a quad with corners (m) in counter-clockwise order.
fn area([a, b, c, d]: &[[f64; 2]; 4]) -> f64 {
    0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]))
}

/// Shows what distinguishes it from others of the same mesh and material, for the fingerprint of a model.
impl fmt::Debug for BulkViscosity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { coefficients, largest_drop, .. } = self;
        write!(formatter, "BulkViscosity {{ {coefficients:?}, largest_drop: {largest_drop:?} }}")
    }
}

impl Part for BulkViscosity {
    /// Three: force of the next step (N), work done against it so far (J), and means of dilatation rates (1/s), which
    /// are used within a step.
    fn n_history(&self) -> usize {
        3
    }

    /// Frees the bound, which is not needed any more.
    fn set_time_step(&mut self, _: f64) {
        self.damping_bound = Vec::new();
    }
}

impl NodeForce for BulkViscosity {
    /// Returns 0: internal forces of a body add up to zero.
    fn add_forces(&self, _: &Motion<'_>, history: &[NodalField], forces: &mut Field) -> f64 {
        add(&history[0], forces);
        0.0
    }

    fn advance(&self, motion: &Motion<'_>, history: &mut [NodalField]) {
        let [force, work, means] = history else { return };
        let half_step = 0.5 * motion.time_step;
        take_work(half_step, motion.velocity, force, work);
        self.elements.subtract_forces(motion.velocity, means, force);
        add_work(half_step, motion.velocity, force, work);
    }

    fn add_energies(&self, _: &Motion<'_>, history: &[NodalField], accounts: &mut Accounts) {
        let work = history[1].iter().map(|work| work[0] + work[1]).sum();
        accounts.energies.add(Account::BulkViscosity, work);
    }

    fn add_damping_bound(&self, bound: &mut [f64]) {
        bound.iter_mut().zip(&self.damping_bound).for_each(|(bound, own)| *bound += own);
    }
}

/// f ← f + q.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
fn add(q: &Field, f: &mut Field) {
    for (f, q) in f.as_flattened_mut().iter_mut().zip(q.as_flattened()) {
        *f += q;
    }
}

/// w ← w − t v q, q ← 0.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
fn take_work(t: f64, v: &Field, q: &mut Field, w: &mut Field) {
    let (w, q) = (w.as_flattened_mut(), q.as_flattened_mut());
    for ((w, q), v) in w.iter_mut().zip(q).zip(v.as_flattened()) {
        *w -= t * v * *q;
        *q = 0.0;
    }
}

/// w ← w − t v q.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
fn add_work(t: f64, v: &Field, q: &Field, w: &mut Field) {
    for ((w, q), v) in w.as_flattened_mut().iter_mut().zip(q.as_flattened()).zip(v.as_flattened()) {
        *w -= t * v * q;
    }
}

#[cfg(test)]
mod tests;
