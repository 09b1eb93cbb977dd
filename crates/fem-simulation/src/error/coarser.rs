//! What coarser meshes tell of condensed bodies, by how many elements their contact has.
//!
//! Margins of one mesh, and what grows where elements are few, are measured: of 110 random scenes with 5.5 to 6.7 elements
//! across the contact all numbers of 105 were within their bars, which are 2.9 times the error in the median. Between 7.5
//! and nine elements a tolerance is tight, and bars of coarser meshes so wide (0.11 % of the contact time of glass spheres,
//! which is off by 0.03 %) that the collision would be computed again on a finer one.

use super::companion::COARSER;
use super::margins::{FEW, OF_FEW_CONDENSED};

/// Fewer elements across the contact leave coarser meshes nothing to tell.
const FEWEST: f64 = 5.0;
/// With more, a finer mesh tells it more sharply, ...
const MOST_FOR_ONE: f64 = 7.5;
/// ... and from here on a mesh of half as many has enough.
const ENOUGH_FOR_TWO: f64 = 2.0 * FEW;

/// Coarser meshes, and what their differences are worth; arrays in the order of [`QuantityOfInterest::ALL`].
///
/// [`QuantityOfInterest::ALL`]: fem_collision::QuantityOfInterest::ALL
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ByCoarserMeshes {
    /// Lengths of their elements over those of the collision.
    pub ratios: &'static [f64],
    /// Errors that are told over those that are estimated.
    pub margin: [f64; 6],
    /// What both grow by, times the square of h/a.
    of_few: [f64; 6],
    /// More of it of the restitution, over what relaxation takes of it: the error passes through zero with the place of
    /// the contact's edge. Of 111 random scenes three were off by more than was told without.
    of_loss: f64,
}

/// The place of the edge shows in the force.
const ONE: ByCoarserMeshes = ByCoarserMeshes {
    ratios: &[COARSER[0]],
    margin: [1.2, 1.15, 0.6, 1.5, 0.75, 0.8],
    of_few: [8e-4, 0.024, 0.028, 0.022, 0.32, 0.45],
    of_loss: 0.04,
};
/// Contact time and force converge faster than is counted with.
const TWO: ByCoarserMeshes = ByCoarserMeshes {
    ratios: &COARSER,
    margin: [1.6, 1.0, 0.5, 1.2, 0.7, 0.8],
    of_few: OF_FEW_CONDENSED,
    of_loss: 0.0,
};
impl ByCoarserMeshes {
    /// Of so many elements across the contact; none where coarser meshes tell nothing.
    pub fn of(across: f64) -> Option<Self> {
        match across {
            _ if across >= ENOUGH_FOR_TWO => Some(TWO),
            _ if (FEWEST..MOST_FOR_ONE).contains(&across) => Some(ONE),
            _ => None,
        }
    }

    /// Whether a finer mesh tells it more sharply: before a collision is computed again, that one is asked.
    pub fn may_be_sharper(&self) -> bool {
        *self == ONE
    }

    /// What grows where elements are few, of a collision with this restitution.
    pub fn of_few(&self, restitution: Option<f64>) -> [f64; 6] {
        let mut of_few = self.of_few;
        of_few[0] += self.of_loss * (1.0 - restitution.unwrap_or(1.0)).clamp(0.0, 1.0);
        of_few
    }
}

/// Time that what tells the error of condensed bodies with so many elements across the contact takes, over that of the
/// collision with its factors: a mesh of 1.5 times the elements across where there are few, and else coarser ones.
pub fn condensed_companion_time(across: f64) -> f64 {
    match ByCoarserMeshes::of(across) {
        None => 3.0,
        Some(ByCoarserMeshes { ratios: [_], .. }) => 0.5,
        Some(_) => 0.7,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No coarser mesh is left with three elements, and where there are coarser meshes they are cheaper than a finer one.
    #[test]
    fn coarser_meshes_have_enough_elements() {
        let finer = condensed_companion_time(4.9);
        for across in (10..300).map(|k| f64::from(k) / 10.0) {
            let Some(by_coarser) = ByCoarserMeshes::of(across) else {
                assert!(across < FEWEST || (MOST_FOR_ONE..ENOUGH_FOR_TWO).contains(&across));
                continue;
            };
            assert!(by_coarser.ratios.iter().all(|ratio| across / ratio > 3.3), "{across}");
            assert!(condensed_companion_time(across) < finer);
        }
    }

    /// What relaxation takes is in the bar of the restitution, and in no other.
    #[test]
    fn what_relaxes_has_a_wider_bar() {
        let few = |restitution| ByCoarserMeshes::of(5.5).unwrap().of_few(restitution);
        let [elastic, half] = [few(Some(1.0)), few(Some(0.5))];
        assert!((half[0] - elastic[0] - 0.02).abs() < 1e-12);
        assert_eq!(elastic[1..], half[1..]);
        assert_eq!(few(None), elastic);
    }
}
