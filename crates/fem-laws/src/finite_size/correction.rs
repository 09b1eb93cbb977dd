//! Converts the total approach δ into Hertz' approach u; the difference is the compliance of finite size and its creep.
//!
//! In units of a length, with w = u^(3/2) and the fading memory M_k = ∫ e^(−p_k(t−s)) dw,
//!
//! ```math
//! \delta = u + w\,(\alpha_\infty-\beta_\infty\ln u) + \sum_k M_k\,(\alpha_k-\beta_k\ln u).
//! ```
//!
//! The logarithm is of the present contact, inside which all earlier load lies in loading.

use crate::numerics::ln;

/// α − β ln u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Correction {
    pub alpha: f64,
    pub beta: f64,
}

/// The corrections that multiply w and each M_k.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RelaxingCorrection {
    pub equilibrium: Correction,
    pub fading: Vec<Correction>,
}

impl Correction {
    /// The correction of half-spaces: none.
    pub const NONE: Self = Self { alpha: 0.0, beta: 0.0 };

    /// Adds `factor` times another correction.
    pub fn add(&mut self, other: &Self, factor: f64) {
        self.alpha += factor * other.alpha;
        self.beta += factor * other.beta;
    }

    /// Returns ∫F dδ of an elastic contact up to Hertz' u: with w = u^(3/2) the second part is ∫w dδ₂.
    pub fn strain_energy(&self, hertz: f64) -> f64 {
        let half_space = 0.4 * hertz * hertz * hertz.sqrt();
        if *self == Self::NONE || hertz == 0.0 {
            return half_space;
        }
        let cube = hertz * hertz * hertz;
        half_space + cube * (0.5 * (self.alpha - self.beta * ln(hertz)) - self.beta / 6.0)
    }

    /// Returns α − β ln u, 0 at u = 0.
    pub fn at(&self, hertz: f64) -> f64 {
        if hertz > 0.0 { self.alpha - self.beta * ln(hertz) } else { 0.0 }
    }

    /// Returns u, and ∂u/∂δ there, at δ (an open contact: 0), with the `remembered` Σ M_k (α_k − β_k ln u), after a
    /// number of iterations of Newton's method.
    pub fn hertz_approach_after(
        &self,
        n_iterations: usize,
        approach: f64,
        remembered: &Self,
    ) -> (f64, f64) {
        if approach <= remembered.alpha.max(0.0) {
            return (0.0, 1.0);
        }
        if *self == Self::NONE && *remembered == Self::NONE {
            return (approach, 1.0);
        }
        let mut hertz = approach;
        let mut slope = 1.0;
        for _ in 0..n_iterations {
            let (root, log) = (hertz.sqrt(), ln(hertz));
            let factor = self.alpha - self.beta * log;
            let stiffening = root * (1.5 * factor - self.beta) - remembered.beta / hertz;
            // Beyond the validity, but a motion: an iteration of a step may stray.
            slope = (1.0 + stiffening.max(-0.5)).recip();
            let added = hertz * root * factor + remembered.alpha - remembered.beta * log;
            hertz = (hertz - (hertz + added - approach) * slope).max(0.1 * hertz);
        }
        (hertz, slope)
    }
}

impl RelaxingCorrection {
    /// Returns the correction of half-spaces, which is zero, for a number of elements.
    pub fn none(n_elements: usize) -> Self {
        Self { equilibrium: Correction::NONE, fading: vec![Correction::NONE; n_elements] }
    }

    /// Adds another correction of as many elements.
    pub fn add(&mut self, other: &Self) {
        self.equilibrium.add(&other.equilibrium, 1.0);
        for (own, other) in self.fading.iter_mut().zip(&other.fading) {
            own.add(other, 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// δ(u) and du/dδ, put back.
    #[test]
    fn finite_size_correction_inverts_approach_and_slope() {
        let correction = Correction { alpha: -0.03, beta: 0.002 };
        for scale in [0.0, 1.0] {
            for approach in [1e-30, 1e-9, 0.3, 1.0, 3.0f64] {
                // A memory is at most of the order of u^(3/2).
                let memory = scale * approach * approach.sqrt();
                let remembered = Correction { alpha: 0.01 * memory, beta: -0.003 * memory };
                let whole = |u: f64| {
                    let own = u * u.sqrt() * (correction.alpha - correction.beta * u.ln());
                    u + own + remembered.alpha - remembered.beta * u.ln()
                };
                let (hertz, slope) = correction.hertz_approach_after(4, approach, &remembered);
                assert!((whole(hertz) / approach - 1.0).abs() < 1e-15);
                let h = 1e-6 * hertz;
                let secant = 2.0 * h / (whole(hertz + h) - whole(hertz - h));
                // Rounding over the width of the secant.
                assert!((slope - secant).abs() < 1e-9);
            }
        }
        assert_eq!(Correction::NONE.hertz_approach_after(4, 0.7, &Correction::NONE), (0.7, 1.0));
    }
}
