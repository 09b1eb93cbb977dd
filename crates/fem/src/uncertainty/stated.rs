//! What the warnings of a result say that it is off by: no bar is smaller.

use fem_collision::{Collision, Headline};

use crate::assess::{excess_of_restitution, noise, overlap_of_approach, unbalanced_energy};
use crate::simulation::Simulation;

/// Of the energy, what a restitution near 1 is off by.
const RESTITUTION_OVER_ENERGY: f64 = 0.5;

/// What is said of a quantity by the warnings that a collision of bodies with elements gives: of the restitution as it
/// is, of others as shares; zero where nothing is said.
pub(super) fn stated(simulation: &Simulation, collision: &Collision, headline: Headline) -> f64 {
    let mesh = || simulation.mesh_error_stated(collision).unwrap_or_default();
    let error = match headline {
        Headline::Restitution => {
            let energy = unbalanced_energy(collision).unwrap_or(0.0);
            excess_of_restitution(collision).unwrap_or(0.0).max(RESTITUTION_OVER_ENERGY * energy)
        }
        Headline::ContactTime => mesh()[0],
        Headline::PeakForce => mesh()[1].max(noise(collision).unwrap_or(0.0)),
        Headline::MaxApproach => overlap_of_approach(simulation, collision).unwrap_or(0.0),
        // The pressure at one place scatters by more than the force.
        Headline::PeakPressure => noise(collision)
            .map_or(0.0, |noise| noise.max(beside_foretold_pressure(simulation, collision))),
        Headline::MaxContactRadius => 0.0,
    };
    if error.is_finite() { error } else { 0.0 }
}

/// What a peak pressure is off that of closed forms, over it.
fn beside_foretold_pressure(simulation: &Simulation, collision: &Collision) -> f64 {
    let foretold = simulation.estimate(collision).map(|it| it.softened.sizes.peak_pressure);
    let both = collision.peak_pressure.zip(foretold);
    both.map_or(0.0, |(told, foretold)| (1.0 - foretold / told).abs())
}
