//! A bound of the stiffness and damping of the contact, for the critical time step.

use super::DeformedInterface;
use super::common_refinement::{GaussPoint, Interval};
use super::segment::Segment;
use crate::interface::OPENING_SAFETY;
use crate::surface::STEEPEST;

/// Replaces [`OPENING_SAFETY`] when dashpots are present: a spring that opens and closes within a few steps
/// gains less energy than they dissipate. With 0.3 of critical damping a glass pair, rubber on a wall and steel
/// on a soft ball keep their energy to 1e-6, 3e-5 and 3e-6 at 50 times the default penalty and the full critical
/// step. A factor of 4 keeps it equally well with 1.28 times as many steps.
const DAMPED_OPENING_SAFETY: f64 = 2.0;

impl DeformedInterface {
    /// Adds a bound of the contact stiffness of the undeformed surfaces at each node (N/m) of a side (0
    /// lower, 1 upper), for any closed points and slopes up to 1, the limit of a contact at small strain. See
    /// [`DeformedInterface::add_deformed_stiffness_bound`].
    pub fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        let per_area = self.springs_per_area();
        self.add_bound(AT_REST, side, steepness_at_rest, per_area, bound);
    }

    /// Adds a bound of the contact stiffness at each node (N/m) of a side for displacements `u` (m). It holds until a
    /// point has come nearer to the other surface by more than `reach` (m).
    ///
    /// A spring k A (m·δ)² along m = (−y', 1) is at most (1 + y'²) k A in any direction. The rest is as
    /// in [`ContactInterface::add_stiffness_bound`](crate::ContactInterface::add_stiffness_bound), but with the
    /// current areas of the surfaces and with all points closed. The slope is that of the interface: of a rigid
    /// body its own, of two deformable bodies the steeper one. It is included where a point is closed or within
    /// reach. Elsewhere y'² is taken as 0: flanks that touch nothing have no largest slope where a surface
    /// bulges over its contact.
    ///
    /// Two terms are neglected: geometric stiffness by the pressure (p A over the length of a segment, so −g/h
    /// of the spring) and the motion of the intervals' ends. Up to overlaps of a segment's length, or half of
    /// one with dashpots, the safety factor for opening and closing covers them.
    pub fn add_deformed_stiffness_bound(
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
    /// upper), like that of the springs but without the safety factor for opening and closing.
    pub fn add_damping_bound(&self, side: usize, bound: &mut [f64]) {
        if self.impedance > 0.0 {
            self.add_bound(AT_REST, side, steepness_at_rest, |_| self.impedance, bound);
        }
    }

    /// Adds the growth of the bounds of stiffness (N/m) and damping (N s/m) from the undeformed surfaces to
    /// displacements `u` (m). Slopes are included where a point is closed or within `reach` (m).
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
        self.add_bound(AT_REST, side, steepness_at_rest, |interval| -springs(interval), stiffness);
        self.add_bound(moved(u), side, &grown, &springs, stiffness);
        if self.impedance > 0.0 {
            self.add_bound(AT_REST, side, steepness_at_rest, |_| -self.impedance, damping);
            self.add_bound(moved(u), side, &grown, |_| self.impedance, damping);
        }
    }

    /// Returns by how much points of both surfaces can approach each other in a time (s), m, for displacements
    /// (m) and velocities (m/s): twice the path of the fastest relative motion, because the velocity of a wave
    /// doubles at a free surface.
    pub fn reach(&self, u: [&[[f64; 2]]; 2], v: [&[[f64; 2]]; 2], time: f64) -> f64 {
        let speed_squared = |(interval, point): (Interval<'_>, GaussPoint)| {
            let [lower, upper] = [0, 1].map(|side: usize| interval.velocity(&point, side, v[side]));
            (upper[0] - lower[0]).powi(2) + (upper[1] - lower[1]).powi(2)
        };
        2.0 * time * self.points(moved(u)).map(speed_squared).fold(0.0, f64::max).sqrt()
    }

    /// Returns the stiffness per area of an interval with its safety factor, Pa/m.
    fn springs_per_area(&self) -> impl Fn(&Interval<'_>) -> f64 {
        let safety = if self.impedance > 0.0 { DAMPED_OPENING_SAFETY } else { OPENING_SAFETY };
        move |interval| safety * interval.stiffness
    }

    fn add_bound(
        &self,
        u: [impl Fn(u32) -> [f64; 2]; 2],
        side: usize,
        steepness: impl Fn(&Interval<'_>, &GaussPoint) -> f64,
        per_area: impl Fn(&Interval<'_>) -> f64,
        bound: &mut [f64],
    ) {
        for (interval, point) in self.points(u) {
            let own = &interval.segments[side];
            let steepness = if own.is_rigid() { 0.0 } else { steepness(&interval, &point) };
            let of_point =
                self.bound_factors[side] * per_area(&interval) * point.area * (1.0 + steepness);
            let [inner, outer] = own.nodes().map(|node| node as usize);
            let share = point.surface_points[side].share;
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

/// Returns y'² of undeformed surfaces, within its limit.
fn steepness_at_rest(interval: &Interval<'_>, point: &GaussPoint) -> f64 {
    slope_squared(interval, point).min(STEEPEST * STEEPEST)
}

/// Returns y'² where a point is closed or within reach (m), 0 elsewhere.
fn steepness_within(reach: f64) -> impl Fn(&Interval<'_>, &GaussPoint) -> f64 {
    move |interval, point| match is_within(point, reach) {
        true => slope_squared(interval, point),
        false => 0.0,
    }
}

/// Returns whether a point is closed, or can close if its surfaces approach each other by a reach, m.
///
/// Surfaces that slope in the same direction are separated by the gap along their normal, at least
/// g / √(1 + y'²) of the flatter slope. Surfaces that open like a wedge can touch only where the gap is less than
/// twice the reach.
fn is_within(point: &GaussPoint, reach: f64) -> bool {
    let [lower, upper] = point.surface_points.map(|surface_point| surface_point.slope);
    let reach_along_y = match lower * upper > 0.0 {
        true => reach * lower.abs().min(upper.abs()).hypot(1.0),
        false => 2.0 * reach,
    };
    point.gap <= reach_along_y.max(0.0)
}

/// Returns y'² of the interface at a point.
fn slope_squared(interval: &Interval<'_>, point: &GaussPoint) -> f64 {
    let squares =
        point.surface_points.map(|surface_point| surface_point.slope * surface_point.slope);
    match interval.segments.each_ref().map(Segment::is_rigid) {
        [true, _] => squares[0],
        [_, true] => squares[1],
        _ => squares[0].max(squares[1]),
    }
}
