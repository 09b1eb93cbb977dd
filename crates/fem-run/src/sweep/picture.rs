//! `sweep.svg`: one panel a column, curves over one varied key, Hertz dashed beside.

use fem::sweep::{column_unit, column_words};
use fem_case::Sweep;
use fem_case::engineering::Unit;
use fem_figure::{Axis, Chart, Curve as Line, GREY};

use super::picture_data::{Choice, Curve, Horizontal, curves};
use super::picture_points::PicturePoint;

/// Hertz in the legend.
const HERTZ: &str = "Hertz";
/// Curves that a legend has room for beside Hertz.
const LONGEST_LEGEND: usize = 14;
/// Values that span this ratio go on a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 10.0;

/// The picture, or none if there is nothing to draw.
pub fn picture(sweep: &Sweep, points: &[PicturePoint], choice: &Choice) -> Option<String> {
    let x = choice.x.as_ref()?;
    let panel = |(k, column): (usize, &&'static str)| {
        chart(sweep, x, column, &curves(sweep, points, choice, x, k))
    };
    fem_figure::svg(&choice.y.iter().enumerate().map(panel).collect::<Vec<_>>())
}

fn chart(sweep: &Sweep, x: &Horizontal, column: &str, curves: &[Curve]) -> Chart {
    let all = || curves.iter().flat_map(|curve| curve.points.iter().chain(&curve.hertz));
    let horizontal = Scale::of(all().map(|point| point.0), x.unit);
    let vertical = Scale::of(all().map(|point| point.1), Some(column_unit(column)));
    let scaled = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        points.iter().map(|(x, y)| (horizontal.scaled(*x), vertical.scaled(*y))).collect()
    };
    let name = sweep.keys().nth(x.key).map_or("", |swept| &swept.key);
    let mut chart = Chart::new(horizontal.axis(name), vertical.axis(&column_words(column)));
    for (k, curve) in curves.iter().enumerate() {
        let label = match curves.len() {
            1 => "computed",
            _ if k < LONGEST_LEGEND => &curve.label,
            _ => "",
        };
        let hertz = Line::dashed("", scaled(&curve.hertz));
        let hertz = if curves.len() == 1 { hertz.coloured(GREY) } else { hertz.like_curve(k) };
        chart = chart
            .with(Line::points_on_line(label, scaled(&curve.points)).like_curve(k))
            .with(hertz);
    }
    if curves.iter().any(|curve| !curve.hertz.is_empty()) {
        chart = chart.with(Line::dashed(HERTZ, Vec::new()).coloured(GREY));
    }
    chart
}

/// How numbers stand on an axis.
struct Scale {
    /// None: no unit, or one that takes no prefix.
    unit: Option<Unit>,
    symbol: Option<&'static str>,
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
            is_logarithmic: smallest > 0.0 && largest >= LOGARITHMIC_FROM * smallest,
            unit,
        }
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
