//! SVG path data.

use std::fmt::Write;

use super::region::Region;
use super::window::Window;

/// Returns the closed paths of a region.
pub(crate) fn of_region(region: &Region, window: &Window) -> String {
    let mut data = String::new();
    for polygon in &region.loops {
        add(&mut data, polygon.iter().copied(), window);
        data.push('Z');
    }
    data
}

/// Returns an open path; points far outside the window are left out.
pub(crate) fn of_line(points: impl Iterator<Item = [f64; 2]>, window: &Window) -> String {
    let mut data = String::new();
    add(&mut data, points.filter(|point| window.is_near(*point)), window);
    data
}

/// Appends points that differ by at least a tenth of a pixel, with absolute coordinates.
fn add(data: &mut String, points: impl Iterator<Item = [f64; 2]>, window: &Window) {
    let tenths = |point: [f64; 2]| window.place(point).map(|x| (10.0 * x).round() as i64);
    let mut last = None;
    for place in points.map(tenths) {
        if last == Some(place) {
            continue;
        }
        data.push(if last.is_none() { 'M' } else { 'L' });
        let [x, y] = place.map(|tenths| tenths as f64 / 10.0);
        let _ = write!(data, "{x} {y}");
        last = Some(place);
    }
}
