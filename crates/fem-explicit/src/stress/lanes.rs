//! Four elements at once.
//!
//! The element kernels are written once over [`Lanes`] and compiled for plain
//! arrays and for AVX2, which is chosen at run time. Neither fuses multiply and
//! add, so both give the same bits.

use std::ops::{Add, Div, Mul, Sub};

use fem_material::finite::{Number, inverse_cube_root_estimate};

/// Elements that one pass of a kernel treats together.
pub(crate) const LANES: usize = 4;

/// One number of each of four elements.
pub(crate) trait Lanes: Number {
    /// The larger of both, lane by lane; `other` where one is no number.
    fn max(self, other: Self) -> Self;

    /// The smaller of both, lane by lane; `other` where one is no number.
    fn min(self, other: Self) -> Self;

    /// The numbers of an array.
    fn load(values: &[f64; LANES]) -> Self;

    /// The numbers as an array.
    fn to_array(self) -> [f64; LANES];

    /// The pairs (r, y) of four nodes, all r and all y.
    ///
    /// # Safety
    /// Every node is an index of `field`.
    unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; LANES]) -> (Self, Self);

    /// Subtracts (r, y) from the pairs of four nodes, lane by lane.
    ///
    /// # Safety
    /// Every node is an index of `field`.
    unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; LANES]);
}

/// A loop over elements that is written once for lanes of any kind.
pub(crate) trait LaneKernel {
    /// What the loop writes to.
    type Output: ?Sized;

    /// The loop. It and all that it calls must be `#[inline(always)]`, so that it is compiled for
    /// the instruction set of its lanes. The output is a parameter of its own, which tells the
    /// compiler that nothing of the kernel points there: as a field of the kernel it cost a tenth
    /// of the time.
    fn on<L: Lanes>(self, output: &mut Self::Output);
}

/// Runs a kernel on the widest lanes that the processor has.
pub(crate) fn run_lanes<K: LaneKernel>(kernel: K, output: &mut K::Output) {
    #[cfg(target_arch = "x86_64")]
    {
        #[target_feature(enable = "avx2")]
        fn on_avx2<K: LaneKernel>(kernel: K, output: &mut K::Output) {
            kernel.on::<Avx2>(output);
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has been asked.
            return unsafe { on_avx2(kernel, output) };
        }
    }
    kernel.on::<Plain>(output);
}

/// Lanes as an array, for any machine.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plain([f64; LANES]);

macro_rules! plain_operator {
    ($operator:ident, $method:ident) => {
        impl $operator for Plain {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(std::array::from_fn(|lane| self.0[lane].$method(other.0[lane])))
            }
        }
    };
}

plain_operator!(Add, add);
plain_operator!(Sub, sub);
plain_operator!(Mul, mul);
plain_operator!(Div, div);

impl Number for Plain {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    fn inverse_cube_root_estimate(self) -> Self {
        let of = inverse_cube_root_estimate;
        Self([of(self.0[0]), of(self.0[1]), of(self.0[2]), of(self.0[3])])
    }
}

impl Lanes for Plain {
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let larger =
            |lane: usize| if self.0[lane] > other.0[lane] { self.0[lane] } else { other.0[lane] };
        Self([larger(0), larger(1), larger(2), larger(3)])
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let smaller =
            |lane: usize| if self.0[lane] < other.0[lane] { self.0[lane] } else { other.0[lane] };
        Self([smaller(0), smaller(1), smaller(2), smaller(3)])
    }

    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        Self(*values)
    }

    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; LANES]) -> (Self, Self) {
        // SAFETY: the caller's promise.
        let pairs = nodes.map(|node| unsafe { *field.get_unchecked(node as usize) });
        (Self(pairs.map(|pair| pair[0])), Self(pairs.map(|pair| pair[1])))
    }

    #[inline(always)]
    unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; LANES]) {
        for lane in 0..LANES {
            // SAFETY: the caller's promise.
            let pair = unsafe { field.get_unchecked_mut(nodes[lane] as usize) };
            pair[0] -= self.0[lane];
            pair[1] -= y.0[lane];
        }
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::{
        __m256d, _mm_loadu_pd, _mm_storeu_pd, _mm_sub_pd, _mm256_add_pd, _mm256_castpd_si256,
        _mm256_castpd256_pd128, _mm256_castsi256_pd, _mm256_div_pd, _mm256_extractf128_pd,
        _mm256_loadu_pd, _mm256_max_pd, _mm256_min_pd, _mm256_mul_epu32, _mm256_mul_pd,
        _mm256_set_m128d, _mm256_set1_epi64x, _mm256_set1_pd, _mm256_slli_epi64, _mm256_srli_epi64,
        _mm256_storeu_pd, _mm256_sub_epi64, _mm256_sub_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd,
    };
    use std::ops::{Add, Div, Mul, Sub};

    use super::{LANES, Lanes, Number};

    /// Lanes as an AVX register. Values must be made and used only in functions
    /// that are compiled for AVX2 and called after the processor was asked.
    #[derive(Debug, Clone, Copy)]
    pub(crate) struct Avx2(__m256d);

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
                let even = _mm256_unpacklo_pd(self.0, y.0);
                let odd = _mm256_unpackhi_pd(self.0, y.0);
                let pairs = [
                    _mm256_castpd256_pd128(even),
                    _mm256_castpd256_pd128(odd),
                    _mm256_extractf128_pd::<1>(even),
                    _mm256_extractf128_pd::<1>(odd),
                ];
                for (node, pair) in nodes.iter().zip(pairs) {
                    let place = field.get_unchecked_mut(*node as usize).as_mut_ptr();
                    _mm_storeu_pd(place, _mm_sub_pd(_mm_loadu_pd(place), pair));
                }
            }
        }
    }
}
