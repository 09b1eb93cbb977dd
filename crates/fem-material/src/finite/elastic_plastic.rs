//! Elastic–plastic solid at finite strain: Hencky's law of the elastic part, von Mises' yield condition, isotropic
//! hardening.
//!
//! ```math
//! F = F_e F_p, \qquad b_e = F C_p^{-1} F^T, \qquad h = \tfrac12 \ln b_e, \qquad \tau = K \ln J\, 1 + 2G\, \mathrm{dev}\, h,
//! ```
//! ```math
//! \sqrt{\tfrac32}\, |\mathrm{dev}\, \tau| \le J\, \sigma_Y(\varepsilon, \dot\varepsilon), \qquad
//! -\tfrac12 \mathcal{L}_v b_e\, b_e^{-1} = \dot\varepsilon\, \tfrac32 \frac{\mathrm{dev}\, \tau}{q}, \qquad
//! q = \sqrt{\tfrac32}\, |\mathrm{dev}\, \tau|
//! ```
//!
//! Plastic flow keeps the volume, det C_p = 1. The yield condition is one of Cauchy's stress τ/J, since flow stresses are
//! measured as true stress: with Kirchhoff's it would be lower by the change of volume.
//!
//! **The step** is the exponential return map (Weber & Anand 1990, Computer Methods in Applied Mechanics and Engineering
//! 79:173; Simo 1992, ibid. 99:61), which is the radial return of small strain for logarithmic strains. With the trial strain
//! h\* at the last C_p, and its q\*,
//!
//! ```math
//! q^* - 3G\, \Delta\varepsilon = J\, \sigma_Y(\varepsilon + \Delta\varepsilon, \Delta\varepsilon/\Delta t), \qquad
//! \mathrm{dev}\, h = \left(1 - \frac{3G\, \Delta\varepsilon}{q^*}\right) \mathrm{dev}\, h^*, \qquad
//! C_p = F^T e^{-2h} F
//! ```
//!
//! C_p follows from F in each step of flow, so that errors do not add up; an elastic step leaves it as it is. The plastic
//! work of a step is q Δε per undeformed volume, with the mean of q over a step that hardens.

use super::exponential::{exp_less_one, exp_less_one_of};
use super::hencky::{Hencky, logarithmic_strain};
use super::hyperelastic::{Inverted, upright};
use super::kinematics::{Strain, first_piola, push_forward};
use super::logarithm::ln_of_one_plus;
use super::number::{Number, inverse_cube_root};
use super::tensor::{AxisymmetricTensor, SymmetricTensor};
use super::viscous::ViscousStrain;
use crate::elastic::ElasticModuli;
use crate::flow::{FlowCurve, FlowRule, RateFactor};

/// Number of Newton steps for Swift's power law. They converge from one side, quadratically.
const N_SWIFT_STEPS: usize = 7;
/// Number of Newton steps for a flow stress that depends on the rate.
const N_RATE_STEPS: usize = 8;

/// An elastic–plastic solid.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticPlastic {
    elastic: Hencky,
    flow: FlowRule,
}

/// Internal variables of an elastic–plastic solid at a point; all zero in a body that has never flowed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlasticState<N = f64> {
    /// C_p − 1; its change of volume stays 0.
    pub metric: ViscousStrain<N>,
    /// Equivalent plastic strain.
    pub plastic_strain: N,
    /// Plastic work per undeformed volume, J/m³.
    pub plastic_work: N,
}

/// The stress at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlasticStress<N = f64> {
    /// First Piola–Kirchhoff stress, Pa. It has a meaning where J − 1 > −1.
    pub first_piola: AxisymmetricTensor<N>,
    /// J − 1.
    pub volume_change: N,
    /// Ratio of the deviator of the stress to that of the trial stress; 1 without flow.
    pub retained: N,
}

/// The elastic part of a deformation: its logarithmic strain h, and the mean and deviator of it.
struct ElasticPart<N> {
    strain: SymmetricTensor<N>,
    mean: N,
    deviator: SymmetricTensor<N>,
}

impl<N: Number> ElasticPart<N> {
    #[inline(always)]
    fn of(h: &AxisymmetricTensor<N>, strain: &Strain<N>, metric: &ViscousStrain<N>) -> Self {
        let strain = elastic_strain(h, strain, metric);
        let SymmetricTensor { rr, yy, tt, ry } = strain;
        let mean = (rr + yy + tt) * N::splat(1.0 / 3.0);
        let deviator = SymmetricTensor { rr: rr - mean, yy: yy - mean, tt: tt - mean, ry };
        Self { strain, mean, deviator }
    }

    /// Returns the logarithmic strain with a part of the deviator.
    #[inline(always)]
    fn with_retained(&self, retained: N) -> SymmetricTensor<N> {
        let SymmetricTensor { rr, yy, tt, ry } = self.deviator;
        let mean = self.mean;
        SymmetricTensor {
            rr: mean.plus_product(retained, rr),
            yy: mean.plus_product(retained, yy),
            tt: mean.plus_product(retained, tt),
            ry: retained * ry,
        }
    }
}

impl ElasticPlastic {
    /// Creates the solid from its moduli and its flow rule.
    pub fn new(moduli: &ElasticModuli, flow: FlowRule) -> Self {
        let elastic = Hencky { bulk: moduli.bulk_modulus(), shear: moduli.shear_modulus() };
        Self { elastic, flow }
    }

    /// Returns the shear modulus G, Pa.
    pub fn shear_modulus(&self) -> f64 {
        self.elastic.shear
    }

    /// Returns the stress at a displacement gradient at the end of a step (s), and advances the internal variables to
    /// it. It runs on one number or on lanes.
    #[inline(always)]
    pub fn advance<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        time_step: f64,
        state: &mut PlasticState<N>,
    ) -> PlasticStress<N> {
        let one = N::splat(1.0);
        let strain = Strain::of(h);
        let elastic = ElasticPart::of(h, &strain, &state.metric);
        let jacobian = one + strain.volume_change;
        let trial = N::splat(self.elastic.shear)
            * (N::splat(6.0) * elastic.deviator.dot(&elastic.deviator)).sqrt();
        let first = self.flow_stress(state.plastic_strain).0;
        let ratio = trial / (jacobian * first);
        if ratio.all_within(1.0) {
            return self.stress(h, &strain, &elastic.strain, one);
        }
        let flown = self.increment((trial, jacobian, state.plastic_strain), time_step);
        let flown = ratio.choose_within(1.0, N::splat(0.0), flown);
        let three_g = N::splat(3.0 * self.elastic.shear);
        let retained = ratio.choose_within(1.0, one, one - three_g * flown / trial);
        let returned = choose(ratio, &elastic.strain, &elastic.with_retained(retained));
        let SymmetricTensor { rr, yy, ry, .. } = plastic_metric(h, &returned);
        let old = state.metric;
        state.metric.rr = ratio.choose_within(1.0, old.rr, rr);
        state.metric.yy = ratio.choose_within(1.0, old.yy, yy);
        state.metric.ry = ratio.choose_within(1.0, old.ry, ry);
        state.plastic_strain = state.plastic_strain + flown;
        let last = self.flow_stress(state.plastic_strain).0;
        let mean = N::splat(0.5) * retained * trial * (one + first / last);
        state.plastic_work = state.plastic_work.plus_product(mean, flown);
        self.stress(h, &strain, &returned, retained)
    }

    /// Returns the stress at a displacement gradient and fixed internal variables, on one number or on lanes.
    #[inline(always)]
    pub fn stress_at<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        state: &PlasticState<N>,
    ) -> PlasticStress<N> {
        let strain = Strain::of(h);
        self.stress(h, &strain, &elastic_strain(h, &strain, &state.metric), N::splat(1.0))
    }

    /// Returns the stored elastic energy per undeformed volume (J/m³) at fixed internal variables, on one number or on
    /// lanes. It is valid where J − 1 > −1.
    #[inline(always)]
    pub fn energy<N: Number>(&self, h: &AxisymmetricTensor<N>, state: &PlasticState<N>) -> N {
        self.elastic.energy_of(&elastic_strain(h, &Strain::of(h), &state.metric))
    }

    /// Returns the Cauchy stress at fixed internal variables, Pa.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn cauchy(
        &self,
        h: &AxisymmetricTensor,
        state: &PlasticState,
    ) -> Result<SymmetricTensor, Inverted> {
        let strain = upright(h)?;
        let kirchhoff = self.elastic.kirchhoff_of(&elastic_strain(h, &strain, &state.metric));
        Ok(kirchhoff.times(1.0 / (1.0 + strain.volume_change)))
    }

    #[inline(always)]
    fn stress<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        strain: &Strain<N>,
        elastic_strain: &SymmetricTensor<N>,
        retained: N,
    ) -> PlasticStress<N> {
        let volume_change = strain.volume_change;
        let kirchhoff = self.elastic.kirchhoff_of(elastic_strain);
        // The hourglass energy of an element needs this root too.
        let y = inverse_cube_root(N::splat(1.0) + volume_change);
        let first_piola = first_piola(&kirchhoff, h, y * y * y);
        PlasticStress { first_piola, volume_change, retained }
    }

    /// Returns the flow stress at the reference rate (Pa) and its slope, Pa.
    #[inline(always)]
    fn flow_stress<N: Number>(&self, plastic_strain: N) -> (N, N) {
        match self.flow.curve() {
            FlowCurve::Lines(lines) => {
                let (mut stress, mut slope) = (N::splat(0.0), N::splat(0.0));
                for (k, line) in lines.iter().enumerate() {
                    let own = N::splat(line.slope);
                    let value = N::splat(line.at_zero).plus_product(own, plastic_strain);
                    (stress, slope) = match k {
                        0 => (value, own),
                        _ => {
                            let place = plastic_strain * N::splat(line.start.recip());
                            (
                                place.choose_within(1.0, stress, value),
                                place.choose_within(1.0, slope, own),
                            )
                        }
                    };
                }
                (stress, slope)
            }
            FlowCurve::Swift { yield_strength, strain, exponent } => {
                let relative = plastic_strain * N::splat(strain.recip());
                let power = exp_less_one(N::splat(*exponent) * ln_of_one_plus(relative));
                let stress =
                    N::splat(*yield_strength).plus_product(N::splat(*yield_strength), power);
                let slope = N::splat(exponent / strain) * stress / (N::splat(1.0) + relative);
                (stress, slope)
            }
        }
    }

    /// Returns Δε of lanes that flow, for a trial stress q*, J and a plastic strain; it has no meaning in others.
    #[inline(always)]
    fn increment<N: Number>(&self, state: (N, N, N), time_step: f64) -> N {
        let flown = self.increment_at_reference_rate(state);
        match self.flow.rate() {
            Some(rate) => self.increment_at_rate(rate, time_step, flown, state),
            None => flown,
        }
    }

    #[inline(always)]
    fn increment_at_reference_rate<N: Number>(
        &self,
        (trial, jacobian, plastic_strain): (N, N, N),
    ) -> N {
        let three_g = N::splat(3.0 * self.elastic.shear);
        match self.flow.curve() {
            // The end lies on the first line whose solution does not pass the start of the next.
            FlowCurve::Lines(lines) => {
                let mut flown = N::splat(0.0);
                for (k, line) in lines.iter().enumerate() {
                    let slope = N::splat(line.slope);
                    let start = N::splat(line.at_zero).plus_product(slope, plastic_strain);
                    let on_line = trial.minus_product(jacobian, start)
                        / three_g.plus_product(jacobian, slope);
                    flown = match k {
                        0 => on_line,
                        _ => ((plastic_strain + flown) * N::splat(line.start.recip()))
                            .choose_within(1.0, flown, on_line),
                    };
                }
                flown
            }
            FlowCurve::Swift { .. } => {
                let mut flown = N::splat(0.0);
                for _ in 0..N_SWIFT_STEPS {
                    let (stress, slope) = self.flow_stress(plastic_strain + flown);
                    let excess =
                        trial.minus_product(three_g, flown).minus_product(jacobian, stress);
                    flown = flown + excess / three_g.plus_product(jacobian, slope);
                }
                flown
            }
        }
    }

    /// Solves the yield condition with the factor of the rate, by Newton's method in x = ln(Δε/ε̇₀Δt) from above, where
    /// the excess of stress is a concave function that falls. The step of x is applied as (1 − Δx/4)⁻⁴ ≥ e^Δx, which stays
    /// above the solution.
    #[inline(always)]
    fn increment_at_rate<N: Number>(
        &self,
        RateFactor { coefficient, reference_rate }: RateFactor,
        time_step: f64,
        without_rate: N,
        (trial, jacobian, plastic_strain): (N, N, N),
    ) -> N {
        let (one, quarter) = (N::splat(1.0), N::splat(0.25));
        let (three_g, c) = (N::splat(3.0 * self.elastic.shear), N::splat(coefficient));
        let per_reference = N::splat((reference_rate * time_step).recip());
        if (without_rate * per_reference).all_within(1.0) {
            return without_rate;
        }
        let mut flown = without_rate;
        for _ in 0..N_RATE_STEPS {
            let (stress, slope) = self.flow_stress(plastic_strain + flown);
            let factor = one.plus_product(c, ln_of_one_plus(flown * per_reference - one));
            let excess =
                trial.minus_product(three_g, flown).minus_product(jacobian, stress * factor);
            let descent = (jacobian * stress * c)
                .plus_product(flown, three_g.plus_product(jacobian, slope * factor));
            let scale = one / one.minus_product(quarter, excess / descent);
            let squared = scale * scale;
            flown = flown * (squared * squared);
        }
        (without_rate * per_reference).choose_within(1.0, without_rate, flown)
    }
}

/// Returns the logarithmic strain h of the elastic part for C_p − 1.
#[inline(always)]
fn elastic_strain<N: Number>(
    h: &AxisymmetricTensor<N>,
    strain: &Strain<N>,
    metric: &ViscousStrain<N>,
) -> SymmetricTensor<N> {
    let (inverse, _) = metric.inverse();
    logarithmic_strain(&strain.left.plus(&push_forward(&inverse, h)))
}

/// Returns the components of `inside` in lanes whose ratio is at most 1, and of `outside` in the others.
#[inline(always)]
fn choose<N: Number>(
    ratio: N,
    inside: &SymmetricTensor<N>,
    outside: &SymmetricTensor<N>,
) -> SymmetricTensor<N> {
    SymmetricTensor {
        rr: ratio.choose_within(1.0, inside.rr, outside.rr),
        yy: ratio.choose_within(1.0, inside.yy, outside.yy),
        tt: ratio.choose_within(1.0, inside.tt, outside.tt),
        ry: ratio.choose_within(1.0, inside.ry, outside.ry),
    }
}

/// Returns C_p − 1 = Fᵀ e^(−2h) F − 1 of an elastic logarithmic strain.
#[inline(always)]
fn plastic_metric<N: Number>(
    h: &AxisymmetricTensor<N>,
    elastic: &SymmetricTensor<N>,
) -> SymmetricTensor<N> {
    let inverse = exp_less_one_of(&elastic.times(N::splat(-2.0)));
    h.right_strain().plus(&push_forward(&inverse, &h.transposed()))
}
