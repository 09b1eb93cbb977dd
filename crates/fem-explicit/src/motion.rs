//! The motion of the nodes over a step. The compiler turns the loop into vector
//! code by itself; it is compiled for several instruction sets and chosen at run
//! time.

use multiversion::multiversion;

use crate::part::Field;

/// An impulse of forces that last for a time (s): v ← v + t f/m.
pub(crate) fn push(time: f64, inverse_mass: &Field, f: &Field, v: &mut Field) {
    let nodes = inverse_mass.as_flattened().iter().zip(f.as_flattened());
    for (v, (inverse_mass, f)) in v.as_flattened_mut().iter_mut().zip(nodes) {
        *v += time * (inverse_mass * f);
    }
}

/// Central differences: v ← v + Δt f/m, u ← u + Δt v.
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
