//! Flow of a Maxwell branch at finite strain.
//!
//! F = F_e F_v. The state of a branch is the metric C_v = F_vᵀ F_v, with the volume J_v² and the shape
//! C̄_v, det C̄_v = 1. With the shape C̄ = J^{−2/3} C of the whole and a relaxation time τ
//!
//! ```math
//! \dot{\bar C}_v = \frac1\tau (\bar C - s\, \bar C_v), \quad
//! s = \tfrac13 \mathrm{tr}(\bar C \bar C_v^{-1}), \qquad \dot J_v = \frac1\tau (J - J_v)
//! ```
//!
//! s keeps det C̄_v = 1. In the deformed body that is a viscous rate of dev b̄_e/2τ and a relative
//! rate of volume (J_e − 1)/τ. For the shape it is the evolution of Reese & Govindjee (1998,
//! International Journal of Solids and Structures 35:3455), −½ 𝓛_v b_e b_e⁻¹ = dev τ/2η, of a
//! neo-Hooke branch with the constant viscosity η = Gτ. The other laws share it: a flow that is
//! proportional to elastic strain where theirs would be to stress. See also Lubliner (1985,
//! Mechanics Research Communications 12:93).
//!
//! **The step.** C̄ is assumed to grow at a constant rate and s to be constant, so that C̄ − s C̄_v takes the Maxwell
//! element's exact step ([`RelaxationStep`]) with the time τ/s. The variation of s within the step only scales
//! C̄_v, whose scale follows from its determinant (Shutov, Landgraf & Ihlemann 2013, Computer Methods in
//! Applied Mechanics and Engineering 265:213, for the implicit Euler step):
//!
//! ```math
//! \bar C_v \leftarrow \mathrm{unimodular}\left[\bar C_1 - a(\bar C_0 - s\bar C_v) - b(\bar C_1 - \bar C_0)\right],
//! \quad a = e^{-s\Delta t/\tau}, \quad b = \frac{1-a}{s\Delta t/\tau}
//! ```
//!
//! It needs no iteration and no eigenvectors. It is of second order, and exact at small strain for
//! a constant rate, where s = 1. 0 ≤ a ≤ b ≤ 1 make C̄_v a mean of metrics: positive definite, hence
//! stable, for any Δt/τ. For that e^{−y}, y = (s − 1)Δt/τ ≥ 0, may be 1/(1 + y + y²/2).

use super::number::{
    Number, inverse_cube_root_change, inverse_cube_root_change_near_one, inverses,
};
use super::tensor::{AxisymmetricTensor, SymmetricTensor};
use crate::relaxation_step::RelaxationStep;

/// Internal variables of a relaxation term at a point; all zero in a body that was never strained.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ViscousStrain<N = f64> {
    /// Radial component of C̄_v − 1; the hoop's follows from det C̄_v = 1.
    pub rr: N,
    /// Axial component of C̄_v − 1.
    pub yy: N,
    /// Shear component of C̄_v − 1.
    pub ry: N,
    /// J_v − 1.
    pub volume_change: N,
}

/// Inverses of C̄_v and J_v, from which the stress follows.
#[derive(Debug, Clone, Copy)]
pub struct InverseMetric<N = f64> {
    /// C̄_v⁻¹ − 1.
    pub(super) shape: SymmetricTensor<N>,
    /// Hoop component of C̄_v − 1.
    pub(super) hoop: N,
    /// J_v − 1.
    pub(super) volume_change: N,
    /// Inverse volume 1/J_v.
    pub(super) inverse_volume: N,
}

impl<N: Number> InverseMetric<N> {
    /// Returns the inverse metric of a term without flow.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = N::splat(0.0);
        let shape = SymmetricTensor { rr: zero, yy: zero, tt: zero, ry: zero };
        Self { shape, hoop: zero, volume_change: zero, inverse_volume: N::splat(1.0) }
    }
}

impl<N: Number> ViscousStrain<N> {
    /// Returns the inverse metric and volume.
    #[inline(always)]
    pub fn inverse_metric(&self) -> InverseMetric<N> {
        let (one, plane) = (N::splat(1.0), self.plane());
        let (inverse_plane, inverse_volume) = inverses(one + plane, one + self.volume_change);
        let (shape, hoop) = self.inverse_over(plane, inverse_plane);
        InverseMetric { shape, hoop, volume_change: self.volume_change, inverse_volume }
    }

    /// Returns C̄_v⁻¹ − 1, and the hoop component of C̄_v − 1.
    #[inline(always)]
    pub(super) fn inverse(&self) -> (SymmetricTensor<N>, N) {
        let plane = self.plane();
        self.inverse_over(plane, N::splat(1.0) / (N::splat(1.0) + plane))
    }

    /// Returns the determinant of C̄_v in the meridian, less 1.
    #[inline(always)]
    fn plane(&self) -> N {
        (self.rr + self.yy).plus_product(self.rr, self.yy).minus_product(self.ry, self.ry)
    }

    /// Returns the inverse from that determinant and its reciprocal.
    #[inline(always)]
    fn inverse_over(&self, plane: N, scale: N) -> (SymmetricTensor<N>, N) {
        let zero = N::splat(0.0);
        let inverse = SymmetricTensor {
            rr: (self.yy - plane) * scale,
            yy: (self.rr - plane) * scale,
            tt: plane,
            ry: (zero - self.ry) * scale,
        };
        (inverse, zero - plane * scale)
    }
}

impl ViscousStrain {
    /// Returns U_v⁻¹, the root of C_v⁻¹. That of a plane M is (M + √det M)/√(tr M + 2 √det M).
    pub(super) fn inverse_stretch(&self) -> SymmetricTensor {
        let (inverse, viscous_tt) = self.inverse();
        let determinant_root = (1.0 + viscous_tt).sqrt();
        let (rr, yy) = (1.0 + inverse.rr, 1.0 + inverse.yy);
        let scale = 1.0 / (rr + yy + 2.0 * determinant_root).sqrt();
        let stretch = SymmetricTensor {
            rr: (rr + determinant_root) * scale,
            yy: (yy + determinant_root) * scale,
            tt: 1.0 / determinant_root,
            ry: inverse.ry * scale,
        };
        stretch.times(1.0 + inverse_cube_root_change(self.volume_change))
    }
}

/// Shape and volume of a deformation: C̄ − 1 and J − 1.
#[derive(Debug, Clone, Copy)]
pub struct Shape<N = f64> {
    strain: SymmetricTensor<N>,
    volume_change: N,
}

impl<N: Number> Shape<N> {
    /// Computes the shape of a displacement gradient with J > 0.
    #[inline(always)]
    pub fn of(h: &AxisymmetricTensor<N>) -> Self {
        let volume_change = h.volume_change();
        let z = inverse_cube_root_change(volume_change);
        Self { strain: h.right_strain().rescaled((z + z).plus_product(z, z)), volume_change }
    }

    /// Returns the shape as four numbers, which a body keeps until the next step.
    #[inline(always)]
    pub fn remembered(&self) -> ViscousStrain<N> {
        let Self { strain: SymmetricTensor { rr, yy, ry, .. }, volume_change } = *self;
        ViscousStrain { rr, yy, ry, volume_change }
    }

    /// Creates the shape from these four numbers.
    #[inline(always)]
    pub fn of_remembered(past: &ViscousStrain<N>) -> Self {
        let ViscousStrain { rr, yy, ry, volume_change } = *past;
        let (_, tt) = past.inverse();
        Self { strain: SymmetricTensor { rr, yy, tt, ry }, volume_change }
    }
}

/// Factors of a step of one term.
#[derive(Debug, Clone, Copy, PartialEq)]
struct TermStep {
    linear: RelaxationStep,
    /// Ratio of time step and relaxation time.
    ratio: f64,
}

/// A time step of all terms.
#[derive(Debug, Clone, PartialEq)]
pub struct ViscousStep {
    terms: Vec<TermStep>,
    volume_flows: bool,
}

impl ViscousStep {
    /// Creates the update for relaxation times and a time step, all positive, s. The volume flows too or is elastic.
    pub(super) fn new(
        relaxation_times: impl Iterator<Item = f64>,
        volume_flows: bool,
        time_step: f64,
    ) -> Self {
        let of = |tau: f64| TermStep {
            linear: RelaxationStep::new(tau, time_step),
            ratio: time_step / tau,
        };
        Self { terms: relaxation_times.map(of).collect(), volume_flows }
    }

    /// Updates the history between two displacement gradients with J > 0; see [`ViscousStep::advance_between`].
    #[inline(always)]
    pub fn advance<N: Number>(
        &self,
        before: &AxisymmetricTensor<N>,
        after: &AxisymmetricTensor<N>,
        history: &mut [ViscousStrain<N>],
    ) {
        self.advance_between(&Shape::of(before), &Shape::of(after), history);
    }

    /// Updates the history, one entry per term, from the shape at the start of the step to that at its end. There are
    /// no branches on computed values.
    #[inline(always)]
    pub fn advance_between<N: Number>(
        &self,
        before: &Shape<N>,
        after: &Shape<N>,
        history: &mut [ViscousStrain<N>],
    ) {
        for (term, viscous) in history.iter_mut().enumerate() {
            self.advance_term(term, before, after, viscous);
        }
    }

    /// Updates one term and returns its inverse metric.
    #[inline(always)]
    pub fn advance_term<N: Number>(
        &self,
        term: usize,
        before: &Shape<N>,
        after: &Shape<N>,
        viscous: &mut ViscousStrain<N>,
    ) -> InverseMetric<N> {
        let term = &self.terms[term];
        let one = N::splat(1.0);
        let plane = viscous.plane();
        let mut inverse = (one / (one + plane), one);
        if self.volume_flows {
            let (decay, gain) = (N::splat(term.linear.decay), N::splat(term.linear.gain));
            viscous.volume_change = after
                .volume_change
                .minus_product(decay, before.volume_change - viscous.volume_change)
                .minus_product(gain, after.volume_change - before.volume_change);
            inverse = inverses(one + plane, one + viscous.volume_change);
        }
        let old = viscous.inverse_over(plane, inverse.0);
        let hoop = term.advance_shape(&before.strain, &after.strain, old, viscous);
        let ViscousStrain { rr, yy, ry, volume_change } = *viscous;
        // det C̄_v = 1.
        let shape = SymmetricTensor {
            rr: (yy + hoop).plus_product(yy, hoop),
            yy: (rr + hoop).plus_product(rr, hoop),
            tt: viscous.plane(),
            ry: (N::splat(0.0) - ry).minus_product(ry, hoop),
        };
        InverseMetric { shape, hoop, volume_change, inverse_volume: inverse.1 }
    }
}

impl TermStep {
    /// Updates the shape, given the inverse of C̄_v and its hoop component, and returns the new hoop component.
    #[inline(always)]
    fn advance_shape<N: Number>(
        &self,
        before: &SymmetricTensor<N>,
        after: &SymmetricTensor<N>,
        (inverse, viscous_tt): (SymmetricTensor<N>, N),
        viscous: &mut ViscousStrain<N>,
    ) -> N {
        let (one, half) = (N::splat(1.0), N::splat(0.5));
        // s − 1 of the mean of C̄ over the step: tr((1 + A)(1 + B))/3 − 1.
        let mean = before.plus(after).times(half);
        let excess = (mean.trace() + inverse.trace() + mean.dot(&inverse)) * N::splat(1.0 / 3.0);
        let speed = one + excess;
        let y = excess * N::splat(self.ratio);
        let half_y = half * y;
        let growth = (one + y).plus_product(half_y, y);
        let (inverse_speed, r) = inverses(speed, growth);
        let linear_decay = N::splat(self.linear.decay);
        let decay = linear_decay * r;
        let lost = excess.plus_product(excess, half_y);
        let gain = N::splat(self.linear.gain).plus_product(decay, lost) * inverse_speed;

        let old =
            SymmetricTensor { rr: viscous.rr, yy: viscous.yy, tt: viscous_tt, ry: viscous.ry };
        let old = old.rescaled(excess);
        let rr = followed(old.rr, before.rr, after.rr, (decay, gain));
        let yy = followed(old.yy, before.yy, after.yy, (decay, gain));
        let ry = followed(old.ry, before.ry, after.ry, (decay, gain));
        let tt = followed(old.tt, before.tt, after.tt, (decay, gain));
        let plane = (rr + yy).plus_product(rr, yy).minus_product(ry, ry);
        // Of second order in the step.
        let z = inverse_cube_root_change_near_one((plane + tt).plus_product(plane, tt));
        viscous.rr = rr + z.plus_product(z, rr);
        viscous.yy = yy + z.plus_product(z, yy);
        viscous.ry = ry.plus_product(z, ry);
        tt + z.plus_product(z, tt)
    }
}

/// Returns a component of C̄_v after a step, from its value before the step and the components of C̄ before and after.
// A closure would be a function of its own, compiled without the lanes' instructions.
#[inline(always)]
fn followed<N: Number>(old: N, before: N, after: N, (decay, gain): (N, N)) -> N {
    after.minus_product(decay, before - old).minus_product(gain, after - before)
}
