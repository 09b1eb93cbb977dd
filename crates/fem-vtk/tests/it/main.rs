//! Files from outside, in one program: linked once, its tests run side by side.

mod collection;
mod fixtures;
mod hostile;
mod refusals;
mod round_trip;
