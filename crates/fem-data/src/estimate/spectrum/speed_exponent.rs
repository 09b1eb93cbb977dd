//! The power of the speed in the loss, 1 − e ∝ v^p, which shows whether a Prony series can explain the
//! data.
//!
//! A quasi-static collision of given bodies depends on speed by its duration alone, T ∝ v^(−1/5) (Hertz). A
//! mild loss is 1 − e = Σ w_k φ(T/τ_k), and φ(x) rises no faster than x and falls no faster than 1/x: p
//! lies within ±1/5 for any spectrum. p = −1/5 for terms slower than the collision (the loss β T of a
//! Maxwell fluid), and +1/5 for faster ones (a Kelvin solid, Ramírez et al., *Phys. Rev. E* 60 (1999) 4465).
//! A strong loss saturates and its |p| is smaller.

/// One measured collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedPoint {
    /// Index of the pair of bodies.
    pub pair: usize,
    /// Approach speed, m/s.
    pub speed: f64,
    /// The restitution e.
    pub restitution: f64,
}

/// The exponent p and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedExponent {
    /// The exponent p, which is positive if e falls with speed.
    pub value: f64,
    /// Standard error from the scatter about the line; `None` without degrees of freedom.
    pub standard_error: Option<f64>,
    /// Slowest and fastest speed, m/s.
    pub speeds: (f64, f64),
}

impl SpeedExponent {
    /// Largest |p| of a linear viscoelastic spectrum.
    pub const LIMIT: f64 = 0.2;

    /// Whether p is above `value` by more than twice its standard error.
    pub fn is_above(&self, value: f64) -> bool {
        self.standard_error.is_some_and(|error| self.value - 2.0 * error > value)
    }
}

/// Fits lines through (ln v, ln(1 − e)) of each pair with one slope for all; `None` if no pair has two
/// speeds. Points with e ≥ 1 are left out.
pub fn speed_exponent(points: &[SpeedPoint]) -> Option<SpeedExponent> {
    let lossy: Vec<&SpeedPoint> = points.iter().filter(|point| point.restitution < 1.0).collect();
    let n_pairs = lossy.iter().map(|point| point.pair + 1).max()?;
    let (mut sxx, mut sxy, mut syy, mut freedom) = (0.0, 0.0, 0.0, 0usize);
    for pair in 0..n_pairs {
        let own = lossy.iter().filter(|point| point.pair == pair);
        let own: Vec<(f64, f64)> =
            own.map(|point| (point.speed.ln(), (1.0 - point.restitution).ln())).collect();
        let mean = |get: fn(&(f64, f64)) -> f64| {
            own.iter().map(get).sum::<f64>() / own.len().max(1) as f64
        };
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        for point in &own {
            let (dx, dy) = (point.0 - x, point.1 - y);
            (sxx, sxy, syy) = (sxx + dx * dx, sxy + dx * dy, syy + dy * dy);
        }
        freedom += own.len().saturating_sub(1);
    }
    // Speeds that differ by rounding count as equal.
    if sxx < 1e-12 {
        return None;
    }
    let value = sxy / sxx;
    let left = (syy - value * sxy).max(0.0);
    let freedom = freedom.saturating_sub(1);
    let standard_error = (freedom > 0).then(|| (left / freedom as f64 / sxx).sqrt());
    let speeds = lossy.iter().map(|point| point.speed);
    let speeds = (speeds.clone().fold(f64::INFINITY, f64::min), speeds.fold(0.0, f64::max));
    Some(SpeedExponent { value, standard_error, speeds })
}
