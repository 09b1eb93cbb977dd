//! A bound of the springs' stiffness for the critical time step.

use super::MovedInterface;
use super::pieces::Point;
use super::segment::Segment;
use crate::interface::OPENING_SAFETY;

impl MovedInterface {
    /// Adds a bound of the contact stiffness of the undeformed surfaces at each node (N/m) of a side (0
    /// lower, 1 upper); see [`MovedInterface::add_moved_stiffness_bound`].
    pub fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        self.add_bound([|_| [0.0; 2]; 2], side, bound);
    }

    /// The same of displacements `u`, m.
    ///
    /// A spring k A (m·δ)² along m = (−y', 1) is at most (1 + y'²) k A in any direction; the rest is as
    /// in [`ContactInterface::add_stiffness_bound`](crate::ContactInterface::add_stiffness_bound), but
    /// of the areas that the surfaces have now and with all points closed. The slope is that of the
    /// interface where it closes: a rigid body's own, of bodies that both deform the steeper one.
    /// The terms by which the pressure stiffens or softens (p A over the length of a segment, so −g/h
    /// of the spring) and those of the ends of pieces are not counted: up to overlaps of a
    /// segment's length they are within what is taken for opening and closing.
    pub fn add_moved_stiffness_bound(&self, u: [&[[f64; 2]]; 2], side: usize, bound: &mut [f64]) {
        self.add_bound(u.map(|u| move |node: u32| u[node as usize]), side, bound);
    }

    fn add_bound(&self, u: [impl Fn(u32) -> [f64; 2]; 2], side: usize, bound: &mut [f64]) {
        for (piece, point) in self.points(u) {
            let own = &piece.segments[side];
            let steepness =
                if own.is_rigid() { 0.0 } else { slope_squared(&piece.segments, &point) };
            let spring = OPENING_SAFETY * self.springs[side] * piece.stiffness * point.area;
            let stiffness = spring * (1.0 + steepness);
            let [inner, outer] = own.nodes().map(|node| node as usize);
            let share = point.places[side].share;
            bound[inner] += (1.0 - share) * stiffness;
            bound[outer] += share * stiffness;
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
