//! Lanes for elements in a row, whose corners are neighbours in memory.

use super::{Lanes, Plain, WIDE};

/// The element of eight in a row that each lane holds. The order follows from splitting registers of pairs into first
/// and second numbers.
pub(crate) const ROW_PLACES: [usize; WIDE] = [0, 4, 1, 5, 2, 6, 3, 7];

/// Lanes that read and write nodes which follow each other.
pub(crate) trait RowLanes: Lanes<WIDE> {
    /// The share of the last element of eight in the node behind them.
    type Carry: Copy;

    /// Returns an empty carry.
    fn no_carry() -> Self::Carry;

    /// Loads the pairs (r, y) of eight nodes from `first` on, all r and all y, in the order of [`ROW_PLACES`].
    ///
    /// # Safety
    /// All of them are in the field.
    unsafe fn load_row(field: &[[f64; 2]], first: usize) -> (Self, Self);

    /// Subtracts, from eight nodes from `first` on, the pairs of each element for its own node and for the next one,
    /// and the carry of the eight before. Returns the new carry.
    ///
    /// # Safety
    /// All of them are in the field.
    unsafe fn subtract_row(
        field: &mut [[f64; 2]],
        first: usize,
        own: (Self, Self),
        next: (Self, Self),
        carry: Self::Carry,
    ) -> Self::Carry;

    /// Returns the pair in a carry.
    fn carried(carry: Self::Carry) -> [f64; 2];
}

impl RowLanes for Plain<WIDE> {
    type Carry = [f64; 2];

    #[inline(always)]
    fn no_carry() -> [f64; 2] {
        [0.0; 2]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    unsafe fn load_row(field: &[[f64; 2]], first: usize) -> (Self, Self) {
        // SAFETY: the caller's promise.
        let pairs = ROW_PLACES.map(|place| unsafe { *field.get_unchecked(first + place) });
        (Self(pairs.map(|pair| pair[0])), Self(pairs.map(|pair| pair[1])))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    unsafe fn subtract_row(
        field: &mut [[f64; 2]],
        first: usize,
        own: (Self, Self),
        next: (Self, Self),
        carry: [f64; 2],
    ) -> [f64; 2] {
        let (mut of_own, mut of_next) = ([[0.0; 2]; WIDE], [carry; WIDE + 1]);
        for (lane, place) in ROW_PLACES.into_iter().enumerate() {
            of_own[place] = [own.0.0[lane], own.1.0[lane]];
            of_next[place + 1] = [next.0.0[lane], next.1.0[lane]];
        }
        for place in 0..WIDE {
            // SAFETY: the caller's promise.
            let pair = unsafe { field.get_unchecked_mut(first + place) };
            for axis in 0..2 {
                pair[axis] -= of_own[place][axis] + of_next[place][axis];
            }
        }
        of_next[WIDE]
    }

    #[inline(always)]
    fn carried(carry: [f64; 2]) -> [f64; 2] {
        carry
    }
}
