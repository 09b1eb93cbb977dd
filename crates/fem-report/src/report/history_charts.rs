//! Charts over time: one result next to Hertz' curves, or several results over each other.

use fem::sweep::column_words;
use fem_case::engineering::show;
use fem_figure::{Axis, Chart, Curve, GREY};

use super::hertz_curves::{HertzCurves, HertzInstant};
use super::stored_result::{ContactSnapshot, StoredResult};
use crate::quantity_axis::{quantity_axis, range};

/// Largest number of pressure profiles of one result, so that they can be distinguished.
const MAX_PROFILES: usize = 4;
/// Energies below this share of the largest get no curve.
const FAINT: f64 = 5e-3;
/// Extension of the time axis beyond the contact, over the contact time.
const BEYOND: f64 = 0.06;
/// End of the time axis over the longest contact time, if Hertz' contact time is longer.
const MAX_OF_HERTZ: f64 = 1.5;
/// End of the vertical axis over the largest computed value, if Hertz' is larger.
const MAX_OVER_DATA: f64 = 1.3;

/// A quantity that is drawn over time.
#[derive(Clone, Copy)]
pub enum Quantity {
    /// The contact force.
    Force,
    /// The approach of the mass centres.
    Approach,
    /// The contact radius.
    Radius,
    /// The contact pressure on the axis.
    Pressure,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Force, Self::Approach, Self::Radius, Self::Pressure];

    /// Returns the column of `history.csv`, the axis label and the unit.
    fn column(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Force => ("contact_force_n", "Contact force F", "N"),
            Self::Approach => ("approach_m", "Approach δ", "m"),
            Self::Radius => ("contact_radius_m", "Contact radius a", "m"),
            Self::Pressure => ("centre_pressure_pa", "Pressure on the axis p_0", "Pa"),
        }
    }

    fn of_hertz(self, hertz: &HertzCurves, instant: &HertzInstant) -> f64 {
        match self {
            Self::Force => instant.force,
            Self::Approach => instant.approach,
            Self::Radius => instant.contact_radius,
            Self::Pressure => hertz.pressure(instant.approach).peak_pressure,
        }
    }
}

/// The time axis of a chart: from first touch to a little after the last contact.
struct TimeAxis {
    axis: Axis,
    end: f64,
}

impl TimeAxis {
    /// A time axis for these results; Hertz' contact may extend it, but not by much.
    fn of(results: &[StoredResult], hertz: Option<&HertzCurves>) -> Self {
        let longest = |results: &mut dyn Iterator<Item = &StoredResult>| {
            results.map(|result| result.last_touch() - result.first_touch()).fold(0.0, f64::max)
        };
        // Contacts without an end would shrink the others.
        let own = match longest(&mut results.iter().filter(|result| !result.stays_together())) {
            0.0 => longest(&mut results.iter()),
            own => own,
        };
        let hertz = hertz.and_then(|hertz| Some(hertz.history().last()?.time)).unwrap_or(own);
        let end = match own > 0.0 {
            true => (1.0 + BEYOND) * hertz.clamp(own, MAX_OF_HERTZ * own),
            false => hertz,
        };
        let axis = quantity_axis("time since first touch t", "s", end).from_to(0.0, end);
        Self { axis, end }
    }

    /// Returns a column (SI) over the time since first touch, s.
    fn column(&self, result: &StoredResult, column: &str) -> Vec<(f64, f64)> {
        let start = result.first_touch();
        let times = result.history.get("time_s").iter().map(|time| time - start);
        let points = times.zip(result.history.get(column).iter().copied());
        points.filter(|(time, _)| (0.0..=self.end).contains(time)).collect()
    }
}

/// Fewest points of a curve over several contacts.
const MIN_POINTS: f64 = 200.0;

/// Returns the range of the finite values and zero.
fn range_with_zero<'a>(points: impl IntoIterator<Item = &'a (f64, f64)>) -> (f64, f64) {
    let (from, to) = range(points.into_iter().map(|point| point.1));
    (from.min(0.0), to.max(0.0))
}

/// Returns a chart over time of computed curves in this range (SI), with Hertz' curve dashed. If that goes far beyond the
/// computed values, the axis ends before it and the label says how far it goes.
fn beside_hertz(
    time: Axis,
    (name, symbol): (&str, &str),
    (from, to): (f64, f64),
    curves: impl Iterator<Item = Curve>,
    (hertz_name, hertz): (&str, Vec<(f64, f64)>),
) -> Chart {
    let axis = quantity_axis(name, symbol, to.max(-from));
    let largest = range_with_zero(&hertz).1;
    let (axis, label) = match largest <= MAX_OVER_DATA * to {
        true => (axis, hertz_name.to_string()),
        false => (
            axis.from_to(MAX_OVER_DATA * from, MAX_OVER_DATA * to),
            format!("{hertz_name}, up to {}", show(largest, symbol)),
        ),
    };
    with_hertz(curves.fold(Chart::new(time, axis), Chart::with), hertz, label)
}

fn with_hertz(chart: Chart, points: Vec<(f64, f64)>, label: String) -> Chart {
    match points.is_empty() {
        true => chart,
        false => chart.with(Curve::dashed(label, points).coloured(GREY)),
    }
}

/// Returns Hertz' curves if they are the same for all results.
fn common_hertz(results: &[StoredResult]) -> Option<HertzCurves> {
    let of = |result: &StoredResult| result.summary.get("hertz").cloned();
    let first = of(results.first()?)?;
    let is_common = results.iter().all(|result| of(result).as_ref() == Some(&first));
    HertzCurves::of(results.first()?).filter(|_| is_common)
}

/// Returns the charts of height and velocity over several contacts and the flights between them; none for one contact.
///
/// The height is the gap between the bodies, the approach with the opposite sign.
pub fn bounce_charts(result: &StoredResult) -> Vec<Chart> {
    if result.list("bounces").len() < 2 {
        return Vec::new();
    }
    let times = || result.history.get("time_s").iter().copied();
    let column = |name: &str| -> Vec<(f64, f64)> {
        times().zip(result.history.get(name).iter().copied()).collect()
    };
    let moves = |(_, points): &(String, Vec<(f64, f64)>)| points.iter().any(|point| point.1 != 0.0);
    let speeds = result.body_names().into_iter();
    let speeds = speeds.map(|name| (name.clone(), column(&format!("velocity_{name}_m_s"))));
    let end = times().last().unwrap_or(1.0);
    let chart = |name: &str, unit: &str, curves: Vec<(String, Vec<(f64, f64)>)>| {
        let (from, to) = range_with_zero(curves.iter().flat_map(|(_, points)| points));
        let time = quantity_axis("time t", "s", end);
        let chart = Chart::new(time, quantity_axis(name, unit, to.max(-from)));
        let curves = curves.into_iter().enumerate();
        curves.fold(chart, |chart, (k, (name, points))| {
            chart.with(Curve::line(name, points).like_curve(k))
        })
    };
    let speeds: Vec<_> = speeds.collect();
    let rates = |k: usize| -> f64 {
        // Bodies are listed from below.
        let of = |body: usize| speeds.get(body).map_or(0.0, |(_, points)| points[k].1);
        of(1) - of(0)
    };
    let rows: Vec<[f64; 3]> = column("approach_m")
        .iter()
        .enumerate()
        .map(|(k, (time, approach))| [*time, -approach, rates(k)])
        .collect();
    let height = vec![("gap between the bodies".to_string(), on_cubics(&rows, end / MIN_POINTS))];
    let speeds = speeds.into_iter().filter(moves).collect();
    vec![chart("Height h", "m", height), chart("Velocity v, upward", "m/s", speeds)]
}

/// Returns points at most `longest` apart in time on the cubics through rows of time, value and rate. The cubics are
/// exact for a body in free flight.
fn on_cubics(rows: &[[f64; 3]], longest: f64) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::with_capacity(rows.len());
    for pair in rows.windows(2) {
        let [[start, from, from_rate], [end, to, to_rate]] = [pair[0], pair[1]];
        let length = end - start;
        let n = if longest > 0.0 { (length / longest).ceil().clamp(1.0, MIN_POINTS) } else { 1.0 };
        points.extend((0..n as usize).map(|k| {
            let t = k as f64 / n;
            let s = 1.0 - t;
            let value = s * s * (1.0 + 2.0 * t) * from + t * t * (1.0 + 2.0 * s) * to;
            (start + t * length, value + length * s * t * (s * from_rate - t * to_rate))
        }));
    }
    points.extend(rows.last().map(|[time, value, _]| (*time, *value)));
    points
}

/// Returns the chart of the contact force over the approach; `None` if no result has both.
pub fn loop_chart(results: &[StoredResult]) -> Option<Chart> {
    let points = |result: &StoredResult| -> Vec<(f64, f64)> {
        let approach = result.history.get("approach_m").iter().copied();
        let rows = result
            .history
            .get("time_s")
            .iter()
            .zip(approach.zip(result.history.get("contact_force_n").iter().copied()));
        let (start, end) = (result.first_touch(), result.last_touch());
        rows.filter(|(time, _)| (start..=end).contains(*time)).map(|(_, point)| point).collect()
    };
    let curves: Vec<_> = results.iter().map(points).collect();
    let (_, deepest) = range(curves.iter().flatten().map(|point| point.0));
    let (_, largest) = range(curves.iter().flatten().map(|point| point.1));
    if !(deepest > 0.0 && largest > 0.0) {
        return None;
    }
    let x = quantity_axis("approach δ", "m", deepest);
    let y = quantity_axis("Contact force F", "N", largest);
    Some(lines(results, curves).fold(Chart::new(x, y), Chart::with))
}

/// Returns the chart of a quantity over time; `None` if no result has it.
pub fn history_chart(results: &[StoredResult], quantity: Quantity) -> Option<Chart> {
    let hertz = common_hertz(results);
    let time = TimeAxis::of(results, hertz.as_ref());
    let (column, name, unit) = quantity.column();
    let curves: Vec<_> = results.iter().map(|result| time.column(result, column)).collect();
    let range = range_with_zero(curves.iter().flatten());
    if range.0 == range.1 {
        return None;
    }
    let hertz_points: Vec<(f64, f64)> = hertz.as_ref().map_or(Vec::new(), |hertz| {
        let history = hertz.history();
        history.iter().map(|now| (now.time, quantity.of_hertz(hertz, now))).collect()
    });
    let dots = |result: &StoredResult| {
        let start = result.first_touch();
        let at = |time: f64| (time - start, result.history.at(column, time));
        let times = drawn_contacts(result).into_iter().map(|contact| contact.time);
        let dots = times.map(at).filter(|(_, value)| value.is_finite()).collect();
        Curve::points("", dots).like_curve(0)
    };
    let only = if let [only] = results { Some(dots(only)) } else { None };
    let curves = lines(results, curves).chain(only);
    Some(beside_hertz(time.axis, (name, unit), range, curves, ("Hertz", hertz_points)))
}

/// Returns a named line of each result.
fn lines(results: &[StoredResult], curves: Vec<Vec<(f64, f64)>>) -> impl Iterator<Item = Curve> {
    results.iter().zip(curves).enumerate().map(|(k, (result, points))| {
        let label = if results.len() == 1 { "this run" } else { &result.name };
        Curve::line(label, points).like_curve(k)
    })
}

/// Returns the chart of the force over Hertz' peak force, over the time over Hertz' contact time; `None` if Hertz' results
/// are the same for all, where it would show what the chart of the force shows.
pub fn normalised_chart(results: &[StoredResult]) -> Option<Chart> {
    if common_hertz(results).is_some() {
        return None;
    }
    let x = Axis::new("time over Hertz' contact time t / T_H");
    let mut chart = Chart::new(x, Axis::new("Force over Hertz' peak force F / F_H"));
    let mut hertz_points = Vec::new();
    for (k, result) in results.iter().enumerate() {
        let own = TimeAxis::of(std::slice::from_ref(result), None);
        let scales = ["contact_time_s", "peak_force_n"].map(|key| result.number(&["hertz", key]));
        let (Some(time), Some(force)) = (scales[0], scales[1]) else { continue };
        let points = own.column(result, "contact_force_n").into_iter();
        let points = points.map(|(t, f)| (t / time, f / force)).collect();
        chart = chart.with(Curve::line(&result.name, points).like_curve(k));
        let hertz = HertzCurves::of(result).map(|hertz| hertz.history()).unwrap_or_default();
        let of_hertz = |now: &HertzInstant| (now.time / time, now.force / force);
        hertz_points = hertz.iter().map(of_hertz).collect();
    }
    Some(with_hertz(chart, hertz_points, "Hertz".to_string()))
}

/// Returns the chart of an oblique impact over time or, of several results, the velocity of the patch after over
/// before; `None` of head-on impacts.
pub fn oblique_charts(results: &[StoredResult]) -> Option<Chart> {
    if let [only] = results {
        return oblique_chart(only);
    }
    let point = |result: &StoredResult| {
        Some((result.number(&["psi_before"])?, result.number(&["psi_after"])?))
    };
    let points: Vec<_> = results.iter().filter_map(point).collect();
    let [x, y] = ["psi_before", "psi_after"].map(|column| Axis::new(column_words(column)));
    (!points.is_empty()).then(|| Chart::new(x, y).with(Curve::points("computed", points)))
}

/// Returns the chart of both contact forces, and the share of the contact that sticks, over time; `None` of a head-on impact.
pub(super) fn oblique_chart(result: &StoredResult) -> Option<Chart> {
    let time = TimeAxis::of(std::slice::from_ref(result), None);
    let column = |name: &str| time.column(result, name);
    let (normal, across) = (column("contact_force_n"), column("tangential_force_n"));
    let sticking = column("stick_radius_over_contact_radius");
    let (from, to) = range_with_zero(normal.iter().chain(&across));
    if !across.iter().any(|point| point.1.abs() > 0.0) {
        return None;
    }
    let y = quantity_axis("Contact force F", "N", to.max(-from));
    let largest = range_with_zero(&normal).1;
    let known = sticking.into_iter().filter(|point| point.1.is_finite());
    let sticking = known.map(|(time, share)| (time, share * largest)).collect();
    let chart = Chart::new(time.axis, y)
        .with(Curve::line("normal", normal).like_curve(0))
        .with(Curve::line("tangential", across).like_curve(1));
    let label = "stick radius / contact radius, of the largest force";
    Some(chart.with(Curve::dashed(label, sticking).coloured(GREY)))
}

/// Returns the chart of the energies of a result over time; `None` if its history has none.
pub fn energy_chart(result: &StoredResult) -> Option<Chart> {
    let hertz = HertzCurves::of(result);
    let time = TimeAxis::of(std::slice::from_ref(result), hertz.as_ref());
    let names = result.history.names().iter();
    let names = names.filter(|name| name.ends_with("_j") && *name != "residual_j");
    let accounts: Vec<(&String, Vec<(f64, f64)>)> =
        names.map(|name| (name, time.column(result, name))).collect();
    let (from, to) = range_with_zero(accounts.iter().flat_map(|(_, points)| points));
    if from == to {
        return None;
    }
    let hertz_points: Vec<(f64, f64)> = hertz.map_or(Vec::new(), |hertz| {
        hertz.history().iter().map(|now| (now.time, now.energy)).collect()
    });
    let is_visible = |points: &[(f64, f64)]| {
        let (least, most) = range_with_zero(points);
        let n_known = points.iter().filter(|point| point.1.is_finite()).count();
        // An energy that a model computes only at the end has no curve.
        most.max(-least) > FAINT * to.max(-from) && 2 * n_known > points.len()
    };
    let visible = accounts.into_iter().filter(|(_, points)| is_visible(points));
    let curves = visible.enumerate().map(|(k, (name, points))| {
        let label = match name.trim_end_matches("_j") {
            "viscous_dissipation" => "dissipated".to_string(),
            "contact" => "penalty springs".to_string(),
            other => other.replace('_', " "),
        };
        Curve::line(label, points).like_curve(k)
    });
    let hertz = ("Hertz' strain energy", hertz_points);
    Some(beside_hertz(time.axis, ("Energy E", "J"), (from, to), curves, hertz))
}

/// Returns the contacts that are drawn: all if there are few, and else those nearest to half the largest
/// approach, to the peak force, to half the largest approach again, and to the last contact.
pub fn drawn_contacts(result: &StoredResult) -> Vec<&ContactSnapshot> {
    if result.contacts.len() <= MAX_PROFILES {
        return result.contacts.iter().collect();
    }
    let (times, approach) = (result.history.get("time_s"), result.history.get("approach_m"));
    let peak = result.peak_time();
    let half = 0.5 * approach.iter().copied().filter(|a| a.is_finite()).fold(0.0, f64::max);
    let rows = || times.iter().copied().zip(approach.iter().copied());
    let before = rows().find(|(_, a)| *a >= half).map_or(peak, |(time, _)| time);
    let after = rows().find(|(time, a)| *time > peak && *a <= half);
    let after = after.map_or(peak, |(time, _)| time);
    let nearest = |time: f64| {
        let distance = |k: &usize| (result.contacts[*k].time - time).abs();
        (0..result.contacts.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let mut chosen: Vec<usize> =
        [before, peak, after, result.last_touch()].into_iter().filter_map(nearest).collect();
    chosen.sort_unstable();
    chosen.dedup();
    chosen.into_iter().map(|k| &result.contacts[k]).collect()
}
