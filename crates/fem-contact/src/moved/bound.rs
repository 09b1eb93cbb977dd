//! A bound of the springs' stiffness for the critical time step.

use super::MovedInterface;
use super::common_refinement::{Piece, Point};
use super::segment::Segment;
use crate::interface::OPENING_SAFETY;
use crate::surface::STEEPEST;

/// What takes the place of [`OPENING_SAFETY`] beside dashpots: a spring that opens and closes within a
/// few steps gains less than they take. With 0.3 of critical damping a glass pair, rubber on a wall and
/// steel on a soft ball keep their energy to 1e-6, 3e-5 and 3e-6 at 50 times the default penalty, with
/// the whole critical step; with 4 it is as much, for 1.28 times the steps.
const DAMPED_OPENING_SAFETY: f64 = 2.0;

impl MovedInterface {
    /// Adds a bound of the contact stiffness of the undeformed surfaces at each node (N/m) of a side (0
    /// lower, 1 upper), whatever is closed: of slopes up to 1, as far as two bodies at small strain touch. See
    /// [`MovedInterface::add_moved_stiffness_bound`].
    pub fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        let per_area = self.springs_per_area();
        self.add_bound(AT_REST, side, steepness_at_rest, per_area, bound);
    }

    /// The same of displacements `u`, m, as long as no point comes nearer to the other surface than by a
    /// `reach`, m.
    ///
    /// A spring k A (m·δ)² along m = (−y', 1) is at most (1 + y'²) k A in any direction; the rest is as
    /// in [`ContactInterface::add_stiffness_bound`](crate::ContactInterface::add_stiffness_bound), but
    /// of the areas that the surfaces have now and with all points closed. The slope is that of the
    /// interface where it closes: a rigid body's own, of bodies that both deform the steeper one. It counts
    /// where a point is closed or within reach; elsewhere it is that of a flank that touches nothing, which
    /// has no limit where a surface bulges over its contact, and y'² is taken as 0.
    /// The terms by which the pressure stiffens or softens (p A over the length of a segment, so −g/h
    /// of the spring) and those of the ends of pieces are not counted: up to overlaps of a
    /// segment's length, half of one beside dashpots, they are within what is taken for opening and
    /// closing.
    pub fn add_moved_stiffness_bound(
        &self,
        u: [&[[f64; 2]]; 2],
        reach: f64,
        side: usize,
        bound: &mut [f64],
    ) {
        let per_area = self.springs_per_area();
        self.add_bound(moved(u), side, steepness_within(reach), per_area, bound);
    }

    /// Adds a bound of the damping of the undeformed surfaces at each node (N s/m) of a side (0 lower, 1
    /// upper), as the springs' without what is taken for opening and closing.
    pub fn add_damping_bound(&self, side: usize, bound: &mut [f64]) {
        if self.impedance > 0.0 {
            self.add_bound(AT_REST, side, steepness_at_rest, |_| self.impedance, bound);
        }
    }

    /// Adds what the bounds of stiffness (N/m) and damping (N s/m) have grown by from the undeformed
    /// surfaces to displacements `u`, m, with the slopes of what is closed or within a `reach`, m.
    pub fn add_bound_growth(
        &self,
        u: [&[[f64; 2]]; 2],
        reach: f64,
        side: usize,
        stiffness: &mut [f64],
        damping: &mut [f64],
    ) {
        let springs = self.springs_per_area();
        let grown = steepness_within(reach);
        self.add_bound(AT_REST, side, steepness_at_rest, |piece| -springs(piece), stiffness);
        self.add_bound(moved(u), side, &grown, &springs, stiffness);
        if self.impedance > 0.0 {
            self.add_bound(AT_REST, side, steepness_at_rest, |_| -self.impedance, damping);
            self.add_bound(moved(u), side, &grown, |_| self.impedance, damping);
        }
    }

    /// How much nearer points of both surfaces can come to each other in a time (s), m, for displacements
    /// (m) and velocities (m/s): as far as the fastest of them moves on the other one, twice, because a wave
    /// doubles its velocity at a free surface.
    pub fn reach(&self, u: [&[[f64; 2]]; 2], v: [&[[f64; 2]]; 2], time: f64) -> f64 {
        let speed_squared = |(piece, point): (Piece<'_>, Point)| {
            let [lower, upper] = [0, 1].map(|side: usize| piece.velocity(&point, side, v[side]));
            (upper[0] - lower[0]).powi(2) + (upper[1] - lower[1]).powi(2)
        };
        2.0 * time * self.points(moved(u)).map(speed_squared).fold(0.0, f64::max).sqrt()
    }

    /// Stiffness per area that counts of a piece, Pa/m.
    fn springs_per_area(&self) -> impl Fn(&Piece<'_>) -> f64 {
        let safety = if self.impedance > 0.0 { DAMPED_OPENING_SAFETY } else { OPENING_SAFETY };
        move |piece| safety * piece.stiffness
    }

    fn add_bound(
        &self,
        u: [impl Fn(u32) -> [f64; 2]; 2],
        side: usize,
        steepness: impl Fn(&Piece<'_>, &Point) -> f64,
        per_area: impl Fn(&Piece<'_>) -> f64,
        bound: &mut [f64],
    ) {
        for (piece, point) in self.points(u) {
            let own = &piece.segments[side];
            let steepness = if own.is_rigid() { 0.0 } else { steepness(&piece, &point) };
            let of_point = self.springs[side] * per_area(&piece) * point.area * (1.0 + steepness);
            let [inner, outer] = own.nodes().map(|node| node as usize);
            let share = point.places[side].share;
            bound[inner] += (1.0 - share) * of_point;
            bound[outer] += share * of_point;
        }
    }
}

/// Displacements of undeformed bodies.
const AT_REST: [fn(u32) -> [f64; 2]; 2] = [|_| [0.0; 2]; 2];

fn moved(u: [&[[f64; 2]]; 2]) -> [impl Fn(u32) -> [f64; 2]; 2] {
    u.map(|u| move |node: u32| u[node as usize])
}

/// y'² that counts of undeformed surfaces.
fn steepness_at_rest(piece: &Piece<'_>, point: &Point) -> f64 {
    slope_squared(piece, point).min(STEEPEST * STEEPEST)
}

/// y'² that counts of surfaces that come nearer by no more than a reach, m.
fn steepness_within(reach: f64) -> impl Fn(&Piece<'_>, &Point) -> f64 {
    move |piece, point| match is_within(point, reach) {
        true => slope_squared(piece, point),
        false => 0.0,
    }
}

/// Whether a point is closed, or its surfaces can touch there as they come nearer by a reach, m.
///
/// Surfaces that lean the same way are apart by the gap along their normal, g / √(1 + y'²), of the flatter
/// slope at least. Between those that open like a wedge, a place of either has to come down by what
/// it rises over the way that it comes in: the gap itself is less than twice the reach.
fn is_within(point: &Point, reach: f64) -> bool {
    let [lower, upper] = point.places.map(|place| place.slope);
    let reach_along_y = match lower * upper > 0.0 {
        true => reach * lower.abs().min(upper.abs()).hypot(1.0),
        false => 2.0 * reach,
    };
    point.gap <= reach_along_y.max(0.0)
}

/// y'² of the interface where a point closes.
fn slope_squared(piece: &Piece<'_>, point: &Point) -> f64 {
    let squares = point.places.map(|place| place.slope * place.slope);
    match piece.segments.each_ref().map(Segment::is_rigid) {
        [true, _] => squares[0],
        [_, true] => squares[1],
        _ => squares[0].max(squares[1]),
    }
}
