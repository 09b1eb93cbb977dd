//! Restitutions of the series that was found beside the data, to draw.

use crate::fit::FitError;
use fem_material::PronyTerm;

use super::calibration::Calibration;
use super::experiment::Experiment;
use super::speed_span::ends;

/// Points of a curve over the speed.
const N: usize = 33;
/// Space beside a single speed.
const BESIDE: f64 = 2.0;

/// The quantity over which restitutions are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Abscissa {
    /// The approach speed, m/s, of one pair of bodies.
    Speed,
    /// The elastic contact time, s, of several: in linear bodies nothing else counts but for the
    /// small ratio of contact to sphere.
    ContactTime,
}

impl Abscissa {
    /// The largest |p| that linear bodies make of 1 − e ∝ x^p: T ∝ v^(−1/5).
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
    /// From, to; around a place that is the only one.
    pub range: (f64, f64),
    /// In the order of the data.
    pub data: Vec<(f64, f64)>,
    /// Restitutions of the best series, ascending: over a range of speeds, or at the data.
    pub best: Vec<(f64, f64)>,
    /// Restitutions of the single Maxwell term, at the same places.
    pub maxwell: Vec<(f64, f64)>,
}

/// A collision that is drawn.
#[derive(Clone, Copy)]
struct Sample<'a> {
    x: f64,
    experiment: &'a Experiment,
    speed: f64,
}

impl Calibration {
    /// Restitutions of the data, of the best series and of the single Maxwell term.
    ///
    /// # Errors
    /// A collision that cannot be computed.
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
            data: points.map(|(point, x)| (x, point.restitution)).collect(),
        })
    }

    /// The collisions of the data, pair by pair.
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

/// From pair by pair to the order of the data.
fn xs_in_order(experiments: &[Experiment], xs: &[f64]) -> Vec<f64> {
    let points = experiments.iter().flat_map(|experiment| &experiment.points);
    let mut ordered = vec![0.0; xs.len()];
    for (point, x) in points.zip(xs) {
        ordered[*point] = *x;
    }
    ordered
}
