//! Eight lanes in an AVX-512 register.

use std::arch::x86_64::{
    __m128d, __m512d, _CMP_LE_OQ, _mm_loadu_pd, _mm_storeu_pd, _mm_sub_pd, _mm256_castpd256_pd128,
    _mm256_extractf128_pd, _mm256_set_m128d, _mm512_abs_pd, _mm512_add_epi64, _mm512_add_pd,
    _mm512_castpd_si512, _mm512_castpd256_pd512, _mm512_castpd512_pd256, _mm512_castsi512_pd,
    _mm512_cmp_pd_mask, _mm512_div_pd, _mm512_extractf64x4_pd, _mm512_fmadd_pd, _mm512_fnmadd_pd,
    _mm512_insertf64x4, _mm512_loadu_pd, _mm512_mask_blend_pd, _mm512_max_pd, _mm512_min_pd,
    _mm512_mul_epu32, _mm512_mul_pd, _mm512_or_si512, _mm512_set1_epi64, _mm512_set1_pd,
    _mm512_slli_epi64, _mm512_sqrt_pd, _mm512_srli_epi64, _mm512_storeu_pd, _mm512_sub_epi64,
    _mm512_sub_pd, _mm512_unpackhi_pd, _mm512_unpacklo_pd,
};
use std::ops::{Add, Div, Mul, Sub};

use fem_material::finite::{Number, POWER_OFFSET, UNITS, UNITS_AND_OFFSET};

use super::super::{Lanes, WIDE};

/// Lanes as an AVX-512 register. Values must be made and used only in functions that are compiled for
/// AVX-512F and called after the processor was asked.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Avx512(pub(super) __m512d);

/// Returns the lanes that lie within ± a bound, one bit per lane.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn within(x: Avx512, bound: f64) -> u8 {
    // SAFETY: the caller's promise.
    unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(_mm512_abs_pd(x.0), _mm512_set1_pd(bound)) }
}

/// Whether all lanes lie within ± a bound.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn all_within(x: Avx512, bound: f64) -> bool {
    // SAFETY: the caller's promise.
    unsafe { within(x, bound) == 0xFF }
}

/// Returns the lanes of one where x lies within ± a bound, and those of the other elsewhere.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn choose_within(x: Avx512, bound: f64, inside: Avx512, outside: Avx512) -> Avx512 {
    // SAFETY: the caller's promise.
    Avx512(unsafe { _mm512_mask_blend_pd(within(x, bound), outside.0, inside.0) })
}

/// Returns the pair (r, y) of each lane.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn pairs(r: Avx512, y: Avx512) -> [__m128d; WIDE] {
    // SAFETY: the caller's promise.
    unsafe {
        let even = _mm512_unpacklo_pd(r.0, y.0);
        let odd = _mm512_unpackhi_pd(r.0, y.0);
        let (even_low, even_high) =
            (_mm512_castpd512_pd256(even), _mm512_extractf64x4_pd::<1>(even));
        let (odd_low, odd_high) = (_mm512_castpd512_pd256(odd), _mm512_extractf64x4_pd::<1>(odd));
        [
            _mm256_castpd256_pd128(even_low),
            _mm256_castpd256_pd128(odd_low),
            _mm256_extractf128_pd::<1>(even_low),
            _mm256_extractf128_pd::<1>(odd_low),
            _mm256_castpd256_pd128(even_high),
            _mm256_castpd256_pd128(odd_high),
            _mm256_extractf128_pd::<1>(even_high),
            _mm256_extractf128_pd::<1>(odd_high),
        ]
    }
}

/// Returns the r and the y of nodes.
///
/// # Safety
/// That of [`Lanes::gather`].
#[inline(always)]
unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; WIDE]) -> (Avx512, Avx512) {
    // SAFETY: the caller's promise.
    unsafe {
        let pair_0 = _mm_loadu_pd(field.get_unchecked(nodes[0] as usize).as_ptr());
        let pair_1 = _mm_loadu_pd(field.get_unchecked(nodes[1] as usize).as_ptr());
        let pair_2 = _mm_loadu_pd(field.get_unchecked(nodes[2] as usize).as_ptr());
        let pair_3 = _mm_loadu_pd(field.get_unchecked(nodes[3] as usize).as_ptr());
        let pair_4 = _mm_loadu_pd(field.get_unchecked(nodes[4] as usize).as_ptr());
        let pair_5 = _mm_loadu_pd(field.get_unchecked(nodes[5] as usize).as_ptr());
        let pair_6 = _mm_loadu_pd(field.get_unchecked(nodes[6] as usize).as_ptr());
        let pair_7 = _mm_loadu_pd(field.get_unchecked(nodes[7] as usize).as_ptr());
        let even = _mm512_castpd256_pd512(_mm256_set_m128d(pair_2, pair_0));
        let even = _mm512_insertf64x4::<1>(even, _mm256_set_m128d(pair_6, pair_4));
        let odd = _mm512_castpd256_pd512(_mm256_set_m128d(pair_3, pair_1));
        let odd = _mm512_insertf64x4::<1>(odd, _mm256_set_m128d(pair_7, pair_5));
        (Avx512(_mm512_unpacklo_pd(even, odd)), Avx512(_mm512_unpackhi_pd(even, odd)))
    }
}

lanes_of_register! {
    Avx512, WIDE,
    arithmetic: [_mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd, _mm512_sqrt_pd, _mm512_max_pd, _mm512_min_pd],
    fused: [_mm512_fmadd_pd, _mm512_fnmadd_pd],
    memory: [_mm512_set1_pd, _mm512_loadu_pd, _mm512_storeu_pd],
    bits: [_mm512_castpd_si512, _mm512_castsi512_pd, _mm512_set1_epi64, _mm512_add_epi64, _mm512_sub_epi64,
        _mm512_mul_epu32, _mm512_or_si512, _mm512_slli_epi64, _mm512_srli_epi64],
}
