//! Charts over time: one result next to Hertz' curves, or several results over each other.

use fem_case::engineering::show;
use fem_figure::{Chart, Curve, GREY};

use super::hertz_curves::{HertzCurves, HertzInstant};
use super::stored_result::{ContactSnapshot, StoredResult};
use crate::quantity_axis::{QuantityAxis, chart_axes, range};

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
    axis: QuantityAxis,
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
        let axis = QuantityAxis::linear("time since first touch t", "s", end).from_to(0.0, end);
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

/// Returns the range of the finite values and zero.
fn range_with_zero<'a>(points: impl IntoIterator<Item = &'a (f64, f64)>) -> (f64, f64) {
    let (from, to) = range(points.into_iter().map(|point| point.1));
    (from.min(0.0), to.max(0.0))
}

/// Returns the vertical axis for computed values in this range (SI), and the label of Hertz' curve. If
/// Hertz' curve goes far beyond the computed values, the axis ends before it and the label says how far it
/// goes.
fn vertical_axis(
    (name, symbol): (&str, &'static str),
    (from, to): (f64, f64),
    hertz: &[(f64, f64)],
    hertz_name: &str,
) -> (QuantityAxis, String) {
    let axis = QuantityAxis::linear(name, symbol, to.max(-from));
    let largest = range_with_zero(hertz).1;
    if largest <= MAX_OVER_DATA * to {
        return (axis, hertz_name.to_string());
    }
    let label = format!("{hertz_name}, up to {}", show(largest, symbol));
    (axis.from_to(MAX_OVER_DATA * from, MAX_OVER_DATA * to), label)
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

/// Returns the chart of the velocities over several contacts and the flights between them; `None` for one contact.
pub fn velocity_chart(result: &StoredResult) -> Option<Chart> {
    if result.list("bounces").len() < 2 {
        return None;
    }
    let times = || result.history.get("time_s").iter().copied();
    let columns = result.body_names().into_iter().map(|name| {
        let values = result.history.get(&format!("velocity_{name}_m_s")).iter().copied();
        (name.to_string(), times().zip(values).collect::<Vec<_>>())
    });
    let columns: Vec<_> =
        columns.filter(|(_, points)| points.iter().any(|it| it.1 != 0.0)).collect();
    let (from, to) = range_with_zero(columns.iter().flat_map(|(_, points)| points));
    let time = QuantityAxis::linear("time t", "s", times().last()?);
    let velocity = QuantityAxis::linear("Velocity v, upward", "m/s", to.max(-from));
    let scaled = |points: &[(f64, f64)]| {
        points.iter().map(|(t, v)| (time.scaled(*t), velocity.scaled(*v))).collect()
    };
    let chart = chart_axes(&time, &velocity);
    Some(columns.iter().enumerate().fold(chart, |chart, (k, (name, points))| {
        chart.with(Curve::line(name.clone(), scaled(points)).like_curve(k))
    }))
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
    let (y, hertz_name) = vertical_axis((name, unit), range, &hertz_points, "Hertz");
    let mut chart = chart_axes(&time.axis, &y);
    for (k, (result, points)) in results.iter().zip(&curves).enumerate() {
        let label = if results.len() == 1 { "this run" } else { &result.name };
        chart = chart.with(Curve::line(label, time.axis.points(&y, points)).like_curve(k));
        if results.len() == 1 {
            let start = result.first_touch();
            let at = |time: f64| (time - start, result.history.at(column, time));
            let times = drawn_contacts(result).into_iter().map(|contact| contact.time);
            let dots: Vec<_> = times.map(at).filter(|(_, value)| value.is_finite()).collect();
            chart = chart.with(Curve::points("", time.axis.points(&y, &dots)).like_curve(k));
        }
    }
    Some(with_hertz(chart, time.axis.points(&y, &hertz_points), hertz_name))
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
    let (y, hertz_name) =
        vertical_axis(("Energy E", "J"), (from, to), &hertz_points, "Hertz' strain energy");
    let mut chart = chart_axes(&time.axis, &y);
    let is_visible = |points: &[(f64, f64)]| {
        let (least, most) = range_with_zero(points);
        let n_known = points.iter().filter(|point| point.1.is_finite()).count();
        // An energy that a model computes only at the end has no curve.
        most.max(-least) > FAINT * to.max(-from) && 2 * n_known > points.len()
    };
    let visible = accounts.iter().filter(|(_, points)| is_visible(points));
    for (k, (name, points)) in visible.enumerate() {
        let label = match name.trim_end_matches("_j") {
            "viscous_dissipation" => "dissipated".to_string(),
            "contact" => "penalty springs".to_string(),
            other => other.replace('_', " "),
        };
        chart = chart.with(Curve::line(label, time.axis.points(&y, points)).like_curve(k));
    }
    Some(with_hertz(chart, time.axis.points(&y, &hertz_points), hertz_name))
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
