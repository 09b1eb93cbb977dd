//! The balance of nodes without mass whose springs turn as they slip.
//!
//! The gap is a function of second order of the displacements there ([`SlippingInterface`]), and what a
//! change x opens it by is one of x:
//!
//! ```math
//! K x = R + \sum_j k_j \langle -g_j(x) \rangle\, \nabla g_j(x)
//! ```
//!
//! In each pass gaps are linear about the x of the pass before, and the balance is that of springs which do
//! not turn ([`ActiveSet`]); what is left of it is of second order in what a pass moves, and there is one pass
//! more while that is more than [`BALANCED`] of the force: two in most steps. The potential is that of
//! [`ActiveSet`] with curvatures of a force over the length of a segment, small beside the stiffness of elements
//! where strains are: it is convex there, and energy is kept as well.

use fem_contact::{Displacement, SlippingInterface};

use super::Massless;
use super::active_set::{ActiveSet, Problem};
use crate::part::MotionMut;

/// What a step may lack in the balance of a node, over the force of the contact. It acts on the next node
/// and is work that no account has: at most this share of what is stored.
const BALANCED: f64 = 1e-7;
/// Passes at most. Four are the most at a contact of a twentieth of the radius, eleven at strains of a third.
const MOST_PASSES: usize = 20;

/// Room for a solution.
#[derive(Debug)]
pub(super) struct SlippingSprings {
    /// Its springs open by what they do at the last x.
    problem: Problem,
    /// Forces of the springs less those of the last solution, N.
    lacking: Vec<f64>,
}

impl SlippingSprings {
    /// Of springs as they are at no displacement.
    pub fn new(problem: &Problem) -> Self {
        Self { problem: problem.clone(), lacking: vec![0.0; problem.stiffness.n_rows()] }
    }
}

impl Massless {
    /// Finds x of the forces that are lacking in `active_set`, for displacements before it. `None` where a
    /// matrix is not positive.
    pub(super) fn solve_slipping(
        &self,
        slipping: &SlippingInterface,
        motions: &[MotionMut<'_>; 2],
        active_set: &mut ActiveSet,
        slipping_springs: &mut SlippingSprings,
    ) -> Option<()> {
        let u = motions.each_ref().map(|motion| &*motion.displacement);
        active_set.change.fill(0.0);
        slipping_springs.turn(self, slipping, u, active_set);
        for _ in 0..MOST_PASSES {
            active_set.forget_closed();
            active_set.solve(&slipping_springs.problem)?;
            let force = slipping_springs.turn(self, slipping, u, active_set);
            if slipping_springs.lacking.iter().all(|lack| lack.abs() <= BALANCED * force) {
                break;
            }
        }
        Some(())
    }
}

impl SlippingSprings {
    /// Makes gaps linear about the x of `active_set`. What is lacking then, and the force of the contact, N.
    fn turn(
        &mut self,
        massless: &Massless,
        slipping: &SlippingInterface,
        u: [&[Displacement]; 2],
        active_set: &mut ActiveSet,
    ) -> f64 {
        let (mut total, x) = (0.0, &active_set.change);
        self.lacking.fill(0.0);
        for (k, (spring, gap)) in
            self.problem.springs.iter_mut().zip(&mut active_set.gaps).enumerate()
        {
            let before = spring.stiffness * (-(*gap + spring.opens_by(x))).max(0.0);
            if before > 0.0 {
                for &(row, share) in &spring.opening {
                    self.lacking[row] -= share * before;
                }
            }
            let feet = &slipping.interface().points()[k].feet;
            let ends: [[Displacement; 2]; 2] = std::array::from_fn(|side| {
                std::array::from_fn(|end| {
                    let [r, y] = u[side][feet[side].nodes[end] as usize];
                    let moved =
                        |axis| massless.unknown(k, side, end, axis).map_or(0.0, |row| x[row]);
                    [r + moved(0), y + moved(1)]
                })
            });
            let now = slipping.gap_of_ends(k, ends);
            for (opening, [side, end, axis]) in spring.opening.iter_mut().zip(massless.entries(k)) {
                opening.1 = now.opening[side][end][axis];
            }
            *gap = now.gap - spring.opens_by(x);
            let force = spring.stiffness * (-now.gap).max(0.0);
            if force > 0.0 {
                for &(row, share) in &spring.opening {
                    self.lacking[row] += share * force;
                }
                total += force;
            }
        }
        total
    }
}
