//! Meshes from outside, in one program: linked once, its tests run side by side.

mod graded_plate;
mod half_disc;
mod import;
mod quarter_disc;
