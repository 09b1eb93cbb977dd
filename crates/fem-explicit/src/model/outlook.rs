//! The critical step of bodies that are deformed, and what is at fault where none is short enough.

use std::f64::consts::SQRT_2;

use fem_collision::Stop;
use fem_contact::SurfaceFold;
use fem_material::Material;

use super::Model;
use crate::ledger::Grown;
use crate::pace::Outlook;
use crate::part::Motion;
use crate::state::{BodyState, Scratch, State};
use crate::step::{Collapsed, Fault};
use crate::stress::Collapse;

impl Model {
    /// Largest rate (1/s) at which an element of a body whose stiffness changes is strained as first touch
    /// changes the velocity of its pole, which both bodies share as waves do: by their impedances.
    pub(crate) fn first_strain_rate(&self) -> f64 {
        let yields = self.bodies.each_ref().map(|body| {
            let of = |material: &Material| {
                (material.density() * material.dilatational_wave_speed()).recip()
            };
            body.material().map_or(0.0, of)
        });
        let rate = |side: usize| {
            let body = &self.bodies[side];
            let (stress, pole) = (body.stress.as_ref()?, *body.mesh()?.surface().first()?);
            let displacement = vec![[0.0; 2]; body.nodal_mass.len()];
            let mut velocity = displacement.clone();
            velocity[pole as usize][1] =
                self.approach.speed() * yields[side] / (yields[0] + yields[1]);
            let (time, time_step) = (self.approach.first_touch(), self.time_step);
            let (displacement, velocity) = (&*displacement, &*velocity);
            let nodal_mass = &*body.nodal_mass;
            let motion = Motion { time, time_step, displacement, velocity, nodal_mass };
            Some(stress.part.strain_rate(&motion))
        };
        [0, 1].into_iter().filter_map(rate).fold(0.0, f64::max)
    }

    /// Largest rate (1/s) at which an element of a body whose stiffness changes is strained now.
    pub(crate) fn strain_rate(&self, state: &State) -> f64 {
        let motions = state.motions(self);
        let rates = self.bodies.iter().zip(&motions).filter_map(|(body, motion)| {
            let stress = body.stress.as_ref().filter(|_| body.bound.is_some())?;
            Some(stress.part.strain_rate(motion))
        });
        rates.fold(0.0, f64::max)
    }

    /// Critical time step of the deformed bodies, and how fast they are strained; what it is made of goes
    /// to `scratch`.
    pub(crate) fn outlook(&self, state: &State, scratch: &mut Scratch) -> Outlook {
        self.outlook_and_node(state, scratch).0
    }

    /// The same, and body and node that ask for the critical step.
    fn outlook_and_node(&self, state: &State, scratch: &mut Scratch) -> (Outlook, [usize; 2]) {
        let motions = state.motions(self);
        let strain_rate = self.strain_rate(state);
        let within = Outlook::reaches(self, strain_rate);
        let (mut critical, mut node) = (f64::INFINITY, [0, 0]);
        for (side, body) in self.bodies.iter().enumerate() {
            let (stiffness, damping) = (&mut scratch.stiffness[side], &mut scratch.damping[side]);
            // Of a body at small strain, or a rigid one, the contact alone.
            if let Some(bound) = &body.bound {
                stiffness.fill(0.0);
                if let Some(stress) = &body.stress {
                    let history = stress.of(&state.bodies[side].history);
                    stress.part.add_stiffness_bound(&motions[side], history, stiffness);
                }
                damping.fill(0.0);
                self.contact.add_bound_growth(&motions, within, side, stiffness, damping);
                let (own, at) = bound.critical_time_step(&body.nodal_mass, stiffness, damping);
                if own < critical || own.is_nan() {
                    (critical, node) = (own, [side, at]);
                }
            }
        }
        let urgencies = self.bodies.iter().enumerate().filter_map(|(side, body)| {
            let stress = body.stress.as_ref().filter(|_| body.bound.is_some())?;
            let room = &mut scratch.stiffness[side];
            for step in room.iter_mut() {
                *step = Outlook::room(*step, critical);
            }
            Some(stress.part.urgency(&motions[side], room))
        });
        let urgency = urgencies.fold(0.0, f64::max);
        (Outlook { critical_time_step: critical, strain_rate, urgency }, node)
    }

    /// What is at fault where no step is short enough: an element that is compressed most and has the node
    /// that asks for it, or what holds that node.
    pub(crate) fn fault(&self, state: &State, scratch: &mut Scratch) -> Fault {
        let (outlook, [side, node]) = self.outlook_and_node(state, scratch);
        let (body, bodies) = (&self.bodies[side], &state.bodies[side]);
        let (stiffness, damping) = (&mut scratch.stiffness[side], &mut scratch.damping[side]);
        stiffness.fill(0.0);
        damping.fill(0.0);
        let mut without_contact = f64::INFINITY;
        if let (Some(bound), Some(stress)) = (&body.bound, &body.stress) {
            let history = stress.of(&bodies.history);
            stress.part.add_stiffness_bound(&state.motions(self)[side], history, stiffness);
            without_contact = bound.critical_time_step(&body.nodal_mass, stiffness, damping).0;
        }
        // More of the stiffness than the elements'.
        let is_of_contact = without_contact > SQRT_2 * outlook.critical_time_step;
        let collapsed = self.most_compressed(state);
        let is_corner = self.bodies[collapsed.side].mesh().is_some_and(|mesh| {
            let quad = mesh.quads().get(collapsed.collapse.element);
            collapsed.side == side && quad.is_some_and(|quad| quad.contains(&(node as u32)))
        });
        match is_corner && !is_of_contact {
            true => Fault::Collapsed(collapsed),
            false => Fault::TooStiff { side, node, is_of_contact },
        }
    }

    /// The element that is compressed most, of a model whose stiffness changes.
    fn most_compressed(&self, state: &State) -> Collapsed {
        let of = |side: usize| {
            let stress = self.bodies[side].stress.as_ref()?;
            let collapse = stress.part.most_compressed(&state.bodies[side].displacement)?;
            Some(Collapsed { side, collapse })
        };
        let ratio = |at: &Collapsed| at.collapse.volume_ratio;
        let most = [0, 1].into_iter().filter_map(of).min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        let none = Collapse { element: 0, volume_ratio: f64::NAN };
        most.unwrap_or(Collapsed { side: 0, collapse: none })
    }

    /// Why a run ends whose energy has grown, with the node that is fastest in its body, or whose motion is
    /// no number.
    pub(crate) fn stop_of(&self, Grown { time, step, ratio }: Grown, state: &State) -> Stop {
        let mut worst = (0, 0, -1.0);
        for side in 0..2 {
            let (body, BodyState { displacement, velocity, .. }) =
                (&self.bodies[side], &state.bodies[side]);
            let centre = body.centre(velocity);
            for (node, (u, v)) in displacement.iter().zip(velocity).enumerate() {
                let square = v[0] * v[0] + (v[1] - centre) * (v[1] - centre);
                let is_lost = ![*u, *v].as_flattened().iter().all(|number| number.is_finite());
                if is_lost {
                    let place = self.place(side, node);
                    return Stop::NoNumber { time, step, body: side, node, place };
                }
                if square > worst.2 {
                    worst = (side, node, square);
                }
            }
        }
        let (body, node, _) = worst;
        Stop::EnergyGrowth { time, step, ratio, body, node, place: self.place(body, node) }
    }

    /// Why a run ends of which a surface has turned over.
    pub(crate) fn stop_of_turn(&self, turn: SurfaceFold, state: &State) -> Stop {
        let SurfaceFold { side, node, radius } = turn;
        let (time, step, node) = (state.time, state.step, node as usize);
        let place = self.place(side, node);
        Stop::SurfaceTurnsOver { time, step, radius, body: side, node, place }
    }

    /// Where a node lies before the collision (r, y), m; of a rigid body its only one.
    fn place(&self, side: usize, node: usize) -> [f64; 2] {
        let place = self.bodies[side].mesh().map(|mesh| mesh.nodes()[node]);
        place.unwrap_or([0.0; 2])
    }

    /// Centre (r, y) of an element of a side before the collision, m.
    pub(crate) fn centre(&self, side: usize, element: usize) -> [f64; 2] {
        let corners = self.bodies[side].mesh().map(|mesh| mesh.corners(element));
        corners.map_or([f64::NAN; 2], |corners| {
            [0, 1].map(|axis: usize| corners.iter().map(|x| x[axis]).sum::<f64>() / 4.0)
        })
    }

    /// Why a run ends that cannot go on.
    pub(crate) fn stop(&self, fault: Fault, state: &State) -> Stop {
        let (time, step) = (state.time, state.step);
        match fault {
            Fault::Collapsed(Collapsed { side, collapse: Collapse { element, volume_ratio } }) => {
                let place = self.centre(side, element);
                Stop::ElementCollapsed { time, step, body: side, element, place, volume_ratio }
            }
            Fault::TooStiff { side, node, is_of_contact } => {
                let place = self.place(side, node);
                Stop::NoStepShortEnough { time, step, body: side, place, of_contact: is_of_contact }
            }
        }
    }
}
