//! Spherical Bessel functions and Legendre polynomials.

/// Size at which a downward recurrence is scaled back.
const LARGE: f64 = 1e200;

/// Returns j_0(x), …, j_L(x) for x > 0.
///
/// Downward recurrence f_{n−1} = (2n+1)/x f_n − f_{n+1} from far above max(L, x), where any start
/// decays into j_n (Miller), normalised by Σ (2n+1) j_n² = 1 (Abramowitz & Stegun, 10.1.19,
/// 10.1.50).
pub(super) fn spherical_bessel(degree: usize, x: f64) -> Vec<f64> {
    let start = degree.max(x.ceil() as usize) + 30 + x.sqrt() as usize;
    let mut values = vec![0.0; start + 2];
    values[start] = 1.0;
    for n in (1..=start).rev() {
        values[n - 1] = (2 * n + 1) as f64 / x * values[n] - values[n + 1];
        if values[n - 1].abs() > LARGE {
            values[n - 1..].iter_mut().for_each(|value| *value /= LARGE);
        }
    }
    let square: f64 =
        values.iter().enumerate().map(|(n, value)| (2 * n + 1) as f64 * value * value).sum();
    values.truncate(degree + 1);
    values.iter_mut().for_each(|value| *value /= square.sqrt());
    values
}

/// Returns P_l and its derivative at a cosine.
pub(super) fn legendre(degree: usize, cosine: f64) -> (f64, f64) {
    let (mut value, mut slope) = ([1.0, cosine], [0.0, 1.0]);
    if degree == 0 {
        return (1.0, 0.0);
    }
    for n in 1..degree {
        let (k, m) = (n as f64, (2 * n + 1) as f64);
        value = [value[1], (m * cosine * value[1] - k * value[0]) / (k + 1.0)];
        // P'_{n+1} = P'_{n−1} + (2n+1) P_n; the value has been updated already.
        slope = [slope[1], slope[0] + m * value[0]];
    }
    (value[1], slope[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_functions_are_their_closed_forms() {
        for x in [1e-3, 0.7, 2.6, 11.0, 80.0] {
            let (sin, cos) = f64::sin_cos(x);
            let j = spherical_bessel(40, x);
            assert!((j[0] - sin / x).abs() < 1e-15);
            // The closed forms cancel at small x.
            if x > 0.5 {
                assert!((j[1] - (sin / x - cos) / x).abs() < 1e-14);
                let second = (3.0 / (x * x) - 1.0) * sin / x - 3.0 * cos / (x * x);
                assert!((j[2] - second).abs() < 1e-14);
            }
        }
        assert!((spherical_bessel(1, 1e-3)[1] / (1e-3 / 3.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn legendre_polynomials_are_their_closed_forms() {
        for c in [-1.0, -0.3, 0.0, 0.8, 1.0] {
            let (value, slope) = legendre(3, c);
            assert!((value - 0.5 * c * (5.0 * c * c - 3.0)).abs() < 1e-15);
            assert!((slope - 0.5 * (15.0 * c * c - 3.0)).abs() < 1e-14);
            assert_eq!(legendre(1, c), (c, 1.0));
        }
        assert_eq!(legendre(20, 1.0).0, 1.0);
    }
}
