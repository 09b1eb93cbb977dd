//! Forecast of a run's time on this machine from a few timed steps. `check` and the run print the same
//! time, with one digit.

use std::time::{Duration, Instant};

use fem::error::CONDENSED_REFERENCE_TIME;
use fem::{Cost, ErrorEstimator, RefinementBound, Simulation};
use fem_case::Body;
use fem_case::engineering::{Unit, number};
use fem_collision::{Monitor, OutputRequest, Phase, Progress};
use indicatif::{HumanCount, HumanDuration};

/// Least time for which steps are timed.
const MIN_TIMING: Duration = Duration::from_millis(1);
/// Least number of reports for which they are timed, within [`LONGEST_TIMING`].
const MIN_REPORTS: u32 = 5;
/// Longest time for which they are timed.
const LONGEST_TIMING: Duration = Duration::from_millis(50);
/// Longest time for which steps of condensed bodies are timed.
const LONGEST_TIMING_OF_CONDENSED: Duration = Duration::from_millis(20);
/// Share of the collision after which their timing ends.
const SHARE_OF_CONDENSED: f64 = 0.2;
/// Time to compute the fields of a snapshot over the time to make condensed bodies: 0.08 for elastic ones,
/// 0.1 for relaxing ones.
const FIELDS: f64 = 0.1;
/// Time to write a snapshot over the time to make the bodies, 0.2 to 0.6.
const FILE: f64 = 0.4;
/// Time to draw the report of a run with snapshots over the time to make the bodies.
const REPORT: f64 = 0.8;

/// Time to write the files of explicit elements and to draw their report, s.
const WRITING: f64 = 0.02;
/// Exponent of the time with all finer meshes over that with none. With 0.4 the times of three balls of rubber are
/// right within a factor of 2.5.
const SHARE_OF_REFINEMENT: f64 = 0.4;
/// Shortest time that is announced, s.
const MIN_TIME: f64 = 0.01;

/// Shows an estimated size with two digits: `120 MB`.
pub fn estimated(value: f64, unit: &str) -> String {
    let value = rounded(value, 2);
    Unit::fitting(value, unit).with_digits(2).show(value)
}

/// Shows an estimated number with two digits: `3,000`.
pub fn estimated_count(number: f64) -> HumanCount {
    HumanCount(rounded(number, 2) as u64)
}

/// Shows an estimated time with one digit: `0.1 s`, `40 s`, `3 minutes` or `2 days`.
pub fn estimated_time(seconds: f64) -> String {
    let seconds = rounded(seconds.max(MIN_TIME), 1);
    if seconds < 60.0 {
        return format!("{} s", number(seconds, 1));
    }
    HumanDuration(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)).to_string()
}

fn rounded(value: f64, digits: i32) -> f64 {
    if value <= 0.0 || !value.is_finite() {
        return value;
    }
    let digit = 10f64.powi(value.log10().floor() as i32 - (digits - 1));
    digit * (value / digit).round()
}

#[derive(Clone, Copy, Debug)]
pub struct Forecast {
    pub seconds: Option<f64>,
    /// Element updates of the collision over those that closed forms estimate.
    pub updates_over_expected: f64,
    /// Element updates of the collision and of its reference runs; 0 for models that take none.
    pub element_updates: f64,
    /// An upper bound of the finer meshes that may follow.
    pub finer: Option<FinerMeshes>,
}

/// Finer meshes that follow if the tolerance is missed, which only the run shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinerMeshes {
    bound: RefinementBound,
    /// Element updates and seconds of the collision with its reference runs.
    first: (f64, f64),
}

impl Forecast {
    /// Estimates the cost of a run whose bodies took `making` seconds to make; `is_open` says whether finer meshes may
    /// follow.
    pub fn of(
        simulation: &Simulation,
        estimator: &mut ErrorEstimator,
        making: f64,
        is_open: bool,
    ) -> Self {
        let updates_over_expected = estimator.updates_over_expected(simulation);
        let seconds = seconds(simulation, making, updates_over_expected);
        let announced = match simulation.setup().cost {
            Cost::Steps { element_updates, .. } => element_updates as f64,
            _ => 0.0,
        };
        let of_reference_runs = simulation.reference_updates().unwrap_or(0.0);
        let element_updates = (1.0 + of_reference_runs) * updates_over_expected * announced;
        let bound = is_open.then(|| simulation.refinement_bound()).flatten();
        let finer = seconds
            .zip(bound)
            .map(|(seconds, bound)| FinerMeshes { bound, first: (element_updates, seconds) });
        Self { seconds, updates_over_expected, element_updates, finer }
    }

    /// Returns the expected seconds of a run of which `spent` have passed, files included.
    ///
    /// If explicit elements may be refined, it is a geometric mean of the times with none and with all of the finer
    /// meshes, since one or two usually suffice. Condensed bodies are rarely refined.
    pub fn whole(&self, spent: f64) -> Option<f64> {
        let has_steps = self.element_updates > 0.0;
        let (first, most) = (self.seconds?, self.most_seconds()?);
        match has_steps {
            true => Some(spent + first * (most / first).powf(SHARE_OF_REFINEMENT) + WRITING),
            false => Some(spent + first),
        }
    }

    /// Returns the seconds here with all finer meshes that may follow.
    pub fn most_seconds(&self) -> Option<f64> {
        let most = self.finer.map_or(0.0, |finer| finer.bound.over_first);
        Some((1.0 + most) * self.seconds?)
    }
}

impl FinerMeshes {
    /// Describes the bound: "at most 2 finer meshes, 1.7e8 element updates more, 3 minutes".
    pub fn in_words(&self) -> String {
        let (updates, seconds) = self.first;
        let RefinementBound { meshes, over_first } = self.bound;
        let plural = if meshes == 1 { "" } else { "es" };
        let time = estimated_time(over_first * seconds);
        match updates > 0.0 {
            true => format!(
                "at most {meshes} finer mesh{plural}, {:.1e} element updates more, {time}",
                over_first * updates
            ),
            false => format!("at most {meshes} finer mesh{plural}, {time} more"),
        }
    }
}

/// Returns the seconds of a run here, reference runs included; `None` for a model without elements, and for a ball that
/// bounces, whose cost is that of one contact.
fn seconds(simulation: &Simulation, making: f64, longer: f64) -> Option<f64> {
    if simulation.case().scene().gravity().is_some() {
        return None;
    }
    match simulation.setup().cost {
        Cost::Steps { steps, seconds, .. } => {
            let of_reference_runs = simulation.reference_updates().unwrap_or(0.0);
            let timed = (1.0 + of_reference_runs) * seconds_a_step(simulation)? * steps as f64;
            // The first steps have little contact, and are in the processor's cache.
            Some(longer * timed.max(seconds))
        }
        Cost::Factors { .. } => Some(of_condensed(simulation, making)),
        Cost::ClosedForm { .. } => None,
    }
}

/// Returns the shortest time of a step among some reports, so that other work of the machine does not
/// count.
fn seconds_a_step(simulation: &Simulation) -> Option<f64> {
    let mut stepper = simulation.start();
    let begin = Instant::now();
    let (mut fewest, mut before) = (None, (Duration::ZERO, 0));
    let mut n_reports = 0;
    let goes_on = |spent: Duration, n_reports: u32| {
        spent < MIN_TIMING || (n_reports < MIN_REPORTS && spent < LONGEST_TIMING)
    };
    while goes_on(begin.elapsed(), n_reports) && stepper.advance(&mut ()) {
        let now = (begin.elapsed(), stepper.progress().step);
        // A run that begins anew with shorter steps counts them from 0.
        let n_steps = now.1.saturating_sub(before.1).max(1);
        let seconds = (now.0 - before.0).as_secs_f64() / n_steps as f64;
        fewest = Some(fewest.map_or(seconds, |fewest: f64| fewest.min(seconds)));
        (before, n_reports) = (now, n_reports + 1);
    }
    fewest
}

/// Returns the run time of condensed bodies that took `making` seconds to make, s.
fn of_condensed(simulation: &Simulation, making: f64) -> f64 {
    let begin = Instant::now();
    let mut patient = Patient { begin, before: 0.0, seen: (0.0, 0.0), is_over: false };
    let approach = &simulation.setup().approach;
    let _ = simulation.model().collide(approach, &OutputRequest::history(), &mut patient);
    if !patient.is_over {
        patient.seen = (begin.elapsed().as_secs_f64(), 1.0);
    }
    let collision = patient.collision();
    let n_snapshots = simulation.request().snapshots.len();
    let has_report = simulation.case().scene().wants_report() && n_snapshots > 0;
    let of_report = if has_report { REPORT } else { 0.0 };
    let files = making * ((FIELDS + FILE) * n_snapshots as f64 + of_report);
    collision + files + CONDENSED_REFERENCE_TIME * (collision + making)
}

struct Patient {
    begin: Instant,
    /// Time until the first step, s: relaxing bodies are factored before it.
    before: f64,
    /// Time and share of the run at the last report.
    seen: (f64, f64),
    is_over: bool,
}

impl Patient {
    fn collision(&self) -> f64 {
        let (spent, fraction) = self.seen;
        let steps = spent - self.before;
        self.before + if fraction > 0.0 { steps / fraction } else { steps }
    }
}

impl Monitor for Patient {
    fn enter(&mut self, phase: Phase) {
        if phase == Phase::Collision {
            self.before = self.begin.elapsed().as_secs_f64();
        }
    }

    fn report(&mut self, progress: Progress) -> bool {
        let spent = self.begin.elapsed();
        self.seen = (spent.as_secs_f64(), progress.fraction);
        let is_enough = progress.fraction >= SHARE_OF_CONDENSED;
        self.is_over =
            is_enough || (spent > LONGEST_TIMING_OF_CONDENSED && progress.fraction > 0.0);
        !self.is_over
    }
}

/// Describes the time of a model without a mesh.
pub fn closed_form_time(simulation: &Simulation) -> &'static str {
    const MANY_TERMS: usize = 20;
    let materials = simulation.case().scene().bodies().iter().filter_map(Body::material);
    let series = materials.filter_map(|material| material.relaxation());
    let n_terms: usize = series.map(|series| series.terms().len()).sum();
    if n_terms > MANY_TERMS { "seconds at most" } else { "milliseconds" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_digits_and_times_one() {
        assert_eq!([1.981e7, 0.0].map(|size| estimated(size, "B")), ["20 MB", "0.0 B"]);
        assert_eq!([2987.0, 7.0].map(|n| estimated_count(n).to_string()), ["3,000", "7"]);
        let times = [1e-5, 0.0931, 0.25, 43.0, 180.0, 2.0 * 86_400.0].map(estimated_time);
        assert_eq!(times, ["0.01 s", "0.09 s", "0.3 s", "40 s", "3 minutes", "2 days"]);
        assert!(!estimated_time(f64::INFINITY).is_empty());
    }

    /// Between 1 s and 32 s of steps 4 s are expected; finer condensed meshes are not.
    #[test]
    fn expected_time_lies_between_those_without_and_with_all_finer_meshes() {
        let of = |element_updates, over_first| {
            let bound = RefinementBound { meshes: 2, over_first };
            let finer = Some(FinerMeshes { bound, first: (element_updates, 1.0) });
            let all =
                Forecast { seconds: Some(1.0), updates_over_expected: 1.0, element_updates, finer };
            all.whole(0.5).unwrap()
        };
        assert!((of(1e6, 31.0) - 4.5 - WRITING).abs() < 1e-12);
        assert_eq!(of(0.0, 15.0), 1.5);
    }

    /// Factors are made once: 4 s of factors and a fifth of the steps in 1 s make 9 s.
    #[test]
    fn remaining_time_counts_factorisation_once() {
        let patient =
            Patient { begin: Instant::now(), before: 4.0, seen: (5.0, 0.2), is_over: true };
        assert!((patient.collision() - 9.0).abs() < 1e-12);
        let nothing = Patient { seen: (5.0, 0.0), ..patient };
        assert!((nothing.collision() - 5.0).abs() < 1e-12);
    }
}
