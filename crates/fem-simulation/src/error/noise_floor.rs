//! The noise floor of the error bars that shows in the finished run: contact chatter, energy that is not conserved,
//! overlapping surfaces, a contact narrower than an element, and an early pressure peak. No error bar is smaller than what
//! the run's warnings report. The floor of the mesh is in [`super::calibration`].

use std::f64::consts::PI;

use fem_collision::{Collision, MAX_RESIDUAL, QuantityOfInterest, longest_at_pole};

use super::calibration::{CHATTER, CLOSED_FORM_PRESSURE, EARLY, FEW_AT_PRESSURE, UNRESOLVED_ERROR};
use crate::effects::MassScaling;
use crate::plan::mesh_source::longest_contact_edge;
use crate::simulation::Simulation;

/// Scatter of the force over its peak above which a warning is given.
pub(crate) const MAX_NOISE: f64 = 0.005;
/// Largest overlap of the surfaces over the approach without a warning.
pub(crate) const MAX_PENETRATION: f64 = 0.01;
/// Excess of the restitution over 1 that is more than rounding.
const MAX_EXCESS: f64 = 1e-5;

/// Returns the floor that the finished run shows, for each quantity.
pub(super) fn floor_of_run(
    simulation: &Simulation,
    collision: &Collision,
) -> impl Fn(QuantityOfInterest) -> f64 {
    let is_unresolved = is_unresolved(simulation, collision);
    let overlap = overlap(simulation, collision).map_or(0.0, |overlap| overlap.of_approach);
    let overlap = if overlap > MAX_PENETRATION { overlap } else { 0.0 };
    let is_early = early_pressure_radius(simulation, collision).is_some();
    let pressure = match is_early || noise(collision).is_some() {
        true => distance_from_closed_form(simulation, collision),
        false => 0.0,
    };
    // The energy goes with the square of a restitution near 1.
    let energy = 0.5 * unbalanced_energy(collision).unwrap_or(0.0);
    let restitution = energy.max(excess_of_restitution(collision).unwrap_or(0.0));
    let chatter = QuantityOfInterest::ALL.map(|quantity| of_chatter(collision, quantity));
    let spikes = spikes_of_flow(simulation, collision).unwrap_or(1.0);
    move |quantity| {
        let chatter = chatter[quantity as usize];
        let unresolved = if is_unresolved { UNRESOLVED_ERROR } else { 0.0 };
        let finite = |error: f64| if error.is_finite() { error } else { 0.0 };
        match quantity {
            QuantityOfInterest::Restitution => finite(chatter.max(restitution)),
            QuantityOfInterest::MaxApproach => finite(chatter).max(overlap).max(unresolved),
            QuantityOfInterest::PeakPressure => {
                finite(spikes * chatter).max(unresolved).max(pressure)
            }
            _ => finite(chatter).max(unresolved),
        }
    }
}

/// Returns the relative error of the pressure of bodies that flow over the scatter of their force: a node that comes into contact
/// meets an elastic body, whose pressure is so much larger. Four soft metals (8 to 20 MPa) have errors of 9 to 25 % at a scatter
/// of 0.6 to 1.3 %, and pressures of 1/21 to 1/46 of the elastic ones.
fn spikes_of_flow(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let estimate = &simulation.setup().estimate;
    estimate.flow.as_ref()?;
    Some((estimate.hertz.peak_pressure() / collision.peak_pressure?).max(1.0))
}

/// Returns the error due to contact chatter.
pub(super) fn of_chatter(collision: &Collision, quantity: QuantityOfInterest) -> f64 {
    let noise = noise(collision).unwrap_or(0.0);
    let [per_root, per_scatter] = CHATTER[quantity as usize];
    per_root * noise.sqrt() + per_scatter * noise
}

/// Returns the scatter of the contact force from step to step over its peak, if it is too large.
pub(crate) fn noise(collision: &Collision) -> Option<f64> {
    let scatter = collision.force_scatter? / collision.peak_force?;
    (scatter > MAX_NOISE).then_some(scatter)
}

/// Overlap of the surfaces that penalty springs allow.
pub(crate) struct Overlap {
    /// Overlap over the element length.
    pub of_element: f64,
    /// Overlap over the largest approach.
    pub of_approach: f64,
}

/// Returns the overlap by the mean pressure F/πa² over the penalty stiffness per area; `None` without springs or if the
/// run did not end by itself.
pub(crate) fn overlap(simulation: &Simulation, collision: &Collision) -> Option<Overlap> {
    let elements = simulation.setup().elements.as_ref()?;
    let is_known = elements.has_springs && collision.is_complete();
    // A contact of the poles alone has no pressure, and a warning about the mesh.
    let radius = collision.max_contact_radius.filter(|radius| is_known && *radius > 0.0)?;
    let mean_pressure = collision.peak_force? / (PI * radius * radius);
    let of_element = mean_pressure / elements.plan.contact_stiffness;
    let longest = longest_contact_edge(simulation.model().meshes(), radius)?;
    let of_approach = of_element * longest / collision.max_approach?;
    Some(Overlap { of_element, of_approach })
}

/// Returns the unbalanced energy over the initial one, if it is too large or not a number.
pub(crate) fn unbalanced_energy(collision: &Collision) -> Option<f64> {
    let residual = collision.residual_relative?;
    let is_balanced = residual <= MAX_RESIDUAL;
    (!is_balanced).then_some(residual)
}

/// Returns the restitution minus 1, if that is positive by more than rounding or not a number.
pub(crate) fn excess_of_restitution(collision: &Collision) -> Option<f64> {
    let restitution = collision.restitution?;
    let is_possible = restitution <= 1.0 + MAX_EXCESS;
    (!is_possible).then_some(restitution - 1.0)
}

/// Returns the larger moved mass of both bodies over the lighter body's mass. The share of a stiffer body is divided by
/// the factor by which more mass is moved in it ([`MassScaling::times`]).
pub(super) fn moved_share(simulation: &Simulation, collision: &Collision) -> f64 {
    let allowed = MassScaling::times(simulation.case().scene());
    let shares = collision.moved_shares().into_iter().zip(allowed);
    shares.filter_map(|(share, times)| Some(share? / times)).fold(0.0, f64::max)
}

/// Returns the element size at the contact that errors are measured with, m; `None` if the collision did not end by itself
/// or has no elements.
pub(super) fn contact_element_size(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let elements = simulation.setup().elements.as_ref().filter(|_| collision.is_complete())?;
    let size = match elements.plan.makes_meshes {
        true => elements.plan.contact_element_size,
        false => longest_at_pole(simulation.model().meshes()),
    };
    (size > 0.0).then_some(size)
}

/// Returns the widest contact radius of a finished collision (m). If only the poles touched, or the contact is narrower
/// than an element, the expected radius counts.
pub(crate) fn widest_contact(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let radius = collision.max_contact_radius.filter(|_| collision.is_complete())?;
    let size = simulation.setup().elements.as_ref()?.plan.contact_element_size;
    let expected = simulation.estimate(&collision.approach)?.contact_radius;
    Some(if radius > 0.0 && expected >= size { radius } else { expected })
}

/// Returns whether the contact of a finished collision is narrower than an element.
pub(crate) fn is_unresolved(simulation: &Simulation, collision: &Collision) -> bool {
    let radius = widest_contact(simulation, collision);
    let edge = radius.and_then(|radius| longest_contact_edge(simulation.model().meshes(), radius));
    radius.zip(edge).is_some_and(|(radius, edge)| radius < edge)
}

/// Returns the contact radius (m) at which closed forms expect the largest pressure, if the contact is still small then
/// and spans few elements. Meshes of similar size agree on a wrong pressure there, and the mesh is not refined for it.
pub(super) fn early_pressure_radius(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let size = contact_element_size(simulation, collision)?;
    let effective = simulation.estimate(&collision.approach)?.effective;
    let radius = effective.pressure_radius;
    let is_early = radius < EARLY * effective.sizes.max_contact_radius;
    (is_early && radius < FEW_AT_PRESSURE * size).then_some(radius)
}

/// Returns the relative distance of the peak pressure from that of closed forms, with their own error.
fn distance_from_closed_form(simulation: &Simulation, collision: &Collision) -> f64 {
    // The closed forms are elastic.
    let estimate =
        simulation.estimate(&collision.approach).filter(|estimate| estimate.flow.is_none());
    let expected = estimate.map(|estimate| estimate.effective.sizes.peak_pressure);
    let both = collision.peak_pressure.zip(expected);
    both.map_or(0.0, |(value, expected)| CLOSED_FORM_PRESSURE * (1.0 - expected / value).abs())
}
