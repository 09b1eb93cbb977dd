//! Files from outside, in one program: linked once, its tests run side by side.

mod collection;
mod fixtures;
mod hostile_files;
mod memory;
mod rejected_inputs;
mod round_trip;
