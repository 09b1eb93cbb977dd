//! Ticks of a linear axis.

use crate::contour::Levels;

/// Returns multiples of 1, 2 or 5 times a power of ten within a range, with at most `n` intervals; none for
/// a range without length.
pub(crate) fn ticks((from, to): (f64, f64), n: usize) -> Vec<f64> {
    let length = to - from;
    if !(length > 0.0 && length.is_finite()) {
        return Vec::new();
    }
    let step = Levels::about_zero(0.0, length, n).step();
    // A tick at the end of the range is kept in spite of rounding.
    let (first, last) = ((from / step - 1e-9).ceil() as i64, (to / step + 1e-9).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks((0.0, 62.8), 7), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(ticks((-0.3, 0.3), 3), [-0.2, 0.0, 0.2]);
        assert!(ticks((1.0, 1.0), 5).is_empty() && ticks((0.0, f64::NAN), 5).is_empty());
    }
}
