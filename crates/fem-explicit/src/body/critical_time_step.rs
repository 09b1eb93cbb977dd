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
//! if every node has m_i ≥ κ_i Δt²/4 = n_i. So the lightest nodes, which hold almost none of the mass, are filled up to n_i
//! from the nodes that have more than they need,
//!
//! ```math
//! m_i' = \max(m_i, n_i) - \theta\,\bigl(\max(m_i, n_i) - n_i\bigr), \qquad
//! \theta = \frac{\sum_j \max(n_j - m_j, 0)}{\sum_j \max(m_j - n_j, 0)},
//! ```
//!
//! so that the body keeps its mass. The step is the longest for which the moved mass stays within its budget and θ is
//! at most ½. Mass that is added and not moved would make the bodies heavier: 1 % of it prolongs the contact by 0.25 %
//! and raises the force by 0.65 %.
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
//! Nodes without mass ([`BoundaryMass`]) are always at the minimum of the energy, so the potential of the other nodes
//! is V(u) = min_b W(u, b), with a convex W of stress and contact. Its curvature is at most that of W at fixed b, which
//! is the stiffness of the elements without those corners. Hence λ_e is that of the rest of an element, and the springs
//! of the contact are not in the bound, however stiff they are. V is convex with a continuous gradient, so this holds
//! while springs open and close.

use fem_element::QuadGeometry;
use fem_mesh::{SphereMesh, lump_mass};

use super::massless_boundary_mass::BoundaryMass;
use crate::stress::{FiniteStrainStress, LumpedElement, Stress};

/// Largest share of their spare mass that is taken from nodes.
const MAX_OF_SPARE: f64 = 0.5;
/// Ratio of missing to spare mass that counts as rounding.
const ROUNDING: f64 = 1e-13;

/// Masses of the nodes of a body, and bounds of stiffness and damping at them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodalBound {
    /// Lumped masses, kg.
    pub mass: Vec<f64>,
    /// Bounds κ_i of the stiffness, N/m.
    pub stiffness: Vec<f64>,
    /// Bounds γ_i of the damping, N s/m.
    pub damping: Vec<f64>,
}

impl NodalBound {
    /// Computes masses and bounds of the elements of a body without contact, for a density (kg/m³) and a stress; some nodes
    /// may have no mass.
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

    /// Returns mass (kg), stiffness (N/m) and damping (N s/m) of each node.
    fn nodes(&self) -> impl Iterator<Item = [f64; 3]> {
        let bounds = self.stiffness.iter().zip(&self.damping);
        self.mass
            .iter()
            .zip(bounds)
            .map(|(&mass, (&stiffness, &damping))| [mass, stiffness, damping])
    }

    /// Sets stiffness and damping of massless nodes to zero, so that they do not limit the step.
    pub fn leave_out(&mut self, massless: impl Iterator<Item = usize>) {
        for node in massless {
            (self.stiffness[node], self.damping[node]) = (0.0, 0.0);
        }
    }

    /// Returns the critical time step without mass scaling, s: the shortest of all nodes.
    pub fn critical_time_step(&self) -> f64 {
        let pulled = self.nodes().filter(|node| *node != [0.0; 3]);
        pulled.map(node_critical_step).fold(f64::INFINITY, f64::min)
    }

    /// Returns the mass that is missing for a critical time step (s) at some nodes, and the spare mass at the others, kg.
    fn missing_and_spare(&self, time_step: f64) -> [f64; 2] {
        self.nodes().fold([0.0; 2], |[missing, spare], node| {
            let needed = needed_mass(time_step, node);
            [missing + (needed - node[0]).max(0.0), spare + (node[0] - needed).max(0.0)]
        })
    }

    /// Returns the longest critical time step (s) within a budget of moved mass, kg.
    pub fn scaled_time_step(&self, budget: f64) -> f64 {
        let plain = self.critical_time_step();
        let has = |time_step: f64| {
            let [missing, spare] = self.missing_and_spare(time_step);
            missing <= budget && missing <= MAX_OF_SPARE * spare
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

    /// Moves mass from nodes that have more than they need for a critical time step (s) to those that have less.
    /// Returns the masses and the moved mass, kg.
    pub fn scale_mass(&self, time_step: f64) -> (Vec<f64>, f64) {
        let [missing, spare] = self.missing_and_spare(time_step);
        // The critical node may lack a rounding error while no node has spare mass.
        let share = if missing > ROUNDING * spare { missing / spare } else { 0.0 };
        let filled = |node: [f64; 3]| {
            let needed = needed_mass(time_step, node);
            node[0].max(needed) - share * (node[0] - needed).max(0.0)
        };
        (self.nodes().map(filled).collect(), missing)
    }
}

/// Bounds for a body in a run whose stiffness changes; mass scaling stays that of the undeformed body.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChangingBound {
    /// Bounds κ_i of the undeformed body, its contact and its forces, N/m.
    stiffness: Vec<f64>,
    /// Share of the elements in these bounds, N/m.
    of_elements: Vec<f64>,
    /// Bounds γ_i of the damping, N s/m.
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

    /// Returns the bounds of the stiffness at the nodes, N/m, for those of the elements as they are deformed.
    pub fn current_stiffness(&self, of_elements: &[f64]) -> Vec<f64> {
        let elements = of_elements.iter().zip(&self.of_elements);
        self.stiffness
            .iter()
            .zip(elements)
            .map(|(all, (now, before))| all + (now - before))
            .collect()
    }

    /// Returns the critical time step (s) of the deformed body and the critical node. `bounds_then_steps` holds the present
    /// bounds of the elements with the growth of the contact's (N/m) on entry, and the critical step of each node (s) on
    /// return. A step that is not a number counts as the shortest.
    pub fn current_critical_step(
        &self,
        mass: &[f64],
        bounds_then_steps: &mut [f64],
        grown_damping: &[f64],
    ) -> (f64, usize) {
        let mut least = (f64::INFINITY, 0);
        for (k, bound) in bounds_then_steps.iter_mut().enumerate() {
            let grown = *bound - self.of_elements[k];
            let damping = self.damping[k] + grown_damping[k];
            let step = node_critical_step([mass[k], self.stiffness[k] + grown, damping]);
            if step < least.0 || step.is_nan() {
                least = (step, k);
            }
            *bound = step;
        }
        least
    }
}

/// Returns the critical time step (s) of a node with a mass (kg), stiffness (N/m) and damping (N s/m).
fn node_critical_step([mass, stiffness, damping]: [f64; 3]) -> f64 {
    match damping == 0.0 {
        true => 2.0 * (mass / stiffness).sqrt(),
        // The root of the module documentation, without the difference of two large numbers.
        false => 4.0 * mass / (damping + damping.hypot(2.0 * (stiffness * mass).sqrt())),
    }
}

/// Returns the mass (kg) with which a node of a stiffness and damping is stable at a time step, s.
fn needed_mass(time_step: f64, [_, stiffness, damping]: [f64; 3]) -> f64 {
    0.25 * time_step * time_step * stiffness + 0.5 * time_step * damping
}
