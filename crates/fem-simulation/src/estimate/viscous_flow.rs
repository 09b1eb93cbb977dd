//! Approach of bodies that relax to a small modulus or none, estimated before the run.
//!
//! A body that flows is stopped by its viscosity alone, in a time and by a contact that elastic closed forms
//! know nothing of: with βT = 10⁴ the contact grows to fourteen times that of the elastic bodies, in a
//! thousand of their contact times. Ting's impact on half-spaces tells both within some per cent.
//! Where the contact would be as wide as a sphere nearly, no model of small strain says anything, and none
//! is asked: all models refuse alike.

use std::rc::Rc;

use fem_case::Scene;
use fem_collision::{Approach, FLIGHT_AFTER, OutputRequest};
use fem_laws::{Impact, LawError, StaticHertz};

use crate::estimate::Estimate;
use crate::estimate::approach::approach_of;
use crate::estimate::duration::{duration_of, expected_duration};
use crate::estimate::quasi_static::{foretold_impact, ting_of};
use crate::rejection::Rejection;

/// Bodies that keep more than the rest of their moduli over the contact are stopped by them.
const RELAXED: f64 = 0.5;
/// Contact radius over that of the smallest sphere beyond which spheres that flow are no spheres.
const WIDEST: f64 = 0.3;
/// Contacts that relaxation has widened by less are as wide by the speed.
const WIDENED: f64 = 3.0;
/// Runs stop after this multiple of the predicted duration.
const PATIENCE: f64 = 3.0;
/// Bodies that come less further than this together than elastic ones are stopped by the clock of those.
const SLOWED: f64 = 3.0;

/// The largest contact radius, m: Hertz' of the instantaneous moduli, with the weight where there is one, or what
/// relaxation makes of it.
///
/// A ball that is laid down goes on until its spring holds what its weight has given, 2/5 K δ^{5/2} = m g δ, which is
/// (5/2)^{2/3} of the static approach; that of the impact adds to it at most.
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

/// Refuses bodies that flow into each other: nothing parts them again.
///
/// # Errors
/// Blames the materials.
pub(crate) fn check(scene: &Scene, estimate: &Estimate) -> Result<(), Rejection> {
    let impact = match impact(scene, estimate) {
        Some(Ok(impact)) => impact,
        Some(Err(LawError::NotFinished { .. })) if flows(scene, estimate) => {
            return Err(refused("the contact would grow beyond all bounds".to_string()));
        }
        _ => return Ok(()),
    };
    let radius = impact.max_contact_radius;
    let share = radius / estimate.smallest_radius;
    let is_widened = radius > WIDENED * estimate.hertz.max_contact_radius();
    if impact.contact_time.is_some() || share <= WIDEST || !is_widened {
        return Ok(());
    }
    Err(refused(format!(
        "the contact would grow to {share:.2} of the smallest radius, {:.0} times as wide as that of elastic \
         bodies",
        radius / estimate.hertz.max_contact_radius()
    )))
}

fn refused(how: String) -> Rejection {
    let found = format!("the bodies relax so fast that they flow into each other: {how}");
    Rejection::new("material", found).with_help(format!(
        "at most {WIDEST} are allowed; check the relaxation times, decay rates and weights of \
         material.NAME.relaxation and their units: weights whose sum is below 1 leave a lasting stiffness"
    ))
}

/// Whether nothing of the bodies' stiffness lasts.
fn flows(scene: &Scene, estimate: &Estimate) -> bool {
    let ting = ting_of(scene, estimate.hertz.pair(), true, None);
    ting.is_ok_and(|ting| ting.equilibrium_weight() <= 0.0)
}

/// Multiple of the elastic contact time after which a finite-element run stops.
pub(crate) fn give_up_after(scene: &Scene, estimate: &Estimate) -> f64 {
    if !relaxes(scene, estimate) {
        return OutputRequest::GIVE_UP_AFTER;
    }
    let duration = approach_of(scene).map(|met| expected_duration(scene, estimate, &met));
    let contact_times = duration.unwrap_or(0.0) / estimate.hertz.contact_time();
    OutputRequest::GIVE_UP_AFTER.max(PATIENCE * contact_times)
}

/// Times of a contact over those of the elastic bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slower {
    /// In which the bodies are stopped. They come to rest at the largest approach δ, in a time of some δ/v.
    pub stop: f64,
    /// From first touch to the end of the run.
    pub end: f64,
}

/// Returns the factor by which relaxation slows the contact, 1 if it does not.
pub(crate) fn slower(scene: &Scene, estimate: &Estimate, met: &Approach) -> Slower {
    let Some(Ok(impact)) = impact(scene, estimate) else { return Slower { stop: 1.0, end: 1.0 } };
    let hertz = &estimate.hertz;
    let stop = Some(impact.max_approach / hertz.max_approach());
    let stop = stop.filter(|stop| *stop > SLOWED && stop.is_finite()).unwrap_or(1.0);
    let end = duration_of(scene, estimate, met, &impact)
        .map_or(stop, |end| end / ((1.0 + FLIGHT_AFTER) * hertz.contact_time()));
    Slower { stop, end: end.max(1.0) }
}

/// Whether relaxation decides how far the bodies come; beside gravity, that does.
fn relaxes(scene: &Scene, estimate: &Estimate) -> bool {
    estimate.relaxed > RELAXED && scene.gravity().is_none()
}

/// Ting's impact of bodies that relax; none of others.
fn impact(scene: &Scene, estimate: &Estimate) -> Option<Result<Rc<Impact>, LawError>> {
    let speed = estimate.hertz.approach_speed();
    relaxes(scene, estimate).then(|| foretold_impact(scene, estimate, speed))
}
