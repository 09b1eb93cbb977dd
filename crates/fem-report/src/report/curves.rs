//! What a result has over time, as charts: of one result beside Hertz, of several over each other.

use fem_case::engineering::{Unit, show};
use fem_figure::{Axis, Chart, Curve, GREY};

use super::hertz::{Hertz, HertzInstant};
use super::record::{ContactAt, Record};

/// Of one result no more profiles of the pressure than eyes tell apart.
const MOST_PROFILES: usize = 4;
/// What is less than this share of the largest energy is no curve.
const FAINT: f64 = 5e-3;
/// How far beyond the contact time goes.
const BEYOND: f64 = 0.06;
/// How far time goes over the longest contact time of the results where Hertz' is longer.
const MOST_OF_HERTZ: f64 = 1.5;
/// Where an axis ends over the largest value of the results where Hertz' is larger.
const MOST_OVER_DATA: f64 = 1.3;

/// One quantity over time.
#[derive(Clone, Copy)]
pub enum Quantity {
    Force,
    Approach,
    Radius,
    Pressure,
}

impl Quantity {
    pub const ALL: [Self; 4] = [Self::Force, Self::Approach, Self::Radius, Self::Pressure];

    fn column(self) -> &'static str {
        match self {
            Self::Force => "contact_force_n",
            Self::Approach => "approach_m",
            Self::Radius => "contact_radius_m",
            Self::Pressure => "centre_pressure_pa",
        }
    }

    fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::Force => ("Contact force F", "N"),
            Self::Approach => ("Approach δ", "m"),
            Self::Radius => ("Contact radius a", "m"),
            Self::Pressure => ("Pressure on the axis p_0", "Pa"),
        }
    }

    fn of_hertz(self, hertz: &Hertz, instant: &HertzInstant) -> f64 {
        match self {
            Self::Force => instant.force,
            Self::Approach => instant.approach,
            Self::Radius => instant.contact_radius,
            Self::Pressure => hertz.pressure(instant.approach).peak_pressure,
        }
    }
}

/// Times of results as one axis has them: since first touch, up to a little after the last.
struct Clock {
    unit: Unit,
    end: f64,
}

impl Clock {
    /// Hertz has his place as far as he does not leave the results a corner.
    fn of(records: &[Record], hertz: Option<&Hertz>) -> Self {
        let longest = |records: &mut dyn Iterator<Item = &Record>| {
            records.map(|record| record.last_touch() - record.first_touch()).fold(0.0, f64::max)
        };
        // Contacts without an end would leave the others a corner.
        let own = match longest(&mut records.iter().filter(|record| !record.stays_together())) {
            0.0 => longest(&mut records.iter()),
            own => own,
        };
        let hertz = hertz.and_then(|hertz| Some(hertz.history().last()?.time)).unwrap_or(own);
        let end = match own > 0.0 {
            true => (1.0 + BEYOND) * hertz.clamp(own, MOST_OF_HERTZ * own),
            false => hertz,
        };
        Self { unit: Unit::fitting(end, "s"), end }
    }

    fn axis(&self) -> Axis {
        let end = self.unit.scaled(self.end);
        Axis::new(format!("time since first touch t [{}]", self.unit.symbol())).from_to(0.0, end)
    }

    /// A column (SI) over the time since first touch, s.
    fn within(&self, record: &Record, column: &str) -> Vec<(f64, f64)> {
        let start = record.first_touch();
        let times = record.history.get("time_s").iter().map(|time| time - start);
        let points = times.zip(record.history.get(column).iter().copied());
        points.filter(|(time, _)| (0.0..=self.end).contains(time)).collect()
    }

    /// As its axis and another's has them.
    fn scaled(&self, points: &[(f64, f64)], unit: &Unit) -> Vec<(f64, f64)> {
        points.iter().map(|(time, value)| (self.unit.scaled(*time), unit.scaled(*value))).collect()
    }
}

/// The least and the largest of values that are numbers, zero among them.
fn range<'a>(points: impl IntoIterator<Item = &'a (f64, f64)>) -> (f64, f64) {
    let values = points.into_iter().map(|point| point.1).filter(|value| value.is_finite());
    values.fold((0.0, 0.0), |(from, to), value| (from.min(value), to.max(value)))
}

/// The axis of values (SI) in such a range, and what Hertz is called beside them: where he goes far beyond them
/// the axis does not follow, and his name says how far.
fn upright(
    (name, symbol): (&str, &str),
    unit: &Unit,
    (from, to): (f64, f64),
    hertz: &[(f64, f64)],
    of_hertz: &str,
) -> (Axis, String) {
    let axis = Axis::new(format!("{name} [{}]", unit.symbol()));
    let largest = range(hertz).1;
    if largest <= MOST_OVER_DATA * to {
        return (axis, of_hertz.to_string());
    }
    let (from, to) = (MOST_OVER_DATA * from, MOST_OVER_DATA * to);
    let name = format!("{of_hertz}, up to {}", show(largest, symbol));
    (axis.from_to(unit.scaled(from), unit.scaled(to)), name)
}

/// Hertz of all of them, if it is the same.
fn common_hertz(records: &[Record]) -> Option<Hertz> {
    let of = |record: &Record| record.summary.get("hertz").cloned();
    let first = of(records.first()?)?;
    let is_common = records.iter().all(|record| of(record).as_ref() == Some(&first));
    Hertz::of(records.first()?).filter(|_| is_common)
}

/// A quantity over time; `None` if no result has it.
pub fn over_time(records: &[Record], quantity: Quantity) -> Option<Chart> {
    let hertz = common_hertz(records);
    let clock = Clock::of(records, hertz.as_ref());
    let (name, symbol) = quantity.label();
    let curves: Vec<_> =
        records.iter().map(|record| clock.within(record, quantity.column())).collect();
    let (from, to) = range(curves.iter().flatten());
    if from == to {
        return None;
    }
    let unit = Unit::fitting(to.max(-from), symbol);
    let of_hertz: Vec<(f64, f64)> = hertz
        .iter()
        .flat_map(|hertz| {
            let at = |instant: &HertzInstant| (instant.time, quantity.of_hertz(hertz, instant));
            hertz.history().iter().map(at).collect::<Vec<_>>()
        })
        .collect();
    let (axis, name_of_hertz) = upright((name, symbol), &unit, (from, to), &of_hertz, "Hertz");
    let mut chart = Chart::new(clock.axis(), axis);
    for (k, (record, points)) in records.iter().zip(&curves).enumerate() {
        let label = if records.len() == 1 { "this run" } else { &record.name };
        chart = chart.with(Curve::line(label, clock.scaled(points, &unit)).like_curve(k));
        if records.len() == 1 {
            let start = record.first_touch();
            let at = |time: f64| (time - start, record.history.at(quantity.column(), time));
            let times = telling(record).into_iter().map(|contact| contact.time);
            let dots: Vec<_> = times.map(at).filter(|(_, value)| value.is_finite()).collect();
            chart = chart.with(Curve::points("", clock.scaled(&dots, &unit)).like_curve(k));
        }
    }
    if !of_hertz.is_empty() {
        let points = clock.scaled(&of_hertz, &unit);
        chart = chart.with(Curve::dashed(name_of_hertz, points).coloured(GREY));
    }
    Some(chart)
}

/// Where the energy of a result is; `None` if its history does not tell.
pub fn energies(record: &Record) -> Option<Chart> {
    let hertz = Hertz::of(record);
    let clock = Clock::of(std::slice::from_ref(record), hertz.as_ref());
    let names = record.history.names().iter();
    let names = names.filter(|name| name.ends_with("_j") && *name != "residual_j");
    let accounts: Vec<(&String, Vec<(f64, f64)>)> =
        names.map(|name| (name, clock.within(record, name))).collect();
    let (from, to) = range(accounts.iter().flat_map(|(_, points)| points));
    if from == to {
        return None;
    }
    let unit = Unit::fitting(to.max(-from), "J");
    let of_hertz: Vec<(f64, f64)> = hertz
        .iter()
        .flat_map(|hertz| hertz.history().iter().map(|at| (at.time, at.energy)).collect::<Vec<_>>())
        .collect();
    let (axis, name_of_hertz) =
        upright(("Energy E", "J"), &unit, (from, to), &of_hertz, "strain of Hertz");
    let mut chart = Chart::new(clock.axis(), axis);
    let is_shown = |points: &[(f64, f64)]| {
        let (least, most) = range(points);
        let n_known = points.iter().filter(|point| point.1.is_finite()).count();
        // What a model knows at the end alone is no curve.
        most.max(-least) > FAINT * to.max(-from) && 2 * n_known > points.len()
    };
    let shown = accounts.iter().filter(|(_, points)| is_shown(points));
    for (k, (name, points)) in shown.enumerate() {
        let label = match name.trim_end_matches("_j") {
            "viscous_dissipation" => "dissipated".to_string(),
            "contact" => "contact springs".to_string(),
            other => other.replace('_', " "),
        };
        chart = chart.with(Curve::line(label, clock.scaled(points, &unit)).like_curve(k));
    }
    if !of_hertz.is_empty() {
        let points = clock.scaled(&of_hertz, &unit);
        chart = chart.with(Curve::dashed(name_of_hertz, points).coloured(GREY));
    }
    Some(chart)
}

/// The contacts that tell most: all of a few, else those nearest to half of the approach, to the largest force, to
/// half again and to the last touch.
pub fn telling(record: &Record) -> Vec<&ContactAt> {
    if record.contacts.len() <= MOST_PROFILES {
        return record.contacts.iter().collect();
    }
    let (times, approach) = (record.history.get("time_s"), record.history.get("approach_m"));
    let peak = record.peak_time();
    let half = 0.5 * approach.iter().copied().filter(|a| a.is_finite()).fold(0.0, f64::max);
    let rows = || times.iter().copied().zip(approach.iter().copied());
    let before = rows().find(|(_, a)| *a >= half).map_or(peak, |(time, _)| time);
    let after = rows().find(|(time, a)| *time > peak && *a <= half);
    let after = after.map_or(peak, |(time, _)| time);
    let nearest = |time: f64| {
        let distance = |k: &usize| (record.contacts[*k].time - time).abs();
        (0..record.contacts.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let mut chosen: Vec<usize> =
        [before, peak, after, record.last_touch()].into_iter().filter_map(nearest).collect();
    chosen.sort_unstable();
    chosen.dedup();
    chosen.into_iter().map(|k| &record.contacts[k]).collect()
}
