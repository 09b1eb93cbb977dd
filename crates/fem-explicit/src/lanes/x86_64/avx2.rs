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

macro_rules! avx2_operator {
    ($operator:ident, $method:ident, $instruction:ident) => {
        impl $operator for Avx2 {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: the type's contract.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

avx2_operator!(Add, add, _mm256_add_pd);
avx2_operator!(Sub, sub, _mm256_sub_pd);
avx2_operator!(Mul, mul, _mm256_mul_pd);
avx2_operator!(Div, div, _mm256_div_pd);

impl Number for Avx2 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    fn plus_product(self, x: Self, y: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm256_fmadd_pd(x.0, y.0, self.0) })
    }

    #[inline(always)]
    fn minus_product(self, x: Self, y: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm256_fnmadd_pd(x.0, y.0, self.0) })
    }

    #[inline(always)]
    fn inverse_cube_root_estimate(self) -> Self {
        // SAFETY: the type's contract.
        unsafe {
            let upper = _mm256_srli_epi64::<32>(_mm256_castpd_si256(self.0));
            let factor = _mm256_set1_epi64x(0xAAAA_AAAB);
            let third = _mm256_srli_epi64::<33>(_mm256_mul_epu32(upper, factor));
            let rest = _mm256_sub_epi64(_mm256_set1_epi64x(0x553E_F0FF), third);
            Self(_mm256_castsi256_pd(_mm256_slli_epi64::<32>(rest)))
        }
    }

    #[inline(always)]
    fn power_of_two(self) -> (Self, Self) {
        // SAFETY: the type's contract.
        unsafe {
            let offset = _mm256_set1_epi64x(POWER_OFFSET as i64);
            let moved = _mm256_add_epi64(_mm256_castpd_si256(self.0), offset);
            let exponent = _mm256_srli_epi64::<52>(moved);
            let units = _mm256_or_si256(exponent, _mm256_set1_epi64x(UNITS as i64));
            let offset = _mm256_set1_pd(UNITS_AND_OFFSET);
            let power = _mm256_sub_pd(_mm256_castsi256_pd(units), offset);
            let rest = _mm256_sub_epi64(_mm256_set1_epi64x(2046), exponent);
            let inverse = _mm256_castsi256_pd(_mm256_slli_epi64::<52>(rest));
            (Self(power), Self(inverse))
        }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn all_within(self, bound: f64) -> bool {
        // SAFETY: the type's contract.
        unsafe { _mm256_movemask_pd(within(self, bound)) == 0b1111 }
    }

    #[inline(always)]
    fn choose_within(self, bound: f64, inside: Self, outside: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm256_blendv_pd(outside.0, inside.0, within(self, bound)) })
    }
}

impl Lanes for Avx2 {
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: the type's contract.
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: the type's contract; the array is as long as the register.
        Self(unsafe { _mm256_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        let mut values = [0.0; LANES];
        // SAFETY: the type's contract; the array is as long as the register.
        unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) };
        values
    }

    #[inline(always)]
    unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; LANES]) -> (Self, Self) {
        // SAFETY: the caller's promise and the type's contract.
        unsafe {
            let pair_0 = _mm_loadu_pd(field.get_unchecked(nodes[0] as usize).as_ptr());
            let pair_1 = _mm_loadu_pd(field.get_unchecked(nodes[1] as usize).as_ptr());
            let pair_2 = _mm_loadu_pd(field.get_unchecked(nodes[2] as usize).as_ptr());
            let pair_3 = _mm_loadu_pd(field.get_unchecked(nodes[3] as usize).as_ptr());
            let even = _mm256_set_m128d(pair_2, pair_0);
            let odd = _mm256_set_m128d(pair_3, pair_1);
            (Self(_mm256_unpacklo_pd(even, odd)), Self(_mm256_unpackhi_pd(even, odd)))
        }
    }

    #[inline(always)]
    unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; LANES]) {
        // SAFETY: the caller's promise and the type's contract.
        unsafe {
            for (node, pair) in nodes.iter().zip(pairs(self, y)) {
                let place = field.get_unchecked_mut(*node as usize).as_mut_ptr();
                _mm_storeu_pd(place, _mm_sub_pd(_mm_loadu_pd(place), pair));
            }
        }
    }
}
