//! The visible part of the plane and its position in a panel.

use crate::style::number;
use crate::ticks::ticks;

/// Width of a window in pixels.
pub(crate) const PANEL_WIDTH: f64 = 400.0;

/// The visible horizontal and vertical range, in the units of the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Range from left to right.
    pub x: (f64, f64),
    /// Range from bottom to top.
    pub y: (f64, f64),
}

impl Window {
    /// Returns pixels per unit of the points.
    fn scale(&self) -> f64 {
        PANEL_WIDTH / (self.x.1 - self.x.0)
    }

    /// Returns the height in pixels.
    pub(crate) fn height(&self) -> f64 {
        self.scale() * (self.y.1 - self.y.0)
    }

    /// Returns the position of a point in pixels from the upper left corner.
    pub(crate) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.scale() * (x - self.x.0), self.scale() * (self.y.1 - y)]
    }

    /// Returns position and number of the ticks of both axes.
    pub(crate) fn ticks(&self, n: usize) -> [Vec<(f64, String)>; 2] {
        let x = ticks(self.x, n).into_iter().map(|x| (self.place([x, 0.0])[0], number(x)));
        let y = ticks(self.y, n).into_iter().map(|y| (self.place([0.0, y])[1], number(y)));
        [x.collect(), y.collect()]
    }

    /// Whether a point is within half a window's width of the window.
    pub(crate) fn is_near(&self, [x, y]: [f64; 2]) -> bool {
        let margin = 0.5 * (self.x.1 - self.x.0);
        let inside =
            |value: f64, (from, to): (f64, f64)| (from - margin..=to + margin).contains(&value);
        inside(x, self.x) && inside(y, self.y)
    }
}
