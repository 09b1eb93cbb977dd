//! `sweep.svg`: one panel a column, curves over one varied key, Hertz dashed beside.

use std::borrow::Cow;

use fem::sweep::{column_unit, column_words};
use fem_case::Sweep;
use fem_case::engineering::Unit;
use fem_figure::{Axis, COLOURS, Chart, Curve as Line, GREY, colour_along};

use super::picture_data::{Choice, Curve, Horizontal, curves};
use super::picture_points::PicturePoint;

/// Hertz in the legend.
const HERTZ: &str = "Hertz";
/// Curves that a legend has room for beside Hertz.
const LONGEST_LEGEND: usize = 14;
/// Free space above and below the data over their range.
const MARGIN: f64 = 0.06;
/// Data that are less than this share of the range with Hertz are shown without Hertz.
const LEAST_SHARE: f64 = 0.2;
/// No axis shows less than this share of its values: what differs by less is noise.
const NOISE: f64 = 1e-4;
/// Keys, and what an axis calls them.
const ROLES: [(&str, &str); 12] = [
    ("approach_speed", "impact speed v"),
    ("diameter", "diameter D"),
    ("density", "density ρ"),
    ("youngs_modulus", "Young's modulus E"),
    ("shear_modulus", "shear modulus G"),
    ("bulk_modulus", "bulk modulus K"),
    ("poissons_ratio", "Poisson's ratio ν"),
    ("weight", "relaxation weight g"),
    ("decay_rate", "decay rate β"),
    ("relaxation_time", "relaxation time τ"),
    ("contact_element_size", "element size h"),
    ("penalty_factor", "penalty factor f"),
];
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
    let own = curves.iter().flat_map(|curve| &curve.points).map(|point| vertical.scaled(point.1));
    let reference = curves.iter().flat_map(|curve| &curve.hertz);
    let reference = reference.map(|point| vertical.scaled(point.1));
    let y = vertical.axis(&column_words(column));
    let y = match shown(own, reference).filter(|_| !vertical.is_logarithmic) {
        Some((from, to)) => y.from_to(from, to),
        None => y,
    };
    let mut chart = Chart::new(horizontal.axis(&role(name)), y);
    let colour = |k: usize| match curves.len() {
        n if n > COLOURS.len() => colour_along(k, n).into(),
        _ => Cow::Borrowed(COLOURS[k]),
    };
    // Of many curves some have names, the first and the last among them; colours run between these.
    let stride = curves.len().saturating_sub(1).div_ceil(LONGEST_LEGEND - 1).max(1);
    for (k, curve) in curves.iter().enumerate() {
        let label = match curves.len() {
            1 => "computed",
            n if k.is_multiple_of(stride) || k + 1 == n => &curve.label,
            _ => "",
        };
        let hertz = Line::dashed("", scaled(&curve.hertz));
        let hertz = hertz.coloured(if curves.len() == 1 { GREY.into() } else { colour(k) });
        chart = chart
            .with(Line::points_on_line(label, scaled(&curve.points)).coloured(colour(k)))
            .with(hertz);
    }
    if curves.iter().any(|curve| !curve.hertz.is_empty()) {
        chart = chart.with(Line::dashed(HERTZ, Vec::new()).coloured(GREY));
    }
    chart
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

/// A key as people call what it is, with its symbol.
fn role(key: &str) -> String {
    let parts: Vec<&str> = key.split('.').collect();
    let last = parts.last().copied().unwrap_or_default();
    let owner = match parts.as_slice() {
        ["body", number, ..] => match number.parse::<usize>() {
            Ok(number) => format!(" of body {}", number + 1),
            Err(_) => String::new(),
        },
        ["material", name, ..] => format!(" of {name}"),
        _ => String::new(),
    };
    let role = ROLES.iter().find(|(known, _)| *known == last).map(|(_, role)| *role);
    match role {
        Some(role) if last == "approach_speed" => role.to_string(),
        Some(role) => match role.rsplit_once(' ') {
            // The symbol stays last: "diameter of body 1 D".
            Some((words, symbol)) => format!("{words}{owner} {symbol}"),
            None => format!("{role}{owner}"),
        },
        None => format!("{}{owner}", last.replace('_', " ")),
    }
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
    }

    #[test]
    fn keys_are_called_by_their_role() {
        for (key, expected) in [
            ("body.0.approach_speed", "impact speed v"),
            ("body.1.sphere.diameter", "diameter of body 2 D"),
            ("material.glass.youngs_modulus", "Young's modulus of glass E"),
            ("mesh.contact_element_size", "element size h"),
            ("time.step_factor", "step factor"),
        ] {
            assert_eq!(role(key), expected);
        }
    }
}
