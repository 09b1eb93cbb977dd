//! What a reader should know before trusting a series.

use fem::measured::MeasuredPairs;
use fem_fit::spectrum::{SpectrumFit, SpeedExponent, SpeedPoint, speed_exponent};

use super::experiment::Experiment;

/// Fewer elements across a contact radius than this do not follow it.
const FEWEST_ELEMENTS: f64 = 3.0;
/// A misfit of so many times the uncertainties is no scatter.
const LARGE_MISFIT: f64 = 2.0;
/// An rms error of e above this is more than a model's or a mesh's own.
const LARGE_ERROR: f64 = 0.02;

/// 1 − e ∝ v^p of measured restitutions.
pub fn measured_exponent(measured: &MeasuredPairs) -> Option<SpeedExponent> {
    let point = |(k, point): (usize, &fem_fit::Point)| SpeedPoint {
        pair: measured.pair_of(k),
        speed: point.speed,
        restitution: point.restitution,
    };
    speed_exponent(&measured.data.points.iter().enumerate().map(point).collect::<Vec<_>>())
}

/// In the order of their weight.
pub fn warnings(
    measured: &MeasuredPairs,
    experiments: &[Experiment],
    fit: &SpectrumFit,
) -> Vec<String> {
    let data = &measured.data;
    let is_given = data.points.iter().any(|point| point.restitution_uncertainty.is_some());
    // Pairs in the same unit are in doubt together.
    let doubts = experiments.iter().filter_map(|experiment| experiment.doubt.clone());
    let mut warnings: Vec<String> = doubts.take(1).collect();
    warnings.extend(measured_exponent(measured).and_then(|found| falling(&found, fit)));
    warnings.extend(data.warnings());
    match fit.misfit {
        Some(misfit) if misses(fit) && !is_given => warnings.push(format!(
            "the misfit is {misfit:.1} times the scatter of repeats: no series of these relaxation \
             times makes these data, and the ranges tell flatness, no probability; try more --terms \
             or other --times"
        )),
        Some(misfit) if misses(fit) => warnings.push(format!(
            "the misfit is {misfit:.1} times the uncertainties: no series of these relaxation \
             times makes these data, or the uncertainties are too small, and so are the ranges; try more \
             --terms or other --times"
        )),
        None if misses(fit) => warnings.push(format!(
            "the rms error is {:.3}: no series of these relaxation times makes these data, and \
             the ranges tell flatness, no probability; try more --terms or other --times",
            fit.rms
        )),
        _ => {}
    }
    if fit.degrees_of_freedom == 0 && !is_given {
        warnings.push(format!(
            "no more data than weights: their scatter is unknown, and the ranges are those of an \
             error of {:.1e} in e; give --uncertainty",
            fit.error
        ));
    }
    let n = fit.weights.len();
    let determined = fit.resolution.n_determined();
    if determined < n {
        warnings.push(format!(
            "the data determine {determined} of {n} combinations of weights; the regularisation and \
             the bounds (no weight below 0, their sum at most 1) chose the rest"
        ));
    }
    for experiment in experiments {
        if let Some((least, _)) = experiment.elements_across
            && least < FEWEST_ELEMENTS
        {
            warnings.push(format!(
                "{least:.1} elements across the smallest contact radius are too few: lower \
                 mesh.contact_element_size, or leave it out"
            ));
        }
        for warning in &experiment.warnings {
            if !warnings.contains(warning) {
                warnings.push(warning.clone());
            }
        }
    }
    warnings
}

/// Whether the best series does not make the data.
fn misses(fit: &SpectrumFit) -> bool {
    fit.misfit.map_or(fit.rms > LARGE_ERROR, |misfit| misfit > LARGE_MISFIT)
}

/// The sentence on restitutions that fall with speed.
fn falling(found: &SpeedExponent, fit: &SpectrumFit) -> Option<String> {
    if !found.is_above(0.0) {
        return None;
    }
    let error = found.standard_error.map_or(String::new(), |error| format!(" ± {error:.3}"));
    let start = format!(
        "restitution falls with speed, 1 - e as the speed to the power {:.3}{error}; a Maxwell \
         term slower than the contact gives -0.2 (restitution rises), and no linear viscoelastic \
         spectrum more than 0.2",
        found.value
    );
    let verdict = if found.is_above(SpeedExponent::LIMIT) {
        "no Prony series makes these data; a loss that grows with the strain, such as plastic \
         flow, fracture or friction, is at work"
    } else if misses(fit) {
        "a single Maxwell term (weight 1) cannot make these data, and the best series misses them"
    } else {
        "a single Maxwell term (weight 1) cannot make these data, only terms faster than the \
         contact beside an equilibrium modulus can"
    };
    Some(format!("{start}: {verdict}"))
}
