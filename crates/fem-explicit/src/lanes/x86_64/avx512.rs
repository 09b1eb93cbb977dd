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

macro_rules! avx512_operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl $operator for Avx512 {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: the type's contract.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

avx512_operator!(Add, add, _mm512_add_pd);
avx512_operator!(Sub, sub, _mm512_sub_pd);
avx512_operator!(Mul, mul, _mm512_mul_pd);
avx512_operator!(Div, div, _mm512_div_pd);

impl Number for Avx512 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    fn plus_product(self, x: Self, y: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm512_fmadd_pd(x.0, y.0, self.0) })
    }

    #[inline(always)]
    fn minus_product(self, x: Self, y: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm512_fnmadd_pd(x.0, y.0, self.0) })
    }

    #[inline(always)]
    fn inverse_cube_root_estimate(self) -> Self {
        // SAFETY: the type's contract.
        unsafe {
            let upper = _mm512_srli_epi64::<32>(_mm512_castpd_si512(self.0));
            let factor = _mm512_set1_epi64(0xAAAA_AAAB);
            let third = _mm512_srli_epi64::<33>(_mm512_mul_epu32(upper, factor));
            let rest = _mm512_sub_epi64(_mm512_set1_epi64(0x553E_F0FF), third);
            Self(_mm512_castsi512_pd(_mm512_slli_epi64::<32>(rest)))
        }
    }

    #[inline(always)]
    fn power_of_two(self) -> (Self, Self) {
        // SAFETY: the type's contract.
        unsafe {
            let offset = _mm512_set1_epi64(POWER_OFFSET as i64);
            let moved = _mm512_add_epi64(_mm512_castpd_si512(self.0), offset);
            let exponent = _mm512_srli_epi64::<52>(moved);
            let units = _mm512_or_si512(exponent, _mm512_set1_epi64(UNITS as i64));
            let offset = _mm512_set1_pd(UNITS_AND_OFFSET);
            let power = _mm512_sub_pd(_mm512_castsi512_pd(units), offset);
            let rest = _mm512_sub_epi64(_mm512_set1_epi64(2046), exponent);
            let inverse = _mm512_castsi512_pd(_mm512_slli_epi64::<52>(rest));
            (Self(power), Self(inverse))
        }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm512_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn all_within(self, bound: f64) -> bool {
        // SAFETY: the type's contract.
        unsafe { within(self, bound) == 0xFF }
    }

    #[inline(always)]
    fn choose_within(self, bound: f64, inside: Self, outside: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm512_mask_blend_pd(within(self, bound), outside.0, inside.0) })
    }
}

/// Returns the lanes that lie within ± a bound, one bit per lane.
///
/// # Safety
/// The type's contract.
#[inline(always)]
unsafe fn within(x: Avx512, bound: f64) -> u8 {
    // SAFETY: the caller's promise.
    unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(_mm512_abs_pd(x.0), _mm512_set1_pd(bound)) }
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

impl Lanes<WIDE> for Avx512 {
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn load(values: &[f64; WIDE]) -> Self {
        // SAFETY: the type's contract; the array is as long as the register.
        Self(unsafe { _mm512_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn to_array(self) -> [f64; WIDE] {
        let mut values = [0.0; WIDE];
        // SAFETY: the type's contract; the array is as long as the register.
        unsafe { _mm512_storeu_pd(values.as_mut_ptr(), self.0) };
        values
    }

    #[inline(always)]
    unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; WIDE]) -> (Self, Self) {
        // SAFETY: the caller's promise and the type's contract.
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
            (Self(_mm512_unpacklo_pd(even, odd)), Self(_mm512_unpackhi_pd(even, odd)))
        }
    }

    #[inline(always)]
    unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; WIDE]) {
        // SAFETY: the caller's promise and the type's contract.
        unsafe {
            for (node, pair) in nodes.iter().zip(pairs(self, y)) {
                let place = field.get_unchecked_mut(*node as usize).as_mut_ptr();
                _mm_storeu_pd(place, _mm_sub_pd(_mm_loadu_pd(place), pair));
            }
        }
    }
}
