//! What a sweep takes here: of some of its members it is foretold as a run foretells it.

use std::time::{Duration, Instant};

use fem::sweep::{Checked, Members};
use fem::{Cost, Foreseen, Simulation};
use fem_case::{Case, Sweep};
use rayon::ThreadPool;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::forecast::Forecast;

/// Companions that tell the mesh of a member are asked until so much time is spent.
const PATIENCE: Duration = Duration::from_millis(500);

/// Members that are looked at, spread over those that are left, from the dearest to the cheapest.
const N_SAMPLES: usize = 12;

/// What the members that are left take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// With the meshes that are foretold.
    pub all: Total,
    /// With all finer meshes that may follow, where some may.
    pub most: Option<Total>,
}

/// Seconds of members.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Total {
    /// All on one thread.
    pub seconds: f64,
    /// The longest of them.
    longest: f64,
}

/// A member that was looked at.
struct Sample {
    /// Its place among those that are left, the dearest first.
    rank: usize,
    /// What it takes over what was expected by its element updates alone, ...
    ratio: f64,
    /// ... and with all finer meshes that may follow.
    most: f64,
}

impl Expected {
    /// Of the members that are left.
    pub fn of(sweep: &Sweep, checked: &Checked, pool: &ThreadPool) -> Self {
        let n = checked.left.len();
        let n_samples = n.min(N_SAMPLES);
        let rank_of = |k: usize| k * n.saturating_sub(1) / n_samples.saturating_sub(1).max(1);
        let are_shared = checked.advice.is_none();
        let look = |k: usize| {
            let rank = rank_of(k);
            let [seconds, most] = seconds_of(sweep.case(checked.left[rank]).ok()?, are_shared)?;
            let expected = checked.seconds[rank];
            Some(Sample { rank, ratio: seconds / expected, most: most / expected })
        };
        let samples = pool.install(|| (0..n_samples).into_par_iter().filter_map(look).collect());
        let samples: Vec<Sample> = samples;
        let total = |ratio: fn(&Sample) -> f64| {
            let mut total = Total::default();
            for (rank, seconds) in checked.seconds.iter().enumerate() {
                total.add(seconds * at_rank(&samples, ratio, rank));
            }
            total
        };
        let is_open = samples.iter().any(|sample| sample.most > sample.ratio);
        Self { all: total(|sample| sample.ratio), most: is_open.then(|| total(|it| it.most)) }
    }
}

impl Total {
    fn add(&mut self, seconds: f64) {
        self.seconds += seconds;
        self.longest = self.longest.max(seconds);
    }

    /// Seconds on so many threads, a member on each.
    pub fn on(&self, n_threads: usize) -> f64 {
        (self.seconds / n_threads as f64).max(self.longest)
    }
}

/// Seconds of a member, and those with all finer meshes that may follow; none of what has no elements. Bodies that
/// members share are made once.
fn seconds_of(case: Case, are_shared: bool) -> Option<[f64; 2]> {
    let begin = Instant::now();
    let simulation = Simulation::new(case).ok()?;
    let making = begin.elapsed().as_secs_f64();
    let Foreseen { simulation, is_open } = simulation.foreseen(|| begin.elapsed() < PATIENCE);
    let setup = begin.elapsed().as_secs_f64();
    let is_made_before = are_shared && matches!(simulation.setup().cost, Cost::Factors { .. });
    let (making, setup) = if is_made_before { (0.0, 0.0) } else { (making, setup) };
    let forecast = Forecast::of(&simulation, making, is_open, 0);
    let all = forecast.all_seconds()?;
    let most = match simulation.setup().cost {
        Cost::Steps { .. } => forecast.most_seconds()?,
        // Few of them go on, and the last of so many meshes would take more than thousands of them.
        _ => all,
    };
    Some([all, most].map(|seconds| setup + seconds))
}

/// Between samples in proportion to powers of what they tell; 1 where there are none.
fn at_rank(samples: &[Sample], of: fn(&Sample) -> f64, rank: usize) -> f64 {
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
    fn what_is_between_samples_goes_by_powers() {
        let sample = |rank, ratio| Sample { rank, ratio, most: 2.0 * ratio };
        let samples = [sample(2, 16.0), sample(4, 4.0), sample(6, 1.0)];
        let told = [0, 2, 3, 4, 5, 6, 9].map(|rank| at_rank(&samples, |it| it.ratio, rank));
        assert_eq!(told, [16.0, 16.0, 8.0, 4.0, 2.0, 1.0, 1.0]);
        assert_eq!(at_rank(&[], |it| it.most, 3), 1.0);
    }

    /// The longest member takes its time on however many threads.
    #[test]
    fn no_sweep_is_shorter_than_its_longest_member() {
        let mut total = Total::default();
        [5.0, 4.0, 3.0].into_iter().for_each(|seconds| total.add(seconds));
        assert_eq!([1, 2, 4].map(|n| total.on(n)), [12.0, 6.0, 5.0]);
    }
}
