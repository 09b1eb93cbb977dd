//! Restitutions from the instants at which a bouncing ball touches the plate.
//!
//! A flight of duration T begins and ends with gT/2 in vacuum, so that the restitution of the bounce between two flights is
//! e = T₂/T₁ (A. D. Bernstein, *Am. J. Phys.* **45** (1977) 41, doi:10.1119/1.10904). With air drag the speeds are those
//! of [`FreeFlight`](super::FreeFlight). Durations are less the contact
//! time if it is given. Uncertainties of instants, contact time, gravity and drag propagate in first order.
//!
//! A ball with a constant restitution comes to rest after the first flight's T/(1 − e), which is a check.

use fem_material::engineering::show;
use serde::Serialize;
use serde_json::{Value, json};

use crate::estimate::median;
use crate::table::Measured;
use crate::table::{DataError, Table, is_numbered};

use super::bad_instants::good_flights;
use super::flight_speeds::{Errors, Speeds};
use super::impact::Impact;
use super::rig::Rig;
use super::roles::{DROPS, EVENTS, INTERVALS, NUMBERED, TIME_UNCERTAINTIES, TIMES};
use super::series::{FlightSpan, Scatter, drops, flight_spans, scatter};

/// Longest flight, s; a longer one, with landing at 100 m/s, is one in another unit.
pub(super) const LONGEST_FLIGHT: f64 = 20.0;
/// Flights shorter than this are warned of: the ball rises by 5 µm.
const SHORT_FLIGHT: f64 = 2e-3;
/// Fewest instants that are too even for bounces.
const EVEN: usize = 6;
/// Difference from 1 below which the usual ratio of successive flights is that of even instants; no ball has e = 0.995.
const EVENNESS: f64 = 0.005;
/// Most instants of one drop.
const MOST_INSTANTS: usize = 1000;
/// Most warnings about single flights.
const MOST_WARNINGS: usize = 5;
/// Number of restitutions whose mean is that of the bounces to come.
const LAST: usize = 3;

/// The instants of a record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Instants {
    /// The name of the record in messages.
    pub name: String,
    /// Increasing instants, s.
    pub values: Vec<f64>,
    /// The line of each in the text; empty for instants that are picked from a trace.
    pub lines: Vec<u64>,
    /// Standard uncertainty of each, s, if the record has them.
    pub uncertainties: Option<Vec<f64>>,
    /// The smallest step between instants, s: one of the last digit, or of a sample.
    pub resolution: f64,
    /// The first instants of drops after the first one, as indices, where the record says it.
    pub starts: Vec<usize>,
    /// Sentences about parts of the record that are left out or changed.
    pub notes: Vec<String>,
}

/// The time between two drops that a record has side by side, s.
const PAUSE: f64 = 1.0;

/// The source of the uncertainty of instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TimeUncertaintySource {
    /// The record or the user gives it.
    Given,
    /// The scatter of the flights about a smooth series.
    Scatter,
    /// The last digit of the record: the flights are too few or too regular for a scatter.
    Digits,
}

/// The restitutions of a bouncing ball.
#[derive(Clone, Debug, PartialEq)]
pub struct BounceTimes {
    /// The instants of the record.
    pub instants: Instants,
    /// The flights between instants.
    pub spans: Vec<FlightSpan>,
    /// Scatter of the flights about a smooth series, if there are enough.
    pub scatter: Option<Scatter>,
    /// The largest standard uncertainty of an instant, s.
    pub time_uncertainty: f64,
    /// Where it is from.
    pub source: TimeUncertaintySource,
    /// The impacts in the order of the record.
    pub impacts: Vec<Impact>,
    /// The errors of their restitutions.
    errors: Vec<Errors>,
    /// The instant at which the ball comes to rest if it bounces on as in its last bounces, s.
    pub predicted_rest: Option<f64>,
    /// The restitution by the time from the first bounce to rest, if that is given.
    pub restitution_to_rest: Option<Measured>,
    /// Change of the last restitution per second of contact time, 1/s.
    pub contact_time_slope: f64,
    /// Instants and flights that are left out, and other warnings.
    pub warnings: Vec<String>,
}

impl Instants {
    /// Reads the instants of a table.
    ///
    /// # Errors
    /// The table has no column of instants, a cell is no number, or the instants do not increase.
    pub fn read(columns: &Table) -> Result<Self, DataError> {
        let numbered = |names: &str| -> Vec<usize> {
            let is_it = |column: &usize| is_numbered(&columns.header()[*column], names);
            (0..columns.header().len()).filter(is_it).collect()
        };
        let (time, interval) = (columns.find(TIMES)?, columns.find(INTERVALS)?);
        let numbers = numbered(NUMBERED);
        if time.is_none() && interval.is_none() && !numbers.is_empty() {
            return Self::of_drops(columns, &numbers, numbered(DROPS).len() == numbers.len());
        }
        let is_count = |column: usize| {
            let count = |row: usize| columns.text(row, column).parse::<usize>().ok();
            let follows = |row: usize| Some(count(row)? == count(row - 1)? + 1);
            (1..columns.n_rows()).all(|row| follows(row) == Some(true))
        };
        let intervals = match (time, interval) {
            (Some(time), Some(interval)) if is_count(interval) => Some(time),
            (None, found) => found,
            _ => None,
        };
        if let Some(column) = intervals {
            return Self::of_intervals(columns, column);
        }
        let column = match (time, columns.find(EVENTS)?) {
            (Some(column), _) | (None, Some(column)) => column,
            _ => columns.require(TIMES, "time_s or time_ms")?,
        };
        let times = columns.numbers(column, [0, 0, 1])?;
        let uncertainties = columns.find(TIME_UNCERTAINTIES)?;
        let uncertainties = uncertainties.map(|column| columns.numbers(column, [0, 0, 1]));
        let is_known: Vec<bool> = times.values.iter().map(|time| time.is_finite()).collect();
        let kept = |values: Vec<f64>| -> Vec<f64> {
            let known = values.into_iter().zip(&is_known).filter(|(_, known)| **known);
            known.map(|(value, _)| value).collect()
        };
        let lines = (0..columns.n_rows()).filter(|row| is_known[*row]);
        let instants = Self {
            name: columns.name().to_string(),
            lines: lines.map(|row| columns.line(row)).collect(),
            values: kept(times.values),
            uncertainties: uncertainties.transpose()?.map(|it| kept(it.values)),
            resolution: times.resolution,
            starts: Vec::new(),
            notes: columns.left_out().to_vec(),
        };
        let values = &instants.values;
        if let Some(k) = (1..values.len()).find(|k| values[*k] <= values[k - 1]) {
            let message =
                format!("the instant {} s does not follow {} s", values[k], values[k - 1]);
            let help =
                "list the instants of one drop in order; keep each drop in a file of its own";
            return Err(instants.fault(k, message).with_help(help));
        }
        let bad = instants.uncertainties.iter().flatten().position(|u| u.is_nan() || *u <= 0.0);
        if let Some(k) = bad {
            let help = "every instant has one greater than 0, or the column is left out";
            return Err(instants.fault(k, "the uncertainty of the instant").with_help(help));
        }
        Ok(instants)
    }

    /// Reads the flights of one drop from a column of their durations.
    fn of_intervals(columns: &Table, column: usize) -> Result<Self, DataError> {
        let flights = columns.numbers(column, [0, 0, 1])?;
        let known = flights.values.iter().copied().filter(|it| *it > 0.0);
        let end = known.scan(0.0, |end, flight| {
            *end += flight;
            Some(*end)
        });
        Ok(Self {
            name: columns.name().to_string(),
            values: std::iter::once(0.0).chain(end).collect(),
            resolution: flights.resolution,
            notes: columns.left_out().to_vec(),
            ..Self::default()
        })
    }

    /// Reads drops side by side, or one drop in a row; those that begin before the end of the last one follow it.
    fn of_drops(columns: &Table, numbers: &[usize], are_drops: bool) -> Result<Self, DataError> {
        let found = numbers.iter().map(|column| columns.numbers(*column, [0, 0, 1]));
        let found = found.collect::<Result<Vec<_>, _>>()?;
        let rows = 0..columns.n_rows();
        let drops: Vec<Vec<f64>> = match are_drops {
            true => found.iter().map(|column| column.values.clone()).collect(),
            false => {
                rows.map(|row| found.iter().map(|column| column.values[row]).collect()).collect()
            }
        };
        let mut all = Self {
            name: columns.name().to_string(),
            // Zeros that fill a row have fewer digits.
            resolution: found.iter().map(|column| column.resolution).fold(f64::INFINITY, f64::min),
            notes: columns.left_out().to_vec(),
            ..Self::default()
        };
        let mut n_moved = 0;
        for (k, mut drop) in drops.into_iter().enumerate() {
            drop.retain(|time| time.is_finite());
            // A stopwatch fills the rest of a row with zeros.
            while drop.len() > 1 && drop.last() == Some(&0.0) {
                drop.pop();
            }
            if let Some(pair) = drop.windows(2).find(|pair| pair[1] <= pair[0]) {
                let message = format!("the instant {} s does not follow {} s", pair[1], pair[0]);
                let place = format!("drop {} has its instants in order", k + 1);
                return Err(DataError::new(&all.name, message).with_help(place));
            }
            let (last, Some(first)) = (all.values.last().copied(), drop.first().copied()) else {
                continue;
            };
            let shift = last.filter(|last| first <= *last).map_or(0.0, |last| last + PAUSE - first);
            n_moved += usize::from(shift > 0.0);
            all.starts.extend(last.map(|_| all.values.len()));
            all.values.extend(drop.iter().map(|time| time + shift));
        }
        if n_moved > 0 {
            all.notes.push(format!(
                "{} drops: the instants of each follow those of the one before after {PAUSE} s",
                all.starts.len() + 1
            ));
        }
        Ok(all)
    }

    /// Returns the flights between the instants of each drop.
    fn spans(&self) -> Vec<FlightSpan> {
        let starts = self.starts.iter().copied();
        let begins = std::iter::once(0).chain(starts.clone());
        let mut spans = Vec::new();
        for (begin, end) in begins.zip(starts.chain([self.values.len()])) {
            if begin > 0 {
                spans.push(FlightSpan { from: begin - 1, to: begin, n_flights: 0 });
            }
            let own = flight_spans(&self.values[begin..end]).into_iter();
            let moved = |span: FlightSpan| FlightSpan {
                from: span.from + begin,
                to: span.to + begin,
                ..span
            };
            spans.extend(own.map(moved));
        }
        spans
    }

    fn fault(&self, k: usize, message: impl std::fmt::Display) -> DataError {
        let error = DataError::new(&self.name, message);
        match self.lines.get(k) {
            Some(line) => error.in_line(*line),
            None => error,
        }
    }
}

impl BounceTimes {
    /// Returns the restitutions between the flights of a ball.
    ///
    /// # Errors
    /// The record does not support a restitution, or a value of the rig is out of range.
    ///
    /// ```
    /// use fem_data::table::Table;
    /// use fem_data::instruments::{BounceTimes, Instants, Rig};
    ///
    /// let text = "time_s\n0.4515\n1.2640\n1.9954\n2.6537\n";
    /// let instants = Instants::read(&Table::of_record("drop.csv", text)?)?;
    /// let bounces = BounceTimes::of(instants, &Rig::default())?;
    /// let first = bounces.impacts[0];
    /// assert!((first.restitution.value - 0.9002).abs() < 1e-4);
    /// assert!((first.speed.value - 3.984).abs() < 1e-3);
    /// # Ok::<(), fem_data::table::DataError>(())
    /// ```
    pub fn of(instants: Instants, rig: &Rig) -> Result<Self, DataError> {
        rig.check(&instants.name)?;
        check_flights(&instants, rig)?;
        let largest = |all: &Vec<f64>| all.iter().copied().fold(0.0, f64::max);
        let known = rig.time_uncertainty.or(instants.uncertainties.as_ref().map(largest));
        let (spans, at_ends) = good_flights(&instants, instants.spans(), known);
        let found = scatter(&instants.values, &spans);
        let (uncertainties, source) = uncertainties(&instants, rig, found.as_ref());
        let mut warnings = instants.notes.clone();
        warnings.extend(left_out(&instants, &spans, &at_ends));
        let speeds = Speeds::of(&instants, &spans, &uncertainties, rig, &mut warnings);
        let mut found_impacts: Vec<(Impact, Errors)> =
            speeds.first(&instants, rig).chain(speeds.others()).collect();
        found_impacts.sort_by(|a, b| a.0.time.total_cmp(&b.0.time));
        warnings.extend(leave_impossible_out(&mut found_impacts, &instants.values));
        let (mut impacts, errors): (Vec<Impact>, Vec<Errors>) = found_impacts.into_iter().unzip();
        let last_drop = drops(&spans).last().map_or(0, |drop| drop[0].from);
        let drop = speeds.drop(rig);
        let to_rest = |rest| to_rest(&instants, last_drop, &uncertainties, rest, drop);
        let restitution_to_rest = rig.rest.map(to_rest);
        let restitution_to_rest = restitution_to_rest.transpose()?;
        if impacts.is_empty()
            && let Some(restitution) = restitution_to_rest
            && let Some((time, speed)) = match speeds.by_span.first() {
                Some(flight) => flight.map(|flight| (flight.time, flight.landing_speed())),
                None => drop.map(|(speed, _)| (instants.values[0], speed)),
            }
        {
            impacts.push(Impact { time, speed, restitution, contact_time: None });
            warnings.push("the restitution is a mean over all bounces until rest".to_string());
        }
        if impacts.is_empty() {
            let message = "no two flights in a row give a restitution between 0 and 1";
            let help = warnings[..warnings.len().min(MOST_WARNINGS)].join("; ");
            return Err(DataError::new(&instants.name, message).with_help(help));
        }
        let n_more = warnings.len().saturating_sub(MOST_WARNINGS);
        if n_more > 1 {
            warnings.truncate(MOST_WARNINGS);
            warnings
                .push(format!("{n_more} more flights or impacts are left out for such reasons"));
        }
        let mut bounces = Self {
            contact_time_slope: speeds.contact_time_slope(),
            time_uncertainty: uncertainties.iter().copied().fold(0.0, f64::max),
            predicted_rest: None,
            instants,
            spans,
            scatter: found,
            source,
            impacts,
            errors,
            restitution_to_rest,
            warnings,
        };
        bounces.predict_rest(rig);
        bounces.warn(rig);
        Ok(bounces)
    }

    /// Predicts the end of bouncing by the sum of the flights to come.
    fn predict_rest(&mut self, rig: &Rig) {
        let last: Vec<f64> =
            self.impacts.iter().rev().take(LAST).map(|impact| impact.restitution.value).collect();
        let e = last.iter().sum::<f64>() / last.len() as f64;
        let Some(FlightSpan { from, to, n_flights: 1 }) = self.spans.last().copied() else {
            return;
        };
        if e >= 1.0 {
            return;
        }
        let duration = self.instants.values[to] - self.instants.values[from];
        let rest = self.instants.values[to] + duration * e / (1.0 - e);
        self.predicted_rest = Some(rest);
        let start = drops(&self.spans).last().map(|drop| self.instants.values[drop[0].from]);
        let (Some(given), Some(start)) = (rig.rest, start) else { return };
        // The last bounces are many and short: a twentieth of the time is what their restitution changes.
        let tolerance = (3.0 * given.uncertainty).max(0.05 * (rest - start));
        if (given.value - rest).abs() > tolerance {
            self.warnings.push(format!(
                "the ball comes to rest at {:.3} s, and would at {rest:.3} s if it bounced on as in its \
                 last bounces: later bounces lose another share, or some are missing",
                given.value
            ));
        }
    }

    /// Returns the variance of each restitution, and its covariance with the next one and with that after it. Neighbours share
    /// the instants of a flight, with opposite signs; contact time and drag are common to all.
    pub fn covariances(&self) -> Vec<[Option<f64>; 3]> {
        let of = |k: usize, j: usize| Some(self.errors[k].covariance(self.errors.get(j)?));
        (0..self.errors.len()).map(|k| [of(k, k), of(k, k + 1), of(k, k + 2)]).collect()
    }

    /// Returns the mean of the restitutions with its standard uncertainty, by the covariances of all; `None` without two.
    pub fn mean_restitution(&self) -> Option<Measured> {
        let n = self.errors.len() as f64;
        let values = self.impacts.iter().map(|impact| impact.restitution.value);
        let own =
            |errors: &Errors| self.errors.iter().map(|other| errors.covariance(other)).sum::<f64>();
        let variance = self.errors.iter().map(own).sum::<f64>().max(0.0) / (n * n);
        let mean = Measured { value: values.sum::<f64>() / n, uncertainty: variance.sqrt() };
        (n > 1.0).then_some(mean)
    }

    /// Returns the numbers of the record for JSON, SI.
    pub(super) fn numbers(&self) -> Value {
        let mean = self.mean_restitution();
        json!({
            "restitution_covariances": self.covariances(),
            "mean_restitution": mean.map(|e| e.value),
            "mean_restitution_uncertainty": mean.map(|e| e.uncertainty),
            "instants_s": self.instants.values,
            "time_uncertainty_s": self.time_uncertainty,
            "time_uncertainty_from": self.source,
            "degrees_of_freedom": self.scatter.as_ref().map(|scatter| scatter.freedom),
            "predicted_rest_s": self.predicted_rest,
            "restitution_to_rest": self.restitution_to_rest.map(|e| e.value),
            "restitution_to_rest_uncertainty": self.restitution_to_rest.map(|e| e.uncertainty),
            "restitution_per_contact_time_1_s": self.contact_time_slope,
        })
    }

    fn warn(&mut self, rig: &Rig) {
        let values = &self.instants.values;
        let longest = values.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        if longest > 0.0 && longest < SHORT_FLIGHT {
            self.warnings.push(format!(
                "the longest flight is {:.3} ms, a bounce of {:.1} um: is the time in seconds?",
                1e3 * longest,
                1e6 * rig.gravity().value * longest * longest / 8.0
            ));
        }
        self.warnings.extend(Impact::gain(&self.impacts));
        if self.source == TimeUncertaintySource::Digits {
            self.warnings.push(format!(
                "the uncertainty of an instant, {}, is that of its last digit only: \
                 --time-uncertainty gives another",
                show(self.time_uncertainty, "s")
            ));
        }
    }
}

/// Rejects records without two flights or an equivalent, and those in another unit.
fn check_flights(instants: &Instants, rig: &Rig) -> Result<(), DataError> {
    let values = &instants.values;
    let error = |message: String| DataError::new(&instants.name, message);
    let (height, rest) = (rig.drop_height.is_some(), rig.rest.is_some());
    let is_enough = match values.len() {
        0 => false,
        1 => height && rest,
        2 => height || rest,
        _ => true,
    };
    if !is_enough {
        let found = match values.len() {
            0 => "there is no instant".to_string(),
            1 => "one instant is no flight".to_string(),
            _ => "two instants are one flight".to_string(),
        };
        let message = format!("{found}: a restitution needs two flights in a row, three instants");
        return Err(error(message).with_help(
            "list more bounces; with two of them --height of the drop or --rest, the time at which the ball comes to \
             rest, suffices, and with one both",
        ));
    }
    let flights = || values.windows(2).map(|pair| pair[1] - pair[0]);
    let ratios: Vec<f64> = flights().zip(flights().skip(1)).map(|(a, b)| b / a).collect();
    if values.len() >= EVEN && (median(&ratios) - 1.0).abs() < EVENNESS {
        let step = show((values[values.len() - 1] - values[0]) / (values.len() - 1) as f64, "s");
        let message = format!(
            "the {} instants are evenly spaced, by {step}: they are those of frames or samples, and no bounces",
            values.len()
        );
        let help = "name the column that goes with them, such as y_m, force_n or signal, or write --columns height=COLUMN";
        return Err(error(message).with_help(help));
    }
    if values.len() > MOST_INSTANTS {
        let message = format!("{} instants are more than the bounces of one drop", values.len());
        let help =
            format!("keep each drop in a file of its own, of at most {MOST_INSTANTS} instants");
        return Err(error(message).with_help(help));
    }
    let (k, longest) = flights().enumerate().fold((0, 0.0), |longest, (k, flight)| {
        if flight > longest.1 { (k, flight) } else { longest }
    });
    if longest > LONGEST_FLIGHT {
        let speed = 0.5 * rig.gravity().value * longest;
        let message = format!("a flight of {longest:.3} s lands at {speed:.0} m/s");
        let help =
            "name the column with its unit, such as time_ms, if the instants are not in seconds";
        return Err(instants.fault(k + 1, message).with_help(help));
    }
    Ok(())
}

/// Returns the standard uncertainty of each instant.
fn uncertainties(
    instants: &Instants,
    rig: &Rig,
    scatter: Option<&Scatter>,
) -> (Vec<f64>, TimeUncertaintySource) {
    let all = |uncertainty: f64| vec![uncertainty; instants.values.len()];
    // A rectangular distribution over one step.
    let digits = instants.resolution / 12f64.sqrt();
    match (&instants.uncertainties, rig.time_uncertainty, scatter) {
        (_, Some(given), _) => (all(given), TimeUncertaintySource::Given),
        (Some(given), _, _) => (given.clone(), TimeUncertaintySource::Given),
        (_, _, Some(scatter)) if scatter.uncertainty > digits => {
            (all(scatter.uncertainty), TimeUncertaintySource::Scatter)
        }
        _ => (all(digits), TimeUncertaintySource::Digits),
    }
}

fn left_out(instants: &Instants, spans: &[FlightSpan], at_ends: &[usize]) -> Vec<String> {
    let does_not_fit = |instant: usize| {
        let time = instants.values[instant];
        format!(
            "the instant {time:.4} s is left out: it does not fit the flights before and after it"
        )
    };
    let mut warnings: Vec<String> = at_ends.iter().copied().map(does_not_fit).collect();
    for FlightSpan { from, to, n_flights } in spans.iter().copied() {
        let [start, end] = [from, to].map(|k| instants.values[k]);
        if n_flights == 0 && !instants.starts.contains(&to) {
            warnings.push(format!(
                "from {start:.4} s to {end:.4} s is no flight of the ball: another drop begins"
            ));
        }
        if n_flights > to - from {
            let missing = if n_flights == 2 { "an instant is" } else { "two instants are" };
            warnings.push(format!(
                "{missing} missing between {start:.4} s and {end:.4} s: these {n_flights} flights are left out"
            ));
        }
        for between in from + 1..to {
            let extra = instants.values[between];
            warnings.push(match n_flights {
                1 => format!("the instant {extra:.4} s is left out: it is no bounce"),
                _ => does_not_fit(between),
            });
        }
    }
    warnings
}

/// Returns the restitution of a ball that bounces on until rest with the same restitution: 1 − T/(rest − first instant), with the index
/// of the first instant of the drop.
fn to_rest(
    instants: &Instants,
    first_index: usize,
    uncertainties: &[f64],
    rest: Measured,
    drop: Option<(Measured, Measured)>,
) -> Result<Measured, DataError> {
    let (first, last) = (instants.values[first_index], instants.values[instants.values.len() - 1]);
    if rest.value <= last {
        let message = format!("the ball is at rest at {} s and bounces at {last} s", rest.value);
        let help = "--rest is the time at which the ball comes to rest, on the clock of the record";
        return Err(DataError::new(&instants.name, message).with_help(help));
    }
    let whole = rest.value - first;
    let Some(second) = instants.values.get(first_index + 1) else {
        // The first flight lasts 2et after a fall of t, so that e = T/(T + 2t).
        let twice = drop.map_or(Measured::exact(0.0), |(_, twice)| twice);
        let e = whole / (whole + twice.value);
        let of_whole = rest.uncertainty.hypot(uncertainties[first_index]) / whole;
        let uncertainty = e * (1.0 - e) * of_whole.hypot(twice.uncertainty / twice.value);
        return Ok(Measured { value: e, uncertainty });
    };
    let flight = second - first;
    let e = 1.0 - flight / whole;
    let slopes = [1.0 / whole - flight / (whole * whole), 1.0 / whole, flight / (whole * whole)];
    let [of_first, of_second] = [first_index, first_index + 1].map(|k| uncertainties[k]);
    let spread = [of_first, of_second, rest.uncertainty];
    let uncertainty = slopes.iter().zip(spread).fold(0.0f64, |sum, (a, b)| sum.hypot(a * b));
    Ok(Measured { value: e, uncertainty })
}

/// Removes impacts in which the ball gains energy, and those of the flights on both sides of their wrong instants as far as others
/// remain. Returns what is left out.
fn leave_impossible_out(found: &mut Vec<(Impact, Errors)>, instants: &[f64]) -> Vec<String> {
    let impossible = found.iter().filter_map(|(impact, _)| Some((impact.time, impact.left_out()?)));
    let (wrong, warnings): (Vec<f64>, Vec<String>) = impossible.unzip();
    let stands_on = |errors: &Errors| errors.times(instants).any(|time| wrong.contains(&time));
    if !found.iter().all(|(_, errors)| stands_on(errors)) {
        found.retain(|(_, errors)| !stands_on(errors));
    }
    found.retain(|(impact, _)| impact.impossible().is_none());
    warnings
}
