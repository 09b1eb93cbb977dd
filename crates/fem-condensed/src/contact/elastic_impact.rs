//! The elastic collision of a condensed pair, in closed form.
//!
//! With E = L Lᵀ, L s = 1 and L t = g₀, point k joins the contact at the approach δ_k = t_k/s_k and
//!
//! ```math
//! F(\delta) = \sum_k s_k^2\,\langle\delta-\delta_k\rangle, \qquad
//! W(\delta) = \tfrac12\sum_k s_k^2\,\langle\delta-\delta_k\rangle^2 ,
//! ```
//!
//! so the quasi-static motion is harmonic between the δ_k and its duration a sum of arcs. It sets
//! the time step of a run, says how far the contact reaches, and is what a run of an elastic pair
//! has to converge to.

use faer::Mat;

use crate::condensation::dense::cholesky;

/// Doublings of the compliance of springs: from any factor that a case may ask for to the usual one.
const MOST_SOFTENINGS: usize = 20;

/// Force against approach, piecewise linear.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ElasticCurve {
    /// δ_k, m, rising.
    touch: Vec<f64>,
    /// s_k², N/m.
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
    /// Points in contact at the largest approach.
    pub n_closed: usize,
}

impl ElasticCurve {
    /// Creates the curve from a compliance (m/N) and the initial gaps (m) at the points, without
    /// the gap of the poles. Where points would not join from the axis outward (penalty springs at
    /// Gauss points), one that comes early waits for the others: then the curve is an estimate.
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

    /// The same for springs (compliances in m/N, counted in `compliance` too) however stiff. At Gauss
    /// points, of which there are more than nodes, such springs press on some points so much earlier
    /// than on others that no order is left: they are softened until there is one. That moves the
    /// estimate by less than a thousandth.
    pub fn of_springs(compliance: &Mat<f64>, springs: &[f64], gaps: &[f64]) -> Option<Self> {
        let mut softened = compliance.to_owned();
        let mut added = 1.0;
        for _ in 0..MOST_SOFTENINGS {
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

    /// Stiffness of all points in contact, as under a rigid punch, N/m.
    pub fn punch_stiffness(&self) -> f64 {
        self.stiffness.iter().sum()
    }

    /// The approach (m) at which the bodies press on each other with a force, N; `None` if the contact
    /// would reach the last point.
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

    /// The force at an approach (m), N; on the last line beyond the last point.
    pub fn force(&self, approach: f64) -> f64 {
        let joined =
            self.touch.iter().zip(&self.stiffness).take_while(|(touch, _)| **touch < approach);
        joined.map(|(touch, stiffness)| stiffness * (approach - touch)).sum()
    }

    /// What of the force at an approach (m) is that of the nodes, N: between two δ_k the force is a chord of the
    /// curve of the continuum, above it and below by
    ///
    /// ```math
    /// F''\bigl[\tfrac12 x(w-x) - \tfrac1{12}w^2\bigr], \qquad x = \delta-\delta_k, \quad
    /// w = \delta_{k+1}-\delta_k ,
    /// ```
    ///
    /// a mean of zero. F'' is the jump of the slope over the widths about it, the mean of both ends if the further
    /// one is on the curve. Of Hertz' contact this is +1/8 to −1/4 of F (h/a)². 0 in the first element, whose other
    /// half is not on the curve, and beyond the last one.
    pub fn swing(&self, approach: f64) -> f64 {
        let k = self.touch.partition_point(|&touch| touch <= approach);
        let (Some(before), Some(end)) = (k.checked_sub(2), self.touch.get(k)) else { return 0.0 };
        let begin = self.touch[k - 1];
        let (x, w) = (approach - begin, end - begin);
        let at_begin = 2.0 * self.stiffness[k - 1] / (end - self.touch[before]);
        let at_end = self.touch.get(k + 1).map(|after| 2.0 * self.stiffness[k] / (after - begin));
        let bend = at_end.map_or(at_begin, |at_end| 0.5 * (at_begin + at_end));
        bend * (0.5 * x * (w - x) - w * w / 12.0)
    }

    /// The collision of a reduced mass (kg) at a speed (m/s); `None` if the contact would reach
    /// the last point.
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
