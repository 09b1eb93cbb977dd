//! Fits from outside, in one program: linked once, its tests run side by side.

mod accuracy;
mod common;
mod cradle;
mod dem;
mod fits;
mod inverse;
mod spectrum;
