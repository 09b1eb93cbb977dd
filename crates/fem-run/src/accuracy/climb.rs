//! Runs the variants of a study of accuracy and times them.

use std::time::{Duration, Instant};

use fem::accuracy::{Measurement, Variant, Variants};
use fem::{CaseError, Monitor, Progress, SharedModels};
use fem_case::engineering::show;

use crate::progress::ItemProgress;
use crate::progress::interrupt::Interrupt;

/// Shorter runs are timed three times, and the median is taken.
const TIMED_THRICE: Duration = Duration::from_millis(500);
const N_TIMES: usize = 3;
/// Time of an element update, s, until one is measured.
const UPDATE: f64 = 2e-8;
/// Fewest element updates from which their time is measured.
const TELLING: u64 = 200_000;
/// Largest ratio of the times of condensed bodies on a mesh and on the next coarser one.
const NEXT_LEVEL: f64 = 4.0;

/// The results of the variants.
pub struct Climb {
    /// Result of each variant and the median of its run times, s, with new meshes each time and without
    /// writing files; `None` if it did not run.
    pub measured: Vec<Option<(Measurement, f64)>>,
    /// Number of variants left out for lack of time.
    pub left_out: usize,
}

/// Runs the variants, the cheapest first, until the budget (s) is spent.
///
/// # Errors
/// A model rejects its variant; that was checked before.
pub fn climb(
    variants: &Variants,
    budget: f64,
    interrupt: &Interrupt,
    quiet: bool,
) -> Result<Climb, CaseError> {
    let progress = ItemProgress::new(interrupt.clone(), "variants", variants.all.len(), quiet);
    let started = Instant::now();
    let mut measured = vec![None; variants.all.len()];
    let mut forecast = Forecast { update: UPDATE, condensed: 0.0 };
    let mut left_out = 0;
    for index in variants.cheapest_first() {
        let variant = &variants.all[index];
        let left = budget - started.elapsed().as_secs_f64();
        if interrupt.is_requested() || forecast.seconds(variant) > left {
            left_out += 1;
            progress.finish_item(&line(variant, None));
            continue;
        }
        let end = started + Duration::try_from_secs_f64(budget).unwrap_or(Duration::MAX / 4);
        let ran = time(variant, variants.lengths.contact_radius, Deadline { end, interrupt })?;
        forecast.learn(variant, &ran);
        progress.finish_item(&line(variant, Some(ran.1)));
        if Instant::now() < end || ran.0.is_complete {
            measured[index] = Some(ran);
        } else {
            left_out += 1;
        }
    }
    progress.finish();
    Ok(Climb { measured, left_out })
}

/// Returns the result of a variant and the median of its run times.
fn time(
    variant: &Variant,
    contact_radius: f64,
    mut deadline: Deadline<'_>,
) -> Result<(Measurement, f64), CaseError> {
    let mut seconds = Vec::new();
    loop {
        let begin = Instant::now();
        // Nothing is shared, so each run pays for its meshes and factors.
        let measurement =
            Measurement::of(variant, contact_radius, &SharedModels::default(), &mut deadline)?;
        let spent = begin.elapsed();
        seconds.push(spent.as_secs_f64());
        if seconds.len() == N_TIMES || spent > TIMED_THRICE {
            seconds.sort_by(f64::total_cmp);
            return Ok((measurement, seconds[seconds.len() / 2]));
        }
    }
}

/// A monitor that ends a run when the budget is spent or the user interrupts.
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

/// Forecast of run times from those of earlier variants.
struct Forecast {
    /// Time of an element update, s.
    update: f64,
    /// Time of the last condensed variant, s.
    condensed: f64,
}

impl Forecast {
    fn seconds(&self, variant: &Variant) -> f64 {
        match variant.price {
            0 => NEXT_LEVEL * self.condensed,
            price => price as f64 * self.update,
        }
    }

    fn learn(&mut self, variant: &Variant, (measurement, seconds): &(Measurement, f64)) {
        match measurement.element_updates {
            None => self.condensed = if variant.value.is_some() { *seconds } else { 0.0 },
            Some(updates) if updates > TELLING => self.update = seconds / updates as f64,
            Some(_) => {}
        }
    }
}

fn line(variant: &Variant, seconds: Option<f64>) -> String {
    let took = seconds.map_or("no time left".to_string(), |seconds| show(seconds, "s"));
    format!("{took:>12}  {}  {}", variant.series.name(), variant.describe())
}
