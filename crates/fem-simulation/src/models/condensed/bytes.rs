//! Expected memory of condensed bodies.
//!
//! Measured for pairs, a wall and a half-space with 2,300 to 46,000 elements: 0.5 to 0.9 kB per eliminated element, 2.8 kB if
//! the factor is kept for snapshots, and 5 to 7 kB with the springs of a relaxing shear modulus.

use fem_case::Body;
use fem_material::{ActsOn, Material};

/// Bytes per element during elimination.
const ELIMINATED: u64 = 800;
/// Bytes per element with its share of a kept factor.
const KEPT: u64 = 2_800;
/// Bytes per element with its share of the factor and of the springs of a relaxing shear modulus.
const RELAXING: u64 = 7_000;
/// Largest number of bytes per element.
pub(crate) const MOST: u64 = 8_000;

/// Returns whether condensed bodies need springs for the relaxation of a body.
pub(crate) fn relaxes_in_shear(body: &Body) -> bool {
    let series = body.material().and_then(Material::relaxation);
    series.is_some_and(|series| series.acts_on() == ActsOn::Shear)
}

/// Returns the expected bytes of bodies with these numbers of elements.
pub(crate) fn expected(bodies: [(&Body, u64); 2], keeps_factors: bool) -> u64 {
    let has_springs = bodies.map(|(body, _)| relaxes_in_shear(body));
    let plain = if keeps_factors || has_springs.contains(&true) { KEPT } else { ELIMINATED };
    let each = has_springs.map(|has| if has { RELAXING } else { plain });
    bodies.iter().zip(each).map(|((_, elements), bytes)| elements.saturating_mul(bytes)).sum()
}
