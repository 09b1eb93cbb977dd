//! Forces and energy of the springs between deformed surfaces.

use std::f64::consts::PI;

use super::DeformedInterface;
use super::common_refinement::{GAUSS, GaussPoint, Interval};
use crate::undeformed_forces::ContactForces;

impl DeformedInterface {
    /// Adds the contact forces (N) of displacements `u` (m) to `f`; both are given for the lower and
    /// the upper body, one pair (r, y) per node.
    ///
    /// They are exactly −∂Π/∂u of the energy in the penalty springs. The call does not allocate.
    pub fn add_forces(&self, u: [&[[f64; 2]]; 2], mut f: [&mut [[f64; 2]]; 2]) -> ContactForces {
        let mut total = ContactForces::default();
        let mut intervals = self.intervals(u.map(|u| move |node: u32| u[node as usize]));
        for interval in intervals.by_ref() {
            for gauss in GAUSS {
                let point = interval.closed_point(gauss);
                total.at_limit = point.is_some();
                if let Some(point) = point {
                    add_spring(&interval, gauss, &point, &mut f, &mut total);
                }
            }
        }
        if let Some((fold, overlaps)) = intervals.surface_fold() {
            total.fold = (overlaps || total.at_limit).then_some(fold);
            total.at_limit = false;
        }
        total
    }

    /// Returns whether any point is closed for the given displacements (u_r, u_y) of the candidate nodes, m.
    pub fn is_closed(&self, displacement: [impl Fn(u32) -> [f64; 2]; 2]) -> bool {
        let is_closed = |interval: Interval<'_>| {
            GAUSS.into_iter().any(|gauss| interval.closed_point(gauss).is_some())
        };
        self.intervals(displacement).any(is_closed)
    }
}

/// Adds the spring of a closed point.
fn add_spring(
    interval: &Interval<'_>,
    [offset, weight]: [f64; 2],
    point: &GaussPoint,
    f: &mut [&mut [[f64; 2]]; 2],
    total: &mut ContactForces,
) {
    let pressure = -interval.stiffness * point.gap;
    let force = interval.add_pressure(point, pressure, f);
    // The point and its area move with the ends of the interval: r_g = (1 ∓ offset)/2 of them,
    // A = 2π r_g (r_1 − r_0)/2.
    let half = weight * 0.5 * (interval.radii[1] - interval.radii[0]);
    let overlap_slope = point.surface_points[1].slope - point.surface_points[0].slope;
    let energy_per_area = -0.5 * pressure * point.gap;
    let by_point = force * overlap_slope - energy_per_area * (2.0 * PI * half);
    let by_length = energy_per_area * (PI * weight * point.radius);
    for (end, sign) in interval.ends.into_iter().zip([-1.0, 1.0]) {
        if let Some((side, node)) = end {
            f[side][node as usize][0] +=
                by_point * (0.5 * (1.0 + sign * offset)) - sign * by_length;
        }
    }
    total.force += force;
    total.energy += energy_per_area * point.area;
    total.n_closed += 1;
    total.note_overlap(point.gap, point.radius);
}

impl Interval<'_> {
    /// Adds a pressure (Pa) at a point to the forces (N) of both bodies, along the normal of each, and returns its
    /// force along y, N. At a given radius a surface rises by N (δy − y' δr).
    pub fn add_pressure(
        &self,
        point: &GaussPoint,
        pressure: f64,
        f: &mut [&mut [[f64; 2]]; 2],
    ) -> f64 {
        let force = pressure * point.area;
        for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let (segment, surface_point) = (&self.segments[side], &point.surface_points[side]);
            let along_y = sign * force;
            let along_r = if segment.is_rigid() { 0.0 } else { -along_y * surface_point.slope };
            let [inner, outer] = segment.nodes().map(|node| node as usize);
            f[side][outer][0] += surface_point.share * along_r;
            f[side][outer][1] += surface_point.share * along_y;
            f[side][inner][0] += (1.0 - surface_point.share) * along_r;
            f[side][inner][1] += (1.0 - surface_point.share) * along_y;
        }
        force
    }

    /// Returns the velocity (r, y) of a side at a point, m/s, for those of its nodes.
    pub fn velocity(&self, point: &GaussPoint, side: usize, v: &[[f64; 2]]) -> [f64; 2] {
        let (segment, surface_point) = (&self.segments[side], &point.surface_points[side]);
        let [inner, outer] = segment.nodes().map(|node| v[node as usize]);
        [0, 1].map(|axis: usize| {
            (1.0 - surface_point.share) * inner[axis] + surface_point.share * outer[axis]
        })
    }

    /// Returns the rate at which a side rises along +y at the fixed radius of a point, m/s: N (ẏ − y' ṙ), for
    /// velocities (m/s) of its nodes.
    pub fn rate_of_height(&self, point: &GaussPoint, side: usize, v: &[[f64; 2]]) -> f64 {
        let [along_r, along_y] = self.velocity(point, side, v);
        match self.segments[side].is_rigid() {
            true => along_y,
            false => along_y - point.surface_points[side].slope * along_r,
        }
    }
}
