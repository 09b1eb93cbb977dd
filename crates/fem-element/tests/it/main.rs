//! The elements from outside, in one program: linked once, its tests run side by side.

mod common;
mod eigenvalue;
mod geometry;
mod matrices;
mod patch;
