//! The static equilibrium of a body that has flowed: its dent, residual stress and locked-in energy without vibration, waves
//! or bending.
//!
//! The elastic energy at the internal variables that the body has is least there. Its curvature is bounded by the diagonal κ
//! of the nodal bounds of stiffness ([`super::critical_time_step`]), and it is minimised by accelerated steps in that metric,
//!
//! ```math
//! u_{k+1} = y_k + \kappa^{-1} f(y_k), \qquad y_{k+1} = u_{k+1} + \frac{k}{k+3}\,(u_{k+1} - u_k),
//! ```
//!
//! which begin anew with k = 0 where the forces f oppose the motion u_{k+1} − u_k (O'Donoghue & Candès 2015, *Found. Comput.
//! Math.* 15, 715, gradient scheme). They need about the square root of the condition number of steps, as many as waves need
//! to cross the body, or bending waves a plate. The first guess is the deformation around the dent alone.

use std::f64::consts::PI;

use super::Body;
use super::state::{BodyState, Clock};
use crate::part::NodalField;

/// Unbalanced forces over those of the first guess at which a body is in equilibrium, in the metric of the bounds.
const UNBALANCED: f64 = 1e-6;
/// Largest number of steps.
const MOST_STEPS: usize = 20_000;
/// Distance from first touch at which the first guess has faded, over that of the farthest element that has flowed.
const FADED: f64 = 2.0;

impl Body {
    /// Takes a body that flows to its equilibrium without further flow; its centre keeps its displacement. A body that does
    /// not flow is left as it is.
    pub(crate) fn settle(&self, state: &mut BodyState, clock: Clock) {
        let (Some(stiffness), true) = (self.current_stiffness(state, clock), self.flows()) else {
            return;
        };
        let centre = self.centre(&state.displacement);
        let mut dented = BodyState { displacement: self.around_dent(state), ..state.clone() };
        let mut before = dented.displacement.clone();
        let mut forces = vec![[0.0; 2]; before.len()];
        let (mut first, mut k) = (None, 0.0);
        for _ in 0..MOST_STEPS {
            // The state is y_k here and u_{k+1} after the step.
            self.start_deformed(&mut dented);
            if dented.update_internal_forces(self, clock, &mut forces).is_err() {
                return;
            }
            let (mut unbalanced, mut power) = (0.0, 0.0);
            let nodes = dented.displacement.iter_mut().zip(&mut before).zip(&forces);
            let places = self.inverse_mass.iter().zip(&stiffness);
            for (((u, before), force), (inverse_mass, stiffness)) in nodes.zip(places) {
                for axis in (0..2).filter(|axis| inverse_mass[*axis] > 0.0) {
                    let step = force[axis] / stiffness;
                    unbalanced += force[axis] * step;
                    let next = u[axis] + step;
                    let moved = next - before[axis];
                    power += force[axis] * moved;
                    before[axis] = next;
                    u[axis] = next + k / (k + 3.0) * moved;
                }
            }
            if unbalanced <= UNBALANCED * UNBALANCED * *first.get_or_insert(unbalanced) {
                break;
            }
            k += 1.0;
            if power < 0.0 {
                dented.displacement.clone_from(&before);
                k = 0.0;
            }
        }
        dented.displacement = before;
        let shift = centre - self.centre(&dented.displacement);
        dented.displacement.iter_mut().for_each(|u| u[1] += shift);
        self.start_deformed(&mut dented);
        *state = dented;
    }

    /// Returns the bounds of the stiffness at the nodes of the body as it is deformed, N/m; `None` for a body at small strain.
    fn current_stiffness(&self, state: &BodyState, clock: Clock) -> Option<Vec<f64>> {
        let (bound, placed, stress) =
            (self.bound.as_ref()?, self.stress.as_ref()?, self.finite_strain()?);
        let mut of_elements = vec![0.0; self.nodal_mass.len()];
        let history = placed.of(&state.history);
        stress.add_stiffness_bound(&state.motion(self, clock), history, &mut of_elements);
        Some(bound.current_stiffness(&of_elements))
    }

    /// Sets the forces of the stress to those of the present deformation without further flow.
    fn start_deformed(&self, state: &mut BodyState) {
        if let Some(stress) = &self.stress {
            stress.part.start_deformed(&state.displacement, stress.of_mut(&mut state.history));
        }
    }

    /// Returns the displacement relative to the end of the axis that is farthest from the contact, which fades beyond the
    /// elements that have flowed.
    fn around_dent(&self, state: &BodyState) -> NodalField {
        let n = state.displacement.len();
        let (Some(mesh), Some(placed), Some(stress)) =
            (self.mesh(), &self.stress, self.finite_strain())
        else {
            return vec![[0.0; 2]; n];
        };
        let mut plastic = Vec::new();
        stress.update_plastic(placed.of(&state.history), &mut plastic);
        let flowed = plastic.iter().enumerate().filter(|(_, [strain, _])| *strain > 0.0);
        let distance = |[r, y]: [f64; 2]| r.hypot(y);
        let radius = flowed.map(|(k, _)| distance(self.element_centre(k))).fold(0.0, f64::max);
        if radius == 0.0 {
            return vec![[0.0; 2]; n];
        }
        let axis = mesh.axis().iter().map(|&node| node as usize);
        let far =
            axis.max_by(|a, b| distance(mesh.nodes()[*a]).total_cmp(&distance(mesh.nodes()[*b])));
        let shift = far.map_or(0.0, |node| state.displacement[node][1]);
        let near = mesh.nodes().iter().zip(&state.displacement).map(|(node, u)| {
            let way = (distance(*node) - radius) / ((FADED - 1.0) * radius);
            let share = match way {
                1.0.. => 0.0,
                0.0..1.0 => 0.5 * (1.0 + (PI * way).cos()),
                _ => 1.0,
            };
            [share * u[0], share * (u[1] - shift)]
        });
        near.collect()
    }
}
