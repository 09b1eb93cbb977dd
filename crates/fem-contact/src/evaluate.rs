//! Contact forces of a configuration.

use crate::interface::{ContactInterface, ContactPoint};
use crate::surface::SurfaceProjection;

/// Contact forces and energy of one configuration.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactForces {
    /// Total force, ≥ 0, N.
    pub force: f64,
    /// Energy in the penalty springs, J.
    pub energy: f64,
    /// Number of closed points.
    pub n_closed: usize,
    /// Largest overlap of a closed point, m.
    pub overlap: f64,
    /// Distance of that point from the axis, m.
    pub overlap_radius: f64,
    /// Whether the outermost candidate point is closed.
    pub at_limit: bool,
    /// Where a surface turns over that the other one touches there, so that it is not a graph over the
    /// radius any more; only of moved surfaces.
    pub turn: Option<SurfaceFold>,
}

/// Where a surface turns over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceFold {
    /// 0 of the lower body, 1 of the upper.
    pub side: usize,
    /// Node of that body that has come as near to the axis as the one before it.
    pub node: u32,
    /// Distance from the axis, m.
    pub radius: f64,
}

impl ContactForces {
    /// Notes the gap (m) of a closed point at a distance from the axis, m.
    pub(crate) fn note_overlap(&mut self, gap: f64, radius: f64) {
        if -gap > self.overlap {
            (self.overlap, self.overlap_radius) = (-gap, radius);
        }
    }
}

impl SurfaceProjection {
    fn displacement(&self, u: &[[f64; 2]]) -> f64 {
        self.shape[0] * u[self.nodes[0] as usize][1] + self.shape[1] * u[self.nodes[1] as usize][1]
    }

    fn add(&self, force: f64, f: &mut [[f64; 2]]) {
        f[self.nodes[0] as usize][1] += self.shape[0] * force;
        f[self.nodes[1] as usize][1] += self.shape[1] * force;
    }
}

impl ContactPoint {
    /// Gap (m) for displacements along y of the nodes of the lower and the upper body.
    fn gap_of(&self, displacement: &[impl Fn(u32) -> f64; 2]) -> f64 {
        let [lower, upper] = [0, 1].map(|side: usize| {
            let foot = &self.feet[side];
            foot.shape[0] * displacement[side](foot.nodes[0])
                + foot.shape[1] * displacement[side](foot.nodes[1])
        });
        self.initial_gap + (upper - lower)
    }
}

impl ContactInterface {
    /// Gap at point k for displacements (u_r, u_y) of the lower and the upper
    /// body, m; negative when closed.
    pub fn gap(&self, k: usize, u: [&[[f64; 2]]; 2]) -> f64 {
        let point = &self.points[k];
        point.initial_gap + (point.feet[1].displacement(u[1]) - point.feet[0].displacement(u[0]))
    }

    /// Adds the contact forces (N) of displacements `u` (m) to `f`; both are
    /// given for the lower and the upper body, one pair (r, y) a node.
    pub fn add_forces(&self, u: [&[[f64; 2]]; 2], f: [&mut [[f64; 2]]; 2]) -> ContactForces {
        let mut total = ContactForces::default();
        let [f_lower, f_upper] = f;
        for (k, point) in self.points.iter().enumerate() {
            let gap = self.gap(k, u);
            if gap < 0.0 {
                let force = -point.stiffness * point.area * gap;
                point.feet[0].add(-force, f_lower);
                point.feet[1].add(force, f_upper);
                total.force += force;
                total.energy -= 0.5 * force * gap;
                total.n_closed += 1;
                total.note_overlap(gap, point.radius);
                total.at_limit = k + 1 == self.points.len();
            }
        }
        total
    }

    /// Whether any point is closed for the given displacements along y of the
    /// candidate nodes.
    pub fn is_closed(&self, displacement: [impl Fn(u32) -> f64; 2]) -> bool {
        self.points.iter().any(|point| point.gap_of(&displacement) < 0.0)
    }

    /// Total force (N) for the given displacements along y of the candidate nodes, m.
    pub fn force(&self, displacement: [impl Fn(u32) -> f64; 2]) -> f64 {
        let force = |point: &ContactPoint| {
            point.stiffness * point.area * (-point.gap_of(&displacement)).max(0.0)
        };
        self.points.iter().map(force).sum()
    }

    /// Signed penalty pressure −k g at every point with its radius: the contact
    /// pressure where positive.
    pub(crate) fn signed_pressure<'a>(
        &'a self,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        (0..self.points.len())
            .map(move |k| (self.points[k].radius, -self.points[k].stiffness * self.gap(k, u)))
    }
}
