//! The stored forms of a calibration: `calibrate.json` and `relaxation.toml`.

use fem_case::schema::{ActsOn, RelaxationTable, TermTable};
use fem_collision::PROGRAM;
use fem_data::relaxation::{shift_toml, toml_key};
use fem_material::PronyTerm;
use serde_json::{Value, json};

use super::calibration::Calibration;
use super::curves::Abscissa;
use super::experiment::Experiment;
use super::maxwell::Beyond;
use super::prior::Prior;
use fem_data::estimate::spectrum::{Combination, Range, Share};

/// Names of the moments of the weights.
const MOMENTS: [&str; 3] = ["weight_sum", "initial_decay_rate_1_s", "viscous_time_s"];

impl Calibration {
    /// Returns the stored form of the calibration in SI units; `case` is the case's name, `warnings` are those of
    /// [`Calibration::warnings`].
    pub fn numbers(&self, case: &str, warnings: Vec<String>) -> Value {
        let fit = &self.fit;
        let moments = self.moments();
        let [total, rate, time] = [0, 1, 2].map(|i| range(&moments[i], &fit.moments[i]));
        let names: Vec<String> = (1..=self.times.len()).map(|k| format!("g{k}")).collect();
        let results = names.iter().map(String::as_str).chain(MOMENTS);
        let results: Vec<(&str, f64)> = results.map(|name| (name, 1.0)).collect();
        let exponent = self.loss_exponent();
        let combinations = fit.resolution.combinations.iter().map(combination);
        json!({
            "case": case,
            "data": self.measured.data.name,
            "model": self.model.word(),
            "material": self.target.material,
            "acts_on": self.acts_on(),
            "points": self.measured.data.points.len(),
            "pairs": self.experiments.iter().map(pair).collect::<Value>(),
            "contact_times_s": self.contact_times(),
            "regularisation": self.regularisation,
            "confidence": self.confidence,
            "terms": (0..self.times.len()).map(|k| self.term(k)).collect::<Value>(),
            (MOMENTS[0]): total,
            (MOMENTS[1]): rate,
            (MOMENTS[2]): time,
            "inputs": self.inputs.iter().map(|part| part.numbers(&results)).collect::<Value>(),
            "prior": self.prior_numbers(),
            "combinations": combinations.collect::<Value>(),
            "combinations_determined": fit.resolution.n_determined(),
            "rms": fit.rms,
            "error": fit.error,
            "misfit": fit.misfit,
            "degrees_of_freedom": fit.degrees_of_freedom,
            "evaluations": fit.n_evaluations,
            "maxwell": {
                "relaxation_time_s": self.maxwell.time,
                "beyond_search": self.maxwell.beyond.map(Beyond::word),
                "rms": self.maxwell.rms,
            },
            "robust": fit.robustness.as_ref().map(|found| found.numbers(&found.weights)),
            "pure_error": fit.pure_error.map(|pure| pure.error),
            "loss_exponent_of_speed": exponent.map(|exponent| {
                json!({ "value": exponent.value, "standard_error": exponent.standard_error })
            }),
            "curves": self.curve_numbers(),
            "warnings": warnings,
        })
    }

    /// Returns restitutions over speed or contact time: the data, the best series, and the single Maxwell term.
    fn curve_numbers(&self) -> Option<Value> {
        let curves = self.curves().ok()?;
        let x = match curves.over {
            Abscissa::Speed => "approach_speed_m_s",
            Abscissa::ContactTime => "elastic_contact_time_s",
        };
        let columns = |points: &[(f64, f64)]| {
            let (xs, restitutions): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
            json!({ x: xs, "restitution": restitutions })
        };
        let [mut data, best, maxwell] =
            [&curves.data, &curves.best, &curves.maxwell].map(|points| columns(points));
        data["weight"] = (0..curves.data.len()).map(|k| self.weight(k)).collect();
        let prior = curves.prior.as_ref().map(|points| columns(points));
        Some(json!({ "over": x, "data": data, "best": best, "maxwell": maxwell, "prior": prior }))
    }

    fn term(&self, k: usize) -> Value {
        let (range, of_data) = (self.weight_range(k), &self.fit.weight_ranges[k]);
        json!({
            "relaxation_time_s": self.times[k],
            "weight": self.fit.weights[k],
            "range": [range.low, range.high],
            "range_of_data": [of_data.low, of_data.high],
            "share_of_data": self.fit.resolution.shares[k],
            "prior": self.fit.parts.as_ref().map(|parts| share(&parts.weights[k])),
            "error": self.fit.parts.as_ref().map(|parts| parts.errors[k]),
        })
    }

    /// Returns what the measured relaxation and the data contribute.
    fn prior_numbers(&self) -> Option<Value> {
        let (prior, parts) = (self.prior.as_ref()?, self.fit.parts.as_ref()?);
        let [of_prior, of_data, of_both] = parts.restitution.each_ref().map(share);
        Some(json!({
            "frequencies_hz": prior.band,
            "weights_of_data": parts.n_of_data,
            "mean_restitution": { "prior": of_prior, "data": of_data, "both": of_both },
            "restitution": parts.restitutions,
        }))
    }
}

fn pair(experiment: &Experiment) -> Value {
    json!({
        "diameters_m": experiment.diameters,
        "points": experiment.points.len(),
        "elements_across_smallest_contact": experiment.elements_across.map(|across| across.0),
        "elements_across_largest_contact": experiment.elements_across.map(|across| across.1),
    })
}

fn share(share: &Share) -> Value {
    json!({ "value": share.value, "error": share.error })
}

fn range(whole: &Range, of_data: &Range) -> Value {
    json!({
        "value": whole.value,
        "range": [whole.low, whole.high],
        "range_of_data": [of_data.low, of_data.high],
    })
}

fn combination(combination: &Combination) -> Value {
    json!({
        "coefficients": combination.coefficients,
        "singular_value": combination.singular_value,
        "value": combination.value,
        "standard_error": Some(combination.standard_error).filter(|error| error.is_finite()),
        "determined": combination.is_determined,
    })
}

impl Calibration {
    /// Returns the table that gives the material the series that was found; `None` if nothing relaxes.
    pub fn relaxation(&self) -> Option<RelaxationTable> {
        let terms = self.reference_terms().into_iter();
        let terms =
            terms.map(|term| TermTable::with_relaxation_time(term.weight, term.relaxation_time));
        let terms: Vec<TermTable> = terms.collect();
        let new = || RelaxationTable::new(self.acts_on(), []);
        let table = self.prior.as_ref().map_or_else(new, |prior| prior.table.clone());
        (!terms.is_empty()).then_some(RelaxationTable { terms, ..table })
    }

    /// Returns the terms that are not zero at the reference temperature, which is that of the case without prior knowledge.
    fn reference_terms(&self) -> Vec<PronyTerm> {
        let log10_shift = |prior: &Prior| prior.measured.log10_shift();
        let factor = 10f64.powf(self.prior.as_ref().map_or(0.0, log10_shift));
        let mut terms = self.terms();
        terms.iter_mut().for_each(|term| term.relaxation_time /= factor);
        terms
    }

    /// Returns the moduli that relax.
    pub fn acts_on(&self) -> ActsOn {
        self.target.acts_on.into()
    }

    /// Returns the table of the relaxation as text to paste into a case file; only comments if nothing relaxes.
    pub fn relaxation_toml(&self) -> String {
        let resolution = &self.fit.resolution;
        let mut text = format!(
            "# By {PROGRAM} calibrate from {}: {} of {} combinations of weights are the data's.\n",
            self.measured.data.name,
            resolution.n_determined(),
            self.fit.weights.len(),
        );
        let terms = self.reference_terms();
        if terms.is_empty() {
            return text + "# No term has a weight: the data show no loss.\n";
        }
        text += &format!("[material.{}.relaxation]\n", toml_key(&self.target.material));
        text += &format!("acts_on = \"{}\"\nterms = [\n", self.acts_on().word());
        for term in terms {
            text += &format!(
                "    {{ weight = {:?}, relaxation_time = {:?} }},\n",
                term.weight, term.relaxation_time
            );
        }
        text += "]\n";
        let Some(prior) = &self.prior else { return text };
        if let Some(law) = &prior.measured.shift {
            let reference = prior.measured.reference_temperature;
            let reference =
                reference.map(|kelvin| format!("reference_temperature = \"{kelvin:?} K\"\n"));
            text += &reference.unwrap_or_default();
            text += &format!("shift = {}\n", shift_toml(law));
        }
        text
    }
}
