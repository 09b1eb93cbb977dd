//! Lanes for elements in a row, whose corners are neighbours in memory.

use super::{Lanes, Plain, WIDE};

/// The element of eight in a row that each lane holds. The order follows from splitting registers of pairs into first and second
/// numbers.
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

    /// Subtracts, from eight nodes from `first` on, the pairs of each element for its own node and for the next one, and the carry
    /// of the eight before. Returns the new carry.
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

    #[inline(always)]
    unsafe fn load_row(field: &[[f64; 2]], first: usize) -> (Self, Self) {
        // SAFETY: the caller's promise.
        let pairs = ROW_PLACES.map(|place| unsafe { *field.get_unchecked(first + place) });
        (Self(pairs.map(|pair| pair[0])), Self(pairs.map(|pair| pair[1])))
    }

    #[inline(always)]
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

#[cfg(target_arch = "x86_64")]
mod of_avx2 {
    use std::arch::x86_64::{
        __m256d, _mm256_add_pd, _mm256_loadu_pd, _mm256_permute2f128_pd, _mm256_setzero_pd,
        _mm256_storeu_pd, _mm256_sub_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd,
    };

    use super::super::{Avx2, TwoRegisters};
    use super::RowLanes;

    /// Nodes of a register of pairs.
    const NODES: usize = 2;

    /// Eight pairs, two a register.
    ///
    /// # Safety
    /// The contract of [`Avx2`].
    #[inline(always)]
    unsafe fn pairs((r, y): (TwoRegisters<Avx2>, TwoRegisters<Avx2>)) -> [__m256d; 4] {
        // SAFETY: the caller's promise.
        unsafe {
            [
                _mm256_unpacklo_pd(r.0.0, y.0.0),
                _mm256_unpacklo_pd(r.1.0, y.1.0),
                _mm256_unpackhi_pd(r.0.0, y.0.0),
                _mm256_unpackhi_pd(r.1.0, y.1.0),
            ]
        }
    }

    /// The second pair of a register and the first of the next.
    ///
    /// # Safety
    /// The contract of [`Avx2`].
    #[inline(always)]
    unsafe fn between(before: __m256d, after: __m256d) -> __m256d {
        // SAFETY: the caller's promise.
        unsafe { _mm256_permute2f128_pd::<0x21>(before, after) }
    }

    impl RowLanes for TwoRegisters<Avx2> {
        type Carry = __m256d;

        #[inline(always)]
        fn no_carry() -> __m256d {
            // SAFETY: the type's contract.
            unsafe { _mm256_setzero_pd() }
        }

        #[inline(always)]
        unsafe fn load_row(field: &[[f64; 2]], first: usize) -> (Self, Self) {
            // SAFETY: the caller's promise and the type's contract.
            unsafe {
                let place = field.as_ptr().add(first);
                let a = _mm256_loadu_pd(place.cast());
                let b = _mm256_loadu_pd(place.add(NODES).cast());
                let c = _mm256_loadu_pd(place.add(2 * NODES).cast());
                let d = _mm256_loadu_pd(place.add(3 * NODES).cast());
                (
                    TwoRegisters(Avx2(_mm256_unpacklo_pd(a, c)), Avx2(_mm256_unpacklo_pd(b, d))),
                    TwoRegisters(Avx2(_mm256_unpackhi_pd(a, c)), Avx2(_mm256_unpackhi_pd(b, d))),
                )
            }
        }

        #[inline(always)]
        unsafe fn subtract_row(
            field: &mut [[f64; 2]],
            first: usize,
            own: (Self, Self),
            next: (Self, Self),
            carry: __m256d,
        ) -> __m256d {
            // SAFETY: the caller's promise and the type's contract.
            unsafe {
                let place = field.as_mut_ptr().add(first);
                let (own, next) = (pairs(own), pairs(next));
                let mut before = carry;
                for k in 0..4 {
                    let place = place.add(k * NODES).cast::<f64>();
                    let both = _mm256_add_pd(own[k], between(before, next[k]));
                    _mm256_storeu_pd(place, _mm256_sub_pd(_mm256_loadu_pd(place), both));
                    before = next[k];
                }
                before
            }
        }

        #[inline(always)]
        fn carried(carry: __m256d) -> [f64; 2] {
            let mut pairs = [[0.0; 2]; NODES];
            // SAFETY: the type's contract; the array is as long as the register.
            unsafe { _mm256_storeu_pd(pairs.as_mut_ptr().cast(), carry) };
            pairs[NODES - 1]
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod of_avx512 {
    use std::arch::x86_64::{
        __m512d, _mm512_add_pd, _mm512_alignr_epi64, _mm512_castpd_si512, _mm512_castsi512_pd,
        _mm512_loadu_pd, _mm512_setzero_pd, _mm512_storeu_pd, _mm512_sub_pd, _mm512_unpackhi_pd,
        _mm512_unpacklo_pd,
    };

    use super::super::Avx512;
    use super::RowLanes;

    /// Nodes of a register of pairs.
    const NODES: usize = 4;

    /// The last pair of a register and the first three of the next.
    ///
    /// # Safety
    /// The contract of [`Avx512`].
    #[inline(always)]
    unsafe fn between(before: __m512d, after: __m512d) -> __m512d {
        // SAFETY: the caller's promise.
        unsafe {
            let (before, after) = (_mm512_castpd_si512(before), _mm512_castpd_si512(after));
            _mm512_castsi512_pd(_mm512_alignr_epi64::<6>(after, before))
        }
    }

    impl RowLanes for Avx512 {
        type Carry = __m512d;

        #[inline(always)]
        fn no_carry() -> __m512d {
            // SAFETY: the type's contract.
            unsafe { _mm512_setzero_pd() }
        }

        #[inline(always)]
        unsafe fn load_row(field: &[[f64; 2]], first: usize) -> (Self, Self) {
            // SAFETY: the caller's promise and the type's contract.
            unsafe {
                let place = field.as_ptr().add(first);
                let a = _mm512_loadu_pd(place.cast());
                let b = _mm512_loadu_pd(place.add(NODES).cast());
                (Avx512(_mm512_unpacklo_pd(a, b)), Avx512(_mm512_unpackhi_pd(a, b)))
            }
        }

        #[inline(always)]
        unsafe fn subtract_row(
            field: &mut [[f64; 2]],
            first: usize,
            own: (Self, Self),
            next: (Self, Self),
            carry: __m512d,
        ) -> __m512d {
            // SAFETY: the caller's promise and the type's contract.
            unsafe {
                let place = field.as_mut_ptr().add(first);
                let (low, high): (*mut f64, *mut f64) = (place.cast(), place.add(NODES).cast());
                let next_low = _mm512_unpacklo_pd(next.0.0, next.1.0);
                let next_high = _mm512_unpackhi_pd(next.0.0, next.1.0);
                let own_low = _mm512_unpacklo_pd(own.0.0, own.1.0);
                let own_high = _mm512_unpackhi_pd(own.0.0, own.1.0);
                let both_low = _mm512_add_pd(own_low, between(carry, next_low));
                let both_high = _mm512_add_pd(own_high, between(next_low, next_high));
                _mm512_storeu_pd(low, _mm512_sub_pd(_mm512_loadu_pd(low), both_low));
                _mm512_storeu_pd(high, _mm512_sub_pd(_mm512_loadu_pd(high), both_high));
                next_high
            }
        }

        #[inline(always)]
        fn carried(carry: __m512d) -> [f64; 2] {
            let mut pairs = [[0.0; 2]; NODES];
            // SAFETY: the type's contract; the array is as long as the register.
            unsafe { _mm512_storeu_pd(pairs.as_mut_ptr().cast(), carry) };
            pairs[NODES - 1]
        }
    }
}
