//! The integration points of a pair of surfaces.

use std::f64::consts::PI;

use crate::error::ContactError;
use crate::surface::{Surface, SurfaceProjection};

/// A point at which the bodies can touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Distance from the axis, m.
    pub radius: f64,
    /// Share of the plane's area, 2πr dr, m².
    pub area: f64,
    /// Gap of the undeformed arcs, m.
    pub initial_gap: f64,
    /// Penalty stiffness per area, Pa/m; infinite where no overlap is allowed.
    pub stiffness: f64,
    /// Lower and upper body.
    pub projections: [SurfaceProjection; 2],
}

impl ContactPoint {
    /// Creates the point at a radius (m) of both surfaces, with its area (m²). Stiffness (Pa) and gap (m) are
    /// those of [`ContactInterface::new`].
    pub(crate) fn between(
        surfaces: &[Surface; 2],
        radius: f64,
        area: f64,
        stiffness: f64,
        gap: f64,
    ) -> Self {
        let located = surfaces.each_ref().map(|surface| surface.locate(radius));
        let length = mean_length(surfaces, located.map(|(segment, _)| segment));
        Self {
            radius,
            area,
            initial_gap: gap + surfaces[0].depth(radius) + surfaces[1].depth(radius),
            stiffness: stiffness / length,
            projections: std::array::from_fn(|side| surfaces[side].project(located[side])),
        }
    }
}

/// All points at which two bodies can touch, from the axis outward.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactInterface {
    pub(crate) points: Vec<ContactPoint>,
    pub(crate) surfaces: [Surface; 2],
    pub(crate) candidate_radius: f64,
    /// Factors on the springs in the stiffness bound of the lower and the upper body; see
    /// [`ContactInterface::add_stiffness_bound`].
    pub(crate) bound_factors: [f64; 2],
}

/// Intervals shorter than this share of a segment are joined to the next: their springs would carry nothing
/// and cost as much as others.
const MIN_INTERVAL_SHARE: f64 = 1e-3;

/// Factor on the stiffness of the penalty springs in the critical time step. A closed spring is
/// stable with one. One that opens and closes within a few steps changes the energy by up to the
/// fraction s/4 each time, s = (ω Δt)², up or down, and chatter adds that up: with 2, an elastic
/// glass pair at 50 times the default penalty gained 2 %; with 4 it keeps its energy to 7e-5, for a
/// tenth more steps at the default penalty.
pub(crate) const OPENING_SAFETY: f64 = 4.0;

impl ContactInterface {
    /// Pairs the lower with the upper surface out to `candidate_radius` (m).
    ///
    /// `stiffness` is the penalty factor times the pair's contact modulus E*
    /// (Pa); the penalty per area is that over the mean length of the two
    /// segments at a point. `gap` (m) separates the poles.
    ///
    /// # Errors
    /// Two rigid bodies or planes; a radius or a stiffness that is not positive and finite.
    pub fn new(
        lower: Surface,
        upper: Surface,
        stiffness: f64,
        gap: f64,
        candidate_radius: f64,
    ) -> Result<Self, ContactError> {
        check_springs([&lower, &upper], stiffness, candidate_radius)?;
        let surfaces = [lower, upper];
        let limit = candidate_radius.min(surfaces[0].extent()).min(surfaces[1].extent());
        let cuts = cuts(&surfaces, limit);
        let mut points = Vec::with_capacity(2 * cuts.len());
        for piece in cuts.windows(2) {
            let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
            for offset in [-half / 3f64.sqrt(), half / 3f64.sqrt()] {
                let radius = middle + offset;
                let area = 2.0 * PI * radius * half;
                points.push(ContactPoint::between(&surfaces, radius, area, stiffness, gap));
            }
        }
        let candidate_radius = cuts[cuts.len() - 1];
        Ok(Self { points, bound_factors: bound_factors(&surfaces), surfaces, candidate_radius })
    }

    /// Divides the stiffness bound between a rigid sphere and the other body by their masses, so that a heavy
    /// rigid sphere shortens the time step no more than a wall does. `ratio` > 0 is its mass over that of the
    /// other body. Nothing changes if both bodies deform, or against a wall.
    #[must_use]
    pub fn with_rigid_mass(mut self, ratio: f64) -> Self {
        share_by_mass(&self.surfaces, ratio, &mut self.bound_factors);
        self
    }

    /// Multiplies the springs in the stiffness bound by a factor. The shorter time step then follows very stiff
    /// springs as they open and close.
    #[must_use]
    pub fn with_stability_factor(mut self, times: f64) -> Self {
        self.bound_factors = self.bound_factors.map(|factor| times * factor);
        self
    }

    /// Returns the radius of the candidate region, in which contact is searched for, m.
    pub fn candidate_radius(&self) -> f64 {
        self.candidate_radius
    }

    /// Returns the integration points, from the axis outward.
    pub fn points(&self) -> &[ContactPoint] {
        &self.points
    }

    /// Returns the number of integration points.
    pub fn n_points(&self) -> usize {
        self.points.len()
    }

    /// Returns the nodes of a side (0 lower, 1 upper) out to the candidate radius.
    pub fn candidate_nodes(&self, side: usize) -> impl Iterator<Item = u32> + Clone + '_ {
        self.surfaces[side].nodes_within(self.candidate_radius).iter().copied()
    }

    /// Adds a bound of the contact stiffness at each node (N/m) of a side (0 lower, 1 upper). The stiffness
    /// matrix of the penalty springs is at most this diagonal, whichever of them are closed.
    ///
    /// A spring between two bodies, k (a − b)², is at most (1 + θ) k a² + (1 + 1/θ) k b² for any θ > 0, and a² of
    /// an interpolated a is at most Σ N a_i² (Jensen). Between two deformable bodies θ is 1, against a wall 0.
    /// Against a rigid sphere θ is the body's mass m_a over the sphere's m_b, at most 1 (see
    /// [`ContactInterface::with_rigid_mass`]): the sphere on all springs then has the frequency of two rigid
    /// bodies, k/m_a + k/m_b. The sum is multiplied by 4, because springs open and close.
    pub fn add_stiffness_bound(&self, side: usize, bound: &mut [f64]) {
        self.add_weighted_bound(side, self.bound_factors[side], bound, |_| 1.0);
    }

    /// Adds the bound of the contact stiffness for a fixed surface of the other body: θ is 0.
    pub fn add_bound_against_held(&self, side: usize, bound: &mut [f64]) {
        self.add_weighted_bound(side, 1.0, bound, |_| 1.0);
    }

    /// Adds the bound of the contact stiffness with a factor on all springs and one per point.
    pub(crate) fn add_weighted_bound(
        &self,
        side: usize,
        springs: f64,
        bound: &mut [f64],
        factor: impl Fn(&ContactPoint) -> f64,
    ) {
        for point in &self.points {
            let springs = springs * factor(point);
            let stiffness = OPENING_SAFETY * springs * point.stiffness * point.area;
            let projection = &point.projections[side];
            for (&node, &shape) in projection.nodes.iter().zip(&projection.shape) {
                bound[node as usize] += stiffness * shape;
            }
        }
    }
}

/// Returns the factors 1 + θ on the springs of each side; see [`ContactInterface::add_stiffness_bound`].
pub(crate) fn bound_factors(surfaces: &[Surface; 2]) -> [f64; 2] {
    [1, 0].map(|other: usize| if surfaces[other].is_wall() { 1.0 } else { 2.0 })
}

/// Sets the factors for a rigid sphere by its mass over that of the other body; see
/// [`ContactInterface::with_rigid_mass`].
pub(crate) fn share_by_mass(surfaces: &[Surface; 2], ratio: f64, factors: &mut [f64; 2]) {
    for (side, surface) in surfaces.iter().enumerate() {
        if surface.is_rigid() && !surface.is_wall() {
            // Beyond the upper limit it is a wall to rounding.
            let ratio = ratio.clamp(1.0, f64::EPSILON.recip());
            factors[side] = 1.0 + ratio;
            factors[1 - side] = 1.0 + ratio.recip();
        }
    }
}

/// Checks that springs of this stiffness (Pa) can join two surfaces out to a radius, m.
pub(crate) fn check_springs(
    surfaces: [&Surface; 2],
    stiffness: f64,
    candidate_radius: f64,
) -> Result<(), ContactError> {
    check(surfaces)?;
    for (name, value) in [("penalty stiffness", stiffness), ("candidate radius", candidate_radius)]
    {
        if !(value > 0.0 && value.is_finite()) {
            return Err(ContactError::NotPositive { name, value });
        }
    }
    Ok(())
}

/// Checks that two surfaces can be in contact.
pub(crate) fn check(surfaces: [&Surface; 2]) -> Result<(), ContactError> {
    if surfaces.iter().all(|surface| surface.is_rigid()) {
        return Err(ContactError::BothRigid);
    }
    if surfaces.iter().all(|surface| surface.is_plane()) {
        return Err(ContactError::TwoPlanes);
    }
    Ok(())
}

/// Radii of all nodes of both surfaces out to the limit, and the first beyond.
fn cuts(surfaces: &[Surface; 2], limit: f64) -> Vec<f64> {
    let mut radii: Vec<f64> = surfaces
        .iter()
        .flat_map(|surface| surface.radii.iter().copied())
        .filter(|r| r.is_finite())
        .collect();
    radii.sort_by(f64::total_cmp);
    // Nodes that all but lie on each other make one cut: those of like meshes on unlike spheres do.
    radii.dedup_by(|outer, inner| {
        let length = mean_length(surfaces, surfaces.each_ref().map(|s| s.locate(*inner).0));
        let sliver = if length.is_finite() { MIN_INTERVAL_SHARE * length } else { 0.0 };
        *outer - *inner <= sliver.max(1e-9 * *outer)
    });
    let common = surfaces[0].extent().min(surfaces[1].extent());
    radii.retain(|&r| r <= common * (1.0 + 1e-9));
    let n = radii.partition_point(|&r| r < limit * (1.0 - 1e-9)) + 1;
    radii.truncate(n.max(2));
    radii
}

/// Returns the mean length of the deformable bodies' segments at a point.
pub(crate) fn mean_length(surfaces: &[Surface; 2], segments: [usize; 2]) -> f64 {
    let lengths = [0, 1].map(|side| {
        let surface = &surfaces[side];
        (!surface.is_rigid()).then(|| surface.segment_length(segments[side]))
    });
    match lengths {
        [Some(a), Some(b)] => 0.5 * (a + b),
        [Some(a), None] | [None, Some(a)] => a,
        [None, None] => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use fem_mesh::Side;

    use super::*;
    use crate::test_support::sphere;

    #[test]
    fn contact_points_have_the_gap_of_the_arcs_and_cover_the_area() {
        let (lower, upper) =
            (sphere(2.0, 0.1, 0.4, Side::Below), sphere(1.0, 0.07, 0.4, Side::Above));
        let surfaces = [Surface::of_sphere(&lower), Surface::of_sphere(&upper)];
        let [lower, upper] = surfaces.clone();
        let interface = ContactInterface::new(lower, upper, 1.0, 0.3, 0.5).unwrap();
        for point in &interface.points {
            let r = point.radius;
            let arcs = 2.0 - (4.0 - r * r).sqrt() + 1.0 - (1.0 - r * r).sqrt();
            // Rounding of numbers of size 2.
            assert!((point.initial_gap - (0.3 + arcs)).abs() < 2e-15);
            for side in 0..2 {
                // Both projections stand at the point.
                let SurfaceProjection { nodes, shape } = point.projections[side];
                let surface = &surfaces[side];
                let at = |node: u32| {
                    surface.radii[surface.nodes.iter().position(|&n| n == node).unwrap()]
                };
                assert!((shape[0] * at(nodes[0]) + shape[1] * at(nodes[1]) - r).abs() < 1e-15);
                assert!((shape[0] + shape[1] - 1.0).abs() < 1e-15 && shape[0] > 0.0);
            }
        }
        let area: f64 = interface.points.iter().map(|point| point.area).sum();
        let exact = PI * interface.candidate_radius().powi(2);
        assert!((area / exact - 1.0).abs() < 1e-14);
    }

    /// Equal meshes share their nodes but for rounding: no slivers.
    #[test]
    fn equal_meshes_have_one_interval_per_element() {
        let [lower, upper] =
            [Side::Below, Side::Above].map(|side| Surface::of_sphere(&sphere(1.0, 0.1, 0.4, side)));
        let n_nodes = lower.radii.iter().take_while(|r| **r < 0.39).count();
        let interface = ContactInterface::new(lower, upper, 1.0, 0.0, 0.39).unwrap();
        assert_eq!(interface.n_points(), 2 * n_nodes);
    }
}
