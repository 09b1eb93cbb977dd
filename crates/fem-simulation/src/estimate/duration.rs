//! Estimates the duration of a run: from first touch until the bodies have parted or stay together.
//!
//! Ting's model knows it of bodies that relax, within 2 %: a contact that relaxes lasts several times as
//! long as closed forms tell, and bodies of which nothing is left creep into each other until the same
//! [`RestCriterion`] that ends a run says that they stay.

use fem_case::Scene;
use fem_collision::{Approach, FLIGHT_AFTER, RelativeMotion, RestCriterion};
use fem_laws::Impact;

use crate::estimate::Estimate;
use crate::estimate::approach::frame_of;
use crate::estimate::quasi_static::foretold_impact;

/// Time (s) from first touch to the end of a run of a scene of whose approach closed forms say this.
pub(crate) fn expected_duration(scene: &Scene, estimate: &Estimate, approach: &Approach) -> f64 {
    let by_estimate = (1.0 + FLIGHT_AFTER) * estimate.contact_time;
    if estimate.relaxed == 0.0 {
        return by_estimate;
    }
    let impact = foretold_impact(scene, estimate, approach.speed());
    let told = impact.ok().and_then(|impact| duration_of(scene, estimate, approach, &impact));
    told.unwrap_or(by_estimate)
}

/// Returns the duration for a predicted impact, in seconds.
pub(crate) fn duration_of(
    scene: &Scene,
    estimate: &Estimate,
    approach: &Approach,
    impact: &Impact,
) -> Option<f64> {
    let told = match impact.contact_time {
        Some(contact_time) => Some((1.0 + FLIGHT_AFTER) * contact_time),
        None => standstill(scene, estimate, approach, impact),
    };
    told.filter(|time| *time > 0.0 && time.is_finite())
}

/// When an impact without an end comes to rest, s.
fn standstill(
    scene: &Scene,
    estimate: &Estimate,
    approach: &Approach,
    impact: &Impact,
) -> Option<f64> {
    let frame = frame_of(scene, approach, estimate.hertz.pair().effective_mass());
    let mut standstill = RestCriterion::new(&frame);
    let mut ends = impact.history.iter().filter(|now| now.time > 0.0);
    let end = ends.find(|now| {
        standstill.observe(&RelativeMotion {
            time: now.time,
            is_closed: true,
            force: now.force,
            rate: now.approach_rate,
            inner_energy: now.strain_energy.unwrap_or_default(),
        })
    });
    end.or(impact.history.last()).map(|now| now.time)
}
