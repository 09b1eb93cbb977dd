//! Restitution and contact time over speed, to which the laws of other codes are fitted.

use fem_case::Scene;
use fem_case::engineering::show;
use fem_data::estimate::{FitError, Point};
use fem_laws::{HertzImpact, LawFamily, Pair};

use super::law_fault::LawFault;
use super::stored_fit::{RestitutionBand, StoredFit};
use fem_data::table::{ACCEPTED_BOUNDS, DataError, Restitutions};

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
    /// The speeds at which the restitution is an upper bound that the caller takes as it is, each with the reason.
    pub bounds: Vec<String>,
    /// The speeds that are left out, each with the reason.
    pub left_out: Vec<String>,
    /// Materials that the case means to be elastic, in a computed curve.
    pub meant_elastic: Vec<String>,
    /// The law that the curve is that of, if it was fitted to data or stands in for elements that flow.
    pub law: Option<LawFamily>,
    /// The deviation of e that is explained by the scatter of the data: three standard deviations of measured points, one
    /// of a law fitted to them, the error of the law that stands in for elements, 0 for other computed points.
    pub scatter: f64,
    /// The confidence band of a law that was fitted to data.
    pub band: Option<RestitutionBand>,
}

impl ImpactCurve {
    /// Returns the curve of data, without those of bodies that stay together. If a contact time is missing, Hertz' contact
    /// times with instantaneous moduli replace all.
    ///
    /// # Errors
    /// The data have one speed only, the bodies stay together at all others, or a speed has no Hertz impact.
    pub fn measured(scene: &Scene, data: &Restitutions) -> Result<Self, LawFault> {
        if data.points.len() < 2 {
            let error = DataError::new(&data.name, "one speed only");
            return Err(error.with_help("a range of validity needs two speeds or more").into());
        }
        let (parted, together): (Vec<Point>, Vec<Point>) =
            data.points.iter().partition(|point| point.restitution > 0.0);
        let speeds = together.iter().map(|point| point.speed);
        let left_out = speeds.reduce(f64::max).map(|fastest| {
            format!(
                "up to {} the bodies stay together, which no dashpot states",
                show(fastest, "m/s")
            )
        });
        if let Some(reason) = left_out.as_ref().filter(|_| parted.len() < 2) {
            let help = "give restitutions at two or more speeds at which the bodies part";
            return Err(LawFault::Sticks(reason.clone(), help.to_string()));
        }
        let curve = Self::of(&scene.pair()?, parted)?;
        let uncertainties = data.points.iter().map(|point| point.restitution_uncertainty);
        let given: Option<Vec<f64>> = uncertainties.collect();
        let deviation = given.map_or_else(|| standard_deviation(&curve.points), |all| rms(&all));
        let bounds = data.accepted_bounds().into_iter().collect();
        let left_out = left_out.into_iter().map(|reason| format!("speeds are left out: {reason}"));
        Ok(Self { scatter: 3.0 * deviation, bounds, left_out: left_out.collect(), ..curve })
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
        let bounds = fit.warnings.iter().filter(|warning| warning.contains(ACCEPTED_BOUNDS));
        let bounds = bounds.map(|warning| format!("of the fitted data, {warning}")).collect();
        Ok(Self { law: Some(fit.family()), scatter: fit.scatter, band, bounds, ..curve })
    }

    pub(super) fn of(pair: &Pair, mut points: Vec<Point>) -> Result<Self, FitError> {
        points.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let has_hertz_times = points.iter().any(|point| point.contact_time.is_none());
        for point in &mut points {
            if has_hertz_times {
                point.contact_time = Some(HertzImpact::new(pair, point.speed)?.contact_time());
            }
            point.restitution_uncertainty = None;
        }
        let (bounds, left_out, meant_elastic) = (Vec::new(), Vec::new(), Vec::new());
        let (law, scatter, band) = (None, 0.0, None);
        Ok(Self { points, has_hertz_times, bounds, left_out, meant_elastic, law, scatter, band })
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
pub(super) fn speeds_between((low, high): (f64, f64)) -> impl Iterator<Item = f64> {
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
