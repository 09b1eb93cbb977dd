//! The ranking of all contact laws by their evidence in the data.
//!
//! The evidence follows Akaike's criterion with its correction for few data (Hurvich & Tsai 1989, *Biometrika* **76**,
//! 297), for N data and p free parameters,
//!
//! ```math
//! \mathrm{AIC}_c = -2\ln L + 2q + \frac{2q(q+1)}{N-q-1}, \qquad
//! w_i \propto \mathrm{e}^{-\mathrm{AIC}_{c,i}/2},
//! ```
//!
//! with −2 ln L = Σ r² and q = p if the data have uncertainties, and −2 ln L = N ln(Σ r²/N) and
//! q = p + 1 otherwise, where the scatter counts as a parameter. Robust fits have the likelihood of their scatter
//! ([`fem_data::estimate::Robustness`]) and q = p + 1. Weights w are shares of the
//! evidence among the laws that were fitted; none of them needs to be right.

use fem_case::Case;
use fem_data::estimate::{Fit, Model};
use fem_laws::{EndRule, LawFamily};

use super::chosen_law::ChosenLaw;
use super::law_fault::LawFault;
use fem_data::estimate::CONFIDENCE;
use fem_data::estimate::loss_parameter;
use fem_data::table::Restitutions;

/// Laws whose misfits differ by less make the same curve.
const SAME: f64 = 1e-6;

/// A law that was fitted.
#[derive(Clone, Debug, PartialEq)]
pub struct RankedLaw {
    /// The law, for the bodies of the case.
    pub model: Model,
    /// Its free parameters.
    pub free: Vec<&'static str>,
    /// Values of all of its parameters, and the residuals.
    pub fit: Fit,
    /// AICc less that of the best law; `None` if there are too few data for the number of parameters.
    pub difference: Option<f64>,
    /// Akaike weight of the law among all fitted laws, 0 to 1.
    pub weight: Option<f64>,
}

impl RankedLaw {
    /// Returns the family of the law.
    pub fn family(&self) -> LawFamily {
        self.model.family()
    }
}

/// All laws, fitted to the same data.
#[derive(Clone, Debug, PartialEq)]
pub struct LawRanking {
    /// The laws, the best first. Laws without evidence come last, by the number of their parameters and then by their
    /// rms.
    pub laws: Vec<RankedLaw>,
    /// Laws that make the curve of another one, with its name.
    pub twins: Vec<(String, &'static str)>,
    /// Laws that could not be fitted, with the reason.
    pub others: Vec<(&'static str, String)>,
}

impl LawRanking {
    /// Fits every law of `among` that loses energy. Its damping is free and, if there are contact times, stiffnesses that no theory
    /// gives; see [`ChosenLaw::problem`]. Robust fits count data far from their curves little.
    ///
    /// # Errors
    /// No law can be fitted; the error is that of the last.
    pub fn of(
        case: &Case,
        data: &Restitutions,
        among: &[LawFamily],
        end_rule: Option<EndRule>,
        is_robust: bool,
    ) -> Result<Self, LawFault> {
        let mut found: Vec<(RankedLaw, Option<f64>)> = Vec::new();
        let (mut twins, mut others, mut last) = (Vec::new(), Vec::new(), None);
        let is_weighted = data.points.iter().all(|point| point.restitution_uncertainty.is_some());
        for (family, exponent) in candidates(among) {
            match fitted(case, data, (family, exponent), (end_rule, is_robust)) {
                Ok(law) => {
                    let rms = law.fit.rms;
                    let twin = found.iter().find(|(other, _)| {
                        other.free.len() == law.free.len()
                            && (other.fit.rms - rms).abs() < SAME * rms
                    });
                    if let Some((twin, _)) = twin {
                        let of = twin.family().name();
                        if twin.family() != family {
                            twins.push((name(family, exponent), of));
                        }
                        continue;
                    }
                    let criterion = criterion(&law.fit, is_weighted);
                    found.push((law, criterion));
                }
                Err(fault) => {
                    if exponent.is_none() {
                        others.push((family.name(), fault.to_string()));
                    }
                    last = Some(fault);
                }
            }
        }
        let best = found.iter().filter_map(|(_, criterion)| *criterion).reduce(f64::min);
        let share = |criterion: f64| (-0.5 * (criterion - best.unwrap_or(criterion))).exp();
        let sum: f64 = found.iter().filter_map(|(_, criterion)| criterion.map(share)).sum();
        for (law, criterion) in &mut found {
            law.difference = criterion.zip(best).map(|(own, best)| own - best);
            law.weight = criterion.map(|own| share(own) / sum);
        }
        let place = |(law, _): &(RankedLaw, Option<f64>)| {
            // Without evidence, laws with fewer parameters come first.
            (law.difference.unwrap_or(f64::INFINITY), law.free.len(), law.fit.rms)
        };
        found.sort_by(|a, b| {
            let (a, b) = (place(a), place(b));
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.total_cmp(&b.2))
        });
        match (found.is_empty(), last) {
            (true, Some(fault)) => Err(fault),
            _ => {
                let laws = found.into_iter().map(|(law, _)| law).collect();
                Ok(Self { laws, twins, others })
            }
        }
    }
}

/// Returns the laws of `among` that lose energy with their damping free, and again with an exponent free that has a default. Laws that
/// dent are fitted by name only.
fn candidates(among: &[LawFamily]) -> impl Iterator<Item = (LawFamily, Option<&'static str>)> {
    // The general law comes last, because its defaults are those of a named law.
    let named = LawFamily::ALL.into_iter().filter(|family| *family != LawFamily::Power);
    let wanted = named.chain([LawFamily::Power]).filter(|family| among.contains(family));
    let lossy = wanted.filter(|family| loss_parameter(*family).is_ok());
    lossy.flat_map(|family| {
        let has_default = |key: &&'static str| {
            let mut parameters = family.parameters().iter();
            parameters.any(|parameter| parameter.key == *key && parameter.default.is_some())
        };
        let exponent = Some("n").filter(has_default);
        std::iter::once((family, None)).chain(exponent.map(|key| (family, Some(key))))
    })
}

/// Fits a law to the data, without its rank.
fn fitted(
    case: &Case,
    data: &Restitutions,
    (family, exponent): (LawFamily, Option<&'static str>),
    (end_rule, is_robust): (Option<EndRule>, bool),
) -> Result<RankedLaw, LawFault> {
    let end_rule = end_rule.filter(|_| family.end_rule().is_none());
    let law = ChosenLaw::of(case, family, &[], end_rule)?;
    let damping = family.parameters()[loss_parameter(family)?].key;
    let free: Vec<&str> = match exponent {
        // The exponent is free in addition to the usual parameters.
        Some(key) => {
            let alone = law.problem(&data.points, &[])?;
            let keys = alone.free.iter().map(|free| alone.parameter(free.index).key);
            keys.chain([key]).collect()
        }
        None => Vec::new(),
    };
    let problem = law.problem(&data.points, &free)?.robust(is_robust);
    let mut free: Vec<&'static str> =
        problem.free.iter().map(|free| problem.parameter(free.index).key).collect();
    // The damping comes first.
    free.sort_by_key(|key| *key != damping);
    let fit = problem.fit(CONFIDENCE)?;
    Ok(RankedLaw { model: law.model().clone(), free, fit, difference: None, weight: None })
}

/// Returns the name of a law, with its exponent if that is held but could be free.
fn name(family: LawFamily, exponent: Option<&str>) -> String {
    let exponents = family.parameters().iter().filter(|parameter| parameter.key == "n");
    match exponents.filter_map(|n| n.default).next() {
        Some(default) if exponent.is_none() => format!("{} with n = {default}", family.name()),
        Some(_) => format!("{} with n free", family.name()),
        None => family.name().to_string(),
    }
}

/// Returns AICc; `None` for too few data.
fn criterion(fit: &Fit, is_weighted: bool) -> Option<f64> {
    let n = fit.residuals.len() as f64;
    let p = fit.estimates.len() as f64;
    let (misfit, q) = match is_weighted {
        _ if fit.robustness.is_some() => {
            (fit.robustness.as_ref().map_or(0.0, |robustness| robustness.deviance), p + 1.0)
        }
        true => (fit.sum_of_squares, p),
        // The misfit of an exact fit is limited by rounding.
        false => (n * (fit.sum_of_squares / n).max(f64::EPSILON.powi(2)).ln(), p + 1.0),
    };
    let left = n - q - 1.0;
    (left > 0.0).then(|| misfit + 2.0 * q + 2.0 * q * (q + 1.0) / left)
}
