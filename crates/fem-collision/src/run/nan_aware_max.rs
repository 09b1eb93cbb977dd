//! The largest of many numbers, none of which may pass unseen.

/// The larger magnitude; NaN wins and stays.
pub fn nan_aware_max_abs(so_far: f64, value: f64) -> f64 {
    if so_far.is_nan() || value.abs() <= so_far { so_far } else { value.abs() }
}

/// The larger number; NaN wins and stays.
pub fn nan_aware_max(so_far: f64, value: f64) -> f64 {
    if so_far.is_nan() || value <= so_far { so_far } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_is_the_largest_magnitude_and_nan_stays() {
        let of = |values: &[f64]| {
            values.iter().fold(0.0, |so_far, &value| nan_aware_max_abs(so_far, value))
        };
        assert_eq!(of(&[0.1, -0.3, 0.2]), 0.3);
        assert_eq!(of(&[0.1, f64::NEG_INFINITY, 0.2]), f64::INFINITY);
        assert!(of(&[0.1, f64::NAN, 0.2]).is_nan());
        assert!(of(&[0.1, f64::NAN]).is_nan());
        let of =
            |values: &[f64]| values.iter().fold(0.0, |so_far, &value| nan_aware_max(so_far, value));
        assert_eq!(of(&[0.1, -0.3, 0.2]), 0.2);
        assert!(of(&[0.1, f64::NAN, 0.2]).is_nan());
    }
}
