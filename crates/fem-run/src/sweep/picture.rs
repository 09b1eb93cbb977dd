//! `sweep.svg`: one panel a column, curves over one varied key, Hertz dashed beside.

use std::sync::Arc;

use fem_case::Sweep;
use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::prelude::{Figure, Layout, LinePlot, Plot, ScatterPlot, TickFormat};

use super::collect::Row;
use super::member::Member;
use super::picture_data::{Choice, Curve, axis_unit, column_unit, column_words, curves};
use crate::engineering::Unit;

/// Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), used in turn.
const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];
const HERTZ_COLOUR: &str = "#333333";
/// Hertz in the legend, and its dashes.
const HERTZ: &str = "Hertz";
const DASHES: &str = "8 4";
/// Curves that a legend can tell apart.
const LONGEST_LEGEND: usize = 14;
/// Values that span this ratio go on a logarithmic axis.
const LOGARITHMIC_FROM: f64 = 10.0;
/// Free space beside the data on a logarithmic axis, as a factor.
const MARGIN: f64 = 1.2;
const PANEL_WIDTH: f64 = 480.0;
const PANEL_HEIGHT: f64 = 340.0;

/// The picture, or none if there is nothing to draw.
pub fn picture(sweep: &Sweep, members: &[Member], rows: &[Row], choice: &Choice) -> Option<String> {
    let x = choice.x?;
    let panel = |column: &&'static str| {
        let curves = curves(sweep, members, rows, choice, x, column);
        (*column, curves)
    };
    let panels: Vec<_> = choice.y.iter().map(panel).collect();
    let has_points = |(_, curves): &(_, Vec<Curve>)| curves.iter().any(|c| !c.points.is_empty());
    let panels: Vec<_> = panels.into_iter().filter(has_points).collect();
    let legend = legend(&panels);
    let (plots, layouts): (Vec<_>, Vec<_>) =
        panels.iter().map(|(column, curves)| draw(sweep, x, column, curves)).unzip();
    if plots.is_empty() {
        return None;
    }
    let columns = if plots.len() == 1 { 1 } else { 2 };
    let mut figure = Figure::new(plots.len().div_ceil(columns), columns)
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(PANEL_WIDTH, PANEL_HEIGHT);
    if !legend.is_empty() {
        figure = figure.with_shared_legend().with_shared_legend_entries(legend);
    }
    Some(renumber(&SvgBackend::new().render_scene(&figure.render())) + "\n")
}

/// The same with its clip paths counted from 0: kuva counts on from one picture of a process to the
/// next, and whoever draws a sweep writes the same bytes.
fn renumber(svg: &str) -> String {
    const CLIP: &str = "kuva-clip-";
    let mut parts = svg.split(CLIP);
    let mut text = parts.next().unwrap_or_default().to_string();
    let mut known: Vec<&str> = Vec::new();
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        let (number, rest) = part.split_at(end);
        let index = known.iter().position(|other| *other == number).unwrap_or_else(|| {
            known.push(number);
            known.len() - 1
        });
        text += &format!("{CLIP}{index}{rest}");
    }
    text
}

fn draw(sweep: &Sweep, x: usize, column: &str, curves: &[Curve]) -> (Vec<Plot>, Layout) {
    let all = || curves.iter().flat_map(|curve| curve.points.iter().chain(&curve.hertz));
    let horizontal = Scale::of(all().map(|point| point.0), axis_unit(sweep, x));
    let vertical = Scale::of(all().map(|point| point.1), Some(column_unit(column)));
    let scaled = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
        points.iter().map(|(x, y)| (horizontal.scaled(*x), vertical.scaled(*y))).collect()
    };
    let mut plots: Vec<Plot> = Vec::new();
    for (k, curve) in curves.iter().enumerate() {
        let colour = colour(k);
        let hertz_colour = if curves.len() == 1 { HERTZ_COLOUR } else { colour };
        let points = scaled(&curve.points);
        let line = LinePlot::new().with_data(points.clone()).with_color(colour);
        plots.push(line.with_stroke_width(1.5).into());
        if !curve.hertz.is_empty() {
            let line = LinePlot::new().with_data(scaled(&curve.hertz)).with_color(hertz_colour);
            plots.push(line.with_stroke_width(1.5).with_dashed().into());
        }
        plots.push(ScatterPlot::new().with_data(points).with_color(colour).with_size(3.5).into());
    }
    let mut layout = Layout::auto_from_plots(&plots)
        .with_x_label(horizontal.label(&sweep.axes[x].key))
        .with_y_label(vertical.label(&column_words(column)));
    layout = layout.with_tick_format(TickFormat::Custom(Arc::new(tick)));
    if horizontal.is_logarithmic {
        let (from, to) = horizontal.range;
        layout = layout.with_log_x().with_x_axis_min(from / MARGIN).with_x_axis_max(to * MARGIN);
    }
    if vertical.is_logarithmic {
        layout = layout.with_log_y();
    }
    (plots, layout)
}

/// A tick's number: as short as it can be said, rounding errors left out.
fn tick(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size == 0.0 || (1e-4..1e6).contains(&size) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

fn colour(curve: usize) -> &'static str {
    COLOURS[curve % COLOURS.len()]
}

fn legend(panels: &[(&str, Vec<Curve>)]) -> Vec<LegendEntry> {
    let Some((_, curves)) = panels.first() else { return Vec::new() };
    let entry = |label: &str, colour: &str, dasharray: Option<&str>| LegendEntry {
        label: label.to_string(),
        color: colour.to_string(),
        shape: LegendShape::Line,
        dasharray: dasharray.map(str::to_string),
    };
    let mut entries: Vec<_> = match curves.as_slice() {
        [_] => vec![entry("computed", colour(0), None)],
        curves => {
            let shown = curves.iter().take(LONGEST_LEGEND).enumerate();
            shown.map(|(k, curve)| entry(&curve.label, colour(k), None)).collect()
        }
    };
    let has_hertz = panels.iter().flat_map(|(_, curves)| curves).any(|c| !c.hertz.is_empty());
    if has_hertz {
        entries.push(entry(HERTZ, HERTZ_COLOUR, Some(DASHES)));
    }
    entries
}

/// How numbers stand on an axis.
struct Scale {
    /// None: no unit, or one that takes no prefix.
    unit: Option<Unit>,
    symbol: Option<&'static str>,
    is_logarithmic: bool,
    /// Of the data, scaled.
    range: (f64, f64),
}

impl Scale {
    fn of(values: impl Iterator<Item = f64> + Clone, symbol: Option<&'static str>) -> Self {
        let smallest = values.clone().fold(f64::INFINITY, f64::min);
        let largest = values.fold(f64::NEG_INFINITY, f64::max);
        let takes_prefix =
            symbol.is_some_and(|unit| ["m", "m/s", "s", "N", "Pa", "J"].contains(&unit));
        let unit = symbol.filter(|_| takes_prefix);
        let unit = unit.map(|unit| Unit::fitting(largest.abs().max(smallest.abs()), unit));
        let scaled = |value: f64| unit.as_ref().map_or(value, |unit| unit.scaled(value));
        Self {
            symbol,
            is_logarithmic: smallest > 0.0 && largest >= LOGARITHMIC_FROM * smallest,
            range: (scaled(smallest), scaled(largest)),
            unit,
        }
    }

    fn scaled(&self, value: f64) -> f64 {
        self.unit.as_ref().map_or(value, |unit| unit.scaled(value))
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
    use super::renumber;

    #[test]
    fn clip_paths_are_counted_from_0() {
        let svg = "<clipPath id=\"kuva-clip-4\"/><clipPath id=\"kuva-clip-15\"/>url(#kuva-clip-4)";
        let expected =
            "<clipPath id=\"kuva-clip-0\"/><clipPath id=\"kuva-clip-1\"/>url(#kuva-clip-0)";
        assert_eq!(renumber(svg), expected);
        assert_eq!(renumber("none"), "none");
    }
}
