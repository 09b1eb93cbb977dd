//! The crate from outside, in one program.

mod numerics;
