//! Noise that a finished run shows: no error bar is smaller than what its warnings state.

use fem_collision::{Collision, LARGEST_RESIDUAL, QuantityOfInterest};

use super::calibration::{RADIUS_PER_SCATTER, RESTITUTION_PER_ROOT_SCATTER, TIME_PER_ROOT_SCATTER};

/// Scatter of the force over its peak above which a warning is given.
pub(crate) const LARGEST_NOISE: f64 = 0.005;
/// Restitution above 1 that is more than rounding.
const LARGEST_EXCESS: f64 = 1e-5;

/// Returns the error that a run itself shows: of the restitution absolute, of others relative; zero if none shows.
pub(super) fn noise_floor(collision: &Collision, headline: QuantityOfInterest) -> f64 {
    let of_energy = match headline {
        QuantityOfInterest::Restitution => {
            // The energy goes by the square of a restitution near 1.
            let energy = 0.5 * unbalanced_energy(collision).unwrap_or(0.0);
            energy.max(excess_of_restitution(collision).unwrap_or(0.0))
        }
        _ => 0.0,
    };
    let error = of_energy.max(of_chatter(collision, headline));
    if error.is_finite() { error } else { 0.0 }
}

/// Returns the error due to contact chatter.
pub(super) fn of_chatter(collision: &Collision, headline: QuantityOfInterest) -> f64 {
    let noise = noise(collision).unwrap_or(0.0);
    match headline {
        QuantityOfInterest::Restitution => RESTITUTION_PER_ROOT_SCATTER * noise.sqrt(),
        QuantityOfInterest::ContactTime => TIME_PER_ROOT_SCATTER * noise.sqrt(),
        QuantityOfInterest::PeakForce | QuantityOfInterest::PeakPressure => noise,
        QuantityOfInterest::MaxContactRadius => RADIUS_PER_SCATTER * noise,
        QuantityOfInterest::MaxApproach => 0.0,
    }
}

/// Returns the unbalanced energy over the initial one, if it is too large.
pub(crate) fn unbalanced_energy(collision: &Collision) -> Option<f64> {
    let residual = collision.residual_relative?;
    // A residual that is no number is above every limit.
    let is_sound = residual <= LARGEST_RESIDUAL;
    (!is_sound).then_some(residual)
}

/// Returns the restitution minus 1, if that is positive by more than rounding.
pub(crate) fn excess_of_restitution(collision: &Collision) -> Option<f64> {
    let restitution = collision.restitution?;
    // So is one that is no number.
    let is_sound = restitution <= 1.0 + LARGEST_EXCESS;
    (!is_sound).then_some(restitution - 1.0)
}

/// Returns the scatter of the contact force from step to step over its peak, if it is too large.
pub(crate) fn noise(collision: &Collision) -> Option<f64> {
    let scatter = collision.force_scatter? / collision.peak_force?;
    (scatter > LARGEST_NOISE).then_some(scatter)
}
