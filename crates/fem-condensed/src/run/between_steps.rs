//! Interpolation between the steps of a collision by a parabola through the last three.
//!
//! With the values f₋, f₀ and f₁ at the previous step, the begin and the end of a step, and 0 ≤ θ ≤ 1,
//!
//! ```math
//! f(\theta) = f_0 + \theta(f_1-f_0) - \tfrac12\theta(1-\theta)D, \qquad D = f_1 - 2f_0 + f_- ,
//! ```
//!
//! ```math
//! \int_0^\theta f\,\mathrm d\theta
//! = \theta f_0 + \tfrac12\theta^2(f_1-f_0) - \tfrac1{12}\theta^2(3-2\theta)D, \qquad
//! f'(1) = f_1 - f_0 + \tfrac12 D :
//! ```
//!
//! which is the third-order method of Adams and Moulton. After a first touch or the end of a contact f₋ is not used,
//! and D = 0, the trapezoidal rule.

use fem_collision::nan_aware_max_abs;

/// A quantity over a step, as a parabola.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepParabola {
    begin: f64,
    change: f64,
    /// Second difference D.
    bend: f64,
}

impl StepParabola {
    /// Creates a parabola from the values at begin and end, and one step before if it is known.
    pub fn new(before: Option<f64>, begin: f64, end: f64) -> Self {
        let bend = before.map_or(0.0, |before| end - 2.0 * begin + before);
        Self { begin, change: end - begin, bend }
    }

    /// Returns the value at a share of the step.
    pub fn at(&self, theta: f64) -> f64 {
        self.begin + theta * (self.change - 0.5 * (1.0 - theta) * self.bend)
    }

    /// Returns the integral up to a share of the step, over the length of the step.
    pub fn integral(&self, theta: f64) -> f64 {
        let [first, second] = [0.5 * self.change, (3.0 - 2.0 * theta) * self.bend / 12.0];
        theta * (self.begin + theta * (first - second))
    }

    /// Returns the slope at the end of the step, per step.
    pub fn slope(&self) -> f64 {
        self.change + 0.5 * self.bend
    }
}

/// Largest value of a smooth function given at even steps, at least 0: the vertex of the parabola through the
/// highest three. NaN is kept.
#[derive(Debug, Default)]
pub(crate) struct InterpolatedPeak {
    last: [f64; 2],
    pub highest: f64,
}

impl InterpolatedPeak {
    /// Adds the next value.
    pub fn observe(&mut self, value: f64) {
        let [before, middle] = self.last;
        if middle >= before && middle > value {
            let (slope, bend) = (0.5 * (value - before), value - 2.0 * middle + before);
            self.note(middle - 0.5 * slope * slope / bend);
        }
        self.note(value);
        self.last = [middle, value];
    }

    fn note(&mut self, value: f64) {
        // Negative values count as 0; NaN is kept.
        self.highest = nan_aware_max_abs(self.highest, value.clamp(0.0, f64::INFINITY));
    }
}
