//! The contact from the axis outward: what results show of it at an instant.
//!
//! Rows are at the nodes at which pressures are read, those of the coarser of the surfaces that deform. A
//! pressure is the force on a node over its area; near the axis it is without what elements take off it
//! there ([`centre_pressure`](crate::centre_pressure)). A gap is the mean over the same surroundings: single
//! points swing as their pressures do.

use crate::interface::ContactInterface;
use crate::read_out::{Barrier, pressure_profile};
use crate::slip::SlippingInterface;
use crate::surface::Surface;

/// One distance from the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
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
    /// From the axis outward, as far as contact is looked for.
    pub points: Vec<ProfilePoint>,
}

impl Profile {
    /// Of pressures at nodes from the axis outward (r in m, p in Pa), the radius (m) out to which they reach, and
    /// what gap (m) and radial displacements (m) there are at each node; nothing where there is none.
    pub fn new(
        nodes: impl Iterator<Item = (f64, f64)> + Clone,
        contact_radius: f64,
        barrier: Barrier,
        facing: impl Iterator<Item = Option<(f64, [f64; 2])>>,
    ) -> Self {
        let pressures = pressure_profile(nodes.clone(), contact_radius, barrier);
        let rows = nodes.zip(pressures).zip(facing);
        let point = |(((radius, _), pressure), facing): (((f64, f64), f64), Option<_>)| {
            facing.map(|(gap, radial)| ProfilePoint { radius, pressure, gap, radial })
        };
        let mut points: Vec<ProfilePoint> = rows.filter_map(point).collect();
        // Of the last node only the inner half of its surroundings is looked at.
        points.pop();
        Self { contact_radius, points }
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
        Profile::new(
            self.nodal_pressure(u),
            self.contact_radius(u),
            Barrier::Springs,
            self.facing(gaps, u),
        )
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
        Profile::new(self.nodal_pressure(u), self.contact_radius(u), Barrier::Springs, facing)
    }
}
