//! Contact radius and duration for bodies that relax to a small modulus or flow, estimated before the run.
//!
//! A flowing body is stopped by its viscosity alone, and elastic closed forms predict neither the time nor the contact
//! radius: with βT = 10⁴ the contact becomes fourteen times as wide as that of the elastic bodies, in a thousand of their
//! contact times. Ting's impact between half-spaces predicts both within some per cent. If the contact would become nearly
//! as wide as a sphere, no model of small strain is valid, and every model rejects the scene.

use std::sync::Arc;

use fem_case::Scene;
use fem_collision::{Approach, OutputRequest, POST_CONTACT_FRACTION};
use fem_laws::{Impact, LawError, StaticHertz};

use crate::estimate::approach::{approach_of, duration_of, expected_duration};
use crate::estimate::quasi_static::ting_of;
use crate::estimate::{Estimate, LARGE_LOSS_OF_MODULI};
use crate::rejection::Rejection;

/// Contact radius over the smallest sphere's radius above which flowing spheres are rejected.
const WIDEST_CONTACT_OVER_RADIUS: f64 = 0.3;
/// Widening of the contact by relaxation below which the speed is the cause of a wide contact.
const MIN_WIDENING_BY_FLOW: f64 = 3.0;
/// Multiple of the predicted duration after which runs stop.
const DURATION_OVER_PREDICTED: f64 = 3.0;
/// Approach over that of the elastic bodies below which relaxation does not slow the contact.
const MIN_APPROACH_OVER_ELASTIC: f64 = 3.0;

/// Returns the largest contact radius, m: Hertz' radius with instantaneous moduli, plus that by the weight, or the radius
/// after relaxation.
///
/// A ball that is released on a plane moves until the contact stores the work of its weight, 2/5 K δ^{5/2} = m g δ,
/// which is (5/2)^{2/3} of the static approach. The impact adds at most its own radius.
pub(crate) fn widest_contact(scene: &Scene, estimate: &Estimate) -> f64 {
    let pair = estimate.hertz.pair();
    let pressed = scene.gravity().and_then(|gravity| {
        StaticHertz::new(pair, pair.effective_mass() * gravity.acceleration).ok()
    });
    let pressed = pressed.map_or(0.0, |pressed| 2.5f64.cbrt() * pressed.contact_radius);
    let elastic = match pressed > 0.0 {
        true => estimate.hertz.max_contact_radius().hypot(pressed),
        false => estimate.hertz.max_contact_radius(),
    };
    let impact = impact(scene, estimate).and_then(Result::ok);
    impact.map_or(elastic, |impact| impact.max_contact_radius.max(elastic))
}

/// Rejects bodies that flow into each other.
pub(crate) fn check(scene: &Scene, estimate: &Estimate) -> Result<(), Rejection> {
    let impact = match impact(scene, estimate) {
        Some(Ok(impact)) => impact,
        Some(Err(LawError::NotFinished { .. })) if flows(scene, estimate) => {
            return Err(rejected("the contact would grow beyond all bounds".to_string()));
        }
        _ => return Ok(()),
    };
    let radius = impact.max_contact_radius;
    let share = radius / estimate.smallest_radius;
    let is_widened = radius > MIN_WIDENING_BY_FLOW * estimate.hertz.max_contact_radius();
    if impact.contact_time.is_some() || share <= WIDEST_CONTACT_OVER_RADIUS || !is_widened {
        return Ok(());
    }
    Err(rejected(format!(
        "the contact would grow to {share:.2} of the smallest radius, {:.0} times as wide as that of elastic \
         bodies",
        radius / estimate.hertz.max_contact_radius()
    )))
}

fn rejected(how: String) -> Rejection {
    let found = format!("the bodies relax so fast that they flow into each other: {how}");
    Rejection::new("material", found).with_help(format!(
        "at most {WIDEST_CONTACT_OVER_RADIUS} are allowed; check the relaxation times, decay rates and weights of \
         material.NAME.relaxation and their units: weights whose sum is below 1 leave a lasting stiffness"
    ))
}

/// Returns whether the bodies have no equilibrium stiffness.
fn flows(scene: &Scene, estimate: &Estimate) -> bool {
    let ting = ting_of(scene, estimate.hertz.pair(), true, None);
    ting.is_ok_and(|ting| ting.equilibrium_weight() <= 0.0)
}

/// Returns the multiple of the elastic contact time after which a finite-element run stops.
pub(crate) fn max_contact_times(scene: &Scene, estimate: &Estimate) -> f64 {
    if !relaxes(scene, estimate) {
        return OutputRequest::MAX_CONTACT_TIMES;
    }
    let duration = approach_of(scene).map(|met| expected_duration(scene, estimate, &met));
    let contact_times = duration.unwrap_or(0.0) / estimate.hertz.contact_time();
    OutputRequest::MAX_CONTACT_TIMES.max(DURATION_OVER_PREDICTED * contact_times)
}

/// Times of a contact over those of elastic bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SlowdownFactors {
    /// Ratio of the times until the largest approach δ, about δ/v.
    pub stop: f64,
    /// Ratio of the times from first touch to the end of the run.
    pub end: f64,
}

/// Returns the factors by which relaxation slows the contact, at least 1.
pub(crate) fn slower(scene: &Scene, estimate: &Estimate, met: &Approach) -> SlowdownFactors {
    let Some(Ok(impact)) = impact(scene, estimate) else {
        return SlowdownFactors { stop: 1.0, end: 1.0 };
    };
    let hertz = &estimate.hertz;
    let stop = Some(impact.max_approach / hertz.max_approach());
    let stop =
        stop.filter(|stop| *stop > MIN_APPROACH_OVER_ELASTIC && stop.is_finite()).unwrap_or(1.0);
    let end = duration_of(scene, estimate, met, &impact)
        .map_or(stop, |end| end / ((1.0 + POST_CONTACT_FRACTION) * hertz.contact_time()));
    SlowdownFactors { stop, end: end.max(1.0) }
}

/// Returns whether relaxation determines the approach. Under gravity the weight does.
fn relaxes(scene: &Scene, estimate: &Estimate) -> bool {
    estimate.relaxed > LARGE_LOSS_OF_MODULI && scene.gravity().is_none()
}

/// Returns Ting's impact of strongly relaxing bodies; `None` for others.
fn impact(scene: &Scene, estimate: &Estimate) -> Option<Result<Arc<Impact>, LawError>> {
    let Estimate { hertz, impacts, .. } = estimate;
    let impact = || impacts.on_half_spaces(scene, hertz.pair(), hertz.approach_speed());
    relaxes(scene, estimate).then(impact)
}
