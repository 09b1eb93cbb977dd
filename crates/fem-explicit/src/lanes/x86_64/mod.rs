//! Lanes on the vector registers of x86-64 processors.

/// Implements lanes on one kind of register by its instructions. The functions `all_within`, `choose_within`, `pairs` and `gather`, which
/// are of each kind's own, are beside it.
macro_rules! lanes_of_register {
    (
        $lanes:ident, $n:expr,
        arithmetic: [$add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $max:ident, $min:ident],
        fused: [$plus_product:ident, $minus_product:ident],
        memory: [$splat:ident, $load:ident, $store:ident],
        bits: [$bits:ident, $number:ident, $whole:ident, $add_whole:ident, $sub_whole:ident,
            $mul_halves:ident, $or:ident, $left:ident, $right:ident],
    ) => {
        lanes_of_register!($lanes: Add, add, $add);
        lanes_of_register!($lanes: Sub, sub, $sub);
        lanes_of_register!($lanes: Mul, mul, $mul);
        lanes_of_register!($lanes: Div, div, $div);

        // SAFETY, of all blocks: the type's contract; arrays are as long as the register.
        impl Number for $lanes {
            #[inline(always)]
            fn splat(value: f64) -> Self {
                Self(unsafe { $splat(value) })
            }

            #[inline(always)]
            fn plus_product(self, x: Self, y: Self) -> Self {
                Self(unsafe { $plus_product(x.0, y.0, self.0) })
            }

            #[inline(always)]
            fn minus_product(self, x: Self, y: Self) -> Self {
                Self(unsafe { $minus_product(x.0, y.0, self.0) })
            }

            #[inline(always)]
            fn inverse_cube_root_estimate(self) -> Self {
                unsafe {
                    let upper = $right::<32>($bits(self.0));
                    let third = $right::<33>($mul_halves(upper, $whole(0xAAAA_AAAB)));
                    let rest = $sub_whole($whole(0x553E_F0FF), third);
                    Self($number($left::<32>(rest)))
                }
            }

            #[inline(always)]
            fn power_of_two(self) -> (Self, Self) {
                unsafe {
                    let moved = $add_whole($bits(self.0), $whole(POWER_OFFSET as i64));
                    let exponent = $right::<52>(moved);
                    let units = $or(exponent, $whole(UNITS as i64));
                    let power = $sub($number(units), $splat(UNITS_AND_OFFSET));
                    let inverse = $number($left::<52>($sub_whole($whole(2046), exponent)));
                    (Self(power), Self(inverse))
                }
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }

            #[inline(always)]
            fn all_within(self, bound: f64) -> bool {
                unsafe { all_within(self, bound) }
            }

            #[inline(always)]
            fn choose_within(self, bound: f64, inside: Self, outside: Self) -> Self {
                unsafe { choose_within(self, bound, inside, outside) }
            }
        }

        impl Lanes<$n> for $lanes {
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(unsafe { $max(self.0, other.0) })
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(unsafe { $min(self.0, other.0) })
            }

            #[inline(always)]
            fn load(values: &[f64; $n]) -> Self {
                Self(unsafe { $load(values.as_ptr()) })
            }

            #[inline(always)]
            fn to_array(self) -> [f64; $n] {
                let mut values = [0.0; $n];
                unsafe { $store(values.as_mut_ptr(), self.0) };
                values
            }

            #[inline(always)]
            unsafe fn gather(field: &[[f64; 2]], nodes: &[u32; $n]) -> (Self, Self) {
                unsafe { gather(field, nodes) }
            }

            #[inline(always)]
            unsafe fn scatter_subtract(self, y: Self, field: &mut [[f64; 2]], nodes: &[u32; $n]) {
                unsafe {
                    for (node, pair) in nodes.iter().zip(pairs(self, y)) {
                        let place = field.get_unchecked_mut(*node as usize).as_mut_ptr();
                        _mm_storeu_pd(place, _mm_sub_pd(_mm_loadu_pd(place), pair));
                    }
                }
            }
        }
    };
    ($lanes:ident: $operator:ident, $method:ident, $instruction:ident) => {
        impl $operator for $lanes {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: the type's contract.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}

mod avx2;
mod avx512;
mod rows;
mod two_registers;

pub(super) use avx2::Avx2;
pub(super) use avx512::Avx512;
pub(super) use two_registers::TwoRegisters;
