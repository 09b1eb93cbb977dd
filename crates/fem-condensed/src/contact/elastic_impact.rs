//! The elastic collision of a condensed pair, in closed form.
//!
//! With E = L Lᵀ, L s = 1 and L t = g₀, point k joins the contact at the approach δ_k = t_k/s_k and
//!
//! ```math
//! F(\delta) = \sum_k s_k^2\,\langle\delta-\delta_k\rangle, \qquad
//! W(\delta) = \tfrac12\sum_k s_k^2\,\langle\delta-\delta_k\rangle^2 ,
//! ```
//!
//! so the quasi-static motion is harmonic between the δ_k, and its duration is a sum of arcs. It sets
//! the time step of a run, predicts the contact radius, and is the limit to which a run of an elastic pair
//! converges.

use faer::Mat;

use crate::condensation::dense::cholesky;

/// Largest number of doublings of the compliance of springs: sufficient for any penalty factor of a case.
const MAX_SOFTENINGS: usize = 20;

/// Force against approach, piecewise linear.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ElasticCurve {
    /// Approaches δ_k at which points join, in rising order, m.
    touch: Vec<f64>,
    /// Increments s_k² of the stiffness, N/m.
    stiffness: Vec<f64>,
}

/// An elastic, quasi-static collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticImpact {
    /// Contact time, s.
    pub contact_time: f64,
    /// Largest approach, m.
    pub max_approach: f64,
    /// Largest force, N.
    pub peak_force: f64,
    /// Number of points in contact at the largest approach.
    pub n_closed: usize,
}

impl ElasticCurve {
    /// Creates the curve from a compliance (m/N) and the initial gaps (m) at the points, without
    /// the gap of the poles. Where points would not join from the axis outward (penalty springs at
    /// Gauss points), an early one is delayed until the others have joined, and the curve is an estimate.
    pub fn new(compliance: &Mat<f64>, gaps: &[f64]) -> Option<Self> {
        let factor = cholesky(compliance)?;
        let n = gaps.len();
        let (mut s, mut t) = (vec![0.0; n], vec![0.0; n]);
        let (mut touch, mut stiffness) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for k in 0..n {
            let before = |x: &[f64]| (0..k).map(|j| factor[(k, j)] * x[j]).sum::<f64>();
            (s[k], t[k]) =
                ((1.0 - before(&s)) / factor[(k, k)], (gaps[k] - before(&t)) / factor[(k, k)]);
            let joins = t[k] / s[k];
            if s[k] <= 0.0 || s[k].is_nan() {
                break;
            }
            touch.push(touch.last().map_or(joins, |&last: &f64| joins.max(last)));
            stiffness.push(s[k] * s[k]);
        }
        Some(Self { touch, stiffness })
    }

    /// Creates the curve for penalty springs of any stiffness; their compliances (m/N) are included in `compliance`.
    /// There are more Gauss points than nodes, so that stiff springs do not close in an order from the axis. They
    /// are softened until there is one, which changes the estimate by less than 0.1 %.
    pub fn of_springs(compliance: &Mat<f64>, springs: &[f64], gaps: &[f64]) -> Option<Self> {
        let mut softened = compliance.to_owned();
        let mut added = 1.0;
        for _ in 0..MAX_SOFTENINGS {
            let curve = Self::new(&softened, gaps)?;
            if curve.touch.len() == gaps.len() {
                return Some(curve);
            }
            for (k, spring) in springs.iter().enumerate() {
                softened[(k, k)] += added * spring;
            }
            added *= 2.0;
        }
        Self::new(&softened, gaps)
    }

    /// Returns the stiffness with all points in contact, as under a rigid punch, N/m.
    pub fn punch_stiffness(&self) -> f64 {
        self.stiffness.iter().sum()
    }

    /// Returns the approach (m) for a contact force, N; `None` if the contact would reach the last point.
    pub fn approach(&self, force: f64) -> Option<f64> {
        let (mut before, mut stiffness) = (0.0, 0.0);
        for k in 0..self.touch.len() {
            stiffness += self.stiffness[k];
            let width = self.touch.get(k + 1)? - self.touch[k];
            if before + stiffness * width >= force {
                return Some(self.touch[k] + (force - before) / stiffness);
            }
            before += stiffness * width;
        }
        None
    }

    /// Returns the force at an approach (m), N, extrapolated beyond the last point.
    pub fn force(&self, approach: f64) -> f64 {
        let joined =
            self.touch.iter().zip(&self.stiffness).take_while(|(touch, _)| **touch < approach);
        joined.map(|(touch, stiffness)| stiffness * (approach - touch)).sum()
    }

    /// Returns the difference of the force at an approach (m) from that of the continuum, N. Between two δ_k the force
    /// is a chord of the curve of the continuum, with the difference
    ///
    /// ```math
    /// F''\bigl[\tfrac12 x(w-x) - \tfrac1{12}w^2\bigr], \qquad x = \delta-\delta_k, \quad
    /// w = \delta_{k+1}-\delta_k ,
    /// ```
    ///
    /// of zero mean. F'' is the jump of the slope over the mean width of the two chords there, averaged over both ends
    /// of the chord if possible. For Hertz' contact the difference is between −1/4 and 1/8 of F (h/a)². It is 0 in the
    /// first element, for which F'' is unknown, and beyond the last one.
    pub fn force_oscillation(&self, approach: f64) -> f64 {
        let k = self.touch.partition_point(|&touch| touch <= approach);
        let (Some(before), Some(end)) = (k.checked_sub(2), self.touch.get(k)) else { return 0.0 };
        let begin = self.touch[k - 1];
        let (x, w) = (approach - begin, end - begin);
        let at_begin = 2.0 * self.stiffness[k - 1] / (end - self.touch[before]);
        let at_end = self.touch.get(k + 1).map(|after| 2.0 * self.stiffness[k] / (after - begin));
        let bend = at_end.map_or(at_begin, |at_end| 0.5 * (at_begin + at_end));
        bend * (0.5 * x * (w - x) - w * w / 12.0)
    }

    /// Returns the collision of a reduced mass (kg) at a speed (m/s); `None` if the contact would reach the last
    /// point.
    pub fn impact(&self, mass: f64, speed: f64) -> Option<ElasticImpact> {
        let (mut time, mut velocity) = (0.0, speed);
        let (mut force, mut stiffness) = (0.0, 0.0);
        for k in 0..self.touch.len() {
            stiffness += self.stiffness[k];
            let width = self.touch.get(k + 1)? - self.touch[k];
            let (a, squared) = (force / mass, stiffness / mass);
            let omega = squared.sqrt();
            // ω x + a/ω = A sin(ω t + φ)
            let amplitude = (omega * velocity).hypot(a) / squared;
            let phase = |x: f64| ((x + a / squared) / amplitude).min(1.0).asin();
            let turn = amplitude - a / squared;
            if turn <= width {
                time += (std::f64::consts::FRAC_PI_2 - phase(0.0)) / omega;
                return Some(ElasticImpact {
                    contact_time: 2.0 * time,
                    max_approach: self.touch[k] + turn - self.touch[0],
                    peak_force: force + stiffness * turn,
                    n_closed: k + 1,
                });
            }
            time += (phase(width) - phase(0.0)) / omega;
            velocity = (velocity * velocity - (2.0 * a + squared * width) * width).sqrt();
            force += stiffness * width;
        }
        None
    }
}
