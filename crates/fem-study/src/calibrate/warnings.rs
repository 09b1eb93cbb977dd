//! Warnings about a series.

use fem_case::engineering::{number, show};
use fem_data::estimate::Robustness;
use fem_data::estimate::spectrum::{SpectrumFit, SpeedExponent};

use super::calibration::{Calibration, UNUSED_STEPS};
use super::pair_model::STEPS_PER_CONTACT_TIME;
use super::settings::SettingNames;
use fem_simulation::effects::QUASI_STATIC_LIMIT;
use fem_simulation::error::MIN_ACROSS;
use fem_simulation::{WarningKind, WarningKinds};

/// Larger misfits, in multiples of the uncertainties, are not scatter.
pub(super) const LARGE_MISFIT: f64 = 2.0;
/// Larger rms errors of e are not those of the model or the mesh.
pub(super) const LARGE_ERROR: f64 = 0.02;

impl Calibration {
    /// Returns the warnings, the most important first; `names` are those of the settings that they suggest.
    pub fn warnings(&self, names: &SettingNames) -> Vec<String> {
        let mut warnings: Vec<String> = self.doubt(names).into_iter().collect();
        warnings.extend(self.loss_exponent().and_then(|found| falling(&found, &self.fit)));
        warnings.extend(self.flow.map(|flow| {
            format!(
                "a yield strength of {} explains these restitutions too, with an rms error of {:.4} where the series has \
                 {:.4}: {}data of other sizes tell both apart, since flow depends on the speed alone and a relaxation \
                 on the contact time",
                show(flow.yield_strength, "Pa"),
                flow.rms,
                self.fit.rms,
                if self.experiments.len() > 1 { "more " } else { "" },
            )
        }));
        warnings.extend(self.measured.data.warnings());
        warnings.extend(self.fit.robustness.as_ref().and_then(Robustness::warning));
        warnings.extend(self.contradiction());
        warnings.extend(self.misfit(names));
        warnings.extend(self.scatter(names));
        warnings.extend(self.undetermined());
        warnings.extend(self.coarse());
        warnings.extend(self.wide_contact());
        warnings.extend(self.of_pairs());
        warnings.extend(self.unused(names));
        warnings
    }

    /// Returns the warning about the coarsest of the meshes that are too coarse.
    fn coarse(&self) -> Option<String> {
        let across = self.experiments.iter().filter_map(|experiment| experiment.elements_across);
        let few: Vec<f64> = across.map(|(least, _)| least).filter(|n| *n < MIN_ACROSS).collect();
        let least = few.iter().copied().reduce(f64::min)?;
        let others = match few.len() {
            1 => String::new(),
            n => format!(", of {n} pairs the fewest,"),
        };
        Some(format!(
            "{least:.1} elements across the smallest contact radius{others} are too few: lower \
             mesh.contact_element_size, or leave it out"
        ))
    }

    /// Returns why no series fits the data, in some words; `None` if the best one fits.
    pub fn why_none_fits(&self) -> Option<String> {
        let exponent = self.loss_exponent().filter(|found| found.is_above(SpeedExponent::LIMIT));
        match (self.fit.misfit.filter(|_| misses(&self.fit)), exponent) {
            (Some(misfit), _) => {
                Some(format!("the best misses them by {} standard errors", number(misfit, 2)))
            }
            (None, Some(found)) => {
                Some(format!("1 - e grows as the speed to the power {:.2}", found.value))
            }
            (None, None) => {
                misses(&self.fit).then(|| format!("the rms error is {:.3}", self.fit.rms))
            }
        }
    }

    /// Returns the warning about contacts with the best series that are too large for the first order of finite size.
    fn wide_contact(&self) -> Option<String> {
        let terms = self.terms();
        let too_fast = self.experiments.iter().filter_map(|experiment| experiment.too_fast(&terms));
        let speed = show(too_fast.reduce(f64::max)?, "m/s");
        Some(format!(
            "at {speed} the contact is wider than a tenth of the sphere's radius with the best series, beyond the first order of its \
             finite size: leave the fastest impacts out"
        ))
    }

    /// Returns the warnings about the pairs. Of several that differ in their numbers only, it returns the first, with
    /// their count.
    fn of_pairs(&self) -> Vec<String> {
        let mut kinds = WarningKinds::default();
        for (place, experiment) in self.experiments.iter().enumerate() {
            experiment.warnings.iter().for_each(|warning| kinds.add(place, warning));
        }
        let told = |kind: &WarningKind| match kind.count {
            1 => kind.first.clone(),
            n => format!("{} (so of {n} pairs, each with its own numbers)", kind.first),
        };
        kinds.all().iter().map(told).collect()
    }

    /// Groups the speeds that are too fast by their unit.
    fn doubt(&self, names: &SettingNames) -> Option<String> {
        let doubt = self.experiments.iter().find_map(|experiment| experiment.doubt)?;
        Some(format!(
            "{} is {:.2} % of the shear wave speed; above {:.1} % the inertia of the bodies counts, \
             which {} {} leaves out: is the unit of the speeds right?",
            show(doubt.speed, "m/s"),
            100.0 * doubt.mach,
            100.0 * QUASI_STATIC_LIMIT,
            names.model,
            self.model.word(),
        ))
    }

    fn has_uncertainties(&self) -> bool {
        let mut points = self.measured.data.points.iter();
        points.any(|point| point.restitution_uncertainty.is_some())
    }

    fn misfit(&self, names: &SettingNames) -> Option<String> {
        if !misses(&self.fit) {
            return None;
        }
        let none = "no series of these relaxation times fits these data";
        let meaningless = "so the ranges have no statistical meaning";
        let remedy = match self.prior {
            Some(_) => "the model or the measured relaxation is wrong".to_string(),
            None => format!("try more {} or other {}", names.terms, names.times),
        };
        Some(match self.fit.misfit {
            Some(misfit) if !self.has_uncertainties() => format!(
                "the misfit is {misfit:.1} times the scatter of repeats: {none}, {meaningless}; \
                 {remedy}"
            ),
            Some(misfit) => format!(
                "the misfit is {misfit:.1} times the uncertainties: {none}, or the uncertainties \
                 are too small, and so are the ranges; {remedy}"
            ),
            None => {
                let rms = self.fit.rms;
                format!("the rms error is {rms:.3}: {none}, {meaningless}; {remedy}")
            }
        })
    }

    fn scatter(&self, names: &SettingNames) -> Option<String> {
        let is_unknown = self.fit.degrees_of_freedom == 0 && !self.has_uncertainties();
        is_unknown.then(|| {
            format!(
                "there are no more data than weights, so their scatter is unknown; the ranges assume \
                 an error of {:.1e} in e. Give {}",
                self.fit.error, names.uncertainty
            )
        })
    }

    /// Returns the warning about data that the measured relaxation does not make.
    fn contradiction(&self) -> Option<String> {
        let [prior, data, _] = self.fit.parts.as_ref()?.restitution;
        let errors = (data.value - prior.value).abs() / prior.error.hypot(data.error);
        (errors > LARGE_MISFIT).then(|| {
            format!(
                "the measured relaxation gives a mean restitution of {:.4} ± {:.4} and the data {:.4} ± {:.4}, {errors:.1} standard \
                 errors away: a loss that is no relaxation, other moduli or an uncertainty that is too small",
                prior.value, prior.error, data.value, data.error,
            )
        })
    }

    fn undetermined(&self) -> Option<String> {
        if self.prior.is_some() {
            return None;
        }
        let (n, determined) = (self.fit.weights.len(), self.fit.resolution.n_determined());
        (determined < n).then(|| {
            format!(
                "the data determine {determined} of {n} combinations of weights; the regularisation \
                 and the bounds (no weight below 0, their sum at most 1) determine the rest"
            )
        })
    }

    fn unused(&self, names: &SettingNames) -> Option<String> {
        let key = self.unused_key.as_deref()?;
        Some(match key {
            UNUSED_STEPS => format!("{key} is ignored: calibrate takes {STEPS_PER_CONTACT_TIME}"),
            _ => format!(
                "{key} is ignored: {} chooses the model, here {}",
                names.model,
                self.model.word()
            ),
        })
    }
}

/// Whether the best series does not fit the data.
pub(super) fn misses(fit: &SpectrumFit) -> bool {
    fit.misfit.map_or(fit.rms > LARGE_ERROR, |misfit| misfit > LARGE_MISFIT)
}

/// Returns the sentence on restitutions that fall with speed.
fn falling(found: &SpeedExponent, fit: &SpectrumFit) -> Option<String> {
    if !found.is_above(0.0) {
        return None;
    }
    let error = found.standard_error.map_or(String::new(), |error| format!(" ± {error:.3}"));
    let start = format!(
        "restitution falls with speed, 1 - e as the speed to the power {:.3}{error}; a Maxwell \
         term slower than the contact gives -0.2 (restitution rises), and no linear viscoelastic \
         spectrum gives more than 0.2",
        found.value
    );
    let verdict = if found.is_above(SpeedExponent::LIMIT) {
        "no Prony series fits these data; the loss grows with the strain, as in plastic \
         flow, fracture or friction"
    } else if misses(fit) {
        "neither a single Maxwell term (weight 1) nor any series fits these data"
    } else {
        "a single Maxwell term (weight 1) does not fit these data, only terms faster than the \
         contact with an equilibrium modulus do"
    };
    Some(format!("{start}: {verdict}"))
}
