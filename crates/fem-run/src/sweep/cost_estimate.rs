//! Cost estimate of a sweep: some of its members are forecast as single runs are.

use std::time::{Duration, Instant};

use fem::sweep::{Checked, Members};
use fem::{Cost, ErrorEstimator, RefinedBeforeRun, Simulation};
use fem_case::{Case, Sweep};
use rayon::ThreadPool;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::forecast::Forecast;

/// Time for reference runs that find the mesh of a member.
const TIME_FOR_REFERENCE_RUNS: Duration = Duration::from_millis(500);

/// Members that are forecast, spread from the most expensive to the cheapest of those left.
const N_SAMPLES: usize = 12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepCost {
    /// With the expected mesh refinements.
    pub all: TotalTime,
    /// With all mesh refinements that may follow, if some may.
    pub most: Option<TotalTime>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TotalTime {
    /// Sum over all members, s.
    pub seconds: f64,
    longest: f64,
}

struct ForecastSample {
    /// Its rank among the members left, by cost.
    rank: usize,
    /// Forecast run time over the estimate from the element updates.
    ratio: f64,
    /// The same with all mesh refinements that may follow.
    most: f64,
}

impl SweepCost {
    pub fn of(sweep: &Sweep, checked: &Checked, pool: &ThreadPool) -> Self {
        let n = checked.left.len();
        let n_samples = n.min(N_SAMPLES);
        let rank_of = |k: usize| k * n.saturating_sub(1) / n_samples.saturating_sub(1).max(1);
        let are_shared = checked.advice.is_none();
        let look = |k: usize| {
            let rank = rank_of(k);
            let [seconds, most] = seconds_of(sweep.case(checked.left[rank]).ok()?, are_shared)?;
            let expected = checked.seconds[rank];
            Some(ForecastSample { rank, ratio: seconds / expected, most: most / expected })
        };
        let samples = pool.install(|| (0..n_samples).into_par_iter().filter_map(look).collect());
        let samples: Vec<ForecastSample> = samples;
        let total = |ratio: fn(&ForecastSample) -> f64| {
            let mut total = TotalTime::default();
            for (rank, seconds) in checked.seconds.iter().enumerate() {
                total.add(seconds * at_rank(&samples, ratio, rank));
            }
            total
        };
        let is_open = samples.iter().any(|sample| sample.most > sample.ratio);
        Self { all: total(|sample| sample.ratio), most: is_open.then(|| total(|it| it.most)) }
    }
}

impl TotalTime {
    fn add(&mut self, seconds: f64) {
        self.seconds += seconds;
        self.longest = self.longest.max(seconds);
    }

    /// Returns the time on `n_threads` threads that run one member each, s.
    pub fn on(&self, n_threads: usize) -> f64 {
        (self.seconds / n_threads as f64).max(self.longest)
    }
}

/// Returns the run time of a member and that with all mesh refinements that may follow, s; `None` for
/// models without elements. Bodies that members share are made once.
fn seconds_of(case: Case, are_shared: bool) -> Option<[f64; 2]> {
    let begin = Instant::now();
    let simulation = Simulation::new(case).ok()?;
    let making = begin.elapsed().as_secs_f64();
    let mut estimator = ErrorEstimator::default();
    let RefinedBeforeRun { simulation, is_open } =
        estimator.refine_before_run(simulation, || begin.elapsed() < TIME_FOR_REFERENCE_RUNS);
    let setup = begin.elapsed().as_secs_f64();
    let is_made_before = are_shared && matches!(simulation.setup().cost, Cost::Factors { .. });
    let (making, setup) = if is_made_before { (0.0, 0.0) } else { (making, setup) };
    let forecast = Forecast::of(&simulation, &mut estimator, making, is_open);
    let all = forecast.seconds?;
    let most = match simulation.setup().cost {
        Cost::Steps { .. } => forecast.most_seconds()?,
        // Few condensed members are refined, and the finest mesh would cost more than thousands
        // of them.
        _ => all,
    };
    Some([all, most].map(|seconds| setup + seconds))
}

/// Interpolates a ratio geometrically between the samples; 1 without samples.
fn at_rank(samples: &[ForecastSample], of: fn(&ForecastSample) -> f64, rank: usize) -> f64 {
    let above = samples.iter().rfind(|sample| sample.rank <= rank).or(samples.first());
    let below = samples.iter().find(|sample| sample.rank >= rank).or(samples.last());
    let (Some(above), Some(below)) = (above, below) else { return 1.0 };
    let between = below.rank.saturating_sub(above.rank);
    let share = if between == 0 { 0.0 } else { (rank - above.rank) as f64 / between as f64 };
    of(above) * (of(below) / of(above)).powf(share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cost_between_samples_is_interpolated_geometrically() {
        let sample = |rank, ratio| ForecastSample { rank, ratio, most: 2.0 * ratio };
        let samples = [sample(2, 16.0), sample(4, 4.0), sample(6, 1.0)];
        let told = [0, 2, 3, 4, 5, 6, 9].map(|rank| at_rank(&samples, |it| it.ratio, rank));
        assert_eq!(told, [16.0, 16.0, 8.0, 4.0, 2.0, 1.0, 1.0]);
        assert_eq!(at_rank(&[], |it| it.most, 3), 1.0);
    }

    /// A sweep takes at least as long as its longest member.
    #[test]
    fn sweep_time_is_at_least_that_of_its_longest_member() {
        let mut total = TotalTime::default();
        [5.0, 4.0, 3.0].into_iter().for_each(|seconds| total.add(seconds));
        assert_eq!([1, 2, 4].map(|n| total.on(n)), [12.0, 6.0, 5.0]);
    }
}
