//! A body's outline as a smooth curve: a mesh has it as a polygon.

/// A chain whose direction turns by more than this at a point, in radians, is seen to have a corner there.
const SEEN: f64 = 0.02;
/// A corner of the body itself turns by more than this, in radians.
const CORNER: f64 = 0.6;
/// Pieces of each chord where it does.
const PIECES: usize = 6;

/// The points between two neighbours of a chain, on the cubic through both whose directions at the ends are
/// those of the parabolas through three neighbours each; none where the chain hardly turns, or has a corner.
pub(crate) fn between(chain: [[f64; 2]; 4]) -> Vec<[f64; 2]> {
    let [before, from, to, after] = chain;
    let [first, chord, last] =
        [difference(before, from), difference(from, to), difference(to, after)];
    if !(SEEN..CORNER).contains(&turn(first, chord).max(turn(chord, last))) {
        return Vec::new();
    }
    let [a, b, c] = [first, chord, last].map(length);
    let slope = |p: [f64; 2], q: [f64; 2], at: f64, other: f64| -> [f64; 2] {
        // Of the parabola through three points, at the middle one, times the chord.
        std::array::from_fn(|k| (p[k] / at * other + q[k] / other * at) / (at + other) * b)
    };
    let start = slope(first, chord, a, b);
    let end = slope(last, chord, c, b);
    let point = |piece: usize| {
        let t = piece as f64 / PIECES as f64;
        let (u, v) = (t * t * (3.0 - 2.0 * t), t * (1.0 - t));
        std::array::from_fn(|k| from[k] + u * chord[k] + v * ((1.0 - t) * start[k] - t * end[k]))
    };
    (1..PIECES).map(point).collect()
}

fn difference(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    [to[0] - from[0], to[1] - from[1]]
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// Angle between two directions; none of a point that is there twice.
fn turn(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (cross, dot) = (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    cross.abs().atan2(dot)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_circle(angle: f64) -> [f64; 2] {
        [angle.cos(), angle.sin()]
    }

    /// Of chords of 0.1 and 0.15 the arc rises by 1e-3 of the radius above its chord; the cubic stays within the
    /// fourth power of the chord of it.
    #[test]
    fn a_polygon_becomes_a_circle() {
        let points = between([0.0, 0.1, 0.2, 0.35].map(on_circle));
        assert_eq!(points.len(), PIECES - 1);
        for point in points {
            assert!((length(point) - 1.0).abs() < 2e-5, "{point:?}");
        }
    }

    #[test]
    fn what_is_straight_or_a_corner_stays_as_it_is() {
        assert!(between([[0.0, 0.0], [1.0, 0.0], [2.0, 0.01], [3.0, 0.03]]).is_empty());
        assert!(between([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 2.0]]).is_empty());
    }
}
