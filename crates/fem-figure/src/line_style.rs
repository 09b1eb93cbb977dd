//! Dashes and markers of curves that share a colour.

use kuva::plot::scatter::MarkerShape;

use crate::curve::Mark;
use crate::style::COLOURS;

/// Dashes of solid lines in pixels, by turns of the colours; the first is solid.
const OF_LINES: [Option<&str>; 4] = [None, Some("2 3"), Some("12 3 2 3"), Some("16 5")];
/// Dashes of dashed lines.
const OF_DASHED: [&str; 4] = ["8 4", "2 4", "9 3 2 3", "18 6"];
/// Markers by turns of the colours.
const MARKERS: [MarkerShape; 4] =
    [MarkerShape::Circle, MarkerShape::Square, MarkerShape::Triangle, MarkerShape::Diamond];

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
    pub fn marker(self) -> MarkerShape {
        MARKERS[self.turn % MARKERS.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_of_twenty_eight_curves_are_alike() {
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
