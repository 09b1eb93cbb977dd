//! Elements in a row on vector registers.

mod of_avx2 {
    use std::arch::x86_64::{
        __m256d, _mm256_add_pd, _mm256_loadu_pd, _mm256_permute2f128_pd, _mm256_setzero_pd,
        _mm256_storeu_pd, _mm256_sub_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd,
    };

    use super::super::super::RowLanes;
    use super::super::{Avx2, TwoRegisters};

    /// Number of nodes whose (r, y) pairs fit into one register.
    const NODES: usize = 2;

    /// Returns eight pairs, two per register.
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

    /// Returns the second pair of a register and the first of the next.
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

mod of_avx512 {
    use std::arch::x86_64::{
        __m512d, _mm512_add_pd, _mm512_alignr_epi64, _mm512_castpd_si512, _mm512_castsi512_pd,
        _mm512_loadu_pd, _mm512_setzero_pd, _mm512_storeu_pd, _mm512_sub_pd, _mm512_unpackhi_pd,
        _mm512_unpacklo_pd,
    };

    use super::super::super::RowLanes;
    use super::super::Avx512;

    /// Number of nodes whose (r, y) pairs fit into one register.
    const NODES: usize = 4;

    /// Returns the last pair of a register and the first three of the next.
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
