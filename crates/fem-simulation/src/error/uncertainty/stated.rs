//! What the warnings of a result say that it is off by: no bar is smaller.

use fem_collision::{Collision, QuantityOfInterest};

use crate::results::diagnostics::{
    excess_of_restitution, noise, overlap_of_approach, unbalanced_energy,
};
use crate::simulation::Simulation;

/// Of the energy, what a restitution near 1 is off by.
const RESTITUTION_OVER_ENERGY: f64 = 0.5;

/// What contacts that rattle take of the restitution, over the square root of the scatter of the force. Of springs at nodes
/// with mass on both surfaces and on one, with factors of 3 to 3000, between spheres of glass and steel that relax or not and
/// on walls, at 0.05 to 20 m/s, it is up to 0.005 of it, ...
const RESTITUTION_OVER_NOISE: f64 = 0.0055;
/// ... what the contact time is off by up to 0.018, ...
const TIME_OVER_NOISE: f64 = 0.02;
/// ... and the largest contact radius up to 0.52 of the scatter itself.
const RADIUS_OVER_NOISE: f64 = 0.55;

/// Closed forms are off by a twentieth of what the pressure of contacts that rattle is off by.
const OF_FORECAST: f64 = 1.1;

/// What is said of a quantity by the warnings that a collision of bodies with elements gives: of the restitution as it
/// is, of others as shares; zero where nothing is said.
pub(super) fn stated(
    simulation: &Simulation,
    collision: &Collision,
    headline: QuantityOfInterest,
) -> f64 {
    let mesh = || simulation.mesh_error_stated(collision).unwrap_or_default();
    let error = match headline {
        QuantityOfInterest::Restitution => {
            let energy = unbalanced_energy(collision).unwrap_or(0.0);
            excess_of_restitution(collision).unwrap_or(0.0).max(RESTITUTION_OVER_ENERGY * energy)
        }
        QuantityOfInterest::ContactTime => mesh()[0],
        QuantityOfInterest::PeakForce => mesh()[1],
        QuantityOfInterest::MaxApproach => {
            overlap_of_approach(simulation, collision).unwrap_or(0.0)
        }
        // The pressure at one place scatters by more than the force.
        QuantityOfInterest::PeakPressure => noise(collision)
            .map_or(0.0, |_| OF_FORECAST * beside_foretold_pressure(simulation, collision)),
        QuantityOfInterest::MaxContactRadius => 0.0,
    };
    let error = error.max(of_noise(collision, headline));
    if error.is_finite() { error } else { 0.0 }
}

/// The same of a force that scatters.
pub(crate) fn of_noise(collision: &Collision, headline: QuantityOfInterest) -> f64 {
    let noise = noise(collision).unwrap_or(0.0);
    match headline {
        QuantityOfInterest::Restitution => RESTITUTION_OVER_NOISE * noise.sqrt(),
        QuantityOfInterest::ContactTime => TIME_OVER_NOISE * noise.sqrt(),
        QuantityOfInterest::PeakForce | QuantityOfInterest::PeakPressure => noise,
        QuantityOfInterest::MaxContactRadius => RADIUS_OVER_NOISE * noise,
        QuantityOfInterest::MaxApproach => 0.0,
    }
}

/// What a peak pressure is off that of closed forms, over it.
fn beside_foretold_pressure(simulation: &Simulation, collision: &Collision) -> f64 {
    let foretold = simulation.estimate(collision).map(|it| it.softened.sizes.peak_pressure);
    let both = collision.peak_pressure.zip(foretold);
    both.map_or(0.0, |(told, foretold)| (1.0 - foretold / told).abs())
}
