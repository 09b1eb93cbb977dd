//! The massless boundary: surface nodes that can be in contact carry no mass, and the forces on them are in balance at
//! the end of every step.
//!
//! ```math
//! 0 = -K_b w + B^T p(w_b), \qquad M_i \ddot u_i = -K_i w + f_i
//! ```
//!
//! with the rows b of the massless nodes and i of the others (Khenous, Laborde & Renard 2008, Eur. J. Mech. A 27, 918;
//! in explicit dynamics Monjaraz-Tec, Gross & Krack 2022, Comput. Struct. 277–278). The springs p between the surfaces
//! are those of [`ContactInterface`]. They open and close without mass between them that could ring, and they do not
//! limit the time step, however stiff they are. The force of the boundary on the other nodes is the gradient of a
//! convex potential (`body/critical_time_step.rs`), so the contact neither gains nor loses energy.
//!
//! A step has a predictor, in which the massless nodes keep their velocity, and a corrector, which solves
//! (K_b + springs) x = R for their further displacement x, with the residual forces R of the predictor. The system is
//! linear except for the springs that close ([`ActiveSet`]). K_b is the stiffness of the elements against a displacement at
//! the end of a step, which includes their history (`SmallStrainStress::stiffness_of_step`). Springs of slipping surfaces
//! turn, so the system is solved in passes ([`SlippingSprings`]). Masses are moved inward
//! (`body/massless_boundary_mass.rs`).

mod active_set;
mod boundary;
mod skyline;
mod slipping_springs;

use std::any::Any;

use fem_collision::{BodyInput, CandidateRegion};
use fem_contact::{ContactForces, ContactInterface, Profile};

use super::{Contact, Springs};
use crate::error::ModelError;
use crate::part::{Field, Motion, MotionMut, NodalField, Part};
use crate::stress::Collapse;
use active_set::{ActiveSet, Problem, Spring};
use boundary::Boundary;
use skyline::Skyline;
use slipping_springs::SlippingSprings;

/// An instant counts as the last contact if the force falls by more than this share in the next predictor.
const LAST_LOSS: f64 = 0.25;

/// The massless boundaries of the deformable bodies, and the springs between them.
#[derive(Debug)]
pub struct Massless {
    springs: Springs,
    sides: [Option<Boundary>; 2],
    /// Side and place of the node of each pair of unknowns (r, y), from the axis outward.
    unknowns: Vec<(usize, usize)>,
    /// For each spring, the unknowns at the ends of the segments on both sides, radial and along y.
    ends: Vec<[[[Option<usize>; 2]; 2]; 2]>,
    /// Present once the time step is known, unless elements have no stiffness.
    problem: Option<Problem>,
    inverse_step: f64,
}

impl Massless {
    /// Takes two bodies and the springs between them; all nodes at the ends of springs lose their mass.
    ///
    /// # Errors
    /// No corner of an element has mass.
    pub fn new(bodies: &[BodyInput; 2], springs: Springs) -> Result<Self, ModelError> {
        let points = springs.interface().points();
        let nodes =
            |side: usize| points.iter().flat_map(|point| point.projections[side].nodes).collect();
        let sides = [Boundary::new(&bodies[0], nodes(0))?, Boundary::new(&bodies[1], nodes(1))?];
        let places = |side: usize| {
            let n = sides[side].as_ref().map_or(0, |boundary| boundary.nodes.len());
            (0..n).map(move |place| (side, place))
        };
        let mut unknowns: Vec<_> = places(0).chain(places(1)).collect();
        let radius = |(side, place): (usize, usize)| {
            sides[side].as_ref().map_or(0.0, |boundary| boundary.radii[place])
        };
        unknowns.sort_by(|&a, &b| radius(a).total_cmp(&radius(b)));
        let none =
            Self { springs, sides, unknowns, ends: Vec::new(), problem: None, inverse_step: 0.0 };
        let ends = none.ends();
        Ok(Self { ends, ..none })
    }

    /// Returns the springs between the nodes without mass.
    pub fn springs(&self) -> &Springs {
        &self.springs
    }

    /// Returns the springs without their slip.
    fn interface(&self) -> &ContactInterface {
        self.springs.interface()
    }

    /// Returns whether the surfaces slip.
    fn slips(&self) -> bool {
        self.springs.slipping().is_some()
    }

    /// Returns the first row of the unknowns of a node of a side.
    fn row(&self, side: usize, node: u32) -> Option<usize> {
        let nodes = &self.sides[side].as_ref()?.nodes;
        let is_node = |&(other, place): &(usize, usize)| other == side && nodes[place] == node;
        Some(2 * self.unknowns.iter().position(is_node)?)
    }

    /// Returns the unknowns at the ends of each spring. Springs that do not turn open along y alone.
    fn ends(&self) -> Vec<[[[Option<usize>; 2]; 2]; 2]> {
        let unknown = |side: usize, node: u32| {
            let row = self.row(side, node);
            let radial = row.filter(|&row| self.slips() && !self.is_fixed(row));
            [radial, row.map(|row| row + 1)]
        };
        let of_spring = |point: &fem_contact::ContactPoint| {
            std::array::from_fn(|side| {
                point.projections[side].nodes.map(|node| unknown(side, node))
            })
        };
        self.interface().points().iter().map(of_spring).collect()
    }

    /// Returns the unknown at an end of a spring.
    fn unknown(&self, k: usize, side: usize, end: usize, axis: usize) -> Option<usize> {
        self.ends[k][side][end][axis]
    }

    /// Returns side, end and axis of the unknowns of a spring, in the order of its openings.
    fn entries(&self, k: usize) -> impl Iterator<Item = [usize; 3]> + '_ {
        (0..8)
            .map(|entry: usize| [entry / 4, entry / 2 % 2, entry % 2])
            .filter(move |&[side, end, axis]| self.unknown(k, side, end, axis).is_some())
    }

    /// Returns the springs of the undeformed surfaces.
    fn undeformed_springs(&self) -> Vec<Spring> {
        let spring = |(k, point): (usize, &fem_contact::ContactPoint)| {
            let at_first = self
                .springs
                .slipping()
                .map(|slipping| slipping.gap_of_ends(k, [[[0.0; 2]; 2]; 2]).opening);
            let ends = self.entries(k).filter_map(|[side, end, axis]| {
                let straight = [-1.0, 1.0][side] * point.projections[side].shape[end];
                let share = at_first.map_or(straight, |opening| opening[side][end][axis]);
                Some((self.unknown(k, side, end, axis)?, share))
            });
            Spring { stiffness: point.stiffness * point.area, opening: ends.collect() }
        };
        self.interface().points().iter().enumerate().map(spring).collect()
    }

    /// Assembles matrix and springs, once the boundaries know the time step.
    fn assemble(&self) -> Option<Problem> {
        let springs = self.undeformed_springs();
        let mut entries = Vec::new();
        for (side, boundary) in self.sides.iter().enumerate() {
            let Some(boundary) = boundary else { continue };
            for (quad, matrix) in boundary.elements() {
                let rows = quad.map(|node| self.row(side, node));
                let unknown = |k: usize| {
                    let row = rows[k / 2]? + k % 2;
                    (!self.is_fixed(row)).then_some(row)
                };
                for (a, b) in (0..8).flat_map(|a| (0..8).map(move |b| (a, b))) {
                    if let (Some(i), Some(j)) = (unknown(a), unknown(b))
                        && j <= i
                    {
                        entries.push((i, j, matrix[(a, b)]));
                    }
                }
            }
        }
        let n = 2 * self.unknowns.len();
        let mut first: Vec<_> = (0..n).collect();
        let coupled = springs.iter().flat_map(|Spring { opening, .. }| {
            opening.iter().flat_map(|&(i, _)| opening.iter().map(move |&(j, _)| (i, j)))
        });
        for (i, j) in entries.iter().map(|&(i, j, _)| (i, j)).chain(coupled) {
            first[i] = first[i].min(j);
        }
        let mut stiffness = Skyline::new(first);
        entries.into_iter().for_each(|(i, j, value)| *stiffness.entry(i, j) += value);
        (0..n).filter(|&row| self.is_fixed(row)).for_each(|row| *stiffness.entry(row, row) = 1.0);
        stiffness.clone().factor(0)?;
        Some(Problem { stiffness, springs })
    }

    /// Returns whether an unknown is the radial motion of a node on the axis, which is zero.
    fn is_fixed(&self, row: usize) -> bool {
        let (side, place) = self.unknowns[row / 2];
        let on_axis = |boundary: &Boundary| boundary.radii[place] == 0.0;
        row.is_multiple_of(2) && self.sides[side].as_ref().is_some_and(on_axis)
    }

    /// Computes the forces that are missing to the balance of the massless nodes after a step in which they kept their
    /// velocity.
    fn update(&self, motions: &[MotionMut<'_>; 2], buffers: &mut Buffers) -> Result<(), Collapse> {
        let Buffers { forces, active_set, .. } = buffers;
        for (side, boundary) in self.sides.iter().enumerate() {
            if let Some(boundary) = boundary {
                boundary.update_forces(&motions[side], &mut forces[side])?;
            }
        }
        for (pair, &(side, place)) in active_set.lacking.chunks_exact_mut(2).zip(&self.unknowns) {
            let Some(boundary) = &self.sides[side] else { continue };
            let [r, y] = forces[side][boundary.nodes[place] as usize];
            pair.copy_from_slice(&[if boundary.radii[place] == 0.0 { 0.0 } else { r }, y]);
        }
        Ok(())
    }

    /// Solves for the further displacements of the massless nodes.
    fn solve(
        &self,
        problem: &Problem,
        motions: &[MotionMut<'_>; 2],
        buffers: &mut Buffers,
    ) -> Option<()> {
        // At small strain no element collapses.
        self.update(motions, buffers).ok()?;
        let Buffers { active_set, slipping_springs, .. } = buffers;
        match (&self.springs, slipping_springs) {
            (Springs::Slipping(slipping), Some(slipping_springs)) => {
                self.solve_slipping(slipping, motions, active_set, slipping_springs)
            }
            (springs, _) => {
                let displacements = motions.each_ref().map(|motion| &*motion.displacement);
                for (k, gap) in active_set.gaps.iter_mut().enumerate() {
                    *gap = springs.interface().gap(k, displacements);
                }
                active_set.solve(problem)
            }
        }
    }
}

/// The buffers of a run.
#[derive(Debug)]
struct Buffers {
    /// Forces of the elements at the boundaries, N; without meaning at other nodes.
    forces: [NodalField; 2],
    active_set: ActiveSet,
    /// Present for slipping surfaces.
    slipping_springs: Option<SlippingSprings>,
}

impl Part for Massless {
    fn set_time_step(&mut self, time_step: f64) {
        self.sides.iter_mut().flatten().for_each(|boundary| boundary.set_time_step(time_step));
        self.inverse_step = time_step.recip();
        self.problem = self.assemble();
    }
}

impl Contact for Massless {
    fn candidate_region(&self) -> CandidateRegion {
        self.springs.candidate_region()
    }

    fn check(&self) -> Result<(), ModelError> {
        self.problem.as_ref().map(|_| ()).ok_or(ModelError::NoBalance)
    }

    /// Bounds the springs at a rigid sphere as if the other body were fixed, which is more than they can pull.
    fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        if self.sides[side].is_none() {
            self.interface().add_bound_against_held(side, bound);
        }
    }

    fn massless_nodes(&self, side: usize) -> &[u32] {
        self.sides[side].as_ref().map_or(&[], |boundary| &boundary.nodes)
    }

    fn pushed_nodes(&self, side: usize) -> Vec<u32> {
        match &self.sides[side] {
            Some(boundary) => boundary.pushed_nodes(),
            None => self.springs.pushed_nodes(side),
        }
    }

    fn buffers(&self) -> Box<dyn Any + Send + Sync> {
        let field =
            |side: &Option<Boundary>| vec![[0.0; 2]; side.as_ref().map_or(0, Boundary::n_nodes)];
        let Some(problem) = &self.problem else { return Box::new(()) };
        let forces = self.sides.each_ref().map(field);
        let slipping_springs = self.slips().then(|| SlippingSprings::new(problem));
        Box::new(Buffers { forces, active_set: ActiveSet::new(problem), slipping_springs })
    }

    fn add_forces(
        &self,
        motions: &[Motion<'_>; 2],
        _: [&[NodalField]; 2],
        [lower, upper]: [&mut Field; 2],
    ) -> ContactForces {
        let contact = self.springs.add_forces(motions, [&[]; 2], [&mut *lower, &mut *upper]);
        for (boundary, forces) in self.sides.iter().zip([lower, upper]) {
            if let Some(boundary) = boundary {
                boundary.hand_over(forces);
            }
        }
        contact
    }

    fn advance(
        &self,
        mut motions: [MotionMut<'_>; 2],
        _: [&mut [NodalField]; 2],
        buffers: &mut dyn Any,
    ) {
        let (Some(problem), Some(buffers)) = (&self.problem, buffers.downcast_mut::<Buffers>())
        else {
            return;
        };
        // A matrix that was positive stays so with springs.
        if self.solve(problem, &motions, buffers).is_none() {
            return;
        }
        for (pair, &(side, place)) in buffers.active_set.change.chunks_exact(2).zip(&self.unknowns)
        {
            if let Some(boundary) = &self.sides[side] {
                let (node, change) = (boundary.nodes[place], [pair[0], pair[1]]);
                boundary.shift(&mut motions[side], node, change, self.inverse_step);
            }
        }
    }

    fn is_closed_next(
        &self,
        now: &ContactForces,
        next: [&dyn Fn(u32) -> [f64; 2]; 2],
        _: [&[NodalField]; 2],
    ) -> bool {
        let force = self.springs.force(next);
        force > (1.0 - LAST_LOSS) * now.force
    }

    fn radius_and_pressure(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> (f64, f64) {
        self.springs.radius_and_pressure(motions, [&[]; 2])
    }

    fn profile(&self, motions: &[Motion<'_>; 2], _: [&[NodalField]; 2]) -> Profile {
        self.springs.profile(motions, [&[]; 2])
    }
}
