//! A calibration as numbers, and as a table for a case file.

use fem_fit::spectrum::Range;
use serde_json::{Value, json};

use super::Calibrated;
use super::maxwell::Beyond;
use super::verdict::measured_exponent;

/// `calibrate.json`.
pub fn calibration_numbers(found: &Calibrated<'_>) -> Value {
    let fit = found.fit;
    let range = |range: &Range| json!({ "value": range.value, "range": [range.low, range.high] });
    let terms = (0..found.times.len()).map(|k| {
        json!({
            "relaxation_time_s": found.times[k],
            "weight": fit.weights[k],
            "range": [fit.weight_ranges[k].low, fit.weight_ranges[k].high],
            "share_of_data": fit.resolution.shares[k],
        })
    });
    let combinations = fit.resolution.combinations.iter().map(|combination| {
        let error = Some(combination.standard_error).filter(|error| error.is_finite());
        json!({
            "coefficients": combination.coefficients,
            "singular_value": combination.singular_value,
            "value": combination.value,
            "standard_error": error,
            "determined": combination.is_determined,
        })
    });
    let pairs = found.experiments.iter().map(|experiment| {
        json!({
            "diameters_m": experiment.diameters,
            "points": experiment.points.len(),
            "elements_across_smallest_contact": experiment.elements_across.map(|across| across.0),
            "elements_across_largest_contact": experiment.elements_across.map(|across| across.1),
        })
    });
    let exponent = measured_exponent(found.measured).map(
        |exponent| json!({ "value": exponent.value, "standard_error": exponent.standard_error }),
    );
    let [total, rate, time] = &fit.moments;
    json!({
        "case": found.case.display().to_string(),
        "data": found.measured.data.name,
        "model": found.model.word(),
        "material": found.target.material,
        "acts_on": found.acts_on(),
        "points": found.measured.data.points.len(),
        "pairs": pairs.collect::<Vec<_>>(),
        "contact_times_s": found.contact_times(),
        "regularisation": found.regularisation,
        "confidence": found.confidence,
        "terms": terms.collect::<Vec<_>>(),
        "weight_sum": range(total),
        "initial_decay_rate_1_s": range(rate),
        "viscous_time_s": range(time),
        "combinations": combinations.collect::<Vec<_>>(),
        "combinations_determined": fit.resolution.n_determined(),
        "rms": fit.rms,
        "error": fit.error,
        "misfit": fit.misfit,
        "degrees_of_freedom": fit.degrees_of_freedom,
        "evaluations": fit.n_evaluations,
        "maxwell": {
            "relaxation_time_s": found.maxwell.time,
            "beyond_search": found.maxwell.beyond.map(Beyond::word),
            "rms": found.maxwell.rms,
        },
        "pure_error": fit.pure_error.map(|pure| pure.error),
        "loss_exponent_of_speed": exponent,
        "warnings": found.warnings,
    })
}

/// `relaxation.toml`: the series as a case has it; only comments where nothing relaxes.
pub fn relaxation_table(found: &Calibrated<'_>) -> String {
    let fit = found.fit;
    let mut text = format!(
        "# By fem-run calibrate from {}: {} of {} combinations of weights are the data's.\n",
        found.measured.data.name,
        fit.resolution.n_determined(),
        fit.weights.len(),
    );
    let terms = found.terms();
    if terms.is_empty() {
        return text + "# No term has a weight: the data show no loss.\n";
    }
    text += &format!("[material.{}.relaxation]\n", toml_key(&found.target.material));
    text += &format!("acts_on = \"{}\"\nterms = [\n", found.acts_on());
    for term in terms {
        text += &format!(
            "    {{ weight = {:?}, relaxation_time = {:?} }},\n",
            term.weight, term.relaxation_time
        );
    }
    text + "]\n"
}

/// A name as a key of TOML.
fn toml_key(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(is_bare) {
        true => name.to_string(),
        // A string of JSON is one of TOML.
        false => json!(name).to_string(),
    }
}
