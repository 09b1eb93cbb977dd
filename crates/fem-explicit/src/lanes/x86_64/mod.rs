//! Lanes on the vector registers of x86-64 processors.

mod avx2;
mod avx512;
mod rows;
mod two_registers;

pub(super) use avx2::Avx2;
pub(super) use avx512::Avx512;
pub(super) use two_registers::TwoRegisters;
