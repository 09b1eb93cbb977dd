//! A collision of condensed spheres from outside, in one program: linked once, its tests run side by side.

mod common;
mod convergence;
mod explicit;
mod half_space;
mod limits;
mod quantities;
mod refusals;
mod rigid;
mod rows;
mod snapshots;
mod springs;
mod together;
mod unlike_meshes;
