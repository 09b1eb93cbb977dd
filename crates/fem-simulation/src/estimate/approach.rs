//! The approach of the bodies of a scene, and the duration of the run from first touch until the bodies have parted or stay
//! together.
//!
//! Ting's model predicts the duration of relaxing bodies within 2 %: their contact lasts several times as long as elastic
//! closed forms predict. Bodies that relax completely creep into each other until the [`RestCriterion`] that ends a run
//! detects rest.

use fem_case::{Body, Scene};
use fem_collision::{Approach, Frame, POST_CONTACT_FRACTION, RelativeMotion, RestCriterion};
use fem_laws::Impact;

use crate::estimate::Estimate;
use crate::rejection::Rejection;

/// Returns how the bodies of a scene meet; for a falling ball, at its first touch.
///
/// # Errors
/// Bodies that do not meet.
pub fn approach_of(scene: &Scene) -> Result<Approach, Rejection> {
    let velocities = scene.bodies().each_ref().map(|body| body.velocity());
    let approach = match scene.gravity() {
        None => Approach::new(velocities, scene.gap().unwrap_or(fem_case::defaults::GAP)),
        Some(_) => Approach::new([0.0, -scene.approach_speed()], 0.0),
    };
    approach.map_err(|error| Rejection::new("body", error.to_string()))
}

/// Returns the frame of the mass centre for this approach; `reduced_mass` (kg) is that of the relative motion.
pub(crate) fn frame_of(scene: &Scene, approach: &Approach, reduced_mass: f64) -> Frame {
    let mass = |body: &Body| body.mass().filter(|_| !body.is_held());
    let masses = scene.bodies().each_ref().map(mass);
    let gravity = scene.gravity().map_or(0.0, |gravity| gravity.acceleration);
    Frame { approach: *approach, masses, reduced_mass, gravity }
}

/// Returns the expected time from first touch to the end of the run, s.
pub(crate) fn expected_duration(scene: &Scene, estimate: &Estimate, approach: &Approach) -> f64 {
    let by_estimate = (1.0 + POST_CONTACT_FRACTION) * estimate.contact_time;
    if estimate.relaxed == 0.0 {
        return by_estimate;
    }
    let Estimate { hertz, impacts, .. } = estimate;
    let impact = impacts.on_half_spaces(scene, hertz.pair(), approach.speed());
    let predicted = impact.ok().and_then(|impact| duration_of(scene, estimate, approach, &impact));
    predicted.unwrap_or(by_estimate)
}

/// Returns the duration of the run for a predicted impact, s.
pub(crate) fn duration_of(
    scene: &Scene,
    estimate: &Estimate,
    approach: &Approach,
    impact: &Impact,
) -> Option<f64> {
    let duration = match impact.contact_time {
        Some(contact_time) => Some((1.0 + POST_CONTACT_FRACTION) * contact_time),
        None => time_of_rest(scene, estimate, approach, impact),
    };
    duration.filter(|time| *time > 0.0 && time.is_finite())
}

/// Returns the time at which an impact without separation comes to rest, s.
fn time_of_rest(
    scene: &Scene,
    estimate: &Estimate,
    approach: &Approach,
    impact: &Impact,
) -> Option<f64> {
    let frame = frame_of(scene, approach, estimate.hertz.pair().effective_mass());
    let mut rest = RestCriterion::new(&frame);
    let mut ends = impact.history.iter().filter(|now| now.time > 0.0);
    let end = ends.find(|now| {
        rest.observe(&RelativeMotion {
            time: now.time,
            is_closed: true,
            force: now.force,
            rate: now.approach_rate,
            inner_energy: now.strain_energy.unwrap_or_default(),
        })
    });
    end.or(impact.history.last()).map(|now| now.time)
}
