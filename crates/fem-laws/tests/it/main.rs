//! The laws from outside, in one program: linked once, its tests run side by side.

mod common;
mod dents;
mod direct;
mod fast_slow_limits;
mod flow_map;
mod gravity;
mod hertz;
mod hertz_pressure;
mod impact_path;
mod kelvin_limit;
mod laws;
mod neglect_errors;
mod pair;
mod pair_relaxation;
mod plate;
mod ramirez;
mod tangential;
mod ting;
mod ting_finite_size;
mod ting_radiation;
