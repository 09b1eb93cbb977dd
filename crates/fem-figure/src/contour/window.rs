//! What of a plane is seen, and where it lies in a panel.

use crate::style::number;
use crate::ticks::ticks;

/// Pixels from the left to the right edge of a window.
pub(crate) const PANEL_WIDTH: f64 = 400.0;

/// What of the plane is seen: horizontal and vertical range, in the units of the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// From left to right.
    pub x: (f64, f64),
    /// From bottom to top.
    pub y: (f64, f64),
}

impl Window {
    /// Pixels a unit of the points.
    fn scale(&self) -> f64 {
        PANEL_WIDTH / (self.x.1 - self.x.0)
    }

    /// Pixels from the lower to the upper edge.
    pub(crate) fn height(&self) -> f64 {
        self.scale() * (self.y.1 - self.y.0)
    }

    /// In pixels from the upper left corner.
    pub(crate) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.scale() * (x - self.x.0), self.scale() * (self.y.1 - y)]
    }

    /// Places of an axis that have a number, and the number.
    pub(crate) fn ticks(&self, n: usize) -> [Vec<(f64, String)>; 2] {
        let x = ticks(self.x, n).into_iter().map(|x| (self.place([x, 0.0])[0], number(x)));
        let y = ticks(self.y, n).into_iter().map(|y| (self.place([0.0, y])[1], number(y)));
        [x.collect(), y.collect()]
    }

    /// Within half a window's width of it.
    pub(crate) fn is_near(&self, [x, y]: [f64; 2]) -> bool {
        let margin = 0.5 * (self.x.1 - self.x.0);
        let inside =
            |value: f64, (from, to): (f64, f64)| (from - margin..=to + margin).contains(&value);
        inside(x, self.x) && inside(y, self.y)
    }
}
