//! Eight lanes in two registers of four.

use std::ops::{Add, Div, Mul, Sub};

use fem_material::finite::Number;

use super::super::{LANES, Lanes, WIDE};

/// Lanes of two registers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TwoRegisters<L>(pub(super) L, pub(super) L);

macro_rules! twice_operator {
    ($operator:ident, $method:ident) => {
        impl<L: Number> $operator for TwoRegisters<L> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    };
}

twice_operator!(Add, add);
twice_operator!(Sub, sub);
twice_operator!(Mul, mul);
twice_operator!(Div, div);

impl<L: Number> Number for TwoRegisters<L> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(L::splat(value), L::splat(value))
    }

    #[inline(always)]
    fn plus_product(self, x: Self, y: Self) -> Self {
        Self(self.0.plus_product(x.0, y.0), self.1.plus_product(x.1, y.1))
    }

    #[inline(always)]
    fn minus_product(self, x: Self, y: Self) -> Self {
        Self(self.0.minus_product(x.0, y.0), self.1.minus_product(x.1, y.1))
    }

    #[inline(always)]
    fn inverse_cube_root_estimate(self) -> Self {
        Self(self.0.inverse_cube_root_estimate(), self.1.inverse_cube_root_estimate())
    }

    #[inline(always)]
    fn power_of_two(self) -> (Self, Self) {
        let (first, second) = (self.0.power_of_two(), self.1.power_of_two());
        (Self(first.0, second.0), Self(first.1, second.1))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }

    #[inline(always)]
    fn all_within(self, bound: f64) -> bool {
        self.0.all_within(bound) && self.1.all_within(bound)
    }

    #[inline(always)]
    fn choose_within(self, bound: f64, inside: Self, outside: Self) -> Self {
        Self(
            self.0.choose_within(bound, inside.0, outside.0),
            self.1.choose_within(bound, inside.1, outside.1),
        )
    }
}

/// Returns the first four and the last four.
#[inline(always)]
fn halves<T: Copy>([a, b, c, d, e, f, g, h]: [T; WIDE]) -> ([T; LANES], [T; LANES]) {
    ([a, b, c, d], [e, f, g, h])
}

impl<L: Lanes> Lanes<WIDE> for TwoRegisters<L> {
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }

    #[inline(always)]
    fn load(values: &[f64; WIDE]) -> Self {
        let (first, second) = halves(*values);
        Self(L::load(&first), L::load(&second))
    }

    #[inline(always)]
    fn to_array(self) -> [f64; WIDE] {
        let ([a, b, c, d], [e, f, g, h]) = (self.0.to_array(), self.1.to_array());
        [a, b, c, d, e, f, g, h]
    }

    #[inline(always)]
    unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; WIDE]) -> (Self, Self) {
        let (first, second) = halves(*nodes);
        // SAFETY: the caller's promise.
        let (first, second) = unsafe { (L::gather(field, &first), L::gather(field, &second)) };
        (Self(first.0, second.0), Self(first.1, second.1))
    }

    #[inline(always)]
    unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; WIDE]) {
        let (first, second) = halves(*nodes);
        // SAFETY: the caller's promise.
        unsafe {
            self.0.scatter_subtract(y.0, field, &first);
            self.1.scatter_subtract(y.1, field, &second);
        }
    }
}
