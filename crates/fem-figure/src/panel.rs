//! One chart as a small picture for a page: few elements, text that is legible on a phone, and a class on everything
//! that has a colour, so that a page can restyle it.
//!
//! Colours are attributes, which any rule of a style sheet overrides: `.c0` to `.c6` are the [`COLOURS`] in turn,
//! `.grey` references, `.ink` text, `.dim` secondary text and axes, `.grid` lines behind the data. A fill and a
//! stroke have the same class.

use std::fmt::Write;

use kuva::plot::scatter::MarkerShape;

use crate::chart::{Chart, VisibleCurve};
use crate::curve::{LineStyle, Mark};
use crate::scale::Scale;
use crate::simplify::simplify;
use crate::style::{COLOURS, DIM, FONT, GREY, GRID, INK, LETTER, escaped, number, words};

const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 190.0;
const LEFT: f64 = 56.0;
const RIGHT: f64 = 14.0;
const BOTTOM: f64 = 44.0;
/// Height of a line of the heading.
const LINE: f64 = 19.0;
const FONT_SIZE: f64 = 12.5;
const SWATCH: f64 = 20.0;
/// Largest deviation of a simplified curve, pixels.
const TOLERANCE: f64 = 0.03;
/// Most intervals between ticks of the horizontal and the vertical axis.
const N_TICKS: [usize; 2] = [9, 7];

/// Draws a chart by itself, with the label of its vertical axis above it; `None` if there is no point to
/// draw.
pub fn panel(chart: &Chart) -> Option<String> {
    drawn(chart).map(|(svg, _)| svg)
}

/// Draws charts like [`panel`], one below the other; `None` if there is no point to draw.
pub fn stacked(charts: &[Chart]) -> Option<String> {
    let (mut parts, mut y) = (String::new(), 0.0);
    for (part, height) in charts.iter().filter_map(drawn) {
        parts += &part.replacen("<svg", &format!("<svg y=\"{y}\""), 1);
        y += height + LINE;
    }
    let head = "<svg xmlns=\"http://www.w3.org/2000/svg\"";
    (y > 0.0).then(|| {
        let height = y - LINE;
        format!("{head} viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\">\n{parts}</svg>\n")
    })
}

/// Returns the picture of a chart and its height.
fn drawn(chart: &Chart) -> Option<(String, f64)> {
    if chart.is_empty() {
        return None;
    }
    let curves: Vec<_> = chart.drawn().collect();
    let on_axis = |get: fn(&(f64, f64)) -> f64| {
        curves.iter().flat_map(move |drawn| drawn.points.iter().map(get))
    };
    let bands = || chart.bands.iter().flat_map(|band| &band.points);
    let x = Scale::of(&chart.x, on_axis(|p| p.0).chain(bands().map(|p| p.0)), false)?;
    let y = on_axis(|p| p.1).chain(bands().flat_map(|p| [p.1, p.2]));
    let bars = curves.iter().flat_map(|drawn| drawn.curve.bars().flat_map(|bar| [bar.1, bar.2]));
    let y = y.chain(bars.filter(|end| chart.y.has_place(*end)));
    let y = Scale::of(&chart.y, y, true)?;
    let entries = legend(chart, &curves);
    let rows = entries.last().map_or(0, |entry| entry.row + 1);
    let top = LINE * (rows as f64 + 1.0) + 8.0;
    let height = top + HEIGHT + BOTTOM;
    let place = |(a, b): (f64, f64)| {
        [LEFT + (WIDTH - LEFT - RIGHT) * x.share(a), top + HEIGHT * (1.0 - y.share(b))]
    };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         width=\"{WIDTH}\" height=\"{height}\" font-family=\"{FONT}\" font-size=\"{FONT_SIZE}\">\n\
         <text class=\"ink\" fill=\"{INK}\" x=\"0\" y=\"14\" font-weight=\"600\">{}</text>\n",
        words(&chart.y.label)
    );
    entries.iter().for_each(|entry| entry.draw(&mut svg));
    draw_axes(&mut svg, chart, [&x, &y], top);
    for band in &chart.bands {
        let ends = band.points.iter().map(|p| place((p.0, p.1)));
        let back = band.points.iter().rev().map(|p| place((p.0, p.2)));
        let path: Vec<[f64; 2]> = ends.chain(back).collect();
        let paint = paint(band.colour, "fill");
        let _ = writeln!(svg, "<path {paint} fill-opacity=\"0.18\" d=\"{}Z\"/>", path_of(&path));
    }
    for drawn in &curves {
        draw_curve(&mut svg, drawn, &place);
        for (a, from, to) in drawn.curve.bars() {
            let ends = [from, to].map(|b| place((a, y.held(b))));
            let paint = paint(drawn.colour, "stroke");
            let _ = writeln!(svg, "<path {paint} d=\"{}\"/>", path_of(&ends));
        }
    }
    svg += "</svg>\n";
    Some((svg, height))
}

fn draw_curve(svg: &mut String, drawn: &VisibleCurve<'_>, place: &impl Fn((f64, f64)) -> [f64; 2]) {
    let mark = drawn.curve.mark;
    let mut path = String::new();
    for run in &drawn.runs {
        let places: Vec<[f64; 2]> = run.iter().map(|point| place(*point)).collect();
        let kept: Vec<_> = simplify(&places, TOLERANCE).into_iter().map(|k| places[k]).collect();
        path += &path_of(&kept);
    }
    if !path.is_empty() {
        let stroke = stroke(drawn.colour, mark, drawn.style);
        let _ = writeln!(svg, "<path {stroke} stroke-linejoin=\"round\" d=\"{path}\"/>");
    }
    if matches!(mark, Mark::Points | Mark::PointsOnLine) {
        drawn.points.iter().for_each(|point| draw_point(svg, place(*point), drawn));
    }
}

/// Draws a point with the marker of its curve.
fn draw_point(svg: &mut String, [x, y]: [f64; 2], drawn: &VisibleCurve<'_>) {
    let paint = paint(drawn.colour, "fill");
    let polygon = |corners: &[[f64; 2]]| {
        let corners: Vec<_> = corners.iter().map(|[a, b]| [x + a, y + b]).collect();
        format!("<path {paint} d=\"{}Z\"/>", path_of(&corners))
    };
    let shape = match drawn.style.marker() {
        MarkerShape::Square => polygon(&[[-2.9, -2.9], [2.9, -2.9], [2.9, 2.9], [-2.9, 2.9]]),
        MarkerShape::Triangle => polygon(&[[0.0, -4.0], [3.7, 2.7], [-3.7, 2.7]]),
        MarkerShape::Diamond => polygon(&[[0.0, -4.2], [4.2, 0.0], [0.0, 4.2], [-4.2, 0.0]]),
        _ => format!("<circle {paint} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.2\"/>"),
    };
    let _ = writeln!(svg, "{shape}");
}

/// Returns the stroke attributes of a line.
fn stroke(colour: &str, mark: Mark, style: LineStyle) -> String {
    let dashes = style.dashes(mark);
    let dashes = dashes.map_or(String::new(), |dashes| format!(" stroke-dasharray=\"{dashes}\""));
    // A dashed line is thinner, so that the line below it stays visible.
    let width = if mark == Mark::Dashed { 1.5 } else { 1.8 };
    format!("{} stroke-width=\"{width}\"{dashes}", paint(colour, "stroke"))
}

fn draw_axes(svg: &mut String, chart: &Chart, [x, y]: [&Scale; 2], top: f64) {
    let (right, bottom) = (WIDTH - RIGHT, top + HEIGHT);
    for value in y.ticks(N_TICKS[1]) {
        let at = bottom - HEIGHT * y.share(value);
        let _ = writeln!(
            svg,
            "<path class=\"grid\" stroke=\"{GRID}\" d=\"M{LEFT} {at:.1}H{right}\"/><text \
             class=\"dim\" fill=\"{DIM}\" x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            LEFT - 8.0,
            at + 4.3,
            number(value)
        );
    }
    for value in x.ticks(N_TICKS[0]) {
        let at = LEFT + (right - LEFT) * x.share(value);
        let _ = writeln!(
            svg,
            "<path class=\"dim\" stroke=\"{DIM}\" d=\"M{at:.1} {bottom:.1}v4\"/><text \
             class=\"dim\" fill=\"{DIM}\" x=\"{at:.1}\" y=\"{:.1}\" \
             text-anchor=\"middle\">{}</text>",
            bottom + 18.0,
            number(value)
        );
    }
    let _ = writeln!(
        svg,
        "<path class=\"dim\" stroke=\"{DIM}\" d=\"M{LEFT} {bottom:.1}H{right}\"/><text \
         class=\"dim\" fill=\"{DIM}\" x=\"{right}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
        bottom + 37.0,
        words(&chart.x.label)
    );
}

/// A legend entry.
struct LegendRow<'a> {
    label: &'a str,
    /// `None` for an area.
    drawn: Option<&'a VisibleCurve<'a>>,
    colour: &'a str,
    row: usize,
    left: f64,
}

impl LegendRow<'_> {
    fn draw(&self, svg: &mut String) {
        let y = LINE * (self.row as f64 + 1.0) + 14.0;
        let (left, middle) = (self.left, y - 4.3);
        match self.drawn {
            None => {
                let _ = write!(
                    svg,
                    "<rect {} fill-opacity=\"0.25\" x=\"{left}\" y=\"{:.1}\" width=\"{SWATCH}\" \
                     height=\"9\"/>",
                    paint(self.colour, "fill"),
                    middle - 4.5
                );
            }
            Some(drawn) => {
                let mark = drawn.curve.mark;
                if mark != Mark::Points {
                    let stroke = stroke(drawn.colour, mark, drawn.style);
                    let _ = write!(svg, "<path {stroke} d=\"M{left} {middle:.1}h{SWATCH}\"/>");
                }
                if matches!(mark, Mark::Points | Mark::PointsOnLine) {
                    draw_point(svg, [left + 0.5 * SWATCH, middle], drawn);
                }
            }
        }
        let _ = writeln!(
            svg,
            "<text class=\"ink\" fill=\"{INK}\" x=\"{:.1}\" y=\"{y:.1}\">{}</text>",
            left + SWATCH + 6.0,
            escaped(self.label)
        );
    }
}

/// Returns the legend entries in rows, each name once.
fn legend<'a>(chart: &'a Chart, curves: &'a [VisibleCurve<'a>]) -> Vec<LegendRow<'a>> {
    let curves = curves.iter().map(|drawn| (drawn.curve.label.as_str(), Some(drawn), drawn.colour));
    let bands = chart.bands.iter().map(|band| (band.label.as_str(), None, band.colour));
    let mut entries: Vec<LegendRow<'_>> = Vec::new();
    let (mut row, mut left) = (0, 0.0);
    for (label, drawn, colour) in curves.chain(bands) {
        if label.is_empty() || entries.iter().any(|entry| entry.label == label) {
            continue;
        }
        let width = SWATCH + 6.0 + LETTER * FONT_SIZE * label.chars().count() as f64 + 16.0;
        if left > 0.0 && left + width > WIDTH {
            (row, left) = (row + 1, 0.0);
        }
        entries.push(LegendRow { label, drawn, colour, row, left });
        left += width;
    }
    entries
}

/// Returns class and colour of a fill or a stroke.
fn paint(colour: &str, attribute: &str) -> String {
    let class = match COLOURS.iter().position(|known| *known == colour) {
        Some(k) => format!("c{k}"),
        None if colour == GREY => "grey".to_string(),
        None => String::new(),
    };
    let other = if attribute == "fill" { "" } else { " fill=\"none\"" };
    format!("class=\"{class} {attribute}\" {attribute}=\"{colour}\"{other}")
}

fn path_of(points: &[[f64; 2]]) -> String {
    let mut data = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let _ = write!(data, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
    }
    data
}
