//! Curves: named points and how they are drawn, with dashes and markers that distinguish curves of one colour.

use std::borrow::Cow;

use crate::style::COLOURS;

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A solid line.
    Line,
    /// A dashed line, for references.
    Dashed,
    /// Points without a line.
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

    /// Creates points without a line.
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

    /// Sets the colour and keeps dashes and markers.
    pub fn in_colour(mut self, colour: impl Into<Cow<'static, str>>) -> Self {
        self.colour = Some(colour.into());
        self
    }

    /// Returns the ends of the error bars (x, from, to).
    pub(crate) fn bars(&self) -> impl Iterator<Item = (f64, f64, f64)> {
        let bars = self.points.iter().zip(&self.errors);
        bars.map(|((x, y), error)| (*x, y - error, y + error))
    }
}

/// The shape of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
}

/// Dashes of solid lines in pixels, by turns of the colours; the first is solid.
const OF_LINES: [Option<&str>; 4] = [None, Some("2 3"), Some("12 3 2 3"), Some("16 5")];
/// Dashes of dashed lines.
const OF_DASHED: [&str; 4] = ["8 4", "2 4", "9 3 2 3", "18 6"];
/// Markers by turns of the colours.
const MARKERS: [Marker; 4] = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond];

/// How many times all colours have been used before a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct LineStyle {
    turn: usize,
}

impl LineStyle {
    /// Returns the style of the k-th curve of a chart, from 0.
    pub fn of_curve(k: usize) -> Self {
        Self { turn: k / COLOURS.len() }
    }

    /// Returns the `stroke-dasharray` of a line, if it has one.
    pub fn dashes(self, mark: Mark) -> Option<&'static str> {
        match mark {
            Mark::Dashed => Some(OF_DASHED[self.turn % OF_DASHED.len()]),
            Mark::Points => None,
            Mark::Line | Mark::PointsOnLine => OF_LINES[self.turn % OF_LINES.len()],
        }
    }

    /// Returns the marker of points.
    pub fn marker(self) -> Marker {
        MARKERS[self.turn % MARKERS.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_of_28_curves_are_distinct() {
        for mark in [Mark::Line, Mark::Dashed] {
            let seen: std::collections::BTreeSet<_> = (0..28)
                .map(|k| (COLOURS[k % COLOURS.len()], LineStyle::of_curve(k).dashes(mark)))
                .collect();
            assert_eq!(seen.len(), 28, "{mark:?}");
        }
        let shape = |k: usize| format!("{:?}", LineStyle::of_curve(k).marker());
        let seen: std::collections::BTreeSet<_> =
            (0..28).map(|k| (COLOURS[k % COLOURS.len()], shape(k))).collect();
        assert_eq!(seen.len(), 28);
        assert_eq!(LineStyle::default().dashes(Mark::Line), None);
    }
}
