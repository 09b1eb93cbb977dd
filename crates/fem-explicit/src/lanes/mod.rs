//! Several elements at once: eight where they lie in rows ([`RowLanes`]) and at finite strain, whose long chains of
//! operations would keep four lanes waiting; otherwise four.
//!
//! The element kernels are written once over [`Lanes`] and compiled for plain arrays, for AVX2 with FMA and, with eight
//! lanes, for AVX-512; the best is chosen at run time. Kernels of eight lanes fuse products and sums, and all lanes
//! round once, so all give the same bits. Plain arrays do so by a library function on a processor without that
//! instruction, slowly. WebAssembly has no such instruction, and rounds twice: there finite strain agrees to rounding,
//! not in bits.
//!
//! Unit tests have plain arrays alone, since compiling the kernels of all lanes again takes minutes. The program
//! `tests/it` runs collisions on lanes of every kind and compares their bits.

use std::ops::{Add, Div, Mul, Sub};
use std::sync::atomic::{AtomicU8, Ordering};

use fem_material::finite::{Number, inverse_cube_root_estimate, power_of_two};

/// Elements that a kernel treats together.
pub(crate) const LANES: usize = 4;

/// The same for a kernel of rows or of finite strain.
pub(crate) const WIDE: usize = 8;

/// One number of each of several elements.
pub(crate) trait Lanes<const N: usize = LANES>: Number {
    /// Returns the larger one, lane by lane; `other` where one is not a number.
    fn max(self, other: Self) -> Self;

    /// Returns the smaller one, lane by lane; `other` where one is not a number.
    fn min(self, other: Self) -> Self;

    /// Loads the numbers of an array.
    fn load(values: &[f64; N]) -> Self;

    /// Returns the numbers as an array.
    fn to_array(self) -> [f64; N];

    /// Gathers the pairs (r, y) of some nodes, all r and all y.
    ///
    /// # Safety
    /// Every node is an index of `field`.
    unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; N]) -> (Self, Self);

    /// Subtracts (r, y) from the pairs of some nodes, lane by lane.
    ///
    /// # Safety
    /// Every node is an index of `field`.
    unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; N]);
}

/// A loop over elements, written once for lanes of any kind.
pub(crate) trait LaneKernel<const N: usize = LANES> {
    /// The output of the loop.
    type Output: ?Sized;

    /// Runs the loop. It and all that it calls must be `#[inline(always)]`, so that it is compiled for the instruction
    /// set of its lanes. The output is a separate parameter, so that the compiler knows that it does not alias the
    /// kernel; as a field of the kernel it cost a tenth of the time.
    fn on<L: Lanes<N>>(self, output: &mut Self::Output);
}

/// Runs a kernel on the widest lanes that the processor has.
pub(crate) fn run_lanes<K: LaneKernel>(kernel: K, output: &mut K::Output) {
    #[cfg(all(target_arch = "x86_64", not(test)))]
    {
        #[target_feature(enable = "avx2,fma")]
        fn on_avx2<K: LaneKernel>(kernel: K, output: &mut K::Output) {
            kernel.on::<Avx2>(output);
        }
        if has_avx2() {
            // SAFETY: the processor has been asked.
            return unsafe { on_avx2(kernel, output) };
        }
    }
    kernel.on::<Plain>(output);
}

/// A loop over rows of elements, written once for lanes of any kind, like [`LaneKernel`].
pub(crate) trait RowKernel {
    /// The output of the loop.
    type Output: ?Sized;

    /// Runs the loop.
    fn on<L: RowLanes>(self, output: &mut Self::Output);
}

/// A kernel of eight elements that lie anywhere.
struct Anywhere<K>(K);

impl<K: LaneKernel<WIDE>> RowKernel for Anywhere<K> {
    type Output = K::Output;

    #[inline(always)]
    fn on<L: RowLanes>(self, output: &mut K::Output) {
        self.0.on::<L>(output);
    }
}

/// Runs a kernel of finite strain on the widest lanes that the processor has.
pub(crate) fn run_wide_lanes<K: LaneKernel<WIDE>>(kernel: K, output: &mut K::Output) {
    run_row_lanes(Anywhere(kernel), output);
}

/// Runs a kernel of rows on the widest lanes that the processor has.
pub(crate) fn run_row_lanes<K: RowKernel>(kernel: K, output: &mut K::Output) {
    #[cfg(all(target_arch = "x86_64", not(test)))]
    {
        #[target_feature(enable = "avx512f")]
        fn on_avx512<K: RowKernel>(kernel: K, output: &mut K::Output) {
            kernel.on::<Avx512>(output);
        }
        #[target_feature(enable = "avx2,fma")]
        fn on_avx2<K: RowKernel>(kernel: K, output: &mut K::Output) {
            kernel.on::<TwoRegisters<Avx2>>(output);
        }
        if has_avx512() {
            // SAFETY: the processor has been asked.
            return unsafe { on_avx512(kernel, output) };
        }
        if has_avx2() {
            // SAFETY: the processor has been asked.
            return unsafe { on_avx2(kernel, output) };
        }
    }
    kernel.on::<Plain<WIDE>>(output);
}

/// Widest lanes that kernels may use, see [`limit_lanes`].
static WIDEST: AtomicU8 = AtomicU8::new(u8::MAX);

/// Limits the lanes of this process: 0 for plain arrays, 1 for AVX2, 2 for AVX-512. Tests compare their results.
#[doc(hidden)]
pub fn limit_lanes(widest: u8) {
    WIDEST.store(widest, Ordering::Relaxed);
}

/// Returns whether [`Avx512`]'s instructions are available and allowed.
#[cfg(all(target_arch = "x86_64", not(test)))]
fn has_avx512() -> bool {
    WIDEST.load(Ordering::Relaxed) >= 2 && std::arch::is_x86_feature_detected!("avx512f")
}

/// Returns whether [`Avx2`]'s instructions are available and allowed.
#[cfg(all(target_arch = "x86_64", not(test)))]
fn has_avx2() -> bool {
    WIDEST.load(Ordering::Relaxed) >= 1
        && std::arch::is_x86_feature_detected!("avx2")
        && std::arch::is_x86_feature_detected!("fma")
}

/// Lanes as an array, for any machine. Builds for tests do not inline them, which halves the time of compiling the kernels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plain<const N: usize = LANES>([f64; N]);

/// Returns x y + z, rounded once except in WebAssembly.
#[inline(always)]
#[allow(clippy::disallowed_methods, reason = "lanes fuse, and these are to have their bits")]
fn fused(x: f64, y: f64, z: f64) -> f64 {
    if cfg!(target_family = "wasm") { x * y + z } else { x.mul_add(y, z) }
}

macro_rules! plain_operator {
    ($operator:ident, $method:ident) => {
        impl<const N: usize> $operator for Plain<N> {
            type Output = Self;

            #[cfg_attr(not(debug_assertions), inline(always))]
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

impl<const N: usize> Number for Plain<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn splat(value: f64) -> Self {
        Self([value; N])
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn plus_product(self, x: Self, y: Self) -> Self {
        Self(std::array::from_fn(|lane| fused(x.0[lane], y.0[lane], self.0[lane])))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn minus_product(self, x: Self, y: Self) -> Self {
        Self(std::array::from_fn(|lane| fused(-x.0[lane], y.0[lane], self.0[lane])))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inverse_cube_root_estimate(self) -> Self {
        Self(self.0.map(inverse_cube_root_estimate))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn power_of_two(self) -> (Self, Self) {
        let both = self.0.map(power_of_two);
        (Self(both.map(|(power, _)| power)), Self(both.map(|(_, inverse)| inverse)))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn all_within(self, bound: f64) -> bool {
        self.0.iter().all(|x| x.all_within(bound))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn choose_within(self, bound: f64, inside: Self, outside: Self) -> Self {
        let choose =
            |lane: usize| self.0[lane].choose_within(bound, inside.0[lane], outside.0[lane]);
        Self(std::array::from_fn(choose))
    }
}

impl<const N: usize> Lanes<N> for Plain<N> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn max(self, other: Self) -> Self {
        let larger =
            |lane: usize| if self.0[lane] > other.0[lane] { self.0[lane] } else { other.0[lane] };
        Self(std::array::from_fn(larger))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn min(self, other: Self) -> Self {
        let smaller =
            |lane: usize| if self.0[lane] < other.0[lane] { self.0[lane] } else { other.0[lane] };
        Self(std::array::from_fn(smaller))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn load(values: &[f64; N]) -> Self {
        Self(*values)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn to_array(self) -> [f64; N] {
        self.0
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; N]) -> (Self, Self) {
        // SAFETY: the caller's promise.
        let pairs = nodes.map(|node| unsafe { *field.get_unchecked(node as usize) });
        (Self(pairs.map(|pair| pair[0])), Self(pairs.map(|pair| pair[1])))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; N]) {
        for lane in 0..N {
            // SAFETY: the caller's promise.
            let pair = unsafe { field.get_unchecked_mut(nodes[lane] as usize) };
            pair[0] -= self.0[lane];
            pair[1] -= y.0[lane];
        }
    }
}

mod rows;
#[cfg(all(target_arch = "x86_64", not(test)))]
mod x86_64;

pub(crate) use rows::{ROW_PLACES, RowLanes};
#[cfg(all(target_arch = "x86_64", not(test)))]
use x86_64::{Avx2, Avx512, TwoRegisters};
