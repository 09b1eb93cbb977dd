//! Points with a name, and how they are drawn.

use std::borrow::Cow;

use crate::line_style::LineStyle;
use crate::style::COLOURS;

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

/// Points (x, y) with a name. A line has a gap where a point is no number, and ends where it leaves its axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    pub(crate) label: String,
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) mark: Mark,
    pub(crate) colour: Option<Cow<'static, str>>,
    pub(crate) style: Option<LineStyle>,
    pub(crate) errors: Vec<f64>,
}

impl Curve {
    /// A curve; an empty label keeps it out of the legend.
    pub fn new(label: impl Into<String>, mark: Mark, points: Vec<(f64, f64)>) -> Self {
        let (label, errors) = (label.into(), Vec::new());
        Self { label, points, mark, colour: None, style: None, errors }
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

    /// In a colour of its own, with the plain line of its mark; else the chart gives one.
    pub fn coloured(mut self, colour: impl Into<Cow<'static, str>>) -> Self {
        (self.colour, self.style) = (Some(colour.into()), Some(LineStyle::default()));
        self
    }

    /// As the chart draws its k-th curve, from 0: colours in turn, and once all were used, other dashes and
    /// markers with each turn.
    pub fn like_curve(mut self, k: usize) -> Self {
        self = self.coloured(COLOURS[k % COLOURS.len()]);
        self.style = Some(LineStyle::of_curve(k));
        self
    }
}
