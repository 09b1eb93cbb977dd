//! Radius and pressure where the nodes of two surfaces lie between each other at the edge.
//!
//! Forces at the nodes of either surface then depend on the nodes of the other, too: read at one surface the
//! radius is off by up to 0.1 elements, to the other side than at the other surface. Their mean is not.

/// The surfaces' elements differ by at least and at most so much, as those of meshes do that are staggered by
/// half an element with 3 to 50 of them across the contact.
const RATIOS: std::ops::Range<f64> = 1.005..1.2;
/// The mean is too small by this share of an element: measured on elastic spheres at every quarter of
/// an element, 3.5 to 8 across the radius; single readings scatter by 0.016.
const EDGE: f64 = 0.025;

/// At whose nodes radius and pressure are read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reading {
    /// Those of one surface, by its number.
    Single(usize),
    /// Those of both, whose meshes are staggered and whose segments have these lengths, m.
    Staggered([f64; 2]),
}

impl Reading {
    /// At both surfaces if segments of these lengths (m) are of staggered meshes, else at this one; a rigid
    /// surface has no length.
    pub fn of(lengths: [Option<f64>; 2], single: usize) -> Self {
        match lengths {
            [Some(a), Some(b)] if are_staggered(lengths) => Self::Staggered([a, b]),
            _ => Self::Single(single),
        }
    }

    /// Whether it reads at a surface.
    pub(crate) fn asks(self, surface: usize) -> bool {
        match self {
            Self::Single(single) => single == surface,
            Self::Staggered(_) => true,
        }
    }

    /// The contact radius (m) of what it is read as at a surface.
    pub fn radius(self, at: impl Fn(usize) -> f64) -> f64 {
        match self {
            Self::Single(surface) => at(surface),
            Self::Staggered(lengths) => staggered_radius([at(0), at(1)], lengths),
        }
    }

    /// The pressure on the axis (Pa) of what it is read as at a surface.
    pub fn pressure(self, at: impl Fn(usize) -> f64) -> f64 {
        match self {
            Self::Single(surface) => at(surface),
            Self::Staggered(_) => 0.5 * (at(0) + at(1)),
        }
    }
}

/// Whether segments of these lengths (m) are of staggered meshes; a rigid surface has none.
fn are_staggered(lengths: [Option<f64>; 2]) -> bool {
    let [Some(a), Some(b)] = lengths else { return false };
    RATIOS.contains(&(a.max(b) / a.min(b)))
}

/// The radius (m) of what it is read as at the nodes of either surface, whose segments have these lengths, m.
fn staggered_radius(readings: [f64; 2], lengths: [f64; 2]) -> f64 {
    let [radius, length] = [readings, lengths].map(|[a, b]| 0.5 * (a + b));
    if radius > 0.0 { radius + EDGE * length } else { radius }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With 3 to 45 elements across a contact, half an element apart; not of one mesh twice as fine, of
    /// meshes of one size, or of a rigid surface.
    #[test]
    fn staggered_meshes_are_known_by_their_elements() {
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
