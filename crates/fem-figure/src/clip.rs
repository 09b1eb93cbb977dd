//! Lines as they are drawn: clipped to the ranges of the axes, and simplified without a visible change.

use crate::chart::{Axis, Chart};
use crate::curve::Curve;

/// Returns the pieces of a line within the given ranges, cut off at their ends. A point that is not a
/// number, or not positive on a logarithmic axis, interrupts the line. A piece has at least two points.
pub(crate) fn runs(chart: &Chart, curve: &Curve) -> Vec<Vec<(f64, f64)>> {
    let axes = [&chart.x, &chart.y];
    let has_place = |(x, y): &(f64, f64)| axes[0].has_place(*x) && axes[1].has_place(*y);
    let mut runs: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut is_open = false;
    for pair in curve.points.windows(2) {
        let piece = (pair.iter().all(has_place)).then(|| within(axes, pair[0], pair[1])).flatten();
        let Some((from, to)) = piece else {
            is_open = false;
            continue;
        };
        match runs.last_mut().filter(|_| is_open && from == pair[0]) {
            Some(run) => run.push(to),
            None => runs.push(vec![from, to]),
        }
        is_open = to == pair[1];
    }
    runs
}

/// Returns the part of a segment within both ranges (Liang and Barsky 1984), straight as it is drawn.
fn within(axes: [&Axis; 2], from: (f64, f64), to: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
    let (mut first, mut last) = (0.0f64, 1.0f64);
    let ends = [[from.0, to.0], [from.1, to.1]];
    for (axis, [a, b]) in axes.iter().zip(ends) {
        let Some((low, high)) = axis.range else { continue };
        let [low, high, a, b] = [low, high, a, b].map(|value| axis.along(value));
        if a == b {
            if !(low..=high).contains(&a) {
                return None;
            }
            continue;
        }
        let (enters, leaves) = ((low - a) / (b - a), (high - a) / (b - a));
        first = first.max(enters.min(leaves));
        last = last.min(enters.max(leaves));
    }
    let at = |share: f64| match share {
        0.0 => from,
        1.0 => to,
        share => {
            let between = |axis: &Axis, a: f64, b: f64| {
                let (own, other) = (axis.along(a), axis.along(b));
                let value = axis.value(own + share * (other - own));
                axis.range.map_or(value, |(low, high)| value.clamp(low, high))
            };
            (between(axes[0], from.0, to.0), between(axes[1], from.1, to.1))
        }
    };
    (first <= last).then(|| (at(first), at(last)))
}

/// Returns the indices of points such that no other point is further from the line through them than a
/// tolerance (Ramer 1972, Douglas & Peucker 1973). The first and the last point are kept.
pub(crate) fn simplify(points: &[[f64; 2]], tolerance: f64) -> Vec<usize> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut is_kept = vec![false; points.len()];
    (is_kept[0], is_kept[last]) = (true, true);
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        let distance = |k: usize| (distance(points[k], points[from], points[to]), k);
        let farthest = (from + 1..to).map(distance).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, k)) = farthest.filter(|(distance, _)| *distance > tolerance) {
            is_kept[k] = true;
            spans.extend([(from, k), (k, to)]);
        }
    }
    (0..points.len()).filter(|k| is_kept[*k]).collect()
}

/// Returns the distance of a point from the segment between two others.
fn distance([x, y]: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let offset = [x - from[0], y - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let dot = offset[0] * along[0] + offset[1] * along[1];
    let share = if square > 0.0 { (dot / square).clamp(0.0, 1.0) } else { 0.0 };
    (offset[0] - share * along[0]).hypot(offset[1] - share * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
        let chart = Chart::new(Axis::new("x"), Axis::new("y").from_to(0.0, 1.0));
        runs(&chart, &Curve::line("", points.to_vec()))
    }

    #[test]
    fn line_leaving_the_axes_is_clipped_into_separate_lines() {
        let tall = of(&[(0.0, 0.0), (1.0, 2.0), (2.0, 2.0), (3.0, 0.0)]);
        assert_eq!(tall, [[(0.0, 0.0), (0.5, 1.0)], [(2.5, 1.0), (3.0, 0.0)]]);
        // One segment passes through the axes, one passes beside them.
        assert_eq!(of(&[(0.0, -1.0), (3.0, 2.0)]), [[(1.0, 0.0), (2.0, 1.0)]]);
        assert!(of(&[(0.0, 1.5), (3.0, 2.0)]).is_empty());
        let whole = of(&[(0.0, 0.1), (1.0, 0.2), (2.0, 0.3)]);
        assert_eq!(whole, [[(0.0, 0.1), (1.0, 0.2), (2.0, 0.3)]]);
    }

    #[test]
    fn nan_splits_a_line() {
        let parted = of(&[(0.0, 0.1), (1.0, 0.2), (2.0, f64::NAN), (3.0, 0.3), (4.0, 0.4)]);
        assert_eq!(parted, [[(0.0, 0.1), (1.0, 0.2)], [(3.0, 0.3), (4.0, 0.4)]]);
        assert!(of(&[(0.0, f64::NAN), (1.0, 0.5)]).is_empty());
    }

    #[test]
    fn a_logarithmic_axis_cuts_along_its_decades() {
        let x = Axis::new("x").logarithmic().from_to(1.0, 10.0);
        let chart = Chart::new(x, Axis::new("y"));
        let run = runs(&chart, &Curve::line("", vec![(1.0, 0.0), (100.0, 2.0)]));
        assert!((run[0][1].0 - 10.0).abs() < 1e-12 && (run[0][1].1 - 1.0).abs() < 1e-12, "{run:?}");
        assert!(runs(&chart, &Curve::line("", vec![(-1.0, 0.0), (5.0, 2.0)])).is_empty());
    }

    #[test]
    fn simplified_curve_deviates_by_at_most_the_tolerance() {
        let curve: Vec<[f64; 2]> = (0..=1000)
            .map(|k| f64::from(k) / 1000.0)
            .map(|t| [400.0 * t, 200.0 * (6.0 * t).sin()])
            .collect();
        let kept = simplify(&curve, 0.1);
        assert!((20..200).contains(&kept.len()), "{}", kept.len());
        for (k, point) in curve.iter().enumerate() {
            let next = kept.partition_point(|index| *index < k).max(1);
            let (from, to) = (curve[kept[next - 1]], curve[kept[next]]);
            assert!(distance(*point, from, to) <= 0.1, "{k}");
        }
    }

    #[test]
    fn simplification_keeps_corners_and_ends() {
        let corner = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 5.0], [2.0, 9.0]];
        assert_eq!(simplify(&corner, 0.1), [0, 2, 4]);
        assert_eq!(simplify(&corner[..1], 0.1), [0]);
        assert!(simplify(&[], 0.1).is_empty());
    }
}
