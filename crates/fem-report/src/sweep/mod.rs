//! The figure of a sweep, `sweep.svg`: one panel per column, over one varied key, with Hertz dashed.
//!
//! Over a key that controls the resolution, such as the element size, each column gets a second panel with
//! its convergence, and the extrapolated limit takes the place of Hertz.

mod choice;
mod convergence;
mod curves;
mod labels;

use fem::sweep::{column_unit, column_words};
use fem_case::Sweep;
use fem_figure::{COLOURS, Chart, Curve as Line, GREY, colour_along, legend_room};

use crate::quantity_axis::{QuantityAxis, chart_axes, range};
use convergence::{ConvergingCurve, ResolutionKey, convergence_chart};
use curves::{SweepCurve, curves};
use labels::{plain, role, role_of_all};

pub use choice::{FigureChoice, HorizontalKey};
pub use curves::{FigurePoint, PanelValues};

/// Legend entries of the dashed reference curves.
const HERTZ: &str = "Hertz";
const LIMIT: &str = "extrapolated limit";
/// Lines of the legend that are not curves: the reference, failed members, curves without a name.
const NOTES: usize = 3;
/// Curves between two legend entries of a colour map.
const MAP_ENTRIES: usize = 8;
/// Most characters of an axis label.
const LONGEST_LABEL: usize = 60;
/// Free space above and below the data over their range.
const MARGIN: f64 = 0.06;
/// The reference is left outside the axis if the data would fill less than this share of it.
const MIN_SHARE: f64 = 0.2;
/// Smallest relative range of an axis; smaller differences are noise.
const NOISE: f64 = 1e-4;

/// Returns the figure as SVG, or `None` if there is nothing to draw; `n_failed` members are mentioned in
/// the legend.
pub fn sweep_figure(
    sweep: &Sweep,
    points: &[FigurePoint],
    choice: &FigureChoice,
    n_failed: usize,
) -> Option<String> {
    let key = sweep.keys().nth(choice.x.key).map_or("", |swept| swept.key.as_str());
    let resolution = ResolutionKey::of(key).filter(|_| !choice.x.is_counted);
    let n_panels = choice.y.len() * if resolution.is_some() { 2 } else { 1 };
    let room = legend_room(n_panels).saturating_sub(NOTES);
    let panels = choice.y.iter().enumerate().flat_map(|(k, column)| {
        let mut curves = curves(sweep, points, choice, k);
        let converging = resolution.and_then(|resolution| {
            let of_curve = |curve: &SweepCurve| ConvergingCurve::of(resolution, column, curve);
            let converging: Vec<_> = curves.iter().map(of_curve).collect();
            // Without a curve of enough levels there is no convergence to show.
            converging.iter().any(Option::is_some).then_some((resolution, converging))
        });
        let reference = if converging.is_some() { LIMIT } else { HERTZ };
        if let Some((_, converging)) = &converging {
            for (curve, one) in curves.iter_mut().zip(converging) {
                curve.reference = one.as_ref().map(ConvergingCurve::limit).unwrap_or_default();
            }
        }
        let value = value_chart(sweep, choice, column, (&curves, reference), room);
        let errors = converging.map(|(resolution, converging)| {
            let x = curves.iter().flat_map(|curve| curve.points.iter().map(|point| point.0));
            let x = horizontal_axis(sweep, choice, x).logarithmic_if_positive();
            let colours = CurveColours::of(&curves);
            let coloured = |line: Line, k: usize| colours.on(line, k);
            convergence_chart(resolution, column, &converging, &x, &coloured)
        });
        [Some(value), errors]
    });
    let with_note = |chart: Chart| match n_failed {
        0 => chart,
        1 => chart.with(note("1 member failed")),
        n => chart.with(note(&format!("{n} members failed"))),
    };
    fem_figure::svg(&panels.flatten().map(with_note).collect::<Vec<_>>())
}

/// Returns a line of the legend that is no curve.
fn note(text: &str) -> Line {
    Line::line(text, Vec::new()).coloured("none")
}

fn horizontal_axis(
    sweep: &Sweep,
    choice: &FigureChoice,
    values: impl Iterator<Item = f64>,
) -> QuantityAxis {
    QuantityAxis::fitting(horizontal_label(sweep, choice), choice.x.unit.unwrap_or(""), values)
}

/// Returns the chart of a column: its curves, and their references under `reference_name`.
fn value_chart(
    sweep: &Sweep,
    choice: &FigureChoice,
    column: &'static str,
    (curves, reference_name): (&[SweepCurve], &'static str),
    room: usize,
) -> Chart {
    let own = || curves.iter().flat_map(|curve| &curve.points);
    let reference = || curves.iter().flat_map(|curve| &curve.reference);
    let x = own().map(|point| point.0).chain(reference().map(|point| point.0));
    let x = horizontal_axis(sweep, choice, x);
    let x = if choice.x.is_counted { x.not_logarithmic() } else { x };
    let x = if reference_name == LIMIT { x.logarithmic_if_positive() } else { x };
    let y = own().map(|point| point.1).chain(reference().map(|point| point.1));
    let y = QuantityAxis::fitting(column_words(column), column_unit(column), y);
    // Error bars of many curves would cover each other.
    let has_errors = curves.len() <= COLOURS.len();
    let bar = |(_, value, error): &(f64, f64, f64)| {
        let is_drawn = has_errors && !(y.is_logarithmic() && error >= value);
        if is_drawn { *error } else { 0.0 }
    };
    let bars = own().map(|point| (point.1, bar(point)));
    let shown =
        shown_range(with_bars(own().map(|point| point.1), bars), reference().map(|point| point.1));
    let errors = |curve: &SweepCurve| curve.points.iter().map(|at| y.scaled(bar(at))).collect();
    let errors: Vec<Vec<f64>> = curves.iter().map(errors).collect();
    let y = match shown.filter(|_| !y.is_logarithmic()) {
        Some((from, to)) => y.from_to(from, to),
        None => y,
    };
    let mut chart = chart_axes(&x, &y);
    // Counted values are not connected by lines.
    let reference_line = if choice.x.is_counted { Line::points } else { Line::dashed };
    let legend = LegendChoice::of(curves, room);
    if let Some(heading) = &legend.heading {
        chart = chart.with(note(heading));
    }
    let colours = CurveColours::of(curves);
    let is_one = curves.windows(2).all(|pair| pair[0].reference == pair[1].reference);
    for (k, (curve, errors)) in curves.iter().zip(errors).enumerate() {
        let label = match curves.len() {
            1 => "computed",
            _ if legend.has(k) => &curve.label,
            _ => "",
        };
        let points: Vec<(f64, f64)> = curve.points.iter().map(|(x, y, _)| (*x, *y)).collect();
        let line = match choice.x.is_counted {
            true => Line::points(label, x.points(&y, &points)),
            false => Line::points_on_line(label, x.points(&y, &points)),
        };
        chart = chart.with(colours.on(line, k).with_errors(errors));
        let reference = reference_line("", x.points(&y, &curve.reference));
        chart = match (is_one, k) {
            (true, 0) => chart.with(reference.coloured(GREY)),
            (false, k) if has_errors => chart.with(colours.on(reference, k)),
            _ => chart,
        };
    }
    if let Some(rest) = &legend.rest {
        chart = chart.with(note(rest));
    }
    if curves.iter().any(|curve| !curve.reference.is_empty()) && (is_one || has_errors) {
        chart = chart.with(reference_line(reference_name, Vec::new()).coloured(GREY));
    }
    chart
}

/// Returns the label of the horizontal axis; for counted values, what each number stands for.
fn horizontal_label(sweep: &Sweep, choice: &FigureChoice) -> String {
    let name = sweep.keys().nth(choice.x.key).map_or("", |swept| &swept.key);
    if !choice.x.is_counted {
        let of_all = sweep.axes[choice.x.axis].keys.len() > 1;
        return if of_all { role_of_all(name) } else { role(name) };
    }
    let elements = sweep.axes[choice.x.axis].values.iter().enumerate();
    let said = elements.map(|(k, element)| format!("{} {}", k + 1, plain(&element.displayed(0))));
    let said = said.collect::<Vec<_>>().join(", ");
    match said.chars().count() {
        0..=LONGEST_LABEL => said,
        _ => format!("{}, in the order of the sweep", role(name)),
    }
}

/// The colours of curves: in turn with other dashes once all are used, or a colour map if there are more
/// curves than colours and a number distinguishes them.
struct CurveColours {
    is_map: bool,
    ranks: Vec<usize>,
}

impl CurveColours {
    fn of(curves: &[SweepCurve]) -> Self {
        let has_numbers = curves.iter().all(|curve| curve.number.is_some());
        Self { is_map: curves.len() > COLOURS.len() && has_numbers, ranks: ranks(curves) }
    }

    /// Returns a line in the colour of the k-th curve.
    fn on(&self, line: Line, k: usize) -> Line {
        match self.is_map {
            true => line.coloured(colour_along(self.ranks[k], self.ranks.len())),
            false => line.like_curve(k),
        }
    }
}

/// Returns the ranks of the curves by their numbers, or in the order of the sweep if they have none.
fn ranks(curves: &[SweepCurve]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..curves.len()).collect();
    order.sort_by(|a, b| {
        let number = |k: &usize| curves[*k].number.unwrap_or(*k as f64);
        number(a).total_cmp(&number(b))
    });
    let mut ranks = vec![0; curves.len()];
    order.iter().enumerate().for_each(|(rank, k)| ranks[*k] = rank);
    ranks
}

/// The curves that the legend names: as many as it has room for or, for a colour map, evenly spaced ones from
/// the first to the last.
struct LegendChoice {
    stride: usize,
    n: usize,
    n_curves: usize,
    heading: Option<String>,
    rest: Option<String>,
}

impl LegendChoice {
    fn of(curves: &[SweepCurve], room: usize) -> Self {
        let n_curves = curves.len();
        if n_curves <= room {
            return Self { stride: 1, n: n_curves, n_curves, heading: None, rest: None };
        }
        if curves.iter().all(|curve| curve.number.is_some()) {
            let stride = (n_curves - 1).div_ceil(MAP_ENTRIES);
            let heading = Some(format!("{n_curves} curves, colours continue between:"));
            return Self { stride, n: n_curves, n_curves, heading, rest: None };
        }
        let rest = Some(format!("… and {} more", n_curves - room));
        Self { stride: 1, n: room, n_curves, heading: None, rest }
    }

    fn has(&self, k: usize) -> bool {
        k < self.n && (k.is_multiple_of(self.stride) || k + 1 == self.n_curves)
    }
}

/// Returns the ends of the error bars, cut off at one range beyond the values so that the values stay
/// distinguishable; if all bars are longer than that, none is cut off.
fn with_bars(
    own: impl Iterator<Item = f64>,
    bars: impl Iterator<Item = (f64, f64)> + Clone,
) -> impl Iterator<Item = f64> {
    let (from, to) = own.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let shortest = bars.clone().fold(f64::INFINITY, |least, (_, bar)| least.min(bar));
    let room = if to > from && shortest <= to - from { to - from } else { f64::INFINITY };
    bars.flat_map(|(value, bar)| [value - bar, value + bar])
        .map(move |end: f64| end.max(from - room).min(to + room))
}

/// Returns the range of an axis: all values, and the references unless they would take most of it. A range
/// that is filled by rounding and noise is widened.
fn shown_range(
    own: impl Iterator<Item = f64>,
    reference: impl Iterator<Item = f64>,
) -> Option<(f64, f64)> {
    let (mut from, mut to) = range(own);
    if from > to {
        return None;
    }
    let (least, most) = range(reference);
    if to - from > MIN_SHARE * (most.max(to) - least.min(from)) {
        (from, to) = (from.min(least), to.max(most));
    }
    let least_span = NOISE * from.abs().max(to.abs());
    let span = (to - from).max(least_span).max(f64::MIN_POSITIVE);
    let middle = 0.5 * (from + to);
    Some((middle - (0.5 + MARGIN) * span, middle + (0.5 + MARGIN) * span))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_show_the_data_and_no_noise() {
        let shown = |own: &[f64], hertz: &[f64]| {
            shown_range(own.iter().copied(), hertz.iter().copied()).unwrap()
        };
        // Hertz is far away: the data fill the axis.
        let (from, to) = shown(&[0.921, 0.929], &[1.0]);
        assert!(from > 0.92 && to < 0.93, "{from} {to}");
        // Hertz is near: both are shown.
        let (from, to) = shown(&[60.0, 62.0], &[60.5, 62.6]);
        assert!(from < 60.0 && to > 62.6, "{from} {to}");
        // Differences of a millionth are noise.
        let (from, to) = shown(&[1.0 - 2e-6, 1.0 - 1e-6], &[1.0]);
        assert!(to - from > 1e-4, "{from} {to}");
        assert!(shown_range([f64::NAN].into_iter(), [1.0].into_iter()).is_none());
        // A bar longer than the range is cut off, unless all bars are.
        let ends = |bars: &[(f64, f64)]| {
            let bars = bars.iter().copied();
            with_bars(bars.clone().map(|(value, _)| value), bars).collect::<Vec<_>>()
        };
        assert_eq!(ends(&[(1.0, 5.0), (2.0, 0.5)]), [0.0, 3.0, 1.5, 2.5]);
        assert_eq!(ends(&[(1.0, 5.0), (2.0, 4.0)]), [-4.0, 6.0, -2.0, 6.0]);
        assert_eq!(ends(&[(1.0, 5.0)]), [-4.0, 6.0]);
    }
}
