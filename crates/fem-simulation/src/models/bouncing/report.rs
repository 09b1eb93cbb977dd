//! Warnings about a bouncing ball, and the influence of the vibrations that a contact leaves on the next one.
//!
//! A contact force leaves the energy E₁ in the vibrations of bodies at rest. In linear bodies that vibrate already with the
//! energy E₀, the same force adds its amplitudes to theirs in an unknown phase, and at the end
//!
//! ```math
//! |E - E_0 - E_1| \le 2\sqrt{E_0E_1}, \qquad
//! |\Delta(e^2)| = \frac{|E - E_0 - E_1|}{\tfrac12mv^2}, \qquad
//! |\Delta e| \le \frac{\sqrt{E_0E_1}}{e\,\tfrac12mv^2},
//! ```
//!
//! since the ball loses the energy that the vibrations gain. Amplitudes of one mode add as complex numbers, and the
//! Cauchy–Schwarz inequality bounds the sum over the modes. The force is that of bodies at rest, so the bound is of first
//! order; vibrations that decay in flight have less influence.

use fem_collision::{Bounce, Ending, StaticContact};

use crate::effects::percent;
use crate::estimate::LARGE_STRAIN;
use crate::rejection::Rejection;

/// Restitution above which a ball does not come to rest.
const RESTITUTION_WITHOUT_REST: f64 = 1.0 - 1e-4;

/// Returns the warnings for these contacts, this ending, and the largest bound on the influence of
/// vibrations with the number of its contact.
pub(super) fn of(bounces: &[Bounce], ending: &Ending, phase: Option<(usize, f64)>) -> Vec<String> {
    let n = bounces.len();
    let mut said = Vec::new();
    if *ending == Ending::AtRest {
        said.push(format!(
            "the ball comes to rest: after {n} contact{} it does not leave again",
            if n == 1 { "" } else { "s" }
        ));
    }
    let least = bounces.iter().map(|bounce| bounce.restitution).fold(f64::INFINITY, f64::min);
    if *ending == Ending::Parted && n > 1 && least > RESTITUTION_WITHOUT_REST {
        said.push(format!(
            "the ball never rests by the losses of the run, which are almost none (no restitution is below {least:.6}); the run \
             ends after the {n} contacts of stop.bounces"
        ));
    }
    if let Some((contact, bound)) = phase {
        said.push(format!(
            "vibrations that a contact has left may change the restitution of contact {contact} by up \
             to {bound:.1e}: each contact is computed as if the bodies had come to rest before"
        ));
    }
    said
}

/// Warns of a static contact that is not small compared with the effective radius (m).
pub(super) fn too_large(contact: &StaticContact, effective_radius: f64) -> Option<String> {
    let share = contact.contact_radius? / effective_radius;
    (share > LARGE_STRAIN).then(|| {
        format!(
            "at rest the contact radius is {} of the effective radius; above {} the small-strain \
             model is not accurate",
            percent(share),
            percent(LARGE_STRAIN)
        )
    })
}

/// Warns of bodies without equilibrium modulus, after a number of contacts.
pub(super) fn sinks(n_contacts: usize) -> String {
    format!(
        "the ball sinks: after {n_contacts} contact{} it does not leave again, and a body without equilibrium \
         modulus flows under the weight without limit",
        if n_contacts == 1 { "" } else { "s" }
    )
}

/// Warns of a static contact that could not be computed.
pub(super) fn unknown(rejection: &Rejection) -> String {
    format!("the contact of the ball at rest could not be computed: {rejection}")
}

/// Bounds above this are reported.
pub(super) const MAX_SILENT_BOUND: f64 = 1e-3;

/// Returns the bound of Δe from the energies (J) that the contact before and this one leave in vibrations, and the kinetic
/// energy (J) before this one. It is 0 if nothing vibrates or the bodies stay together.
pub(super) fn phase_bound(before: f64, left: f64, kinetic: f64, restitution: f64) -> f64 {
    if before <= 0.0 || restitution <= 0.0 {
        return 0.0;
    }
    (before * left).sqrt() / (restitution * kinetic)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of 1 kg and a mode of mass 1 kg and frequency ω under the same half-sine force: the amplitudes add, and the
    /// change of restitution reaches the bound but does not exceed it.
    #[test]
    fn restitution_change_is_within_the_bound_for_every_phase() {
        let (omega, speed, n) = (2.0_f64, 1.0, 4000);
        // The impulse 2 v of a force that acts for a time π.
        let force = |time: f64| speed * time.sin();
        let dt = std::f64::consts::PI / n as f64;
        // Duhamel's integrals of the mode at rest, by the midpoint rule.
        let [cosine, sine] = [f64::cos, f64::sin].map(|wave: fn(f64) -> f64| {
            let times = (0..n).map(|k| (k as f64 + 0.5) * dt);
            0.1 * times.map(|time| force(time) * wave(omega * time) * dt).sum::<f64>()
        });
        let left = 0.5 * (cosine * cosine + sine * sine);
        let kinetic = 0.5 * speed * speed;
        let restitution = (1.0 - left / kinetic).sqrt();
        let amplitude = 0.02_f64;
        let before = 0.5 * amplitude * amplitude;
        let bound = phase_bound(before, left, kinetic, restitution);
        let mut largest = 0.0_f64;
        for k in 0..100 {
            let phase = 2.0 * std::f64::consts::PI * k as f64 / 100.0;
            let (a, b) = (cosine + amplitude * phase.cos(), sine + amplitude * phase.sin());
            let gained = 0.5 * (a * a + b * b) - before;
            let after = (1.0 - gained / kinetic).sqrt();
            largest = largest.max((after - restitution).abs());
        }
        // Half of Δ(e²)/e is Δe to first order, 4 % of it here.
        assert!((largest / bound - 1.0).abs() < 0.05, "{largest} {bound}");
        assert_eq!(phase_bound(0.0, 1.0, 1.0, 1.0), 0.0);
    }
}
