//! Computes the rungs of a ladder and times them.

use std::time::{Duration, Instant};

use fem::accuracy::{Ladder, Measurement, Rung};
use fem::{CaseError, Monitor, Progress, Shared};
use fem_case::engineering::show;

use crate::progress::ItemProgress;
use crate::progress::interrupt::Interrupt;

/// What takes less is timed three times, and the median taken.
const TIMED_THRICE: Duration = Duration::from_millis(500);
const N_TIMES: usize = 3;
/// Seconds of an element update until some are timed.
const UPDATE: f64 = 2e-8;
/// Updates that tell the seconds of others.
const TELLING: u64 = 200_000;
/// Condensed bodies take so many times as long as those a level coarser, at most.
const NEXT_LEVEL: f64 = 4.0;

/// What was computed of a ladder.
pub struct Climb {
    /// What each rung gave and the median of the seconds that it took, meshes made anew each time and
    /// no files written; none of what did not run.
    pub measured: Vec<Option<(Measurement, f64)>>,
    /// Rungs that the budget had no room for.
    pub left_out: usize,
}

/// Computes rungs, from cheap to dear, until the budget (s) is spent.
///
/// # Errors
/// A rung that its model refuses: it was asked before.
pub fn climb(
    ladder: &Ladder,
    budget: f64,
    interrupt: &Interrupt,
    quiet: bool,
) -> Result<Climb, CaseError> {
    let progress = ItemProgress::new(interrupt.clone(), "variants", ladder.rungs.len(), quiet);
    let started = Instant::now();
    let mut measured = vec![None; ladder.rungs.len()];
    let mut forecast = Forecast { update: UPDATE, condensed: 0.0 };
    let mut left_out = 0;
    for index in ladder.cheapest_first() {
        let rung = &ladder.rungs[index];
        let left = budget - started.elapsed().as_secs_f64();
        if interrupt.is_requested() || forecast.seconds(rung) > left {
            left_out += 1;
            progress.finish_item(&line(rung, None));
            continue;
        }
        let end = started + Duration::try_from_secs_f64(budget).unwrap_or(Duration::MAX / 4);
        let ran = time(rung, ladder.lengths.contact_radius, Deadline { end, interrupt })?;
        forecast.learn(rung, &ran);
        progress.finish_item(&line(rung, Some(ran.1)));
        if Instant::now() < end || ran.0.is_complete {
            measured[index] = Some(ran);
        } else {
            left_out += 1;
        }
    }
    progress.finish();
    Ok(Climb { measured, left_out })
}

/// A rung and the median of its seconds.
fn time(
    rung: &Rung,
    contact_radius: f64,
    mut deadline: Deadline<'_>,
) -> Result<(Measurement, f64), CaseError> {
    let mut seconds = Vec::new();
    loop {
        let begin = Instant::now();
        // Nothing is shared: each pays for its own meshes and factors.
        let measurement = Measurement::of(rung, contact_radius, &Shared::default(), &mut deadline)?;
        let spent = begin.elapsed();
        seconds.push(spent.as_secs_f64());
        if seconds.len() == N_TIMES || spent > TIMED_THRICE {
            seconds.sort_by(f64::total_cmp);
            return Ok((measurement, seconds[seconds.len() / 2]));
        }
    }
}

/// Ends a run when the budget is spent or the user wants it.
#[derive(Clone, Copy)]
struct Deadline<'a> {
    end: Instant,
    interrupt: &'a Interrupt,
}

impl Monitor for Deadline<'_> {
    fn report(&mut self, _: Progress) -> bool {
        Instant::now() < self.end && !self.interrupt.is_requested()
    }
}

/// What rungs to come will take, of those that have run.
struct Forecast {
    /// Seconds of an element update.
    update: f64,
    /// Seconds of the last condensed rung.
    condensed: f64,
}

impl Forecast {
    fn seconds(&self, rung: &Rung) -> f64 {
        match rung.price {
            0 => NEXT_LEVEL * self.condensed,
            price => price as f64 * self.update,
        }
    }

    fn learn(&mut self, rung: &Rung, (measurement, seconds): &(Measurement, f64)) {
        match measurement.element_updates {
            None => self.condensed = if rung.value.is_some() { *seconds } else { 0.0 },
            Some(updates) if updates > TELLING => self.update = seconds / updates as f64,
            Some(_) => {}
        }
    }
}

fn line(rung: &Rung, seconds: Option<f64>) -> String {
    let took = seconds.map_or("no time left".to_string(), |seconds| show(seconds, "s"));
    format!("{took:>12}  {}  {}", rung.series.name(), rung.describe())
}
