//! Materials from outside, in one program: linked once, its tests run side by side.

mod finite;
mod moduli;
mod relaxation;
