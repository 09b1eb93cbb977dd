//! Materials from outside, in one program: linked once, its tests run side by side.

mod moduli;
mod relaxation;
