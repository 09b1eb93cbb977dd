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
    /// Fold of a surface that is in contact there, so that it is no longer a function of the radius. Only moved
    /// surfaces have one.
    pub fold: Option<SurfaceFold>,
}

/// The place where a surface folds: from there on it does not run outward from node to node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceFold {
    /// Number of the body: 0 lower, 1 upper.
    pub side: usize,
    /// Node of that body which is no farther from the axis than the node before it.
    pub node: u32,
    /// Distance from the axis, m.
    pub radius: f64,
}

impl ContactForces {
    /// Updates the largest overlap by the gap (m) of a closed point at a distance from the axis, m.
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
    /// Returns the gap (m) for displacements along y of the nodes of the lower and the upper body.
    fn gap_of(&self, displacement: &[impl Fn(u32) -> f64; 2]) -> f64 {
        let [lower, upper] = [0, 1].map(|side: usize| {
            let projection = &self.projections[side];
            projection.shape[0] * displacement[side](projection.nodes[0])
                + projection.shape[1] * displacement[side](projection.nodes[1])
        });
        self.initial_gap + (upper - lower)
    }
}

impl ContactInterface {
    /// Returns the gap at point k for displacements (u_r, u_y) of the lower and the upper body, m; negative when
    /// closed.
    pub fn gap(&self, k: usize, u: [&[[f64; 2]]; 2]) -> f64 {
        let point = &self.points[k];
        point.initial_gap
            + (point.projections[1].displacement(u[1]) - point.projections[0].displacement(u[0]))
    }

    /// Adds the contact forces (N) of displacements `u` (m) to `f`; both are
    /// given for the lower and the upper body, one pair (r, y) per node.
    pub fn add_forces(&self, u: [&[[f64; 2]]; 2], f: [&mut [[f64; 2]]; 2]) -> ContactForces {
        let mut total = ContactForces::default();
        let [f_lower, f_upper] = f;
        for (k, point) in self.points.iter().enumerate() {
            let gap = self.gap(k, u);
            if gap < 0.0 {
                let force = -point.stiffness * point.area * gap;
                point.projections[0].add(-force, f_lower);
                point.projections[1].add(force, f_upper);
                total.force += force;
                total.energy -= 0.5 * force * gap;
                total.n_closed += 1;
                total.note_overlap(gap, point.radius);
                total.at_limit = k + 1 == self.points.len();
            }
        }
        total
    }

    /// Returns whether any point is closed for the given displacements along y of the candidate nodes.
    pub fn is_closed(&self, displacement: [impl Fn(u32) -> f64; 2]) -> bool {
        self.points.iter().any(|point| point.gap_of(&displacement) < 0.0)
    }

    /// Returns the total force (N) for the given displacements along y of the candidate nodes, m.
    pub fn force(&self, displacement: [impl Fn(u32) -> f64; 2]) -> f64 {
        let force = |point: &ContactPoint| {
            point.stiffness * point.area * (-point.gap_of(&displacement)).max(0.0)
        };
        self.points.iter().map(force).sum()
    }

    /// Returns the signed penalty pressure −k g at every point with its radius; positive values are the contact
    /// pressure.
    pub(crate) fn signed_pressure<'a>(
        &'a self,
        u: [&'a [[f64; 2]]; 2],
    ) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        (0..self.points.len())
            .map(move |k| (self.points[k].radius, -self.points[k].stiffness * self.gap(k, u)))
    }
}
