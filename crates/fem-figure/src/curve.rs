//! Curves: named points and how they are drawn.

use std::borrow::Cow;

use crate::line_style::LineStyle;
use crate::style::COLOURS;

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A solid line.
    Line,
    /// A dashed line, for references.
    Dashed,
    /// Points only.
    Points,
    /// Points on a line.
    PointsOnLine,
}

/// Points (x, y) with a name. A line is interrupted at points that are not numbers, and ends where it
/// leaves the axes.
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
    /// Creates a curve; an empty label keeps it out of the legend.
    pub fn new(label: impl Into<String>, mark: Mark, points: Vec<(f64, f64)>) -> Self {
        let (label, errors) = (label.into(), Vec::new());
        Self { label, points, mark, colour: None, style: None, errors }
    }

    /// Creates a solid line.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::Line, points)
    }

    /// Creates a dashed line.
    pub fn dashed(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::Dashed, points)
    }

    /// Creates points.
    pub fn points(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::Points, points)
    }

    /// Creates points on a line.
    pub fn points_on_line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, Mark::PointsOnLine, points)
    }

    /// Adds error bars, by half their height at each point.
    pub fn with_errors(mut self, errors: Vec<f64>) -> Self {
        self.errors = errors;
        self
    }

    /// Sets the colour, with the plain line of the mark. By default the chart chooses colours.
    pub fn coloured(mut self, colour: impl Into<Cow<'static, str>>) -> Self {
        (self.colour, self.style) = (Some(colour.into()), Some(LineStyle::default()));
        self
    }

    /// Draws the curve like the k-th curve of a chart, from 0: colours in turn, and other dashes and
    /// markers each time all colours are used.
    pub fn like_curve(mut self, k: usize) -> Self {
        self = self.coloured(COLOURS[k % COLOURS.len()]);
        self.style = Some(LineStyle::of_curve(k));
        self
    }
}
