//! A collision of condensed spheres from outside, in one program: linked once, its tests run side by side.

mod common;
mod convergence;
mod explicit_agreement;
mod half_space;
mod history_rows;
mod known_limits;
mod no_separation;
mod quantities;
mod rejected_inputs;
mod rigid;
mod snapshots;
mod springs;
mod unlike_meshes;
