//! The explicit method from outside, in one program: linked once, its tests run side by side.

mod bulk_viscosity;
mod collision;
mod common;
mod ending;
mod half_space;
mod massless;
mod observed;
mod outputs;
mod parts;
mod resume;
mod rigid;
mod stress;
