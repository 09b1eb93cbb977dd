//! Springs and dashpots of [`fem_contact`] between the deformed surfaces, as a contact.
//!
//! The springs have no history. The dashpots take the velocity of half a step before, as bulk viscosity does. Their
//! force and the work done against it are the two fields of history. The work
//!
//! ```math
//! W_{n+1} - W_n = -\tfrac12 \Delta t\; v_{n+1/2} \cdot (f_n + f_{n+1})
//! ```
//!
//! is exactly the energy that leapfrog loses in a step.

use std::any::Any;

use fem_collision::{Account, BodyInput, CandidateRegion};
use fem_contact::{ContactError, ContactForces, DeformedInterface, Profile};

use super::Contact;
use super::springs::{mass_ratio, surface};
use crate::part::{Accounts, Field, Motion, MotionMut, NodalField, Part};
use crate::settings::Settings;

/// Damping ratio of the surface nodes on the springs. At 0.3 the peak force of a rubber ball on a wall at 1 to 10 m/s
/// is within 1 % of its mean over 1/64 of the contact time (undamped: 5 to 19 %), at a cost of 3e-5 to 1e-4 in
/// restitution.
const DAMPING_RATIO: f64 = 0.3;

/// Contact between the surfaces of two bodies in their present places, for [`ModelParts`](crate::ModelParts).
#[derive(Debug, Clone)]
pub struct DeformedContact {
    interface: DeformedInterface,
}

impl DeformedContact {
    /// Makes the contact that settings ask for; `gap` (m) separates the poles.
    ///
    /// The impedance of the dashpots is 2ξ √(k m) = ξ √(2K / Σ 1/ρ), with k = K/h and the masses ½ρh of both sides of
    /// an area in series.
    ///
    /// # Errors
    /// Both bodies are rigid or both surfaces are planes; a setting is not positive and finite.
    pub fn new(
        inputs: &[BodyInput; 2],
        gap: f64,
        settings: &Settings,
    ) -> Result<Self, ContactError> {
        let [lower, upper] = inputs;
        let (lower, upper) = (surface(lower)?, surface(upper)?);
        let &Settings { contact_stiffness, candidate_radius, .. } = settings;
        let interface =
            DeformedInterface::new(lower, upper, contact_stiffness, gap, candidate_radius)?;
        let materials = inputs.iter().filter_map(BodyInput::material);
        let inverse_density: f64 = materials.map(|material| material.density().recip()).sum();
        let impedance = DAMPING_RATIO * (2.0 * contact_stiffness / inverse_density).sqrt();
        let interface = interface.with_damping(impedance);
        let interface = match mass_ratio(inputs) {
            Some(ratio) => interface.with_rigid_mass(ratio),
            None => interface,
        };
        Ok(Self { interface })
    }

    /// Adds the work of half a step (s) at a velocity (m/s) against the dashpots of a side.
    fn add_work(&self, side: usize, half_step: f64, velocity: &Field, history: &mut [NodalField]) {
        let [force, work] = history else { return };
        for node in self.interface.candidate_nodes(side).map(|node| node as usize) {
            for axis in 0..2 {
                work[node][axis] -= half_step * velocity[node][axis] * force[node][axis];
            }
        }
    }
}

impl Part for DeformedContact {
    /// Two: the force of the dashpots in the next step (N), and the work done against it so far (J).
    fn n_history(&self) -> usize {
        2
    }
}

impl Contact for DeformedContact {
    fn candidate_region(&self) -> CandidateRegion {
        let (radius, n_points) = (self.interface.candidate_radius(), self.interface.n_points());
        CandidateRegion { radius, n_points, at_nodes: false }
    }

    fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        self.interface.add_stiffness_bound(side, bound);
    }

    fn add_damping_bound(&self, side: usize, bound: &mut [f64]) {
        self.interface.add_damping_bound(side, bound);
    }

    fn add_bound_growth(
        &self,
        motions: &[Motion<'_>; 2],
        within: f64,
        side: usize,
        stiffness: &mut [f64],
        damping: &mut [f64],
    ) {
        let u = motions.each_ref().map(|motion| motion.displacement);
        let v = motions.each_ref().map(|motion| motion.velocity);
        let reach = self.interface.reach(u, v, within);
        self.interface.add_bound_growth(u, reach, side, stiffness, damping);
    }

    fn add_forces(
        &self,
        motions: &[Motion<'_>; 2],
        history: [&[NodalField]; 2],
        forces: [&mut Field; 2],
    ) -> ContactForces {
        let [lower, upper] = forces;
        let u = motions.each_ref().map(|motion| motion.displacement);
        let mut total = self.interface.add_forces(u, [&mut *lower, &mut *upper]);
        if total.n_closed > 0 {
            for (side, forces) in [lower, upper].into_iter().enumerate() {
                let damping = &history[side][0];
                for node in self.interface.candidate_nodes(side).map(|node| node as usize) {
                    forces[node][0] += damping[node][0];
                    forces[node][1] += damping[node][1];
                    total.force += [0.0, damping[node][1]][side];
                }
            }
        }
        total
    }

    fn advance(
        &self,
        motions: [MotionMut<'_>; 2],
        history: [&mut [NodalField]; 2],
        _: &mut dyn Any,
    ) {
        let half_step = 0.5 * motions[0].time_step;
        let [lower, upper] = history;
        let u = motions.each_ref().map(|motion| &*motion.displacement);
        let v = motions.each_ref().map(|motion| &*motion.velocity);
        for (side, history) in [&mut *lower, &mut *upper].into_iter().enumerate() {
            self.add_work(side, half_step, v[side], history);
            for node in self.interface.candidate_nodes(side) {
                history[0][node as usize] = [0.0; 2];
            }
        }
        self.interface.add_damping(u, v, [&mut lower[0], &mut upper[0]]);
        for (side, history) in [lower, upper].into_iter().enumerate() {
            self.add_work(side, half_step, v[side], history);
        }
    }

    fn add_energies(&self, history: [&[NodalField]; 2], accounts: &mut Accounts) {
        let nodes = |side: usize| {
            let work = &history[side][1];
            self.interface.candidate_nodes(side).map(|node| work[node as usize])
        };
        let work = nodes(0).chain(nodes(1)).map(|work| work[0] + work[1]).sum();
        accounts.energies.add(Account::ContactDamping, work);
    }

    fn pushed_nodes(&self, side: usize) -> Vec<u32> {
        self.interface.candidate_nodes(side).collect()
    }

    fn is_closed_next(
        &self,
        _: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        _: [&[NodalField]; 2],
    ) -> bool {
        self.interface.is_closed(next)
    }

    fn radius_and_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> (f64, f64) {
        self.interface.radius_and_pressure(motions.each_ref().map(|motion| motion.displacement))
    }

    fn profile(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> Profile {
        self.interface.profile(motions.each_ref().map(|motion| motion.displacement))
    }
}
