//! Cases from outside, in one program: linked once, its tests run side by side.

mod faults;
mod flow;
mod in_code;
mod library;
mod overrides;
mod relaxation_file;
mod round_trip;
#[cfg(feature = "schema")]
mod schemas;
mod sweep_faults;
