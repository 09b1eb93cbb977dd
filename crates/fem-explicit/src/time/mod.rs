//! Time integration by central differences (leapfrog): displacements at t_n, velocities at t_n − Δt/2; and the control of the time
//! step.
//!
//! The compiler vectorises the loops by itself. The main one is compiled for several instruction sets, of which the best
//! is chosen at run time.

mod step_control;

pub(crate) use step_control::{StepControl, StepDemand, step_levels};

use multiversion::multiversion;

use crate::part::Field;

/// Adds the impulse of forces that act for a time (s): v ← v + t f/m.
pub(crate) fn add_impulse(time: f64, inverse_mass: &Field, f: &Field, v: &mut Field) {
    let nodes = inverse_mass.as_flattened().iter().zip(f.as_flattened());
    for (v, (inverse_mass, f)) in v.as_flattened_mut().iter_mut().zip(nodes) {
        *v += time * (inverse_mass * f);
    }
}

/// Takes a step of central differences: v ← v + Δt f/m, u ← u + Δt v.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn advance_motion(
    time_step: f64,
    inverse_mass: &Field,
    f: &Field,
    v: &mut Field,
    u: &mut Field,
) {
    let (f, v, u) = (f.as_flattened(), v.as_flattened_mut(), u.as_flattened_mut());
    for (((v, u), f), inverse_mass) in v.iter_mut().zip(u).zip(f).zip(inverse_mass.as_flattened()) {
        *v += time_step * (inverse_mass * f);
        *u += time_step * *v;
    }
}
