//! Contact profile at an instant, from the axis outward.
//!
//! The nodes are those of the coarser deformable surface. The pressure there is the force on the node over the
//! area of its hat function, near the axis corrected for discretisation
//! ([`centre_pressure`](crate::centre_pressure)). The gap is the mean over the same hat function, because gaps of
//! single points oscillate as their pressures do. A [closed](Profile::closed) profile has pointwise pressures in
//! place of means, and includes the edge of the contact.

use crate::interface::ContactInterface;
use crate::pressure::coarser;
use crate::pressure_recovery::{
    ContactEnforcement, PressureCurve, carried_force, places_inside, pressure_profile,
};
use crate::slip::SlippingInterface;
use crate::surface::Surface;

/// Number of radii inside the contact that a closed profile has in addition to the nodes.
const N_PLACES: usize = 32;
/// Number of nodes beyond the candidate region.
pub(crate) const N_BEYOND: usize = 5;
/// Least distance of such a radius from a node, over the contact radius.
const MIN_DISTANCE_FROM_NODE: f64 = 1e-3;

/// The contact at one distance from the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
    /// Whether the point is a node.
    pub is_node: bool,
    /// Distance from the axis, m.
    pub radius: f64,
    /// Contact pressure, Pa.
    pub pressure: f64,
    /// y of the upper less that of the lower surface, m; negative where springs overlap.
    pub gap: f64,
    /// Displacement along r of the lower and the upper surface, m.
    pub radial: [f64; 2],
}

/// The contact profile at an instant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Profile {
    /// Radius at which the pressure falls to zero, m; 0 without contact.
    pub contact_radius: f64,
    /// Sum of the nodal forces, N.
    pub force: f64,
    /// Points from the axis outward, to a few nodes beyond the candidate region.
    pub points: Vec<ProfilePoint>,
}

impl Profile {
    /// Creates the profile from mean pressures at nodes from the axis outward (r in m, p in Pa), the contact radius
    /// (m), and gap and radial displacements (m) of each node. Nodes without a gap are left out.
    pub fn new(
        nodes: impl Iterator<Item = (f64, f64)> + Clone,
        contact_radius: f64,
        enforcement: ContactEnforcement,
        facing: impl Iterator<Item = Option<(f64, [f64; 2])>>,
    ) -> Self {
        let pressures = pressure_profile(nodes.clone(), contact_radius, enforcement);
        let force = carried_force(nodes.clone());
        let rows = nodes.zip(pressures).zip(facing);
        let point = |(((radius, _), pressure), facing): (((f64, f64), f64), Option<_>)| {
            let at = |(gap, radial)| ProfilePoint { is_node: true, radius, pressure, gap, radial };
            facing.map(at)
        };
        let mut points: Vec<ProfilePoint> = rows.filter_map(point).collect();
        // Only the inner half of the last node's hat function is in the candidate region.
        points.pop();
        Self { contact_radius, force, points }
    }

    /// Adds nodes beyond the candidate region: their distances from the axis (m), from the last outward, gaps (m)
    /// and radial displacements, m.
    pub fn extended(mut self, nodes: impl Iterator<Item = (f64, (f64, [f64; 2]))>) -> Self {
        self.points.extend(nodes.map(|(radius, (gap, radial))| ProfilePoint {
            is_node: true,
            radius,
            pressure: 0.0,
            gap,
            radial,
        }));
        self
    }

    /// Returns the radii (m) of the nodes after the last one, at most `N_BEYOND`, for surfaces that can touch out
    /// to a radius, m.
    pub fn nodes_beyond(
        &self,
        surfaces: [&Surface; 2],
        radius: f64,
    ) -> impl Iterator<Item = f64> + Clone + use<> {
        let last = self.points.last().map_or(0.0, |point| point.radius);
        let extent = surfaces.map(Surface::extent).into_iter().fold(f64::INFINITY, f64::min);
        let radii = &surfaces[coarser(surfaces, radius)].radii;
        let beyond = radii.iter().copied().filter(|r| *r > last * (1.0 + 1e-9) && *r <= extent);
        beyond.take(N_BEYOND).collect::<Vec<f64>>().into_iter()
    }

    /// Replaces mean pressures by those at the nodes, zero outside of the contact radius, and adds the edge and
    /// points between nodes. Linear interpolation between all points carries the force to 0.5 %. Displacements are
    /// interpolated linearly between nodes; at the edge the gap is 0.
    pub fn closed(mut self) -> Self {
        let nodes: Vec<(f64, f64)> =
            self.points.iter().map(|at| (at.radius, at.pressure)).collect();
        let edge = self.contact_radius;
        let Some(curve) = PressureCurve::new(&nodes, edge, self.force) else { return self };
        self.points.iter_mut().for_each(|point| point.pressure = curve.at(point.radius));
        let n_inside = nodes.partition_point(|(radius, _)| *radius < edge);
        if let Some(rim) = self.between(edge).filter(|_| n_inside < nodes.len()) {
            self.points.insert(n_inside, ProfilePoint { gap: 0.0, ..rim });
        }
        let is_free = |radius: &f64| {
            self.points
                .iter()
                .all(|point| (point.radius - radius).abs() > MIN_DISTANCE_FROM_NODE * edge)
        };
        let free = places_inside(edge, N_PLACES).filter(is_free);
        let between: Vec<ProfilePoint> = free.filter_map(|radius| self.between(radius)).collect();
        let pressed =
            between.iter().map(|at| ProfilePoint { pressure: curve.at(at.radius), ..*at });
        self.points.extend(pressed);
        self.points.sort_by(|one, other| one.radius.total_cmp(&other.radius));
        self
    }

    /// Interpolates gap and displacements linearly at a radius, m, without pressure.
    fn between(&self, radius: f64) -> Option<ProfilePoint> {
        let outer = self.points.partition_point(|point| point.radius <= radius);
        let (from, to) = (self.points.get(outer.checked_sub(1)?)?, self.points.get(outer)?);
        let share = (radius - from.radius) / (to.radius - from.radius);
        let along = |a: f64, b: f64| a + share * (b - a);
        Some(ProfilePoint {
            is_node: false,
            radius,
            pressure: 0.0,
            gap: along(from.gap, to.gap),
            radial: [0, 1].map(|side: usize| along(from.radial[side], to.radial[side])),
        })
    }
}

impl Surface {
    /// Returns the displacement (m) at a radius, for those of the body's nodes; of a rigid body, its own.
    fn displacement_at(&self, radius: f64, u: &[[f64; 2]]) -> [f64; 2] {
        let projection = self.project(self.locate(radius));
        let ends = projection.nodes.map(|node| u[node as usize]);
        [0, 1].map(|axis: usize| {
            projection.shape[0] * ends[0][axis] + projection.shape[1] * ends[1][axis]
        })
    }
}

/// Returns the gap (m) at a radius of two surfaces whose poles are `gap` apart, and their displacements along r,
/// for displacements (m) of the nodes of the lower and the upper body.
pub fn facing(
    surfaces: [&Surface; 2],
    gap: f64,
    radius: f64,
    u: [&[[f64; 2]]; 2],
) -> (f64, [f64; 2]) {
    let [lower, upper] = [0, 1].map(|side: usize| surfaces[side].displacement_at(radius, u[side]));
    let depths = surfaces[0].depth(radius) + surfaces[1].depth(radius);
    (gap + depths + (upper[1] - lower[1]), [lower[0], upper[0]])
}

impl ContactInterface {
    /// Returns the contact profile for displacements (m) of the nodes of the lower and the upper body.
    pub fn profile(&self, u: [&[[f64; 2]]; 2]) -> Profile {
        let gaps = (0..self.n_points()).map(|k| self.gap(k, u));
        let facing = self.facing(gaps, u);
        let radius = self.contact_radius(u);
        self.extended(
            Profile::new(self.nodal_pressure(u), radius, ContactEnforcement::Springs, facing),
            u,
        )
    }

    /// Adds the nodes beyond the candidate region.
    fn extended(&self, profile: Profile, u: [&[[f64; 2]]; 2]) -> Profile {
        let surfaces = self.surfaces.each_ref();
        let depths = |r: f64| surfaces[0].depth(r) + surfaces[1].depth(r);
        let gap = self.points.first().map_or(0.0, |first| first.initial_gap - depths(first.radius));
        let beyond = profile.nodes_beyond(surfaces, self.candidate_radius);
        profile.extended(beyond.map(|radius| (radius, facing(surfaces, gap, radius, u))))
    }

    /// Returns for each node the mean gap (m) over its hat function, and the radial displacements.
    pub(crate) fn facing<'a>(
        &'a self,
        gaps: impl Iterator<Item = f64> + Clone + 'a,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = Option<(f64, [f64; 2])>> + 'a {
        self.sums(gaps).map(move |(radius, [sum, area])| {
            let radial = |side: usize| self.surfaces[side].displacement_at(radius, u[side])[0];
            (area > 0.0).then(|| (sum / area, [radial(0), radial(1)]))
        })
    }
}

impl SlippingInterface {
    /// Returns the profile like [`ContactInterface::profile`], with the gap between the slipped surfaces.
    pub fn profile(&self, u: [&[[f64; 2]]; 2]) -> Profile {
        let facing = self.interface().facing(self.gaps(u), u);
        let radius = self.contact_radius(u);
        let own = Profile::new(self.nodal_pressure(u), radius, ContactEnforcement::Springs, facing);
        self.interface().extended(own, u)
    }
}
