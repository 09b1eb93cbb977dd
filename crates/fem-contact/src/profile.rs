//! Contact profile at an instant, from the axis outward.
//!
//! Nodes are those at which pressures are read, of the coarser of the surfaces that deform. What is read there
//! is the force on a node over its area, near the axis without what elements take off it
//! there ([`centre_pressure`](crate::centre_pressure)). A gap is the mean over the same surroundings: single
//! points swing as their pressures do. A [closed](Profile::closed) profile has pressures in place of means, and
//! ends where the contact does.

use crate::interface::ContactInterface;
use crate::pressure::coarser;
use crate::pressure_recovery::{
    ContactEnforcement, PressureCurve, carried_force, places_inside, pressure_profile,
};
use crate::slip::SlippingInterface;
use crate::surface::Surface;

/// Places inside the contact that a closed profile has beside the nodes.
const N_PLACES: usize = 32;
/// Nodes beyond those at which contact is looked for.
pub(crate) const N_BEYOND: usize = 5;
/// Nearer to a node than this share of the radius there is no other place.
const APART: f64 = 1e-3;

/// One distance from the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
    /// Whether a node is there.
    pub is_node: bool,
    /// Distance from the axis, m.
    pub radius: f64,
    /// Contact pressure, Pa.
    pub pressure: f64,
    /// y of the upper less that of the lower surface, m; negative by what springs overlap.
    pub gap: f64,
    /// Displacement along r of the lower and the upper surface, m.
    pub radial: [f64; 2],
}

/// The contact at an instant.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Profile {
    /// Where the pressure falls to zero, m; 0 without contact.
    pub contact_radius: f64,
    /// What the nodes carry, N.
    pub force: f64,
    /// From the axis outward, as far as contact is looked for.
    pub points: Vec<ProfilePoint>,
}

impl Profile {
    /// Of pressures at nodes from the axis outward (r in m, p in Pa), the radius (m) out to which they reach, and
    /// what gap (m) and radial displacements (m) there are at each node; nothing where there is none. A point a
    /// node, with the mean of the pressure around it.
    pub fn new(
        nodes: impl Iterator<Item = (f64, f64)> + Clone,
        contact_radius: f64,
        barrier: ContactEnforcement,
        facing: impl Iterator<Item = Option<(f64, [f64; 2])>>,
    ) -> Self {
        let pressures = pressure_profile(nodes.clone(), contact_radius, barrier);
        let force = carried_force(nodes.clone());
        let rows = nodes.zip(pressures).zip(facing);
        let point = |(((radius, _), pressure), facing): (((f64, f64), f64), Option<_>)| {
            let at = |(gap, radial)| ProfilePoint { is_node: true, radius, pressure, gap, radial };
            facing.map(at)
        };
        let mut points: Vec<ProfilePoint> = rows.filter_map(point).collect();
        // Of the last node only the inner half of its surroundings is looked at.
        points.pop();
        Self { contact_radius, force, points }
    }

    /// With nodes further out, where contact is not looked for: their distances from the axis (m), from the last
    /// outward, gaps (m) and radial displacements, m.
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

    /// Where the nodes are that come after the last (m), some of them, for surfaces that can touch out to a
    /// radius, m.
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

    /// With the pressure at each node in place of its mean, none outside of the contact radius, and with the edge
    /// and points between: straight lines between all carry the force to 0.5 %. Displacements between
    /// nodes are on straight lines; at the edge the surfaces part.
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
            self.points.iter().all(|point| (point.radius - radius).abs() > APART * edge)
        };
        let free = places_inside(edge, N_PLACES).filter(is_free);
        let between: Vec<ProfilePoint> = free.filter_map(|radius| self.between(radius)).collect();
        let pressed =
            between.iter().map(|at| ProfilePoint { pressure: curve.at(at.radius), ..*at });
        self.points.extend(pressed);
        self.points.sort_by(|one, other| one.radius.total_cmp(&other.radius));
        self
    }

    /// On the line between the points around a radius, m, without pressure.
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
    /// Displacement (m) at a radius, for those of the body's nodes; of a rigid body, its own.
    fn displacement_at(&self, radius: f64, u: &[[f64; 2]]) -> [f64; 2] {
        let foot = self.foot(self.locate(radius));
        let ends = foot.nodes.map(|node| u[node as usize]);
        [0, 1].map(|axis: usize| foot.shape[0] * ends[0][axis] + foot.shape[1] * ends[1][axis])
    }
}

/// Gap (m) at a radius of two surfaces whose poles are `gap` apart, and their displacements along r, for
/// displacements (m) of the nodes of the lower and the upper body.
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
    /// The contact for displacements (m) of the nodes of the lower and the upper body.
    pub fn profile(&self, u: [&[[f64; 2]]; 2]) -> Profile {
        let gaps = (0..self.n_points()).map(|k| self.gap(k, u));
        let facing = self.facing(gaps, u);
        let radius = self.contact_radius(u);
        self.extended(
            Profile::new(self.nodal_pressure(u), radius, ContactEnforcement::Springs, facing),
            u,
        )
    }

    /// With nodes beyond its own.
    fn extended(&self, profile: Profile, u: [&[[f64; 2]]; 2]) -> Profile {
        let surfaces = self.surfaces.each_ref();
        let depths = |r: f64| surfaces[0].depth(r) + surfaces[1].depth(r);
        let gap = self.points.first().map_or(0.0, |first| first.initial_gap - depths(first.radius));
        let beyond = profile.nodes_beyond(surfaces, self.candidate_radius);
        profile.extended(beyond.map(|radius| (radius, facing(surfaces, gap, radius, u))))
    }

    /// At each node the mean of the gaps (m) of the points around, and the radial displacements.
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
    /// As [`ContactInterface::profile`], with the gap where both surfaces have come to lie.
    pub fn profile(&self, u: [&[[f64; 2]]; 2]) -> Profile {
        let facing = self.interface().facing(self.gaps(u), u);
        let radius = self.contact_radius(u);
        let own = Profile::new(self.nodal_pressure(u), radius, ContactEnforcement::Springs, facing);
        self.interface().extended(own, u)
    }
}
