//! A bound of the springs' stiffness for the critical time step.

use super::MovedInterface;
use super::pieces::{Piece, Point};
use super::segment::Segment;
use crate::interface::OPENING_SAFETY;

/// What takes the place of [`OPENING_SAFETY`] beside dashpots: a spring that opens and closes within a
/// few steps gains less than they take. With 0.3 of critical damping a glass pair, rubber on a wall and
/// steel on a soft ball keep their energy to 1e-6, 3e-5 and 3e-6 at 50 times the default penalty, with
/// the whole critical step; with 4 it is as much, for 1.28 times the steps.
const DAMPED_OPENING_SAFETY: f64 = 2.0;

impl MovedInterface {
    /// Adds a bound of the contact stiffness of the undeformed surfaces at each node (N/m) of a side (0
    /// lower, 1 upper); see [`MovedInterface::add_moved_stiffness_bound`].
    pub fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        self.add_bound(
            [|_| [0.0; 2]; 2],
            side,
            |piece| self.opening_safety() * piece.stiffness,
            bound,
        );
    }

    /// The same of displacements `u`, m.
    ///
    /// A spring k A (m·δ)² along m = (−y', 1) is at most (1 + y'²) k A in any direction; the rest is as
    /// in [`ContactInterface::add_stiffness_bound`](crate::ContactInterface::add_stiffness_bound), but
    /// of the areas that the surfaces have now and with all points closed. The slope is that of the
    /// interface where it closes: a rigid body's own, of bodies that both deform the steeper one.
    /// The terms by which the pressure stiffens or softens (p A over the length of a segment, so −g/h
    /// of the spring) and those of the ends of pieces are not counted: up to overlaps of a
    /// segment's length, half of one beside dashpots, they are within what is taken for opening and
    /// closing.
    pub fn add_moved_stiffness_bound(&self, u: [&[[f64; 2]]; 2], side: usize, bound: &mut [f64]) {
        let u = u.map(|u| move |node: u32| u[node as usize]);
        self.add_bound(u, side, |piece| self.opening_safety() * piece.stiffness, bound);
    }

    /// Adds a bound of the damping of the undeformed surfaces at each node (N s/m) of a side (0 lower, 1
    /// upper), as the springs' without what is taken for opening and closing.
    pub fn add_damping_bound(&self, side: usize, bound: &mut [f64]) {
        if self.impedance > 0.0 {
            self.add_bound([|_| [0.0; 2]; 2], side, |_| self.impedance, bound);
        }
    }

    /// Adds what the bounds of stiffness (N/m) and damping (N s/m) have grown by from the undeformed
    /// surfaces to displacements `u`, m.
    pub fn add_bound_growth(
        &self,
        u: [&[[f64; 2]]; 2],
        side: usize,
        stiffness: &mut [f64],
        damping: &mut [f64],
    ) {
        let safety = self.opening_safety();
        let moved = || u.map(|u| move |node: u32| u[node as usize]);
        let still = || [|_: u32| [0.0; 2]; 2];
        self.add_bound(still(), side, |piece| -safety * piece.stiffness, stiffness);
        self.add_bound(moved(), side, |piece| safety * piece.stiffness, stiffness);
        if self.impedance > 0.0 {
            self.add_bound(still(), side, |_| -self.impedance, damping);
            self.add_bound(moved(), side, |_| self.impedance, damping);
        }
    }

    fn opening_safety(&self) -> f64 {
        if self.impedance > 0.0 { DAMPED_OPENING_SAFETY } else { OPENING_SAFETY }
    }

    fn add_bound(
        &self,
        u: [impl Fn(u32) -> [f64; 2]; 2],
        side: usize,
        per_area: impl Fn(&Piece<'_>) -> f64,
        bound: &mut [f64],
    ) {
        for (piece, point) in self.points(u) {
            let own = &piece.segments[side];
            let steepness =
                if own.is_rigid() { 0.0 } else { slope_squared(&piece.segments, &point) };
            let of_point = self.springs[side] * per_area(&piece) * point.area * (1.0 + steepness);
            let [inner, outer] = own.nodes().map(|node| node as usize);
            let share = point.places[side].share;
            bound[inner] += (1.0 - share) * of_point;
            bound[outer] += share * of_point;
        }
    }
}

/// y'² of the interface where a point closes.
fn slope_squared(segments: &[Segment<'_>; 2], point: &Point) -> f64 {
    let squares = point.places.map(|place| place.slope * place.slope);
    match segments.each_ref().map(Segment::is_rigid) {
        [true, _] => squares[0],
        [_, true] => squares[1],
        _ => squares[0].max(squares[1]),
    }
}
