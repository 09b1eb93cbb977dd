//! The balance of massless nodes whose springs turn as the surfaces slip.
//!
//! The gap is a function of second order of the displacements ([`SlippingInterface`]), so the opening of a spring
//! depends on the change x:
//!
//! ```math
//! K x = R + \sum_j k_j \langle -g_j(x) \rangle\, \nabla g_j(x)
//! ```
//!
//! In each pass the gaps are linearised about the x of the pass before, and the balance is that of springs that do not
//! turn ([`ActiveSet`]). The remaining error is of second order in the change of a pass. Passes are repeated while it
//! is more than [`MAX_IMBALANCE`] of the force; two suffice in most steps. The potential differs from that of
//! [`ActiveSet`] by curvatures of a force over the length of a segment, which are small compared with the stiffness of
//! elements at small strain: it is convex there, and energy is conserved as well.

use fem_contact::{Displacement, SlippingInterface};

use super::Massless;
use super::active_set::{ActiveSet, Problem};
use crate::part::MotionMut;

/// Largest error in the balance of a node over the force of the contact. It acts on the next node, and its work is in
/// no account: at most this share of the stored energy.
const MAX_IMBALANCE: f64 = 1e-7;
/// Largest number of passes: 4 are needed at a contact radius of a twentieth of the radius, 11 at strains of a third.
const MAX_PASSES: usize = 20;

/// Buffers for a solution.
#[derive(Debug)]
pub(super) struct SlippingSprings {
    /// The springs have the openings of the last x.
    problem: Problem,
    /// Change of the forces of the springs since the last solution, N.
    lacking: Vec<f64>,
}

impl SlippingSprings {
    /// Starts with the springs of the undeformed surfaces.
    pub fn new(problem: &Problem) -> Self {
        Self { problem: problem.clone(), lacking: vec![0.0; problem.stiffness.n_rows()] }
    }
}

impl Massless {
    /// Solves for x, given the missing forces in `active_set` and the displacements before the change. `None` if a
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
        for _ in 0..MAX_PASSES {
            active_set.forget_closed();
            active_set.solve(&slipping_springs.problem)?;
            let force = slipping_springs.turn(self, slipping, u, active_set);
            if slipping_springs.lacking.iter().all(|lack| lack.abs() <= MAX_IMBALANCE * force) {
                break;
            }
        }
        Some(())
    }
}

impl SlippingSprings {
    /// Linearises the gaps about the x of `active_set`. Leaves the missing forces in this struct, and returns the
    /// contact force, N.
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
            let projections = &slipping.interface().points()[k].projections;
            let ends: [[Displacement; 2]; 2] = std::array::from_fn(|side| {
                std::array::from_fn(|end| {
                    let [r, y] = u[side][projections[side].nodes[end] as usize];
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
