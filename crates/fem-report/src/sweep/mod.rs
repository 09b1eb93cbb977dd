//! `sweep.svg`: one panel a column, curves over one varied key, Hertz dashed beside. Over what makes members
//! finer a second panel shows how far they are from their limit, and the limit stands in the place of Hertz.

use fem::sweep::{column_unit, column_words};
use fem_case::Sweep;
use fem_case::engineering::Unit;
use fem_figure::{Axis, COLOURS, Chart, Curve as Line, GREY, colour_along, legend_room};

use super::picture_convergence::{self, Converging, Fineness};
use super::picture_curves::{Curve, curves};
use super::picture_data::Choice;
use super::picture_points::PicturePoint;
use super::picture_words::{plain, role, role_of_all};

/// What curves are compared with, in the legend.
const HERTZ: &str = "Hertz";
/// The same where members converge.
const LIMIT: &str = "extrapolated limit";
/// Lines of a legend beside curves: what they are compared with, what failed, how many are not named.
const NOTES: usize = 3;
/// Steps between the entries of a colour map.
const MAP_ENTRIES: usize = 8;
/// Letters below a panel.
const LONGEST_LABEL: usize = 60;
/// Free space above and below the data over their range.
const MARGIN: f64 = 0.06;
/// Data that are less than this share of the range with what they are compared with are shown without it.
const LEAST_SHARE: f64 = 0.2;
/// No axis shows less than this share of its values: what differs by less is noise.
const NOISE: f64 = 1e-4;
/// Values that span this ratio go on a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 10.0;

/// The picture, or none if there is nothing to draw; so many members failed.
pub fn picture(
    sweep: &Sweep,
    points: &[PicturePoint],
    choice: &Choice,
    n_failed: usize,
) -> Option<String> {
    let key = sweep.keys().nth(choice.x.key).map_or("", |swept| swept.key.as_str());
    let fineness = Fineness::of(key).filter(|_| !choice.x.is_counted);
    let n_panels = choice.y.len() * if fineness.is_some() { 2 } else { 1 };
    let room = legend_room(n_panels).saturating_sub(NOTES);
    let panels = choice.y.iter().enumerate().flat_map(|(k, column)| {
        let mut curves = curves(sweep, points, choice, k);
        let errors = fineness.and_then(|fineness| {
            let of_curve = |curve: &Curve| Converging::of(fineness, column, curve);
            let converging: Vec<_> = curves.iter().map(of_curve).collect();
            // Where no curve has levels enough there is nothing to converge.
            converging.iter().any(Option::is_some).then_some((fineness, converging))
        });
        let reference = if errors.is_some() { LIMIT } else { HERTZ };
        if let Some((_, converging)) = &errors {
            for (curve, one) in curves.iter_mut().zip(converging) {
                curve.reference = one.as_ref().map(Converging::limit).unwrap_or_default();
            }
        }
        let value = chart(sweep, choice, column, (&curves, reference), room);
        let errors = errors.map(|(fineness, converging)| {
            let x = curves.iter().flat_map(|curve| curve.points.iter().map(|point| point.0));
            let horizontal = Scale::of(x, choice.x.unit).logarithmic();
            let (axis, paint) = (horizontal.axis(&along(sweep, choice)), Paint::of(&curves));
            let place = |x: f64| horizontal.scaled(x);
            let drawn = |line: Line, k: usize| paint.on(line, k);
            picture_convergence::chart(fineness, column, &converging, (axis, &place), &drawn)
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

/// A line of the legend that is no curve.
fn note(text: &str) -> Line {
    Line::line(text, Vec::new()).coloured("none")
}

/// Curves of a column, and beside them what they are compared with, by its name.
fn chart(
    sweep: &Sweep,
    choice: &Choice,
    column: &str,
    (curves, reference_name): (&[Curve], &'static str),
    room: usize,
) -> Chart {
    let own = || curves.iter().flat_map(|curve| &curve.points);
    let reference = || curves.iter().flat_map(|curve| &curve.reference);
    let x = own().map(|point| point.0).chain(reference().map(|point| point.0));
    let horizontal = Scale::of(x, choice.x.unit).linear_if(choice.x.is_counted);
    let horizontal = if reference_name == LIMIT { horizontal.logarithmic() } else { horizontal };
    let y = own().map(|point| point.1).chain(reference().map(|point| point.1));
    let vertical = Scale::of(y, Some(column_unit(column)));
    let scaled = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        points.iter().map(|(x, y)| (horizontal.scaled(*x), vertical.scaled(*y))).collect()
    };
    // Bars of many curves cover each other.
    let has_errors = curves.len() <= COLOURS.len();
    let bar = |(_, y, error): &(f64, f64, f64)| {
        let is_drawn = has_errors && !(vertical.is_logarithmic && error >= y);
        if is_drawn { vertical.scaled(*error) } else { 0.0 }
    };
    let own_range = own().map(|point| vertical.scaled(point.1));
    let bars = own().map(|point| (vertical.scaled(point.1), bar(point)));
    let y = vertical.axis(&column_words(column));
    let of_reference = reference().map(|point| vertical.scaled(point.1));
    let y = match shown(with_bars(own_range, bars), of_reference)
        .filter(|_| !vertical.is_logarithmic)
    {
        Some((from, to)) => y.from_to(from, to),
        None => y,
    };
    let mut chart = Chart::new(horizontal.axis(&along(sweep, choice)), y);
    // Between what is counted there is nothing.
    let reference_line = if choice.x.is_counted { Line::points } else { Line::dashed };
    let named = Named::of(curves, room);
    if let Some(heading) = &named.heading {
        chart = chart.with(note(heading));
    }
    let paint = Paint::of(curves);
    let is_one = curves.windows(2).all(|pair| pair[0].reference == pair[1].reference);
    for (k, curve) in curves.iter().enumerate() {
        let label = match curves.len() {
            1 => "computed",
            _ if named.has(k) => &curve.label,
            _ => "",
        };
        let points: Vec<(f64, f64)> = curve.points.iter().map(|(x, y, _)| (*x, *y)).collect();
        let errors = curve.points.iter().map(bar).collect();
        let line = match choice.x.is_counted {
            true => Line::points(label, scaled(&points)),
            false => Line::points_on_line(label, scaled(&points)),
        };
        chart = chart.with(paint.on(line, k).with_errors(errors));
        let reference = reference_line("", scaled(&curve.reference));
        chart = match (is_one, k) {
            (true, 0) => chart.with(reference.coloured(GREY)),
            (false, k) if has_errors => chart.with(paint.on(reference, k)),
            _ => chart,
        };
    }
    if let Some(note_of_rest) = &named.rest {
        chart = chart.with(note(note_of_rest));
    }
    if curves.iter().any(|curve| !curve.reference.is_empty()) && (is_one || has_errors) {
        chart = chart.with(reference_line(reference_name, Vec::new()).coloured(GREY));
    }
    chart
}

/// What is along the horizontal, in words; of what is counted what the numbers stand for.
fn along(sweep: &Sweep, choice: &Choice) -> String {
    let name = sweep.keys().nth(choice.x.key).map_or("", |swept| &swept.key);
    if !choice.x.is_counted {
        let of_all = sweep.axes[choice.x.axis].keys.len() > 1;
        return if of_all { role_of_all(name) } else { role(name) };
    }
    let elements = sweep.axes[choice.x.axis].elements.iter().enumerate();
    let said = elements.map(|(k, element)| format!("{} {}", k + 1, plain(&element.said(0))));
    let said = said.collect::<Vec<_>>().join(", ");
    match said.chars().count() {
        0..=LONGEST_LABEL => said,
        _ => format!("{}, in the order of the sweep", role(name)),
    }
}

/// What tells curves apart: colours in turn and, once all were used, other dashes; of more than there are
/// colours for a map of colours if a number tells them apart.
struct Paint {
    is_map: bool,
    ranks: Vec<usize>,
}

impl Paint {
    fn of(curves: &[Curve]) -> Self {
        let has_numbers = curves.iter().all(|curve| curve.number.is_some());
        Self { is_map: curves.len() > COLOURS.len() && has_numbers, ranks: ranks(curves) }
    }

    /// A line of the k-th curve.
    fn on(&self, line: Line, k: usize) -> Line {
        match self.is_map {
            true => line.coloured(colour_along(self.ranks[k], self.ranks.len())),
            false => line.like_curve(k),
        }
    }
}

/// Places of the curves by their numbers; in the order of the sweep if they have none.
fn ranks(curves: &[Curve]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..curves.len()).collect();
    order.sort_by(|a, b| {
        let number = |k: &usize| curves[*k].number.unwrap_or(*k as f64);
        number(a).total_cmp(&number(b))
    });
    let mut ranks = vec![0; curves.len()];
    order.iter().enumerate().for_each(|(rank, k)| ranks[*k] = rank);
    ranks
}

/// Which curves the legend names: all that it has room for. Of more that a number tells apart it is a colour
/// map, some of them evenly from the first to the last.
struct Named {
    stride: usize,
    n: usize,
    n_curves: usize,
    heading: Option<String>,
    rest: Option<String>,
}

impl Named {
    fn of(curves: &[Curve], room: usize) -> Self {
        let n_curves = curves.len();
        if n_curves <= room {
            return Self { stride: 1, n: n_curves, n_curves, heading: None, rest: None };
        }
        if curves.iter().all(|curve| curve.number.is_some()) {
            let stride = (n_curves - 1).div_ceil(MAP_ENTRIES);
            let heading = Some(format!("{n_curves} curves, colours run on between:"));
            return Self { stride, n: n_curves, n_curves, heading, rest: None };
        }
        let rest = Some(format!("… and {} more", n_curves - room));
        Self { stride: 1, n: room, n_curves, heading: None, rest }
    }

    fn has(&self, k: usize) -> bool {
        k < self.n && (k.is_multiple_of(self.stride) || k + 1 == self.n_curves)
    }
}

/// Values with the ends of their error bars. Beyond the values they go by no more than their range: what is
/// compared stays apart; where all bars are longer than that, nothing is told apart, and all are whole.
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

/// What an axis shows of its own values and of what they are compared with: all of the former, and the latter
/// unless they would take most of it. A range so small that rounding and noise fill it is widened.
fn shown(
    own: impl Iterator<Item = f64>,
    reference: impl Iterator<Item = f64>,
) -> Option<(f64, f64)> {
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
    };
    let (mut from, mut to) = range(&mut { own });
    if from > to {
        return None;
    }
    let (least, most) = range(&mut { reference });
    if to - from > LEAST_SHARE * (most.max(to) - least.min(from)) {
        (from, to) = (from.min(least), to.max(most));
    }
    let least_span = NOISE * from.abs().max(to.abs());
    let span = (to - from).max(least_span).max(f64::MIN_POSITIVE);
    let middle = 0.5 * (from + to);
    Some((middle - (0.5 + MARGIN) * span, middle + (0.5 + MARGIN) * span))
}

/// How numbers stand on an axis.
struct Scale {
    /// None: no unit, or one that takes no prefix.
    unit: Option<Unit>,
    symbol: Option<&'static str>,
    is_positive: bool,
    is_logarithmic: bool,
}

impl Scale {
    fn of(values: impl Iterator<Item = f64> + Clone, symbol: Option<&'static str>) -> Self {
        let smallest = values.clone().fold(f64::INFINITY, f64::min);
        let largest = values.fold(f64::NEG_INFINITY, f64::max);
        let takes_prefix =
            symbol.is_some_and(|unit| ["m", "m/s", "s", "N", "Pa", "J"].contains(&unit));
        let unit = symbol.filter(|_| takes_prefix);
        let unit = unit.map(|unit| Unit::fitting(largest.abs().max(smallest.abs()), unit));
        Self {
            symbol,
            is_positive: smallest > 0.0,
            is_logarithmic: smallest > 0.0 && largest >= LOGARITHMIC_FROM * smallest,
            unit,
        }
    }

    /// The same, not logarithmic if `linear`.
    fn linear_if(mut self, linear: bool) -> Self {
        self.is_logarithmic &= !linear;
        self
    }

    /// The same, logarithmic if its values are positive.
    fn logarithmic(mut self) -> Self {
        self.is_logarithmic |= self.is_positive;
        self
    }

    fn scaled(&self, value: f64) -> f64 {
        self.unit.as_ref().map_or(value, |unit| unit.scaled(value))
    }

    fn axis(&self, name: &str) -> Axis {
        let axis = Axis::new(self.label(name));
        if self.is_logarithmic { axis.logarithmic() } else { axis }
    }

    fn label(&self, name: &str) -> String {
        match self.unit.as_ref().map(Unit::symbol).or(self.symbol) {
            Some("") | None => name.to_string(),
            Some(symbol) => format!("{name} [{symbol}]"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_show_the_data_and_no_noise() {
        let shown =
            |own: &[f64], hertz: &[f64]| shown(own.iter().copied(), hertz.iter().copied()).unwrap();
        // Hertz is far away: the data fill the axis.
        let (from, to) = shown(&[0.921, 0.929], &[1.0]);
        assert!(from > 0.92 && to < 0.93, "{from} {to}");
        // He is near: both are shown.
        let (from, to) = shown(&[60.0, 62.0], &[60.5, 62.6]);
        assert!(from < 60.0 && to > 62.6, "{from} {to}");
        // A millionth is no curve.
        let (from, to) = shown(&[1.0 - 2e-6, 1.0 - 1e-6], &[1.0]);
        assert!(to - from > 1e-4, "{from} {to}");
        assert!(super::shown([f64::NAN].into_iter(), [1.0].into_iter()).is_none());
        // A bar that is longer than all the rest is cut off; one alone, and bars that are all so long, are whole.
        let ends = |bars: &[(f64, f64)]| {
            let bars = bars.iter().copied();
            super::with_bars(bars.clone().map(|(value, _)| value), bars).collect::<Vec<_>>()
        };
        assert_eq!(ends(&[(1.0, 5.0), (2.0, 0.5)]), [0.0, 3.0, 1.5, 2.5]);
        assert_eq!(ends(&[(1.0, 5.0), (2.0, 4.0)]), [-4.0, 6.0, -2.0, 6.0]);
        assert_eq!(ends(&[(1.0, 5.0)]), [-4.0, 6.0]);
    }
}
