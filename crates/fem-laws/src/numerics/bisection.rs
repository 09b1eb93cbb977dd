//! The sign change of a function of a positive number.
//!
//! [`last_where`] bisects to the last bit: the bit patterns of positive floats are ordered like the floats,
//! so halving the interval of the patterns needs at most 64 evaluations for any number of decades between
//! the ends, and the result has full relative accuracy. [`falling_zero`] needs fewer evaluations. It is the
//! Illinois method: the secant method, with the value at an end that stays halved (Dowell & Jarratt 1971).

/// Returns the largest float in `low ..= high` at which `is_below` holds, if it holds up to a point and
/// not beyond; `low` if it never does. Both ends are at least 0.
pub fn last_where(low: f64, high: f64, is_below: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (low.to_bits(), high.to_bits());
    while low + 1 < high {
        let middle = low + (high - low) / 2;
        if is_below(f64::from_bits(middle)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::from_bits(low)
}

/// Returns the place where a function falls through 0 between `low`, where it is positive, and `high`, where it is
/// not, to some 1e-14 of the interval if it is smooth.
pub fn falling_zero(low: f64, high: f64, value: impl Fn(f64) -> f64) -> f64 {
    let (mut a, mut b) = ((low, value(low)), (high, value(high)));
    let mut kept_low = None;
    for _ in 0..60 {
        let middle = a.0 + (b.0 - a.0) * (a.1 / (a.1 - b.1));
        if b.0 - a.0 <= 1e-14 * (high - low) || !(middle > a.0 && middle < b.0) {
            break;
        }
        let at_middle = value(middle);
        if at_middle > 0.0 {
            a = (middle, at_middle);
            if kept_low == Some(false) {
                b.1 *= 0.5;
            }
            kept_low = Some(false);
        } else {
            b = (middle, at_middle);
            if kept_low == Some(true) {
                a.1 *= 0.5;
            }
            kept_low = Some(true);
        }
    }
    if a.1 < -b.1 { a.0 } else { b.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bisection_finds_the_last_bit_over_all_decades() {
        for root in [1e-300, 1e-9, 0.3, 7.0, 1e200] {
            assert_eq!(last_where(0.0, f64::MAX, |x| x <= root), root);
        }
        assert_eq!(last_where(2.0, 3.0, |_| false), 2.0);
    }

    #[test]
    fn illinois_finds_zeros_of_smooth_and_bent_functions() {
        type Case = (fn(f64) -> f64, f64);
        let functions: [Case; 4] = [
            (|x| 1.0 - x * x, 1.0),
            (|x| (0.3 - x) * (1.0 + x.powi(6)), 0.3),
            (|x| (1.9f64 - x).cbrt(), 1.9),
            (|x| (-x).exp() - 0.2, 5f64.ln()),
        ];
        for (function, root) in functions {
            // A rounding of the function or 1e-14 of the interval.
            assert!((falling_zero(0.0, 2.0, function) - root).abs() < 1e-13);
        }
    }
}
