//! Springs at the nodes of each surface, against the other one.
//!
//! This is the penalty contact of textbooks (Wriggers, Computational Contact Mechanics, 2006, ch. 9) in two passes:
//! first the nodes of one body are slaves of the other's surface, then the reverse. A node's spring has
//! half the area of its hat function, ∫ N 2πr dr, in each pass; against a rigid body there is one pass with the
//! whole area. The method serves for comparison with [`ContactInterface::new`]: a point that closes adds the
//! spring of a whole element at once.

use fem_mesh::segment_measures;

use crate::error::ContactError;
use crate::interface::{ContactInterface, ContactPoint, bound_factors, check_springs};
use crate::surface::Surface;

impl ContactInterface {
    /// Creates springs at the nodes of both surfaces out to `candidate_radius` (m). Stiffness (Pa) and gap (m) are
    /// those of [`ContactInterface::new`].
    ///
    /// # Errors
    /// Two rigid bodies or planes; a radius or a stiffness that is not positive and finite.
    pub fn node_to_surface(
        lower: Surface,
        upper: Surface,
        stiffness: f64,
        gap: f64,
        candidate_radius: f64,
    ) -> Result<Self, ContactError> {
        check_springs([&lower, &upper], stiffness, candidate_radius)?;
        let surfaces = [lower, upper];
        let deformable = || surfaces.iter().filter(|surface| !surface.is_rigid());
        let limit = candidate_radius.min(surfaces[0].extent()).min(surfaces[1].extent());
        let share = (deformable().count() as f64).recip();
        let mut points: Vec<_> = deformable()
            .flat_map(|own| {
                let n = own.radii.partition_point(|&r| r <= limit * (1.0 + 1e-12));
                (0..n).map(|k| (own.radii[k], share * hat_area(&own.radii, k)))
            })
            .map(|(radius, area)| ContactPoint::between(&surfaces, radius, area, stiffness, gap))
            .collect();
        points.sort_by(|a, b| a.radius.total_cmp(&b.radius));
        let candidate_radius = points.last().map_or(limit, |point| point.radius);
        Ok(Self { points, bound_factors: bound_factors(&surfaces), surfaces, candidate_radius })
    }
}

/// Returns ∫ N 2πr dr of the hat function of the k-th of these radii (m), m².
fn hat_area(radii: &[f64], k: usize) -> f64 {
    let share = |neighbour: f64| segment_measures([neighbour, 0.0], [radii[k], 0.0])[1];
    let neighbours = [k.checked_sub(1), Some(k + 1)];
    neighbours.into_iter().filter_map(|k| radii.get(k?).copied()).map(share).sum()
}
