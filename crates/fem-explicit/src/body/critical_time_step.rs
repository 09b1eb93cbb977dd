//! The critical time step, and mass scaling.
//!
//! An element's stiffness is bounded by its own lumped masses, K_e ≤ λ_e M_e,
//! and the contact springs by a diagonal D (see
//! [`fem_contact::ContactInterface::add_stiffness_bound`]). So the assembled
//! stiffness is bounded by the diagonal κ_i = Σ_e λ_e m_e,i + D_i, and
//!
//! ```math
//! \omega_{max}^2 \le \max_i \kappa_i / m_i, \qquad \Delta t_{crit} = 2/\omega_{max}.
//! ```
//!
//! With m_i = Σ m_e,i and no contact this is never above the largest λ_e, the
//! bound of Irons and Treharne. Mass scaling turns it round: a step Δt is stable
//! once every node has m_i ≥ κ_i Δt²/4 = n_i, so the lightest nodes, which are the
//! stiffest and hold almost none of the mass, are filled up to that from the nodes
//! that have more than they need,
//!
//! ```math
//! m_i' = \max(m_i, n_i) - \theta\,\bigl(\max(m_i, n_i) - n_i\bigr), \qquad
//! \theta = \frac{\sum_j \max(n_j - m_j, 0)}{\sum_j \max(m_j - n_j, 0)},
//! ```
//!
//! so that the body keeps its mass. The step is the longest for which the mass that
//! is moved stays within its budget and θ is no more than ½. Mass that is only added
//! makes the bodies heavier: of 1 % the contact lasts 0.25 % longer and
//! pushes 0.65 % harder, which moved mass does not (docs/accuracy.md).
//!
//! Forces of damping C take the velocity of half a step before, which is the same as
//! the mean velocity at the mass M − ½ Δt C. So with C bounded by a diagonal γ_i the
//! condition is
//!
//! ```math
//! \Delta t^2 \kappa_i + 2 \Delta t\, \gamma_i \le 4 m_i
//!   \quad\Leftrightarrow\quad
//!   \Delta t \le 2 \sqrt{m_i/\kappa_i}\, (\sqrt{1 + \xi_i^2} - \xi_i), \qquad
//!   \xi_i = \frac{\gamma_i}{2 \sqrt{\kappa_i m_i}},
//! ```
//!
//! the step of an oscillator of damping ratio ξ (Belytschko, Liu & Moran 2000, eq. 6.2.30). Without
//! damping it is the step above, to the bit.
//!
//! Nodes without mass ([`BoundaryMass`]) are where the others have them: at the least of the energy, so
//! that the potential of the others is V(u) = min_b W(u, b), with a convex W of stress and contact. Its
//! curvature is at most that of W at fixed b, which is the stiffness of the elements without those
//! corners: λ_e is that of what is left of an element, and the springs of the contact, whichever are
//! closed and however stiff, are not in the bound. V is convex and its gradient continuous, so springs
//! that open and close change nothing of that.

use fem_element::QuadGeometry;
use fem_mesh::{SphereMesh, lump_mass};

use super::massless_boundary_mass::BoundaryMass;
use crate::stress::{FiniteStrainStress, LumpedElement, Stress};

/// Share of what nodes have beyond their need that is taken from them at most.
const MOST_OF_SPARE: f64 = 0.5;
/// Mass over what is spare that is a rounding.
const ROUNDING: f64 = 1e-13;

/// Masses of a body's nodes and a bound of the stiffness that pulls at them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodalBound {
    /// Lumped masses, kg.
    pub mass: Vec<f64>,
    /// κ_i, N/m.
    pub stiffness: Vec<f64>,
    /// γ_i, N s/m.
    pub damping: Vec<f64>,
}

impl NodalBound {
    /// Of the elements of a body without contact, for a density (kg/m³) and a stress; some nodes may
    /// have no mass.
    pub fn of_elements(
        mesh: &SphereMesh,
        geometries: &[QuadGeometry],
        density: f64,
        stress: &dyn Stress,
        boundary: &BoundaryMass,
    ) -> Self {
        let of = |(element, (quad, geometry)): (usize, (&[u32; 4], &QuadGeometry))| {
            let masses = geometry.nodal_volumes.map(|volume| density * volume);
            let masses = boundary.of_corners(quad, masses);
            let on_axis = mesh.corners(element).map(|corner| corner[0] == 0.0);
            LumpedElement { geometry: *geometry, masses, on_axis }
        };
        let elements: Vec<_> = mesh.quads().iter().zip(geometries).enumerate().map(of).collect();
        let eigenvalues = stress.largest_eigenvalues(&elements);
        let mut stiffness = vec![0.0; mesh.nodes().len()];
        for ((quad, element), eigenvalue) in mesh.quads().iter().zip(&elements).zip(eigenvalues) {
            for (&node, mass) in quad.iter().zip(element.masses) {
                stiffness[node as usize] += eigenvalue * mass;
            }
        }
        let nodal_volumes: Vec<_> =
            geometries.iter().map(|geometry| geometry.nodal_volumes).collect();
        let damping = vec![0.0; mesh.nodes().len()];
        let mass = lump_mass(mesh, density, &nodal_volumes);
        Self { mass: boundary.of_nodes(mesh, geometries, mass), stiffness, damping }
    }

    /// Mass (kg), stiffness (N/m) and damping (N s/m) of each node.
    fn nodes(&self) -> impl Iterator<Item = [f64; 3]> {
        let bounds = self.stiffness.iter().zip(&self.damping);
        self.mass
            .iter()
            .zip(bounds)
            .map(|(&mass, (&stiffness, &damping))| [mass, stiffness, damping])
    }

    /// Leaves out nodes that have no mass: what pulls at them is in balance.
    pub fn leave_out(&mut self, massless: impl Iterator<Item = usize>) {
        for node in massless {
            (self.stiffness[node], self.damping[node]) = (0.0, 0.0);
        }
    }

    /// Critical time step without mass scaling, s.
    pub fn critical_time_step(&self) -> f64 {
        let pulled = self.nodes().filter(|node| *node != [0.0; 3]);
        pulled.map(critical_time_step).fold(f64::INFINITY, f64::min)
    }

    /// Masses that a critical time step (s) asks for beyond what is there, and that are there beyond what it
    /// asks for, kg.
    fn missing_and_spare(&self, time_step: f64) -> [f64; 2] {
        self.nodes().fold([0.0; 2], |[missing, spare], node| {
            let needed = needed_mass(time_step, node);
            [missing + (needed - node[0]).max(0.0), spare + (node[0] - needed).max(0.0)]
        })
    }

    /// Longest critical time step (s) within a budget of moved mass, kg.
    pub fn scaled_time_step(&self, budget: f64) -> f64 {
        let plain = self.critical_time_step();
        let has = |time_step: f64| {
            let [missing, spare] = self.missing_and_spare(time_step);
            missing <= budget && missing <= MOST_OF_SPARE * spare
        };
        if !(plain > 0.0 && plain.is_finite() && has(plain * (1.0 + 1e-9))) {
            return plain;
        }
        let (mut stable, mut beyond) = (plain, 2.0 * plain);
        while has(beyond) {
            (stable, beyond) = (beyond, 2.0 * beyond);
        }
        while beyond - stable > 1e-12 * stable {
            let middle = 0.5 * (stable + beyond);
            if has(middle) {
                stable = middle;
            } else {
                beyond = middle;
            }
        }
        stable
    }

    /// Fills the masses up for a critical time step (s) from those that have more than they need. Returns
    /// the masses and what was moved, kg.
    pub fn scale_mass(&self, time_step: f64) -> (Vec<f64>, f64) {
        let [missing, spare] = self.missing_and_spare(time_step);
        // The node that decides may be filled up by a rounding, and from none.
        let share = if missing > ROUNDING * spare { missing / spare } else { 0.0 };
        let filled = |node: [f64; 3]| {
            let needed = needed_mass(time_step, node);
            node[0].max(needed) - share * (node[0] - needed).max(0.0)
        };
        (self.nodes().map(filled).collect(), missing)
    }
}

/// The same of a body whose stiffness changes as it deforms; mass scaling stays as it was.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChangingBound {
    /// κ_i of the undeformed body, its contact and its forces, N/m.
    stiffness: Vec<f64>,
    /// What of that is its elements', N/m.
    of_elements: Vec<f64>,
    /// γ_i, N s/m.
    damping: Vec<f64>,
}

impl ChangingBound {
    /// Takes the bound that the time step was chosen from, and the stress if that is at finite strain.
    pub fn new(bound: NodalBound, stress: Option<&dyn FiniteStrainStress>) -> Self {
        let mut of_elements = vec![0.0; bound.mass.len()];
        if let Some(stress) = stress {
            stress.add_undeformed_stiffness_bound(&mut of_elements);
        }
        Self { stiffness: bound.stiffness, of_elements, damping: bound.damping }
    }

    /// Critical time step (s) at masses (kg), where the elements have these bounds now (N/m), with what the
    /// contact's have grown by, and its damping (N s/m); and the node that asks for it. What is no number
    /// counts. In place of the bounds it leaves the steps of all nodes, s.
    pub fn critical_time_step(
        &self,
        mass: &[f64],
        of_elements: &mut [f64],
        grown_damping: &[f64],
    ) -> (f64, usize) {
        let mut least = (f64::INFINITY, 0);
        for (k, bound) in of_elements.iter_mut().enumerate() {
            let grown = *bound - self.of_elements[k];
            let damping = self.damping[k] + grown_damping[k];
            let step = critical_time_step([mass[k], self.stiffness[k] + grown, damping]);
            if step < least.0 || step.is_nan() {
                least = (step, k);
            }
            *bound = step;
        }
        least
    }
}

/// Critical time step of a node of this mass (kg), stiffness (N/m) and damping (N s/m), s.
fn critical_time_step([mass, stiffness, damping]: [f64; 3]) -> f64 {
    match damping == 0.0 {
        true => 2.0 * (mass / stiffness).sqrt(),
        // The same root without the difference of two large numbers.
        false => 4.0 * mass / (damping + damping.hypot(2.0 * (stiffness * mass).sqrt())),
    }
}

/// Mass (kg) with which a node of this stiffness and damping is stable at a time step, s.
fn needed_mass(time_step: f64, [_, stiffness, damping]: [f64; 3]) -> f64 {
    0.25 * time_step * time_step * stiffness + 0.5 * time_step * damping
}
