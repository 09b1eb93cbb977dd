//! Charts as pictures: one for a page, several below each other, or a document with panels side by side and one legend. They have few
//! elements, text that is legible on a phone, and a class on everything that has a colour, so that a page can restyle it.
//!
//! Colours are attributes, which any rule of a style sheet overrides: `.c0` to `.c6` are the [`COLOURS`] in turn,
//! `.grey` references, `.ink` text, `.dim` secondary text and axes, `.grid` lines behind the data. A fill and a
//! stroke have the same class.

use std::fmt::Write;

use crate::chart::{Chart, VisibleCurve};
use crate::clip::simplify;
use crate::curve::{LineStyle, Mark, Marker};
use crate::scale::{Room, Scale};
use crate::style::{COLOURS, DIM, FONT, GREY, GRID, INK, LETTER, escaped, number, words};

/// Size of a chart of a page, and of one in a document.
const ON_PAGE: Frame = Frame { width: 440.0, height: 190.0, room: Room::FromZero };
const IN_DOCUMENT: Frame = Frame { width: 480.0, height: 270.0, room: Room::Around };
/// Space between panels and around them.
const GAP: f64 = 22.0;
/// Least room for the numbers of the vertical axis.
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

/// The size of the area of a chart, and the room on its axes.
#[derive(Clone, Copy)]
struct Frame {
    width: f64,
    /// That of the area between the axes.
    height: f64,
    /// The room on the vertical axis.
    room: Room,
}

/// A chart with its scales, ready to be drawn.
struct Drawing<'a> {
    chart: &'a Chart,
    frame: Frame,
    curves: Vec<VisibleCurve<'a>>,
    scales: [Scale; 2],
    /// Where the vertical axis is.
    left: f64,
}

/// Draws a chart by itself, with the label of its vertical axis above it; `None` if there is no point to
/// draw.
pub fn panel(chart: &Chart) -> Option<String> {
    let drawing = Drawing::of(chart, ON_PAGE)?;
    let legend = legend(std::slice::from_ref(&drawing), ON_PAGE.width);
    let (body, height) = drawing.with(&legend);
    Some(document(ON_PAGE.width, height, &body))
}

/// Draws charts like [`panel`], one below the other; `None` if there is no point to draw.
pub fn stacked(charts: &[Chart]) -> Option<String> {
    let (mut parts, mut y) = (String::new(), 0.0);
    for drawing in charts.iter().filter_map(|chart| Drawing::of(chart, ON_PAGE)) {
        let legend = legend(std::slice::from_ref(&drawing), ON_PAGE.width);
        let (body, height) = drawing.with(&legend);
        let _ = writeln!(parts, "<g transform=\"translate(0 {y})\">\n{body}</g>");
        y += height + LINE;
    }
    (y > 0.0).then(|| document(ON_PAGE.width, y - LINE, &parts))
}

/// Returns the number of legend entries of a document with `n_charts` charts above which a reader loses track.
pub fn legend_room(n_charts: usize) -> usize {
    const ENTRIES_A_ROW: usize = 18;
    n_charts.div_ceil(n_columns(n_charts)).max(1) * ENTRIES_A_ROW - 1
}

fn n_columns(n_charts: usize) -> usize {
    if n_charts <= 1 { 1 } else { 2 }
}

/// Draws the charts, two in a row, as one SVG document; `None` if there is no point to draw.
///
/// Curves of the same name share a legend entry.
pub fn svg(charts: &[Chart]) -> Option<String> {
    let drawings: Vec<Drawing<'_>> =
        charts.iter().filter_map(|chart| Drawing::of(chart, IN_DOCUMENT)).collect();
    let columns = n_columns(drawings.len());
    let step = IN_DOCUMENT.width + GAP;
    let width = columns as f64 * step + GAP;
    let mut entries = legend(&drawings, width - 2.0 * GAP);
    entries.truncate(legend_room(drawings.len()));
    let rows = entries.last().map_or(0, |entry| entry.row + 1);
    let mut y = GAP + LINE * rows as f64 + if rows > 0 { 0.5 * GAP } else { 0.0 };
    let mut body = format!(
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<g transform=\"translate({GAP} {GAP})\">\n"
    );
    entries.iter().for_each(|entry| entry.draw(&mut body, -LINE));
    body += "</g>\n";
    for row in drawings.chunks(columns) {
        let mut tallest = 0.0f64;
        for (k, drawing) in row.iter().enumerate() {
            let (panel, height) = drawing.with(&[]);
            let x = GAP + k as f64 * step;
            let _ = writeln!(body, "<g transform=\"translate({x} {y})\">\n{panel}</g>");
            tallest = tallest.max(height);
        }
        y += tallest + GAP;
    }
    (!drawings.is_empty()).then(|| document(width, y, &body))
}

/// Returns a document with its head.
fn document(width: f64, height: f64, body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"{FONT}\" font-size=\"{FONT_SIZE}\">\n{body}</svg>\n"
    )
}

/// Returns the width of a text, about.
fn width_of(text: &str) -> f64 {
    LETTER * FONT_SIZE * text.chars().count() as f64
}

impl<'a> Drawing<'a> {
    /// Finds the axes of a chart; `None` if it has no point.
    fn of(chart: &'a Chart, frame: Frame) -> Option<Self> {
        if chart.is_empty() {
            return None;
        }
        let curves: Vec<_> = chart.drawn().collect();
        let on_axis = |get: fn(&(f64, f64)) -> f64| {
            curves.iter().flat_map(move |drawn| drawn.points.iter().map(get))
        };
        let bands = || chart.bands.iter().flat_map(|band| &band.points);
        let beside = if frame.room == Room::FromZero { Room::None } else { frame.room };
        let x = Scale::of(&chart.x, on_axis(|p| p.0).chain(bands().map(|p| p.0)), beside)?;
        let y = on_axis(|p| p.1).chain(bands().flat_map(|p| [p.1, p.2]));
        let bars =
            curves.iter().flat_map(|drawn| drawn.curve.bars().flat_map(|bar| [bar.1, bar.2]));
        let y = y.chain(bars.filter(|end| chart.y.has_place(*end)));
        let y = Scale::of(&chart.y, y, frame.room)?;
        let numbers = y.ticks(N_TICKS[1]).into_iter().map(|value| width_of(&number(value)));
        let left = numbers.fold(LEFT, |left, width| left.max(width + 10.0));
        Some(Self { chart, frame, curves, scales: [x, y], left })
    }

    /// Returns the elements of the chart below a legend, and its height.
    fn with(&self, legend: &[LegendRow<'_>]) -> (String, f64) {
        let Self { chart, frame, scales: [x, y], left, .. } = self;
        let mut heading = String::new();
        let mut head = |text: &str, line: usize| {
            let at = LINE * line as f64 + 14.0;
            let _ = writeln!(
                heading,
                "<text class=\"ink\" fill=\"{INK}\" x=\"0\" y=\"{at}\" font-weight=\"600\">{}</text>",
                words(text)
            );
        };
        let title = chart.title.as_deref().unwrap_or_default();
        let n_title = usize::from(!title.is_empty());
        if n_title > 0 {
            head(title, 0);
        }
        head(&chart.y.label, n_title);
        let above = LINE * n_title as f64;
        let rows = legend.last().map_or(0, |entry| entry.row + 1);
        let top = above + LINE * (rows as f64 + 1.0) + 8.0;
        let place = |(a, b): (f64, f64)| {
            let across = left + (frame.width - left - RIGHT) * x.share(a);
            [across, top + frame.height * (1.0 - y.share(b))]
        };
        let mut svg = heading;
        legend.iter().for_each(|entry| entry.draw(&mut svg, above));
        self.draw_axes(&mut svg, top);
        for band in &chart.bands {
            let held = |a: f64, b: f64| place((x.held(a), y.held(b)));
            let ends = band.points.iter().map(|p| held(p.0, p.1));
            let back = band.points.iter().rev().map(|p| held(p.0, p.2));
            let path: Vec<[f64; 2]> = ends.chain(back).collect();
            let paint = paint(band.colour, "fill");
            let _ =
                writeln!(svg, "<path {paint} fill-opacity=\"0.18\" d=\"{}Z\"/>", path_of(&path));
        }
        for drawn in &self.curves {
            draw_curve(&mut svg, drawn, &place);
            for (a, from, to) in drawn.curve.bars().filter(|bar| chart.x.shows(bar.0)) {
                let ends = [from, to].map(|b| place((a, y.held(b))));
                let paint = paint(drawn.colour, "stroke");
                let _ = writeln!(svg, "<path {paint} d=\"{}\"/>", path_of(&ends));
            }
        }
        (svg, top + frame.height + BOTTOM)
    }

    fn draw_axes(&self, svg: &mut String, top: f64) {
        let Self { chart, frame, scales: [x, y], left, .. } = self;
        let (right, bottom) = (frame.width - RIGHT, top + frame.height);
        for value in y.ticks(N_TICKS[1]) {
            let at = bottom - frame.height * y.share(value);
            let _ = writeln!(
                svg,
                "<path class=\"grid\" stroke=\"{GRID}\" d=\"M{left} {at:.1}H{right}\"/><text \
                 class=\"dim\" fill=\"{DIM}\" x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 8.0,
                at + 4.3,
                number(value)
            );
        }
        let across = |value: f64| left + (right - left) * x.share(value);
        for value in fitting_ticks(x, right - left) {
            let at = across(value);
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
            "<path class=\"dim\" stroke=\"{DIM}\" d=\"M{left} {bottom:.1}H{right}\"/><text \
             class=\"dim\" fill=\"{DIM}\" x=\"{right}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            bottom + 37.0,
            words(&chart.x.label)
        );
    }
}

/// Returns as many ticks of a horizontal axis of this length as have room for their numbers.
fn fitting_ticks(scale: &Scale, length: f64) -> Vec<f64> {
    let fits = |ticks: &[f64]| {
        let widest = ticks.iter().map(|tick| width_of(&number(*tick))).fold(0.0, f64::max);
        ticks.windows(2).all(|pair| {
            length * (scale.share(pair[1]) - scale.share(pair[0])) > widest + 0.5 * FONT_SIZE
        })
    };
    let all = (2..=N_TICKS[0]).rev().map(|n| scale.ticks(n));
    let mut last = Vec::new();
    for ticks in all {
        if fits(&ticks) {
            return ticks;
        }
        last = ticks;
    }
    last
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
        Marker::Square => polygon(&[[-2.9, -2.9], [2.9, -2.9], [2.9, 2.9], [-2.9, 2.9]]),
        Marker::Triangle => polygon(&[[0.0, -4.0], [3.7, 2.7], [-3.7, 2.7]]),
        Marker::Diamond => polygon(&[[0.0, -4.2], [4.2, 0.0], [0.0, 4.2], [-4.2, 0.0]]),
        Marker::Circle => format!("<circle {paint} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.2\"/>"),
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
    /// Draws the entry; its rows begin a line below `above`.
    fn draw(&self, svg: &mut String, above: f64) {
        let y = above + LINE * (self.row as f64 + 1.0) + 14.0;
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

/// Returns the legend entries of charts in rows of a width, each name once.
fn legend<'a>(drawings: &'a [Drawing<'a>], width: f64) -> Vec<LegendRow<'a>> {
    let all = drawings.iter().flat_map(|drawing| {
        let curves = drawing.curves.iter();
        let curves = curves.map(|drawn| (drawn.curve.label.as_str(), Some(drawn), drawn.colour));
        let bands = drawing.chart.bands.iter();
        curves.chain(bands.map(|band| (band.label.as_str(), None, band.colour)))
    });
    let mut entries: Vec<LegendRow<'_>> = Vec::new();
    let (mut row, mut left) = (0, 0.0);
    for (label, drawn, colour) in all {
        if label.is_empty() || entries.iter().any(|entry| entry.label == label) {
            continue;
        }
        let own = SWATCH + 6.0 + width_of(label) + 16.0;
        if left > 0.0 && left + own > width {
            (row, left) = (row + 1, 0.0);
        }
        entries.push(LegendRow { label, drawn, colour, row, left });
        left += own;
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
