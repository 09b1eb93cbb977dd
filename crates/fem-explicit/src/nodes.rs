//! The nodal loops of a step. The compiler turns them into vector code by
//! itself; each is compiled for several instruction sets and chosen at run time.

use multiversion::multiversion;

use crate::kernel::Field;

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

/// Starts the effective displacement: w ← g∞ u.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn start_effective(equilibrium_weight: f64, u: &Field, w: &mut Field) {
    for (w, u) in w.as_flattened_mut().iter_mut().zip(u.as_flattened()) {
        *w = equilibrium_weight * u;
    }
}

/// Advances one Prony branch by a step of constant rate and adds its share:
/// q ← decay q + gain Δt v, w ← w + weight q.
#[multiversion(targets("x86_64+avx2", "aarch64+neon"))]
pub(crate) fn advance_branch(
    decay: f64,
    gain_times_step: f64,
    weight: f64,
    v: &Field,
    q: &mut Field,
    w: &mut Field,
) {
    let (q, w) = (q.as_flattened_mut(), w.as_flattened_mut());
    for ((q, w), v) in q.iter_mut().zip(w).zip(v.as_flattened()) {
        *q = decay * *q + gain_times_step * v;
        *w += weight * *q;
    }
}
