//! Restitution and contact time over speed, to which the laws of other codes are fitted.

use crate::fit::{FitError, Point};
use fem_case::schema::{ModelTable, TingTable};
use fem_case::{Body, Case, ModelChoice, Scene};
use fem_laws::{EndRule, HertzImpact, ImpactQuantities, LawFamily, Pair};

use super::chosen_law::model_of;
use super::law_fault::LawFault;
use super::stored_fit::{RestitutionBand, StoredFit};
use crate::measured::{DataError, Restitutions};
use fem_simulation::{
    Reduced, bounds_of_closed_forms, mean_pressure_impact, restitution_with_adhesion,
};

/// Number of speeds at which a reduced model is computed.
const N_SPEEDS: usize = 13;
/// Error of e at which a law counts as valid, without scatter.
const DEFAULT_TOLERANCE: f64 = 0.01;

/// Restitutions and contact times, ascending in speed.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpactCurve {
    /// The points of the curve, at least two.
    pub points: Vec<Point>,
    /// Whether Hertz' contact times replace missing ones.
    pub has_hertz_times: bool,
    /// Materials whose loss is taken as 0 because the caller asks for elastic bodies; empty for measured data.
    pub unknown_loss: Vec<String>,
    /// The law that the curve is that of, if it was fitted to data or stands in for elements that flow.
    pub law: Option<LawFamily>,
    /// The deviation of e that is explained by the scatter of the data: three standard deviations of measured points, one
    /// of a law fitted to them, the error of the law that stands in for elements, 0 for other computed points.
    pub scatter: f64,
    /// The confidence band of a law that was fitted to data.
    pub band: Option<RestitutionBand>,
}

impl ImpactCurve {
    /// Returns the curve of data. If a contact time is missing, Hertz' contact times with instantaneous moduli replace
    /// all.
    ///
    /// # Errors
    /// The data have one speed only, or a speed has no Hertz impact.
    pub fn measured(scene: &Scene, data: &Restitutions) -> Result<Self, LawFault> {
        if data.points.len() < 2 {
            let error = DataError::new(&data.name, "one speed only");
            return Err(error.with_help("a range of validity needs two speeds or more").into());
        }
        let curve = Self::of(&scene.pair()?, data.points.clone())?;
        let uncertainties = data.points.iter().map(|point| point.restitution_uncertainty);
        let given: Option<Vec<f64>> = uncertainties.collect();
        let deviation = given.map_or_else(|| standard_deviation(&curve.points), |all| rms(&all));
        Ok(Self { scatter: 3.0 * deviation, ..curve })
    }

    /// Computes the curve of a fitted law over the speeds of its data, or from one speed to another, m/s.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn fitted(fit: &StoredFit, speeds: Option<(f64, f64)>) -> Result<Self, LawFault> {
        let point = |speed: f64| {
            let outcome = fit.model.outcome(&fit.values, speed)?;
            let point = Point::new(speed, outcome.restitution);
            Ok(Point { contact_time: outcome.contact_time, ..point })
        };
        let points = speeds_between(speeds.unwrap_or(fit.speeds)).map(point);
        let points = points.collect::<Result<_, FitError>>()?;
        let curve = Self::of(fit.model.pair(), points)?;
        let band = fit.band.clone();
        Ok(Self { law: Some(fit.family()), scatter: fit.scatter, band, ..curve })
    }

    /// Computes the curve with the case's contact law, or Ting's model in place of any other and the mean-pressure law for bodies
    /// that flow, from one speed to another, m/s, or over a decade around that of the case. Speeds at which the restitution is
    /// a bound are left out, unless bodies count as elastic.
    ///
    /// # Errors
    /// The restitution is a bound at the case's speed or at most speeds; the case has no such model; the bodies stick; or a
    /// collision cannot be computed.
    pub fn computed(
        case: &Case,
        speeds: Option<(f64, f64)>,
        as_elastic: bool,
    ) -> Result<Self, LawFault> {
        let scene = case.scene();
        let (middle, decade) = (scene.approach_speed(), 10f64.sqrt());
        let range = speeds.unwrap_or((middle / decade, middle * decade));
        let is_known = |speed: &f64| as_elastic || bounds_of_closed_forms(scene, *speed).is_empty();
        let known: Vec<f64> = speeds_between(range).filter(is_known).collect();
        if known.len() < 2 {
            return Err(LawFault::Bound(bounds_of_closed_forms(scene, middle)));
        }
        let is_law = matches!(scene.model(), ModelChoice::Law { .. });
        if scene.flows() && !is_law && !as_elastic {
            return Self::flowing(case, &known);
        }
        let reduced = reduced(case)?;
        let point = |speed: f64| {
            let impact = reduced.impact(speed)?;
            let restitution = restitution_with_adhesion(scene, speed, impact.restitution);
            let point = Point::new(speed, restitution);
            Ok(Point { contact_time: impact.contact_time, ..point })
        };
        let points = known.into_iter().map(point).collect::<Result<_, FitError>>()?;
        let of_elastic = scene.bodies_of_unknown_loss(false).filter(|_| as_elastic);
        let mut unknown_loss: Vec<String> =
            of_elastic.filter_map(|body| body.material_name().map(String::from)).collect();
        unknown_loss.dedup();
        Ok(Self { unknown_loss, ..Self::of(&reduced.scene().pair()?, points)? })
    }

    /// Computes the curve of bodies that flow by the mean-pressure law, whose error is the scatter. Beside a body that relaxes
    /// it takes the restitution of both losses as the product of both, of which half of the second one is uncertain.
    fn flowing(case: &Case, speeds: &[f64]) -> Result<Self, LawFault> {
        let scene = case.scene();
        let pair = scene.pair()?;
        let relaxes = |body: &Body| body.material().is_some_and(|it| it.relaxation().is_some());
        let relaxing = match scene.bodies().iter().any(relaxes) {
            true => Some(reduced(case)?),
            false => None,
        };
        let mut scatter = 0.0f64;
        let points = speeds.iter().map(|&speed| {
            let hertz = HertzImpact::new(&pair, speed)?;
            let flowing = mean_pressure_impact(scene, &hertz);
            let impact = flowing.map_or(ImpactQuantities::from(&hertz), |it| it.quantities);
            let error = flowing.map_or(0.0, |it| it.errors[0] * it.quantities.restitution);
            let relaxed = match &relaxing {
                Some(reduced) => reduced.impact(speed)?.restitution,
                None => 1.0,
            };
            scatter = scatter.max(error + 0.5 * (1.0 - relaxed) * impact.restitution);
            let restitution = restitution_with_adhesion(scene, speed, relaxed * impact.restitution);
            let point = Point::new(speed, restitution);
            let contact_time = Some(impact.contact_time).filter(|time| time.is_finite());
            Ok(Point { contact_time, ..point })
        });
        let points = points.collect::<Result<_, FitError>>()?;
        let curve = Self::of(&pair, points)?;
        Ok(Self { law: Some(LawFamily::MeanPressure), scatter, ..curve })
    }

    fn of(pair: &Pair, mut points: Vec<Point>) -> Result<Self, FitError> {
        points.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let has_hertz_times = points.iter().any(|point| point.contact_time.is_none());
        for point in &mut points {
            if has_hertz_times {
                point.contact_time = Some(HertzImpact::new(pair, point.speed)?.contact_time());
            }
            point.restitution_uncertainty = None;
        }
        let (unknown_loss, law, scatter, band) = (Vec::new(), None, 0.0, None);
        Ok(Self { points, has_hertz_times, unknown_loss, law, scatter, band })
    }

    /// Returns the slowest and the fastest speed, m/s.
    pub fn speeds(&self) -> (f64, f64) {
        (self.points[0].speed, self.points[self.points.len() - 1].speed)
    }

    /// Returns the error of e up to which a law counts as valid by default: 0.01, or the scatter of the data if that is
    /// larger.
    pub fn default_tolerance(&self) -> f64 {
        self.scatter.max(DEFAULT_TOLERANCE)
    }

    /// Returns the range of validity of a law, whose restitution is given by speed: first speed, last speed (m/s) and
    /// the largest error of e. The range is the longest run of neighbouring speeds with errors within the tolerance; its
    /// first speed is above its last if there is none.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn validity(
        &self,
        tolerance: f64,
        restitution: impl Fn(f64) -> Result<f64, FitError>,
    ) -> Result<[f64; 3], FitError> {
        let mut worst = 0.0f64;
        let mut runs: Vec<(usize, usize)> = Vec::new();
        for (index, point) in self.points.iter().enumerate() {
            let error = (restitution(point.speed)? - point.restitution).abs();
            worst = worst.max(error);
            if error > tolerance {
                continue;
            }
            match runs.last_mut() {
                Some(run) if run.1 + 1 == index => run.1 = index,
                _ => runs.push((index, index)),
            }
        }
        let longest = runs.iter().max_by_key(|run| run.1 - run.0);
        let (from, to) = longest.map_or((f64::INFINITY, 0.0), |(first, last)| {
            (self.points[*first].speed, self.points[*last].speed)
        });
        Ok([from, to, worst])
    }
}

/// Returns speeds in equal ratios, m/s.
fn speeds_between((low, high): (f64, f64)) -> impl Iterator<Item = f64> {
    (0..N_SPEEDS).map(move |k| low * (high / low).powf(k as f64 / (N_SPEEDS - 1) as f64))
}

fn rms(values: &[f64]) -> f64 {
    let sum: f64 = values.iter().map(|value| value * value).sum();
    (sum / values.len().max(1) as f64).sqrt()
}

/// Returns the standard deviation of the restitutions about any smooth curve over the logarithm of speed, from the
/// distance of each point to the line between its neighbours; 0 for fewer than three points.
///
/// The estimator is that of Gasser, Sroka & Jennen-Steinmetz 1986, *Biometrika* **73**, 625.
fn standard_deviation(points: &[Point]) -> f64 {
    let distance = |three: &[Point]| {
        let [first, middle, last] = [&three[0], &three[1], &three[2]];
        let span = (last.speed / first.speed).ln();
        let share = if span > 0.0 { (last.speed / middle.speed).ln() / span } else { 0.5 };
        let line = share * first.restitution + (1.0 - share) * last.restitution;
        let weight = share * share + (1.0 - share) * (1.0 - share) + 1.0;
        (line - middle.restitution) / weight.sqrt()
    };
    rms(&points.windows(3).map(distance).collect::<Vec<_>>())
}

/// Returns the case's own model, or Ting's in place of one with elements.
fn reduced(case: &Case) -> Result<Reduced, LawFault> {
    let of = |case: &Case| Reduced::new(case.scene()).map_err(|refusal| refusal.in_case(case));
    if !matches!(case.scene().model(), ModelChoice::Fem | ModelChoice::Condensed(_)) {
        return Ok(of(case)?);
    }
    model_of(case.scene(), LawFamily::Ting, EndRule::ZeroForce).map_err(LawFault::NoStandIn)?;
    let half_spaces = TingTable { finite_size: Some(false), ..TingTable::default() };
    let model = ModelTable { ting: Some(half_spaces), ..ModelTable::default() };
    Ok(of(&case.edited(|file| file.model = Some(model))?)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line over the logarithm of speed has no scatter, and alternating errors ± s have the standard deviation s in the
    /// mean of many: each point is 2 s from the line between its neighbours.
    #[test]
    fn the_scatter_of_points_is_that_about_a_smooth_curve() {
        let curve = |error: f64| -> Vec<Point> {
            let signs = (0..40).map(|k| if k % 2 == 0 { error } else { -error });
            let speeds = (0..40).map(|k| 0.1 * 1.1f64.powi(k));
            speeds.zip(signs).map(|(v, s)| Point::new(v, 0.9 - 0.02 * v.ln() + s)).collect()
        };
        assert!(standard_deviation(&curve(0.0)) < 1e-12);
        let expected = 0.02 * 2.0 / 1.5f64.sqrt();
        assert!((standard_deviation(&curve(0.02)) / expected - 1.0).abs() < 1e-9);
        assert_eq!(standard_deviation(&curve(0.02)[..2]), 0.0);
    }
}
