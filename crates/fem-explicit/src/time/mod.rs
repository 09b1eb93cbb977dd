//! Time integration: the leapfrog scheme, and the control of its time step.

mod leapfrog;
mod step_control;

pub(crate) use leapfrog::{add_impulse, advance_motion};
pub(crate) use step_control::{StepControl, StepDemand, step_levels};
