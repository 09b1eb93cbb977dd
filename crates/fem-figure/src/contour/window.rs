//! The visible part of the plane, its position in a panel, and SVG path data in it.

use std::fmt::Write;

use super::region::Region;
use crate::scale::ticks;
use crate::style::number;

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
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.scale() * (x - self.x.0), self.scale() * (self.y.1 - y)]
    }

    /// Returns position and number of the ticks of both axes.
    pub(crate) fn ticks(&self, n: usize) -> [Vec<(f64, String)>; 2] {
        let x = ticks(self.x, n).into_iter().map(|x| (self.place([x, 0.0])[0], number(x)));
        let y = ticks(self.y, n).into_iter().map(|y| (self.place([0.0, y])[1], number(y)));
        [x.collect(), y.collect()]
    }

    /// Returns the closed paths of a region.
    pub(crate) fn region_path(&self, region: &Region) -> String {
        let loops = region.loops.iter();
        loops.map(|polygon| self.path(polygon.iter().copied()) + "Z").collect()
    }

    /// Returns an open path; points farther than half a window's width from the window are left out.
    pub(crate) fn line_path(&self, points: impl Iterator<Item = [f64; 2]>) -> String {
        let margin = 0.5 * (self.x.1 - self.x.0);
        let inside =
            |value: f64, (from, to): (f64, f64)| (from - margin..=to + margin).contains(&value);
        self.path(points.filter(|[x, y]| inside(*x, self.x) && inside(*y, self.y)))
    }

    /// Returns points that differ by at least a tenth of a pixel, with absolute coordinates.
    fn path(&self, points: impl Iterator<Item = [f64; 2]>) -> String {
        let tenths = |point: [f64; 2]| self.place(point).map(|x| (10.0 * x).round() as i64);
        let (mut data, mut last) = (String::new(), None);
        for place in points.map(tenths) {
            if last == Some(place) {
                continue;
            }
            data.push(if last.is_none() { 'M' } else { 'L' });
            push_tenths(&mut data, place[0]);
            data.push(' ');
            push_tenths(&mut data, place[1]);
            last = Some(place);
        }
        data
    }
}

/// Writes a number of tenths with a decimal if it has one.
fn push_tenths(text: &mut String, tenths: i64) {
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, tenth) = (tenths.unsigned_abs() / 10, tenths.unsigned_abs() % 10);
    let _ = match tenth {
        0 => write!(text, "{sign}{whole}"),
        _ => write!(text, "{sign}{whole}.{tenth}"),
    };
}
