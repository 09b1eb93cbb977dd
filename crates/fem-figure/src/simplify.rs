//! Simplification of curves without a visible change.

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
