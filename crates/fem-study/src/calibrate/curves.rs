//! Curves of restitutions for figures: the data, the best series and the single Maxwell term.

use fem_data::estimate::FitError;
use fem_material::PronyTerm;

use super::calibration::Calibration;
use super::experiment::Experiment;
use super::speed_span::ends;

/// Number of points of a curve over the speed.
const N: usize = 33;
/// Factor by which the range of a single speed is widened to both sides.
const BESIDE: f64 = 2.0;

/// The quantity over which restitutions are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Abscissa {
    /// The approach speed, m/s, for one pair of bodies.
    Speed,
    /// The elastic contact time, s, for several pairs: the restitution of linear bodies depends on nothing else except
    /// the small ratio of contact radius to sphere radius.
    ContactTime,
}

impl Abscissa {
    /// Returns the largest |p| of 1 − e ∝ x^p that linear bodies can have; T ∝ v^(−1/5).
    pub fn steepest_loss(self) -> f64 {
        match self {
            Self::Speed => 0.2,
            Self::ContactTime => 1.0,
        }
    }
}

/// Restitutions over speed or contact time, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct RestitutionCurves {
    /// The quantity over which they are drawn.
    pub over: Abscissa,
    /// Smallest and largest value of the abscissa, widened around a single one.
    pub range: (f64, f64),
    /// The measured restitutions in the order of the data.
    pub data: Vec<(f64, f64)>,
    /// Restitutions of the best series, ascending in the abscissa: over a range of speeds, or at the data.
    pub best: Vec<(f64, f64)>,
    /// Restitutions of the single Maxwell term, at the same places.
    pub maxwell: Vec<(f64, f64)>,
    /// Restitutions of the measured relaxation alone, at the same places; `None` without prior knowledge.
    pub prior: Option<Vec<(f64, f64)>>,
}

/// A collision that is drawn.
#[derive(Clone, Copy)]
struct Sample<'a> {
    x: f64,
    experiment: &'a Experiment,
    speed: f64,
}

impl Calibration {
    /// Returns the restitutions of the data, of the best series and of the single Maxwell term.
    ///
    /// # Errors
    /// A collision cannot be computed.
    pub fn curves(&self) -> Result<RestitutionCurves, FitError> {
        let over =
            if self.experiments.len() == 1 { Abscissa::Speed } else { Abscissa::ContactTime };
        let measured = self.samples(over);
        let xs: Vec<f64> = measured.iter().map(|sample| sample.x).collect();
        let (low, high) = ends(&xs);
        let range = if low < high { (low, high) } else { (low / BESIDE, high * BESIDE) };
        let mut drawn = match &self.experiments[..] {
            [only] => {
                let share = |k: usize| k as f64 / (N - 1) as f64;
                let speed = |k| range.0 * (range.1 / range.0).powf(share(k));
                let sample = |speed| Sample { x: speed, experiment: only, speed };
                (0..N).map(speed).map(sample).collect()
            }
            _ => measured,
        };
        drawn.sort_by(|a, b| a.x.total_cmp(&b.x));
        let curve = |terms: &[PronyTerm]| -> Result<Vec<(f64, f64)>, FitError> {
            let at = |one: &Sample<'_>| Ok((one.x, one.experiment.restitution(terms, one.speed)?));
            drawn.iter().map(at).collect()
        };
        let points = self.measured.data.points.iter().zip(xs_in_order(&self.experiments, &xs));
        Ok(RestitutionCurves {
            over,
            range,
            best: curve(&self.terms())?,
            maxwell: curve(&[self.maxwell.term()])?,
            prior: self.prior_terms().map(|terms| curve(&terms)).transpose()?,
            data: points.map(|(point, x)| (x, point.restitution)).collect(),
        })
    }

    /// Returns the collisions of the data, pair by pair.
    fn samples(&self, over: Abscissa) -> Vec<Sample<'_>> {
        let of_pair = |experiment| {
            let Experiment { speeds, contact_times, .. }: &Experiment = experiment;
            let places = match over {
                Abscissa::Speed => speeds,
                Abscissa::ContactTime => contact_times,
            };
            let both = places.iter().zip(speeds);
            both.map(move |(&x, &speed)| Sample { x, experiment, speed })
        };
        self.experiments.iter().flat_map(of_pair).collect()
    }
}

/// Reorders values from the order of the pairs to that of the data.
fn xs_in_order(experiments: &[Experiment], xs: &[f64]) -> Vec<f64> {
    let points = experiments.iter().flat_map(|experiment| &experiment.points);
    let mut ordered = vec![0.0; xs.len()];
    for (point, x) in points.zip(xs) {
        ordered[*point] = *x;
    }
    ordered
}
