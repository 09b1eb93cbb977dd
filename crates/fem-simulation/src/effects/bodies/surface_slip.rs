//! Tangential slip: surfaces of unlike materials move by different amounts along a curved interface, so the gap between
//! points that faced each other at first changes by the slope of the interface times the difference. Explicit elements
//! include the slip in their step. Condensed bodies and Ting's model have its first order, a spring in series with the
//! contact ([`fem_laws::SurfaceSlip`]).
//!
//! Decided by κβ, the curvature of the interface times Dundurs' second parameter. The effect is on unless κβ is
//! rounding and the bodies relax alike; it is zero between like bodies and against a rigid plane. Neglecting it changes
//! 0.24 aκβ of the contact time and 0.32 aκβ of the peak force, of first order in a/R. Above a/R* = 0.2 the second
//! order, which explicit elements include, may be larger where β is small, as for rubber.

use fem_case::engineering::number;
use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_laws::{RelativeError, SlipSurface, SurfaceSlip as Slip};

use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::{Effect, NamedEffect, SurfaceSlip};
use crate::effects::ting_prediction::change_between;
use crate::estimate::Estimate;
use crate::estimate::effective_modulus::left_at;
use crate::estimate::quasi_static::materials_mismatch;
use crate::quantity_errors::QuantityErrors;

/// Relative error of the series spring over a/R*: explicit elements change approach, time and force less, by 3 % at
/// 0.03 and by 7 to 26 % at 0.08 to 0.2.
const NEXT_ORDER: f64 = 2.0;
/// Neglected change of the contact time above which a warning is given.
const SMALL_SHARE: f64 = 1e-3;

impl Effect for SurfaceSlip {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let RelativeError { contact_time, peak_force, .. } = change(scene, estimate);
        let [time, force] = [contact_time, peak_force].map(|share| percent(share.abs()));
        let slope = estimate.contact_radius * mismatch(scene, estimate).abs();
        let warning = (contact_time.abs() > SMALL_SHARE).then(|| {
            format!(
                "the surfaces of unlike materials slip on each other, which this model leaves out: it changes the \
                 contact time by about {time} and the peak force by {force}; {}",
                if estimate.flow.is_some() { "model fem has it" } else { "models fem, condensed and ting have it" }
            )
        });
        let is_needed = materials_mismatch(scene);
        let slope =
            format!("slope of the interface × mismatch of the materials = {}", number(slope, 2));
        Some(Relevance {
            is_needed,
            number: if is_needed { slope } else { String::new() },
            if_not_needed: "the materials have equal (1 − 2ν)/G: the surfaces do not slip"
                .to_string(),
            open_error: format!("{time} of the contact time is open"),
            warning,
        })
    }

    /// Difference between Ting's impacts with and without slip; zero between like bodies.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        if !materials_mismatch(scene) {
            return Some(NeglectError::NOTHING);
        }
        let [with, without] = [Switch::On, Switch::Off].map(|to| self.switched(scene, Some(to)));
        Some(change_between(with, without, estimate))
    }

    /// The next order of the series spring is neglected; elements compute the slip fully.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let share = match (status.is_lacking, scene.model()) {
            (true, _) => 1.0,
            (false, ModelChoice::Fem) => 0.0,
            (false, _) => NEXT_ORDER * estimate.strain,
        };
        match &status.neglect_error {
            _ if share == 0.0 || !materials_mismatch(scene) => QuantityErrors::ZERO,
            Some(neglect_error) => neglect_error.of_all_quantities(estimate).times(share),
            None => QuantityErrors::default(),
        }
    }
}

fn relaxes(scene: &Scene) -> bool {
    let mut materials = scene.bodies().iter().filter_map(Body::material);
    materials.any(|material| material.relaxation().is_some_and(|series| series.relaxes()))
}

/// Returns the larger of the changes with the instantaneous and with the relaxed moduli.
fn change(scene: &Scene, estimate: &Estimate) -> RelativeError {
    let slip = largest(scene, estimate);
    let change = slip.change(estimate.contact_radius);
    let is_number = change.contact_time.is_finite() && change.peak_force.is_finite();
    if is_number { change } else { RelativeError::default() }
}

/// Returns κβ of the same moduli, in 1/m.
fn mismatch(scene: &Scene, estimate: &Estimate) -> f64 {
    let mismatch = largest(scene, estimate).mismatch();
    if mismatch.is_finite() { mismatch } else { 0.0 }
}

fn largest(scene: &Scene, estimate: &Estimate) -> Slip {
    let now = scene.surface_slip();
    if !relaxes(scene) {
        return now;
    }
    let relaxed = Slip::new(scene.bodies().each_ref().map(|body| {
        let curvature = body.diameter().map_or(0.0, |diameter| 2.0 / diameter);
        let material = body.material().map(|m| left_at(m, estimate.contact_time));
        SlipSurface::new(curvature, material.as_ref())
    }));
    if relaxed.mismatch().abs() > now.mismatch().abs() { relaxed } else { now }
}
