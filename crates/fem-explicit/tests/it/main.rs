//! The explicit method from outside, in one program: linked once, its tests run side by side.

mod allocation;
mod bulk_viscosity;
mod collision;
mod common;
mod deformed;
mod finite_strain;
mod flow;
mod half_space;
mod lanes;
mod massless;
mod outputs;
mod parts;
mod resume;
mod rigid;
mod sampled_history;
mod slip;
mod stress;
mod vibration;
