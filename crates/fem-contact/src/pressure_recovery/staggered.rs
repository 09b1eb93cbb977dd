//! Radius and pressure of staggered meshes, whose nodes lie between each other at the edge.
//!
//! Forces at the nodes of either surface then depend on the nodes of the other. The radius recovered at one surface
//! has an error of up to 0.1 elements, with the opposite sign at the other surface. Their mean has no such error.

/// Ratios of the element sizes of two staggered meshes, which differ by half an element with 3 to 50 elements per
/// contact radius.
const STAGGERED_SIZE_RATIOS: std::ops::Range<f64> = 1.005..1.2;
/// Deficit of the mean radius in elements. Measured on elastic spheres at every quarter of an element, with 3.5 to
/// 8 elements per radius; single values scatter by 0.016.
const DEFICIT_OF_MEAN_RADIUS: f64 = 0.025;

/// The surfaces at whose nodes radius and pressure are recovered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RecoverySurfaces {
    /// One surface, by its number.
    Single(usize),
    /// Both surfaces, whose meshes are staggered and whose segments have these lengths, m.
    Staggered([f64; 2]),
}

impl RecoverySurfaces {
    /// Selects both surfaces if segments of these lengths (m) belong to staggered meshes, else the given one. A
    /// rigid surface has no length.
    pub fn of(lengths: [Option<f64>; 2], single: usize) -> Self {
        match lengths {
            [Some(a), Some(b)] if are_staggered(lengths) => Self::Staggered([a, b]),
            _ => Self::Single(single),
        }
    }

    /// Returns whether a surface is used.
    pub(crate) fn includes(self, surface: usize) -> bool {
        match self {
            Self::Single(single) => single == surface,
            Self::Staggered(_) => true,
        }
    }

    /// Returns the contact radius (m) from those recovered at each surface.
    pub fn radius(self, at: impl Fn(usize) -> f64) -> f64 {
        match self {
            Self::Single(surface) => at(surface),
            Self::Staggered(lengths) => staggered_radius([at(0), at(1)], lengths),
        }
    }

    /// Returns the pressure on the axis (Pa) from those recovered at each surface.
    pub fn pressure(self, at: impl Fn(usize) -> f64) -> f64 {
        match self {
            Self::Single(surface) => at(surface),
            Self::Staggered(_) => 0.5 * (at(0) + at(1)),
        }
    }
}

/// Returns whether segments of these lengths (m) belong to staggered meshes; a rigid surface has none.
fn are_staggered(lengths: [Option<f64>; 2]) -> bool {
    let [Some(a), Some(b)] = lengths else { return false };
    STAGGERED_SIZE_RATIOS.contains(&(a.max(b) / a.min(b)))
}

/// Returns the radius (m) from those recovered at both surfaces, whose segments have these lengths, m.
fn staggered_radius(readings: [f64; 2], lengths: [f64; 2]) -> f64 {
    let [radius, length] = [readings, lengths].map(|[a, b]| 0.5 * (a + b));
    if radius > 0.0 { radius + DEFICIT_OF_MEAN_RADIUS * length } else { radius }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Meshes with 3 to 45 elements per contact radius that differ by half an element are staggered; meshes of equal
    /// size, one of twice the resolution, and rigid surfaces are not.
    #[test]
    fn staggered_meshes_are_recognised_by_element_size() {
        for across in [3.5, 8.0, 45.0] {
            let lengths = [across - 0.25, across + 0.25].map(|across: f64| Some(1.0 / across));
            assert!(are_staggered(lengths) && are_staggered([lengths[1], lengths[0]]));
        }
        for lengths in [[Some(1.0), Some(0.5)], [Some(1.0), Some(1.0 + 1e-4)], [None, Some(1.0)]] {
            assert!(!are_staggered(lengths), "{lengths:?}");
        }
    }

    #[test]
    fn the_radius_is_the_mean_and_a_fortieth_of_an_element() {
        assert!((staggered_radius([3.9, 4.1], [0.9, 1.1]) - 4.025).abs() < 1e-12);
        assert_eq!(staggered_radius([0.0; 2], [0.9, 1.1]), 0.0);
    }
}
