//! One chart as a small picture for a page: few elements, text that is legible on a phone, and a class
//! at everything that has a colour, so that a page can have it otherwise.
//!
//! Colours are attributes, which any rule of a style sheet overrides: `.c0` to `.c6` are the
//! [`COLOURS`] in turn, `.grey` what stands beside the data, `.ink` text, `.dim` text and axes of less
//! weight, `.grid` lines behind the data. A fill and a stroke have the same class.

use std::fmt::Write;

use crate::chart::{Chart, Curve, Mark};
use crate::scale::Scale;
use crate::simplify::simplify;
use crate::style::{COLOURS, DIM, FONT, GREY, GRID, INK, LETTER, number, words};

const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 190.0;
const LEFT: f64 = 56.0;
const RIGHT: f64 = 14.0;
const BOTTOM: f64 = 44.0;
/// Height of a line of the heading.
const LINE: f64 = 19.0;
const FONT_SIZE: f64 = 12.5;
const SWATCH: f64 = 20.0;
/// Farther from the drawn curve is no point, pixels.
const TOLERANCE: f64 = 0.15;
/// Most intervals between ticks.
const N_TICKS: [usize; 2] = [9, 7];

/// A chart by itself, the label of its vertical axis above it; `None` if there is no point to draw.
pub fn panel(chart: &Chart) -> Option<String> {
    if chart.is_empty() {
        return None;
    }
    let curves: Vec<_> = chart.drawn().collect();
    let on_axis = |get: fn(&(f64, f64)) -> f64| {
        curves.iter().flat_map(move |(_, points, _)| points.iter().map(get))
    };
    let bands = || chart.bands.iter().flat_map(|band| &band.points);
    let x = Scale::of(&chart.x, on_axis(|p| p.0).chain(bands().map(|p| p.0)), false)?;
    let y = on_axis(|p| p.1).chain(bands().flat_map(|p| [p.1, p.2]));
    let y = Scale::of(&chart.y, y, true)?;
    let entries = legend(chart);
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
    for (curve, points, colour) in &curves {
        let places: Vec<[f64; 2]> = points.iter().map(|point| place(*point)).collect();
        draw_curve(&mut svg, curve, &places, colour);
        for ((a, b), error) in curve.points.iter().zip(&curve.errors) {
            let ends = [(*a, b - error), (*a, b + error)];
            let ends = ends.map(|(a, b)| place((a, y.held(b))));
            let _ = writeln!(svg, "<path {} d=\"{}\"/>", paint(colour, "stroke"), path_of(&ends));
        }
    }
    svg += "</svg>\n";
    Some(svg)
}

fn draw_curve(svg: &mut String, curve: &Curve, places: &[[f64; 2]], colour: &str) {
    if curve.mark != Mark::Points && !places.is_empty() {
        let kept: Vec<_> = simplify(places, TOLERANCE).into_iter().map(|k| places[k]).collect();
        let dashes = if curve.mark == Mark::Dashed { " stroke-dasharray=\"6 4\"" } else { "" };
        let _ = writeln!(
            svg,
            "<path {} stroke-width=\"1.8\" stroke-linejoin=\"round\"{dashes} \
             d=\"{}\"/>",
            paint(colour, "stroke"),
            path_of(&kept)
        );
    }
    if matches!(curve.mark, Mark::Points | Mark::PointsOnLine) {
        for [x, y] in places {
            let paint = paint(colour, "fill");
            let _ = writeln!(svg, "<circle {paint} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.2\"/>");
        }
    }
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

/// A name beside its mark.
struct Entry<'a> {
    label: &'a str,
    mark: Mark,
    is_area: bool,
    colour: &'a str,
    row: usize,
    left: f64,
}

impl Entry<'_> {
    fn draw(&self, svg: &mut String) {
        let y = LINE * (self.row as f64 + 1.0) + 14.0;
        let (left, middle) = (self.left, y - 4.3);
        let _ = match (self.is_area, self.mark) {
            (true, _) => write!(
                svg,
                "<rect {} fill-opacity=\"0.25\" x=\"{left}\" y=\"{:.1}\" width=\"{SWATCH}\" \
                 height=\"9\"/>",
                paint(self.colour, "fill"),
                middle - 4.5
            ),
            (_, Mark::Points) => write!(
                svg,
                "<circle {} cx=\"{:.1}\" cy=\"{middle:.1}\" r=\"3.2\"/>",
                paint(self.colour, "fill"),
                left + 0.5 * SWATCH
            ),
            (_, mark) => write!(
                svg,
                "<path {} stroke-width=\"1.8\"{} d=\"M{left} {middle:.1}h{SWATCH}\"/>",
                paint(self.colour, "stroke"),
                if mark == Mark::Dashed { " stroke-dasharray=\"6 4\"" } else { "" }
            ),
        };
        let _ = writeln!(
            svg,
            "<text class=\"ink\" fill=\"{INK}\" x=\"{:.1}\" y=\"{y:.1}\">{}</text>",
            left + SWATCH + 6.0,
            words(self.label)
        );
    }
}

/// Names once each, in rows.
fn legend(chart: &Chart) -> Vec<Entry<'_>> {
    let curves =
        chart.drawn().map(|(curve, _, colour)| (curve.label.as_str(), curve.mark, false, colour));
    let bands = chart.bands.iter().map(|b| (b.label.as_str(), Mark::Line, true, b.colour));
    let mut entries: Vec<Entry<'_>> = Vec::new();
    let (mut row, mut left) = (0, 0.0);
    for (label, mark, is_area, colour) in curves.chain(bands) {
        if label.is_empty() || entries.iter().any(|entry| entry.label == label) {
            continue;
        }
        let width = SWATCH + 6.0 + LETTER * FONT_SIZE * label.chars().count() as f64 + 16.0;
        if left > 0.0 && left + width > WIDTH {
            (row, left) = (row + 1, 0.0);
        }
        entries.push(Entry { label, mark, is_area, colour, row, left });
        left += width;
    }
    entries
}

/// Class and colour of a fill or a stroke.
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
        let _ = write!(data, "{}{x:.1} {y:.1}", if k == 0 { 'M' } else { 'L' });
    }
    data
}
