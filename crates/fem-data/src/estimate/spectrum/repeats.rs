//! The scatter of measurements that repeat the same collision, which no model can explain.
//!
//! It is the pure error of Box & Draper, *Empirical Model-Building and Response Surfaces*, ch. 3: the sum
//! of squares about the means of repeats, over the number of measurements less that of collisions.

/// With fewer degrees of freedom than this a misfit cannot be distinguished from chance.
const MIN_DEGREES_OF_FREEDOM: usize = 3;

/// The scatter of repeats.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PureError {
    /// Standard deviation of one measurement.
    pub error: f64,
    /// Number of measurements less that of collisions, at least 1.
    pub degrees_of_freedom: usize,
}

impl PureError {
    /// Computes the scatter from measurements and the collision that each belongs to; `None` if none is repeated.
    pub(super) fn of(measured: &[f64], collisions: &[usize]) -> Option<Self> {
        let degrees_of_freedom = measured.len().checked_sub(n_distinct(collisions))?;
        let mean = |collision: usize| {
            let own = collisions.iter().zip(measured).filter(|(own, _)| **own == collision);
            let (n, sum) = own.fold((0, 0.0), |(n, sum), (_, value)| (n + 1, sum + value));
            sum / f64::from(n)
        };
        let both = measured.iter().zip(collisions);
        let sum: f64 = both.map(|(value, collision)| (value - mean(*collision)).powi(2)).sum();
        let error = (sum / degrees_of_freedom as f64).sqrt();
        (degrees_of_freedom > 0).then_some(Self { error, degrees_of_freedom })
    }

    /// Returns the misfit of a fit relative to the scatter of repeats, from the fit's sum of squares and the number of
    /// its collisions less that of its free weights; `None` if there are too few repeats.
    pub(super) fn misfit(&self, sum: f64, freedom: usize) -> Option<f64> {
        let own = self.error.powi(2) * self.degrees_of_freedom as f64;
        let lack = ((sum - own).max(0.0) / freedom.max(1) as f64).sqrt();
        (self.degrees_of_freedom >= MIN_DEGREES_OF_FREEDOM && self.error > 0.0)
            .then(|| lack / self.error)
    }
}

/// Returns the number of collisions.
pub(super) fn n_distinct(collisions: &[usize]) -> usize {
    let mut known = collisions.to_vec();
    known.sort_unstable();
    known.dedup();
    known.len()
}
