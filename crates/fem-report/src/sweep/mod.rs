//! The figure of a sweep, `sweep.svg`: one panel per column, over one varied key, with Hertz dashed.
//!
//! Over a key that controls the resolution, such as the element size, each column gets a second panel with
//! its convergence, and the extrapolated limit takes the place of Hertz.

mod choice;
mod convergence;
mod curves;
mod labels;

use fem::sweep::{column_below, column_unit, column_words};
use fem_case::Sweep;
use fem_figure::{Axis, COLOURS, Chart, Curve as Line, GREY, colour_along, legend_room};

use crate::quantity_axis::{DECADE, fitting_axis, range};
use convergence::{ConvergingCurve, ResolutionKey, convergence_chart};
use curves::{SweepCurve, curves, label};
use labels::{plain, role, role_of_all};

pub use choice::{FigureChoice, HorizontalKey};
pub use curves::{FigurePoint, PanelValues};

/// Legend entries of the dashed reference curves.
const HERTZ: &str = "Hertz";
const LIMIT: &str = "extrapolated limit";
/// Legend entry of points that are bounds.
const BOUND: &str = "bound";
/// Turn of the colours whose marker, the diamond, bounds have.
const TURN_OF_BOUNDS: usize = 3;
/// Lines of the legend that are not curves: the reference, failed members, curves without a name, bounds.
const NOTES: usize = 4;
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
            let x = horizontal_axis(sweep, choice, x, 1.0);
            let colours = CurveColours::of(sweep, choice, &curves);
            let coloured = |line: Line, k: usize| colours.on(line, k);
            convergence_chart(resolution, column, &converging, x, &coloured)
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
    logarithmic_from: f64,
) -> Axis {
    let (name, unit) = (horizontal_label(sweep, choice), choice.x.unit.unwrap_or(""));
    fitting_axis(name, unit, values, logarithmic_from)
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
    let logarithmic_from = match reference_name {
        LIMIT => 1.0,
        _ if choice.x.is_counted || choice.x.unit == Some("°") => f64::INFINITY,
        _ => DECADE,
    };
    let x = match column_below(column) {
        Some(below) => fitting_axis(column_words(below), column_unit(below), x, f64::INFINITY),
        None => horizontal_axis(sweep, choice, x, logarithmic_from),
    };
    let y = own().map(|point| point.1).chain(reference().map(|point| point.1));
    let y = fitting_axis(column_words(column), column_unit(column), y, DECADE);
    // Error bars of many curves would cover each other.
    let has_errors = curves.len() <= COLOURS.len();
    let bar = |(_, value, error): &(f64, f64, f64)| {
        let is_drawn = has_errors && !(y.is_logarithmic() && error >= value);
        if is_drawn { *error } else { 0.0 }
    };
    // Bars of values that are not negative end at zero.
    let floor = |value: f64| if value < 0.0 { f64::NEG_INFINITY } else { 0.0 };
    let ends = own().flat_map(|point| {
        let (value, bar) = (point.1, bar(point));
        [(value - bar).max(floor(value)), value + bar]
    });
    let shown = shown_range(ends, reference().map(|point| point.1));
    let errors = |curve: &SweepCurve| curve.points.iter().map(bar).collect();
    let errors: Vec<Vec<f64>> = curves.iter().map(errors).collect();
    let y = match shown.filter(|_| !y.is_logarithmic()) {
        Some((from, to)) => y.from_to(from, to),
        None => y,
    };
    let mut chart = Chart::new(x, y);
    // Counted values are not connected by lines.
    let reference_line = if choice.x.is_counted { Line::points } else { Line::dashed };
    let colours = CurveColours::of(sweep, choice, curves);
    let legend = LegendChoice::of(curves, room);
    for (k, name) in colours.pair.iter().flat_map(|pair| &pair.style_names).enumerate() {
        let line = Line::points_on_line(name, Vec::new()).like_curve(k * COLOURS.len());
        chart = chart.with(line.in_colour(GREY));
    }
    if let Some(heading) = &legend.heading {
        chart = chart.with(note(heading));
    }
    let is_one = curves.windows(2).all(|pair| pair[0].reference == pair[1].reference);
    for (k, (curve, errors)) in curves.iter().zip(errors).enumerate() {
        let label = match (curves.len(), &colours.pair) {
            (1, _) => "computed",
            (_, Some(pair)) => pair.colour_label(curve),
            _ if legend.has(k) => &curve.label,
            _ => "",
        };
        let points = curve.points.iter().map(|(x, y, _)| (*x, *y)).collect();
        let line = match choice.x.is_counted {
            true => Line::points(label, points),
            false => Line::points_on_line(label, points),
        };
        chart = chart.with(colours.on(line, k).with_errors(errors));
        let reference = reference_line("", curve.reference.clone());
        chart = match (is_one, k) {
            (true, 0) => chart.with(reference.coloured(GREY)),
            (false, k) if has_errors => chart.with(colours.on(reference, k)),
            _ => chart,
        };
    }
    let bounds: Vec<_> = curves.iter().flat_map(|curve| curve.bounds.iter().copied()).collect();
    if !bounds.is_empty() {
        let line = Line::points(BOUND, bounds);
        chart = chart.with(line.like_curve(TURN_OF_BOUNDS * COLOURS.len()).in_colour(GREY));
    }
    if let Some(rest) = legend.rest.as_ref().filter(|_| colours.pair.is_none()) {
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

/// The colours of curves. Few curves have colours in turn. More curves than colours have a colour map if a number
/// distinguishes them, and a colour for one key and dashes and markers for the other if two keys do. Otherwise colours
/// are in turn, with other dashes once all are used.
struct CurveColours {
    is_map: bool,
    ranks: Vec<usize>,
    pair: Option<KeyPair>,
    places: Vec<Vec<usize>>,
}

impl CurveColours {
    fn of(sweep: &Sweep, choice: &FigureChoice, curves: &[SweepCurve]) -> Self {
        let is_many = curves.len() > COLOURS.len();
        let has_numbers = curves.iter().all(|curve| curve.number.is_some());
        Self {
            is_map: is_many && has_numbers,
            ranks: ranks(curves),
            pair: KeyPair::of(sweep, choice).filter(|_| is_many),
            places: curves.iter().map(|curve| curve.place.clone()).collect(),
        }
    }

    /// Returns a line in the colour of the k-th curve.
    fn on(&self, line: Line, k: usize) -> Line {
        match &self.pair {
            Some(pair) => pair.on(line, &self.places[k]),
            None if self.is_map => line.coloured(colour_along(self.ranks[k], self.ranks.len())),
            None => line.like_curve(k),
        }
    }
}

/// Two keys that distinguish curves: the one with more values by colours, the other by dashes and markers.
struct KeyPair {
    /// Which of the two axes has the colours, 0 or 1.
    colour: usize,
    colour_names: Vec<String>,
    style_names: Vec<String>,
}

impl KeyPair {
    /// Most values that dashes and markers distinguish.
    const MAX_STYLES: usize = 4;

    fn of(sweep: &Sweep, choice: &FigureChoice) -> Option<Self> {
        let &[first, second] = choice.series.as_slice() else { return None };
        let n = [first, second].map(|axis| sweep.axes[axis].values.len());
        let colour = usize::from(n[1] > n[0]);
        let names = |axis: usize| -> Vec<String> {
            let name = |k: usize| {
                let mut elements = vec![0; sweep.axes.len()];
                elements[axis] = k;
                label(sweep, &elements, &[axis])
            };
            (0..sweep.axes[axis].values.len()).map(name).collect()
        };
        let axes = [choice.series[colour], choice.series[1 - colour]];
        let [colour_names, style_names] = axes.map(names);
        (n[1 - colour] <= Self::MAX_STYLES).then_some(Self { colour, colour_names, style_names })
    }

    /// Returns a line in the style of the curve at this place.
    fn on(&self, line: Line, place: &[usize]) -> Line {
        let (own, style) = (place[self.colour], place[1 - self.colour]);
        let n = self.colour_names.len();
        let line = line.like_curve(style * COLOURS.len());
        match n > COLOURS.len() {
            true => line.in_colour(colour_along(own, n)),
            false => line.in_colour(COLOURS[own]),
        }
    }

    /// Returns the name of a curve's colour, which the legend shows once.
    fn colour_label<'a>(&'a self, curve: &SweepCurve) -> &'a str {
        let is_plain = curve.place[1 - self.colour] == 0;
        if is_plain { &self.colour_names[curve.place[self.colour]] } else { "" }
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
        let rest = Some(format!("… and {} more; plot.series chooses one key", n_curves - room));
        Self { stride: 1, n: room, n_curves, heading: None, rest }
    }

    fn has(&self, k: usize) -> bool {
        k < self.n && (k.is_multiple_of(self.stride) || k + 1 == self.n_curves)
    }
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
    }
}
