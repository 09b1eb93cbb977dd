//! Tests of the parts together that need their insides.

mod finite_strain;
mod free_motion;
mod massless;
mod node_forces;
mod relaxation;
mod stability;
