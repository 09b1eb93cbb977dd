//! The contact from outside, in one program: linked once, its tests run side by side.

mod common;
mod deformed;
mod forces;
mod node_to_surface;
mod pressure;
mod rigid;
mod slip;
mod stiffness;
