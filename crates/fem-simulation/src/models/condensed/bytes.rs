//! Bytes that condensed bodies take, before they are made.
//!
//! Measured over pairs, a wall and a half-space with 2,300 to 46,000 elements: 0.5 to 0.9 kB an element to eliminate one,
//! 2.8 kB where the factor is kept, as snapshots need it, and 5 to 7 kB with the springs of a shear modulus that relaxes.

use fem_case::Body;
use fem_material::{ActsOn, Material};

/// Bytes that an element takes while it is eliminated.
const ELIMINATED: u64 = 800;
/// The same, its share of a factor that is kept included.
const KEPT: u64 = 2_800;
/// The same with its share of the springs of a relaxing shear.
const RELAXING: u64 = 7_000;
/// Largest number of bytes per element.
pub(crate) const MOST: u64 = 8_000;

/// Whether condensed bodies have springs for how a body relaxes.
pub(crate) fn relaxes_in_shear(body: &Body) -> bool {
    let series = body.material().and_then(Material::relaxation);
    series.is_some_and(|series| series.acts_on() == ActsOn::Shear)
}

/// Bytes of bodies with so many elements.
pub(crate) fn expected(bodies: [(&Body, u64); 2], keeps_factors: bool) -> u64 {
    let has_springs = bodies.map(|(body, _)| relaxes_in_shear(body));
    let plain = if keeps_factors || has_springs.contains(&true) { KEPT } else { ELIMINATED };
    let each = has_springs.map(|has| if has { RELAXING } else { plain });
    bodies.iter().zip(each).map(|((_, elements), bytes)| elements.saturating_mul(bytes)).sum()
}
