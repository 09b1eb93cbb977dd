//! One panel: curves over an axis.

use std::borrow::Cow;
use std::sync::Arc;

use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::prelude::{BandPlot, Layout, LinePlot, Plot, ScatterPlot, TickFormat};

use crate::style::{COLOURS, tick};

/// Free space beside the data on a logarithmic axis, as a factor.
const MARGIN: f64 = 1.2;
const LINE_WIDTH: f64 = 1.5;
const POINT_SIZE: f64 = 3.5;
const ERROR_BAR_WIDTH: f64 = 1.0;
const BAND_OPACITY: f64 = 0.15;
const DASHES: &str = "8 4";

/// An axis: what it shows, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) is_logarithmic: bool,
    pub(crate) range: Option<(f64, f64)>,
}

impl Axis {
    /// A linear axis; the label names quantity and unit.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), is_logarithmic: false, range: None }
    }

    /// A logarithmic one; points that are not positive are left out.
    pub fn logarithmic(mut self) -> Self {
        self.is_logarithmic = true;
        self
    }

    /// From one value to another, whatever the data.
    pub fn from_to(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    pub(crate) fn shows(&self, value: f64) -> bool {
        let inside = self.range.is_none_or(|(from, to)| (from..=to).contains(&value));
        value.is_finite() && inside && (!self.is_logarithmic || value > 0.0)
    }

    /// Given, or of logarithmic data with free space beside it.
    fn limits(&self, values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
        if self.range.is_some() || !self.is_logarithmic {
            return self.range;
        }
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            (from, to) = (from.min(value), to.max(value));
        }
        (from <= to).then_some((from / MARGIN, to * MARGIN))
    }
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line.
    Line,
    /// A dashed line: what the data is compared with.
    Dashed,
    /// Points alone.
    Points,
    /// Points on a line.
    PointsOnLine,
}

/// Points (x, y) with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    pub(crate) label: String,
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) mark: Mark,
    colour: Option<Cow<'static, str>>,
    pub(crate) errors: Vec<f64>,
}

impl Curve {
    /// A curve; an empty label keeps it out of the legend.
    pub fn new(label: impl Into<String>, mark: Mark, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points, mark, colour: None, errors: Vec::new() }
    }

    /// A line.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::Line, points)
    }

    /// A dashed line.
    pub fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::Dashed, points)
    }

    /// Points.
    pub fn points(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::Points, points)
    }

    /// Points on a line.
    pub fn points_on_line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::PointsOnLine, points)
    }

    /// With half the height of an error bar at each point, in the order of the points.
    pub fn with_errors(mut self, errors: Vec<f64>) -> Self {
        self.errors = errors;
        self
    }

    /// In a colour of its own; else the chart gives one.
    pub fn coloured(mut self, colour: impl Into<Cow<'static, str>>) -> Self {
        self.colour = Some(colour.into());
        self
    }

    /// In the colour that the chart gives its k-th curve, from 0.
    pub fn like_curve(self, k: usize) -> Self {
        self.coloured(COLOURS[k % COLOURS.len()])
    }
}

/// An area between two curves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Band {
    pub(crate) label: String,
    /// (x, one end, the other).
    pub(crate) points: Vec<(f64, f64, f64)>,
    pub(crate) colour: &'static str,
}

/// A panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    title: Option<String>,
    pub(crate) bands: Vec<Band>,
    curves: Vec<Curve>,
}

impl Chart {
    /// A panel without curves.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, title: None, bands: Vec::new(), curves: Vec::new() }
    }

    /// A title above the panel.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// This chart with one more curve.
    pub fn with(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// With a shaded area behind the curves: (x, one end, the other), all finite.
    pub fn with_band(
        mut self,
        label: impl Into<String>,
        points: Vec<(f64, f64, f64)>,
        colour: &'static str,
    ) -> Self {
        self.bands.push(Band { label: label.into(), points, colour });
        self
    }

    /// Whether no point can be drawn.
    pub(crate) fn is_empty(&self) -> bool {
        self.drawn().all(|(_, points, _)| points.is_empty())
    }

    /// Curves with their visible points and colours.
    pub(crate) fn drawn(&self) -> impl Iterator<Item = (&Curve, Vec<(f64, f64)>, &str)> {
        self.curves.iter().enumerate().map(|(k, curve)| {
            let visible = |(x, y): &&(f64, f64)| self.x.shows(*x) && self.y.shows(*y);
            let points = curve.points.iter().filter(visible).copied().collect();
            (curve, points, curve.colour.as_deref().unwrap_or(COLOURS[k % COLOURS.len()]))
        })
    }

    pub(crate) fn draw(&self) -> (Vec<Plot>, Layout) {
        let mut plots: Vec<Plot> = Vec::new();
        let mut all = Vec::new();
        for band in &self.bands {
            all.extend(band.points.iter().flat_map(|(x, a, b)| [(*x, *a), (*x, *b)]));
            let part = |get: fn(&(f64, f64, f64)) -> f64| band.points.iter().map(get);
            let area = BandPlot::new(part(|p| p.0), part(|p| p.1), part(|p| p.2));
            plots.push(area.with_color(band.colour).with_opacity(BAND_OPACITY).into());
        }
        for (curve, points, colour) in self.drawn() {
            all.extend_from_slice(&points);
            for ((x, y), error) in curve.points.iter().zip(&curve.errors) {
                let bar = LinePlot::new().with_data(vec![(*x, y - error), (*x, y + error)]);
                plots.push(bar.with_color(colour).with_stroke_width(ERROR_BAR_WIDTH).into());
            }
            if curve.mark != Mark::Points && !points.is_empty() {
                let line = LinePlot::new().with_data(points.clone()).with_color(colour);
                let line = line.with_stroke_width(LINE_WIDTH);
                plots.push(match curve.mark {
                    Mark::Dashed => line.with_dashed().into(),
                    _ => line.into(),
                });
            }
            if matches!(curve.mark, Mark::Points | Mark::PointsOnLine) && !points.is_empty() {
                let points = ScatterPlot::new().with_data(points).with_color(colour);
                plots.push(points.with_size(POINT_SIZE).into());
            }
        }
        let mut layout = Layout::auto_from_plots(&plots)
            .with_x_label(self.x.label.clone())
            .with_y_label(self.y.label.clone())
            .with_tick_format(TickFormat::Custom(Arc::new(tick)));
        if let Some(title) = &self.title {
            layout = layout.with_title(title.clone());
        }
        if self.x.is_logarithmic {
            layout = layout.with_log_x();
        }
        if self.y.is_logarithmic {
            layout = layout.with_log_y();
        }
        if let Some((from, to)) = self.x.limits(all.iter().map(|point| point.0)) {
            layout = layout.with_x_axis_min(from).with_x_axis_max(to);
        }
        if let Some((from, to)) = self.y.limits(all.iter().map(|point| point.1)) {
            layout = layout.with_y_axis_min(from).with_y_axis_max(to);
        }
        (plots, layout)
    }

    pub(crate) fn legend(&self) -> Vec<LegendEntry> {
        let bands = self.bands.iter().map(|band| LegendEntry {
            label: band.label.clone(),
            color: band.colour.to_string(),
            shape: LegendShape::Rect,
            dasharray: None,
        });
        let named = self.drawn().filter(|(curve, ..)| !curve.label.is_empty());
        let named = named.map(|(curve, _, colour)| LegendEntry {
            label: curve.label.clone(),
            color: colour.to_string(),
            shape: if curve.mark == Mark::Points { LegendShape::Circle } else { LegendShape::Line },
            dasharray: (curve.mark == Mark::Dashed).then(|| DASHES.to_string()),
        });
        named.chain(bands).collect()
    }
}
