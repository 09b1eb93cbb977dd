//! Four lanes in an AVX register.

use std::arch::x86_64::{
    __m128d, __m256d, _CMP_LE_OQ, _mm_loadu_pd, _mm_storeu_pd, _mm_sub_pd, _mm256_add_epi64,
    _mm256_add_pd, _mm256_andnot_pd, _mm256_blendv_pd, _mm256_castpd_si256, _mm256_castpd256_pd128,
    _mm256_castsi256_pd, _mm256_cmp_pd, _mm256_div_pd, _mm256_extractf128_pd, _mm256_fmadd_pd,
    _mm256_fnmadd_pd, _mm256_loadu_pd, _mm256_max_pd, _mm256_min_pd, _mm256_movemask_pd,
    _mm256_mul_epu32, _mm256_mul_pd, _mm256_or_si256, _mm256_set_m128d, _mm256_set1_epi64x,
    _mm256_set1_pd, _mm256_slli_epi64, _mm256_sqrt_pd, _mm256_srli_epi64, _mm256_storeu_pd,
    _mm256_sub_epi64, _mm256_sub_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd,
};
use std::ops::{Add, Div, Mul, Sub};

use super::super::{LANES, Lanes, Number};
use fem_material::finite::{POWER_OFFSET, UNITS, UNITS_AND_OFFSET};

/// Lanes as an AVX register. Values must be made and used only in functions
/// that are compiled for AVX2 and FMA and called after the processor was asked.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Avx2(pub(super) __m256d);

/// Returns all bits of the lanes that lie within ± a bound.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn within(x: Avx2, bound: f64) -> __m256d {
    // SAFETY: the caller's promise.
    unsafe {
        let size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), x.0);
        _mm256_cmp_pd::<_CMP_LE_OQ>(size, _mm256_set1_pd(bound))
    }
}

/// Whether all lanes lie within ± a bound.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn all_within(x: Avx2, bound: f64) -> bool {
    // SAFETY: the caller's promise.
    unsafe { _mm256_movemask_pd(within(x, bound)) == 0b1111 }
}

/// Returns the lanes of one where x lies within ± a bound, and those of the other elsewhere.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn choose_within(x: Avx2, bound: f64, inside: Avx2, outside: Avx2) -> Avx2 {
    // SAFETY: the caller's promise.
    Avx2(unsafe { _mm256_blendv_pd(outside.0, inside.0, within(x, bound)) })
}

/// Returns the pair (r, y) of each lane.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn pairs(r: Avx2, y: Avx2) -> [__m128d; LANES] {
    // SAFETY: the caller's promise.
    unsafe {
        let even = _mm256_unpacklo_pd(r.0, y.0);
        let odd = _mm256_unpackhi_pd(r.0, y.0);
        [
            _mm256_castpd256_pd128(even),
            _mm256_castpd256_pd128(odd),
            _mm256_extractf128_pd::<1>(even),
            _mm256_extractf128_pd::<1>(odd),
        ]
    }
}

/// Returns the r and the y of nodes.
///
/// # Safety
/// That of [`Lanes::gather`].
#[inline(always)]
unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; LANES]) -> (Avx2, Avx2) {
    // SAFETY: the caller's promise.
    unsafe {
        let pair_0 = _mm_loadu_pd(field.get_unchecked(nodes[0] as usize).as_ptr());
        let pair_1 = _mm_loadu_pd(field.get_unchecked(nodes[1] as usize).as_ptr());
        let pair_2 = _mm_loadu_pd(field.get_unchecked(nodes[2] as usize).as_ptr());
        let pair_3 = _mm_loadu_pd(field.get_unchecked(nodes[3] as usize).as_ptr());
        let even = _mm256_set_m128d(pair_2, pair_0);
        let odd = _mm256_set_m128d(pair_3, pair_1);
        (Avx2(_mm256_unpacklo_pd(even, odd)), Avx2(_mm256_unpackhi_pd(even, odd)))
    }
}

lanes_of_register! {
    Avx2, LANES,
    arithmetic: [_mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_sqrt_pd, _mm256_max_pd, _mm256_min_pd],
    fused: [_mm256_fmadd_pd, _mm256_fnmadd_pd],
    memory: [_mm256_set1_pd, _mm256_loadu_pd, _mm256_storeu_pd],
    bits: [_mm256_castpd_si256, _mm256_castsi256_pd, _mm256_set1_epi64x, _mm256_add_epi64, _mm256_sub_epi64,
        _mm256_mul_epu32, _mm256_or_si256, _mm256_slli_epi64, _mm256_srli_epi64],
}
