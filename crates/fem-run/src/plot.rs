//! Plots of curves as SVG: panels side by side, one legend.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::prelude::{Figure, Layout, LinePlot, Plot, ScatterPlot, TickFormat};

/// Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), used in turn.
pub const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];
pub const PANEL_WIDTH: f64 = 480.0;
pub const PANEL_HEIGHT: f64 = 340.0;
/// Of dashed lines in a legend.
const DASHES: &str = "8 4";
/// Free space beside the data on a logarithmic axis, as a factor.
const MARGIN: f64 = 1.2;

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    Line,
    Dashed,
    Points,
}

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    pub label: String,
    pub colour: &'static str,
    pub mark: Mark,
    pub points: Vec<(f64, f64)>,
    /// Half the height of an error bar at each point; none if empty.
    pub errors: Vec<f64>,
}

impl Series {
    /// Without error bars.
    pub fn new(
        label: impl Into<String>,
        colour: &'static str,
        mark: Mark,
        points: Vec<(f64, f64)>,
    ) -> Self {
        Self { label: label.into(), colour, mark, points, errors: Vec::new() }
    }
}

/// One diagram.
#[derive(Clone, Debug)]
pub struct Panel {
    pub x_label: String,
    pub y_label: String,
    pub is_x_logarithmic: bool,
    pub series: Vec<Series>,
}

/// The panels side by side, with one legend of all labels.
pub fn svg(panels: &[Panel]) -> String {
    let (plots, layouts): (Vec<_>, Vec<_>) = panels.iter().map(draw).unzip();
    let figure = Figure::new(1, panels.len().max(1))
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(PANEL_WIDTH, PANEL_HEIGHT)
        .with_shared_legend()
        .with_shared_legend_entries(legend(panels));
    SvgBackend::new().render_scene(&figure.render()) + "\n"
}

/// A tick's number: as short as it can be said, rounding errors left out.
pub fn tick(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size == 0.0 || (1e-4..1e6).contains(&size) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

fn draw(panel: &Panel) -> (Vec<Plot>, Layout) {
    let mut plots: Vec<Plot> = Vec::new();
    for series in &panel.series {
        let points = series.points.clone();
        for ((x, y), error) in series.points.iter().zip(&series.errors) {
            let bar = LinePlot::new().with_data(vec![(*x, y - error), (*x, y + error)]);
            plots.push(bar.with_color(series.colour).with_stroke_width(1.0).into());
        }
        let line = || LinePlot::new().with_data(points.clone()).with_color(series.colour);
        plots.push(match series.mark {
            Mark::Line => line().with_stroke_width(1.8).into(),
            Mark::Dashed => line().with_stroke_width(1.8).with_dashed().into(),
            Mark::Points => {
                ScatterPlot::new().with_data(points).with_color(series.colour).with_size(4.0).into()
            }
        });
    }
    let mut layout = Layout::auto_from_plots(&plots)
        .with_x_label(panel.x_label.clone())
        .with_y_label(panel.y_label.clone())
        .with_tick_format(TickFormat::Custom(Arc::new(tick)));
    if panel.is_x_logarithmic {
        let all = || panel.series.iter().flat_map(|series| series.points.iter().map(|p| p.0));
        let (from, to) =
            (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
        layout = layout.with_log_x().with_x_axis_min(from / MARGIN).with_x_axis_max(to * MARGIN);
    }
    (plots, layout)
}

fn legend(panels: &[Panel]) -> Vec<LegendEntry> {
    let mut entries: Vec<LegendEntry> = Vec::new();
    for series in panels.iter().flat_map(|panel| &panel.series) {
        if series.label.is_empty() || entries.iter().any(|entry| entry.label == series.label) {
            continue;
        }
        entries.push(LegendEntry {
            label: series.label.clone(),
            color: series.colour.to_string(),
            shape: match series.mark {
                Mark::Points => LegendShape::Circle,
                _ => LegendShape::Line,
            },
            dasharray: (series.mark == Mark::Dashed).then(|| DASHES.to_string()),
        });
    }
    entries
}
