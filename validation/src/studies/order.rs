//! Orders of convergence.

/// Returns the power p of |error| ∝ sizeᵖ, by least squares through the logarithms of (size, error). NaN for fewer
/// than two pairs or with an error of 0.
pub(crate) fn fitted_order(pairs: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let logarithms: Vec<(f64, f64)> =
        pairs.into_iter().map(|(size, error)| (size.ln(), error.abs().ln())).collect();
    let n = logarithms.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| logarithms.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|pair| pair.0), mean(|pair| pair.1));
    let covariance: f64 = logarithms.iter().map(|pair| (pair.0 - x) * (pair.1 - y)).sum();
    let variance: f64 = logarithms.iter().map(|pair| (pair.0 - x).powi(2)).sum();
    covariance / variance
}

#[cfg(test)]
mod tests {
    use super::fitted_order;

    #[test]
    fn fitted_order_recovers_a_power() {
        let pairs = [1.0, 0.5, 0.25].map(|size: f64| (size, -3.0 * size.powf(1.7)));
        assert!((fitted_order(pairs) - 1.7).abs() < 1e-14);
        assert!(fitted_order([(1.0, 0.1)]).is_nan());
        assert!(fitted_order([(1.0, 0.1), (0.5, f64::NAN)]).is_nan());
        assert!(!fitted_order([(1.0, 0.1), (0.5, 0.0)]).is_finite());
    }
}
