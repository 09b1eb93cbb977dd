//! One panel of curves over an axis.

use std::sync::Arc;

use kuva::plot::LineStyle as Strokes;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::prelude::{BandPlot, Layout, LinePlot, Plot, ScatterPlot, TickFormat};

use crate::clip::runs;
use crate::curve::{Curve, LineStyle, Mark};
use crate::scale::narrow_step;
use crate::style::{COLOURS, decade, tick};

/// Factor of free space beside the data on a logarithmic axis.
const MARGIN: f64 = 1.2;
/// Most ticks of a logarithmic axis that has hardly any round value.
const N_TICKS: usize = 6;
const LINE_WIDTH: f64 = 1.5;
const POINT_SIZE: f64 = 3.5;
const ERROR_BAR_WIDTH: f64 = 1.0;
const BAND_OPACITY: f64 = 0.15;

/// An axis with its label, kind and range.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(crate) label: String,
    pub(crate) is_logarithmic: bool,
    pub(crate) range: Option<(f64, f64)>,
}

impl Axis {
    /// Creates a linear axis; the label names quantity and unit.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), is_logarithmic: false, range: None }
    }

    /// Makes the axis logarithmic; points that are not positive are left out.
    pub fn logarithmic(mut self) -> Self {
        self.is_logarithmic = true;
        self
    }

    /// Sets the range of the axis, independent of the data.
    pub fn from_to(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    pub(crate) fn shows(&self, value: f64) -> bool {
        self.has_place(value) && self.range.is_none_or(|(from, to)| (from..=to).contains(&value))
    }

    /// Whether the axis can show a value, within its range or not.
    pub(crate) fn has_place(&self, value: f64) -> bool {
        value.is_finite() && (!self.is_logarithmic || value > 0.0)
    }

    /// Returns the position of a value along the axis.
    pub(crate) fn along(&self, value: f64) -> f64 {
        if self.is_logarithmic { value.ln() } else { value }
    }

    /// Returns the value at a position along the axis.
    pub(crate) fn value(&self, along: f64) -> f64 {
        if self.is_logarithmic { along.exp() } else { along }
    }

    /// Returns the given range or, for logarithmic data, one with free space beside them.
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

/// An area between two curves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Band {
    pub(crate) label: String,
    /// Points (x, one end, the other end).
    pub(crate) points: Vec<(f64, f64, f64)>,
    pub(crate) colour: &'static str,
}

/// The visible part of a curve.
pub(crate) struct VisibleCurve<'a> {
    pub(crate) curve: &'a Curve,
    pub(crate) points: Vec<(f64, f64)>,
    /// Pieces of its line.
    pub(crate) runs: Vec<Vec<(f64, f64)>>,
    pub(crate) colour: &'a str,
    pub(crate) style: LineStyle,
}

/// A panel of curves and bands.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    title: Option<String>,
    pub(crate) bands: Vec<Band>,
    curves: Vec<Curve>,
}

impl Chart {
    /// Creates a panel without curves.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, title: None, bands: Vec::new(), curves: Vec::new() }
    }

    /// Sets the title above the panel.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = Some(title.into());
        self
    }

    /// Adds a curve.
    pub fn with(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// Adds a shaded area behind the curves, by finite points (x, one end, the other end).
    pub fn with_band(
        mut self,
        label: impl Into<String>,
        points: Vec<(f64, f64, f64)>,
        colour: &'static str,
    ) -> Self {
        self.bands.push(Band { label: label.into(), points, colour });
        self
    }

    /// Whether there is no point to draw.
    pub(crate) fn is_empty(&self) -> bool {
        self.drawn().all(|drawn| drawn.points.is_empty())
    }

    /// Returns the visible part of each curve.
    pub(crate) fn drawn(&self) -> impl Iterator<Item = VisibleCurve<'_>> {
        self.curves.iter().enumerate().map(|(k, curve)| {
            let visible = |(x, y): &&(f64, f64)| self.x.shows(*x) && self.y.shows(*y);
            let style = curve.style.unwrap_or(LineStyle::of_curve(k));
            VisibleCurve {
                curve,
                points: curve.points.iter().filter(visible).copied().collect(),
                runs: if curve.mark == Mark::Points { Vec::new() } else { runs(self, curve) },
                colour: curve.colour.as_deref().unwrap_or(COLOURS[k % COLOURS.len()]),
                style,
            }
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
        for VisibleCurve { curve, points, runs, colour, style } in self.drawn() {
            all.extend_from_slice(&points);
            for (x, from, to) in curve.bars() {
                all.extend([(x, from), (x, to)].into_iter().filter(|(_, y)| self.y.has_place(*y)));
                let bar = LinePlot::new().with_data(vec![(x, from), (x, to)]);
                plots.push(bar.with_color(colour).with_stroke_width(ERROR_BAR_WIDTH).into());
            }
            for run in runs {
                let line = LinePlot::new().with_data(run).with_color(colour);
                let line = line.with_stroke_width(LINE_WIDTH);
                plots.push(match style.dashes(curve.mark) {
                    Some(dashes) => line.with_line_style(Strokes::Custom(dashes.into())).into(),
                    None => line.into(),
                });
            }
            if matches!(curve.mark, Mark::Points | Mark::PointsOnLine) && !points.is_empty() {
                let points = ScatterPlot::new().with_data(points).with_color(colour);
                plots.push(points.with_size(POINT_SIZE).with_marker(style.marker()).into());
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
            layout = layout.with_log_y().with_y_tick_format(TickFormat::Custom(Arc::new(decade)));
        }
        if let Some((from, to)) = self.x.limits(all.iter().map(|point| point.0)) {
            layout = layout.with_x_axis_min(from).with_x_axis_max(to);
            if let Some(step) = narrow_step((from, to), N_TICKS).filter(|_| self.x.is_logarithmic) {
                layout = layout.with_x_tick_step(step);
            }
        }
        if let Some((from, to)) = self.y.limits(all.iter().map(|point| point.1)) {
            layout = layout.with_y_axis_min(from).with_y_axis_max(to);
            if let Some(step) = narrow_step((from, to), N_TICKS).filter(|_| self.y.is_logarithmic) {
                layout = layout.with_y_tick_step(step);
            }
            // Places the axis label beside the numbers of this range.
            layout.y_range = (from, to);
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
        let named = self.drawn().filter(|drawn| !drawn.curve.label.is_empty());
        let named = named.map(|VisibleCurve { curve, colour, style, .. }| LegendEntry {
            label: curve.label.clone(),
            color: colour.to_string(),
            shape: match curve.mark {
                Mark::Points => LegendShape::Marker(style.marker()),
                _ => LegendShape::Line,
            },
            dasharray: style.dashes(curve.mark).map(String::from),
        });
        named.chain(bands).collect()
    }
}
