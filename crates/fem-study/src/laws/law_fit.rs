//! A law that is fitted to restitutions, and how well the data determine it.

use fem_case::engineering::number;
use fem_case::schema::End;
use fem_case::{Case, half_difference};
use fem_data::estimate::{
    Estimate, Fit, FitError, Free, InputPart, Model, Point, Problem, Profile, Robustness, SPEED,
};
use fem_laws::{LawFamily, ParameterRole};

use super::chosen_law::{ChosenLaw, open_from, strength_at_reference_rate, strength_words};
use super::law_fault::LawFault;
use super::law_ranking::LawRanking;
use fem_data::estimate::loss_parameter;
use fem_data::table::Restitutions;

/// Number of values of a profile.
const GRID: usize = 25;
/// Half the width of that grid, in widths of the parameter's interval if that is known.
const GRID_REACH: f64 = 2.5;
/// The grid of a plain number spans at least the damping exponents of all laws.
const EXPONENTS: (f64, f64) = (0.4, 1.1);
/// Number of speeds of a curve.
const CURVE_SPEEDS: usize = 80;
/// Error of another law that dents over that of the mean-pressure law, below which flow does not explain data.
const FAR_FROM_ELEMENTS: f64 = 0.5;
/// Number of points that stand for all of them where a law's own error is computed.
const GROUPS: usize = 8;
/// Larger misfits, in multiples of the variances, are not scatter.
const LARGE_CHI_SQUARE: f64 = 2.0;

/// A fitted law, its data, and the laws that are compared with it.
#[derive(Clone, Debug)]
pub struct LawFit<'a> {
    /// The restitutions that the law is fitted to.
    pub data: &'a Restitutions,
    /// The law that was fitted.
    pub problem: Problem<'a>,
    /// The best values.
    pub fit: Fit,
    /// The error over one parameter, with all others refitted.
    pub profile: Option<Profile>,
    /// Other laws on the same data.
    pub compared: Vec<(Model, Fit)>,
    /// Confidence level of the intervals.
    pub confidence: f64,
    /// Parts of uncertain inputs of the case in the errors of θ of the free parameters, which are logarithms of scale factors and plain
    /// numbers.
    pub inputs: Vec<InputPart>,
    /// Changes of θ of the free parameters by the law's own error; NaN if there is no fit with it. Zeros for laws that do not dent.
    pub by_law: Vec<f64>,
    /// The least strength, Pa, if all larger ones fit within the error of the law, too.
    pub at_least: Option<f64>,
    /// The fitted yield strength at the reference rate of the case's flow rule, Pa, if that is another.
    pub strength_at_reference_rate: Option<f64>,
}

impl<'a> LawFit<'a> {
    /// Names of the columns of [`LawFit::residuals`].
    pub const RESIDUAL_COLUMNS: [&'static str; 8] = [
        "speed_m_s",
        "restitution",
        "restitution_uncertainty",
        "fitted_restitution",
        "residual",
        "contact_time_s",
        "fitted_contact_time_s",
        "weight",
    ];

    /// Fits a law to measured restitutions.
    ///
    /// # Errors
    /// The data do not determine the free parameters.
    pub fn of(
        data: &'a Restitutions,
        problem: Problem<'a>,
        confidence: f64,
    ) -> Result<Self, LawFault> {
        let fit = problem.fit(confidence)?;
        let (profile, compared, inputs) = (None, Vec::new(), Vec::new());
        let by_law = vec![0.0; fit.estimates.len()];
        Ok(Self {
            data,
            problem,
            fit,
            profile,
            compared,
            confidence,
            inputs,
            by_law,
            at_least: None,
            strength_at_reference_rate: None,
        })
    }

    /// Adds the uncertain inputs of the case and the error of the law to standard errors and intervals, by fitting again with each; `law`
    /// is that of the problem.
    pub fn with_inputs(mut self, case: &Case, law: &ChosenLaw) -> Self {
        let problem = &self.problem;
        let strength = self.fit.estimates.iter().find(|estimate| estimate.key == "yield_strength");
        self.strength_at_reference_rate = strength.and_then(|estimate| {
            let strength = self.fit.values[estimate.index];
            strength_at_reference_rate(case.scene(), law.family(), strength)
        });
        let own = problem.theta_of(&self.fit.values);
        let keys: Vec<&str> = self.fit.estimates.iter().map(|estimate| estimate.key).collect();
        let refit = |law: &ChosenLaw, points: &[Point]| -> Option<Vec<f64>> {
            let near = law.problem(points, &keys).ok()?.near(problem, &self.fit);
            let theta = near.theta_of(&near.solve().ok()?.0);
            Some(theta.iter().zip(&own).map(|(changed, own)| changed - own).collect())
        };
        let points = &self.data.points;
        self.inputs = InputPart::of(case, keys.len(), &[SPEED], |case| {
            refit(&law.in_case(case).ok()?, points)
        });
        if let Some(strength) = law.family().strength_parameter() {
            let (values, groups) = (&self.fit.values, self.groups());
            let range = law.range(case.scene(), strength, values, &groups, self.scatter());
            let of_strength = (values[strength] / range.0).max(range.1 / values[strength]).ln();
            self.at_least = open_from(range);
            let others = match problem.free.iter().all(|free| free.index == strength) {
                true => vec![0.0],
                false => {
                    let shifted = self.shifted_by_error(case, law, &groups);
                    let both = shifted.map(|points| refit(law, &points?));
                    let both = both.each_ref().map(Option::as_deref);
                    // Where larger restitutions fit any strength, no interval has an end.
                    match both {
                        [Some(above), Some(below)] => half_difference(above, below),
                        _ => vec![f64::NAN; keys.len()],
                    }
                }
            };
            let of_free = |(free, other): (&Free, f64)| match free.index == strength {
                true => of_strength,
                false => other,
            };
            self.by_law = problem.free.iter().zip(others).map(of_free).collect();
        }
        for (j, (estimate, free)) in self.fit.estimates.iter_mut().zip(&problem.free).enumerate() {
            let error = InputPart::sum(&self.inputs, j).hypot(self.by_law[j]);
            estimate.widen(error, problem.is_logarithmic(free), self.confidence);
        }
        self
    }

    /// Returns the data with restitutions that are larger and smaller by the error of the law, which has one sign at all speeds and that of
    /// the nearest group; `None` if an error is not known.
    fn shifted_by_error(
        &self,
        case: &Case,
        law: &ChosenLaw,
        groups: &[(Point, f64)],
    ) -> [Option<Vec<Point>>; 2] {
        let error = |(point, _): &(Point, f64)| {
            (point.speed, law.error_at(case.scene(), &self.fit.values, point.speed))
        };
        let errors: Vec<(f64, f64)> = groups.iter().map(error).collect();
        let nearest = |speed: f64| {
            let distance = |it: &&(f64, f64)| (it.0 / speed).ln().abs();
            let found = errors.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            found.map(|(_, error)| *error).filter(|error| error.is_finite())
        };
        [1.0, -1.0].map(|sign| {
            let shifted = |point: &Point| {
                let restitution = point.restitution + sign * nearest(point.speed)?;
                Some(Point { restitution: restitution.clamp(0.0, 1.0), ..*point })
            };
            self.data.points.iter().map(shifted).collect()
        })
    }

    /// Returns a few points that stand for neighbours in speed, with the sums of their weights: the error of a law is a smooth function
    /// of the speed and takes milliseconds.
    fn groups(&self) -> Vec<(Point, f64)> {
        let weighted = self.data.points.iter().zip(self.weights()).map(|(point, weight)| {
            let uncertainty = point.restitution_uncertainty.unwrap_or(1.0);
            (*point, weight / (uncertainty * uncertainty))
        });
        let mut weighted: Vec<(Point, f64)> = weighted.collect();
        weighted.sort_by(|a, b| a.0.speed.total_cmp(&b.0.speed));
        let n_each = weighted.len().div_ceil(GROUPS).max(1);
        let group = |all: &[(Point, f64)]| {
            let sum = |of: fn(&Point) -> f64| {
                all.iter().map(|(point, weight)| weight * of(point)).sum::<f64>()
            };
            let weight = sum(|_| 1.0);
            let speed = (sum(|point| point.speed.ln()) / weight).exp();
            (Point::new(speed, sum(|point| point.restitution) / weight), weight)
        };
        let groups = weighted.chunks(n_each).map(group);
        groups.filter(|(_, weight)| *weight > 0.0).collect()
    }

    /// Returns the change of a free parameter, SI, for a small change of its θ.
    pub fn scale_of(&self, estimate: &Estimate) -> f64 {
        let free = self.problem.free.iter().find(|free| free.index == estimate.index);
        let is_logarithmic = free.is_some_and(|free| self.problem.is_logarithmic(free));
        if is_logarithmic { estimate.value } else { 1.0 }
    }

    /// Returns the part of the law's own error in the standard error of a free parameter, SI.
    pub fn error_by_law(&self, estimate: &Estimate) -> f64 {
        let own = self.fit.estimates.iter().position(|it| it.index == estimate.index);
        own.map_or(0.0, |j| (self.scale_of(estimate) * self.by_law[j]).abs())
    }

    /// Adds the profile of a free parameter.
    ///
    /// # Errors
    /// At some value the others cannot be fitted.
    pub fn with_profile(mut self, free: &Free) -> Result<Self, LawFault> {
        self.profile = Some(self.problem.profile(&self.fit, free, &grid(free, &self.fit))?);
        Ok(self)
    }

    /// Adds another law. Its loss is free, and if there are contact times, so is a stiffness that no theory gives.
    ///
    /// # Errors
    /// The law has no loss, or cannot be fitted.
    pub fn compared_with(mut self, family: LawFamily) -> Result<Self, LawFault> {
        let model = self.problem.model.with_family(family)?;
        let mut free = vec![family.parameters()[loss_parameter(family)?].key];
        // Restitutions do not depend on the stiffness.
        if self.data.points.iter().any(|point| point.contact_time.is_some()) {
            let parameters = family.parameters().iter();
            let stiff = parameters.filter(|parameter| parameter.role == ParameterRole::Stiffness);
            free.extend(stiff.map(|parameter| parameter.key));
        }
        let is_robust = self.problem.is_robust;
        let problem = Problem::new(&model, &self.data.points, &free)?.robust(is_robust);
        let law = family.name();
        let fitted = |error: FitError| LawFault::Compared { law, error };
        let fit = problem.fit(self.confidence).map_err(fitted)?;
        self.compared.push((model, fit));
        Ok(self)
    }

    /// Adds all laws of a ranking in their order, without the best, which is this one.
    pub fn compared_with_ranked(mut self, ranking: &LawRanking) -> Self {
        let others = ranking.laws.iter().skip(1);
        self.compared.extend(others.map(|law| (law.model.clone(), law.fit.clone())));
        self
    }

    /// Returns the fitted law, and then those that are compared with it.
    pub fn laws(&self) -> impl Iterator<Item = (&Model, &Fit)> {
        let compared = self.compared.iter().map(|(model, fit)| (model, fit));
        std::iter::once((self.problem.model, &self.fit)).chain(compared)
    }

    /// Returns the speeds at which the laws are drawn, m/s: over the range of the data, or around a single speed.
    pub fn curve_speeds(&self) -> Vec<f64> {
        let (low, high) = self.data.speeds();
        let (low, high) = if low < high { (low, high) } else { (low / 2.0, high * 2.0) };
        let share = |k: usize| k as f64 / (CURVE_SPEEDS - 1) as f64;
        (0..CURVE_SPEEDS).map(|k| low * (high / low).powf(share(k))).collect()
    }

    /// Returns the restitutions of one of the laws at some speeds, m/s; `None` where it cannot be computed.
    pub fn curve((model, fit): (&Model, &Fit), speeds: &[f64]) -> Vec<Option<f64>> {
        let restitution = |speed: &f64| Some(model.outcome(&fit.values, *speed).ok()?.restitution);
        speeds.iter().map(restitution).collect()
    }

    /// Returns the ends of the confidence band of the fitted law's restitution at some speeds, m/s; `None` where there is none.
    pub fn band(&self, speeds: &[f64]) -> Vec<Option<(f64, f64)>> {
        let curve = Self::curve((self.problem.model, &self.fit), speeds);
        let ends = |(speed, restitution): (&f64, Option<f64>)| {
            let (restitution, half) = (restitution?, self.problem.band(&self.fit, *speed)?);
            Some(((restitution - half).max(0.0), (restitution + half).min(1.0)))
        };
        speeds.iter().zip(curve).map(ends).collect()
    }

    /// Returns data, fitted values and their differences, one row per point; SI.
    pub fn residuals(&self) -> impl Iterator<Item = [Option<f64>; 8]> {
        self.problem.points.iter().zip(self.weights()).map(|(point, weight)| {
            let fitted = self.problem.model.outcome(&self.fit.values, point.speed).ok();
            let restitution = fitted.map(|fitted| fitted.restitution);
            [
                Some(point.speed),
                Some(point.restitution),
                point.restitution_uncertainty,
                restitution,
                restitution.map(|restitution| restitution - point.restitution),
                point.contact_time,
                fitted.and_then(|fitted| fitted.contact_time),
                Some(weight),
            ]
        })
    }

    /// Returns the weight of each point, the least of its values: 1 if the fit is not robust.
    pub fn weights(&self) -> Vec<f64> {
        let robustness = self.fit.robustness.as_ref();
        let mut weights = robustness.into_iter().flat_map(|robustness| &robustness.weights);
        let of_point = |point: &Point| {
            let n_values = 1 + usize::from(point.contact_time.is_some());
            weights.by_ref().take(n_values).copied().fold(1.0, f64::min)
        };
        self.problem.points.iter().map(of_point).collect()
    }

    /// Returns the root mean square of the residuals of e, with their weights.
    pub fn scatter(&self) -> f64 {
        let residuals = self.residuals().filter_map(|row| row[4].zip(row[7]));
        let (n, sum) = residuals.fold((0.0, 0.0), |(n, sum), (r, w)| (n + w, sum + w * r * r));
        f64::sqrt(sum / f64::max(n, f64::MIN_POSITIVE))
    }

    /// Returns the law as the table `[model]` of a case; `None` for Ting's, whose parameter is the material's relaxation.
    pub fn model_toml(&self) -> Option<String> {
        let family = self.problem.model.family();
        if family == LawFamily::Ting {
            return None;
        }
        let parameters = family.parameters().iter().zip(&self.fit.values);
        let mut keys: Vec<String> = parameters
            .map(|(parameter, value)| {
                // Enough digits for the restitution, and not those of a false precision.
                format!("{} = {}", parameter.key, number(*value, 6))
            })
            .collect();
        if family.end_rule().is_none() {
            let end = End::from(self.problem.model.end_rule());
            keys.push(format!("end = \"{}\"", end.word()));
        }
        Some(format!("[model]\nlaw = {{ {} = {{ {} }} }}\n", family.name(), keys.join(", ")))
    }

    /// Returns warnings about the fit.
    pub fn warnings(&self) -> Vec<String> {
        let (fit, problem) = (&self.fit, &self.problem);
        let mut warnings = self.data.warnings();
        for estimate in fit.estimates.iter().filter(|estimate| estimate.is_at_bound) {
            warnings.push(format!("{} is at its bound: the best value lies beyond", estimate.key));
        }
        warnings.extend(self.strength_at_reference_rate.map(strength_words));
        if fit.degrees_of_freedom == 0 {
            let what = "there are as many data as parameters: the law passes through them, which does \
                        not show whether it is right";
            warnings.push(what.to_string());
        }
        let chi_square = match &fit.robustness {
            Some(robustness) => robustness.scale.powi(2),
            None => fit.sum_of_squares / fit.degrees_of_freedom.max(1) as f64,
        };
        warnings.extend(fit.robustness.as_ref().and_then(Robustness::warning));
        let is_misfit = fit.degrees_of_freedom > 0 && chi_square > LARGE_CHI_SQUARE;
        if problem.has_uncertainties() && is_misfit {
            warnings.push(format!(
                "the misfit is {:.1} times the uncertainties: the law is wrong or they are too \
                 small, and so are the intervals",
                chi_square.sqrt()
            ));
        }
        let family = problem.model.family();
        let elements = self.compared.iter().find(|law| law.0.family() == LawFamily::MeanPressure);
        if let Some((_, flowing)) = elements
            && family.is_elastic_plastic()
            && fit.rms < FAR_FROM_ELEMENTS * flowing.rms
        {
            warnings.push(format!(
                "{} fits better than mean_pressure, the law of elements that flow (rms error {:.4}): plastic flow alone \
                 cannot explain these data",
                family.name(),
                flowing.rms
            ));
        }
        if !problem.has_uncertainties() && has_trend(&fit.residuals) {
            let what = "the residuals have a trend: the law does not fit the data, so the intervals have \
                        no statistical meaning";
            warnings.push(what.to_string());
        }
        warnings
    }
}

/// Whether neighbouring residuals have opposite signs much less often than in half of the cases, as scatter has.
fn has_trend(residuals: &[f64]) -> bool {
    let changes = residuals.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
    residuals.len() >= 6 && 4 * changes < residuals.len()
}

/// Returns values around the best one, in equal ratios for a logarithmic parameter.
fn grid(free: &Free, fit: &Fit) -> Vec<f64> {
    let best = fit.values[free.index];
    let estimate = fit.estimates.iter().find(|estimate| estimate.index == free.index);
    let is_exponent = estimate.is_some_and(|estimate| estimate.key == "n");
    let (low, high) = match estimate.and_then(|estimate| estimate.interval) {
        _ if is_exponent => (best.min(EXPONENTS.0), best.max(EXPONENTS.1)),
        Some((low, high)) if low > 0.0 => {
            ((low / best).powf(GRID_REACH) * best, (high / best).powf(GRID_REACH) * best)
        }
        _ => (0.5 * best, 2.0 * best),
    };
    let (low, high) = (low.max(free.bounds.0), high.min(free.bounds.1));
    let part = |k: usize| k as f64 / (GRID - 1) as f64;
    (0..GRID)
        .map(|k| match is_exponent {
            true => low + part(k) * (high - low),
            false => low * (high / low).powf(part(k)),
        })
        .collect()
}
