//! Laws of contacts that dent: loading, and an elastic rebound from any approach δ_m.
//!
//! Every law gives the force F(δ) and the contact radius a(δ) of the loading. A dented sphere springs back as Hertz' of
//! the curvature that has the same contact radius, R_p = 4E*a³/3F, so that
//!
//! ```math
//! F = F_m\left(\frac{\delta-\delta_r}{\delta_m-\delta_r}\right)^{3/2}, \qquad
//! \delta_m-\delta_r = \frac{3F_m}{4E^*a_m}, \qquad e^2 = \frac{\tfrac25F_m(\delta_m-\delta_r)}{\int F\,\mathrm d\delta}
//! ```
//!
//! (Etsion, Kligerman & Kadin 2005, as read in `SPHERE_PLASTIC_PRE2.m` of a public model of rough contacts; it is Thornton's
//! and Johnson's unloading too). A linear spring springs back with another stiffness. δ_r is the dent.
//! A rebound never returns more than the loading took, nor more of the approach: where a law says so, e is 1 or δ_r is 0.
//!
//! | law | loading | read in |
//! |---|---|---|
//! | [`thornton`] | Hertz up to the pressure p_y, then F = F_y + πp_yR*(δ − δ_y), a² = R*δ | the public description of `chiton-helmet-sim`, which cites Thornton (1997); [`crate::FirstYield`] |
//! | [`johnson`] | F = 2πR*p_dδ, a² = 2R*δ | Johnson (1985), section 11.5, as in [`crate::FirstYield`] |
//! | [`jackson_green`] | Hertz up to 1.9 ω_c, then a fit to finite elements | `SPHERE_PLASTIC_PRE2.m`, for a sphere of radius R* on a rigid flat |
//! | [`brake`] | as `jackson_green`; the rebound has Hertz' contact radius, a² = R*δ | `SPHERE_PLASTIC_PRE.m` of the same model, which cites Ghaednia, Brake et al. (2019) and Brake (2015) |
//! | [`mean_pressure`] | Hertz, then a fit to finite elements, and so is the rebound | the module `mean_pressure` |
//! | [`walton_braun`] | F = k₁δ | `walton::normal_force` of a public code for granular flow, which cites Walton & Braun (1986) |
//! | [`luding`] | F = k₁δ, rebound stiffer with δ_m, up to δ\*; beyond all of it elastic with k_p | YADE's LudingPM, which cites Luding (2008), eqs. 6 to 8 |
//! | [`mdr`] | Hertz' mean pressure up to p_Y(δ), then F = πa²p_Y | the module `mdr` |
//!
//! Jackson and Green's fit with the later hardness of Ghaednia et al. (2019, eq. 28), with ω = δ, C = 1.295 exp(0.736 ν) and the yield strength S of the weaker body:
//!
//! ```math
//! \omega_c = R^*\Bigl(\frac{\pi CS}{2E^*}\Bigr)^2, \quad
//! F_c = \frac43\Bigl(\frac{R^*}{E^*}\Bigr)^2\Bigl(\frac{\pi CS}2\Bigr)^3, \quad x = \frac\omega{\omega_c}, \qquad
//! \frac F{F_c} = e^{-x^{5/12}/4}x^{3/2} + \frac{4H}{CS}\bigl(1-e^{-x^{5/9}/25}\bigr)x
//! ```
//!
//! ```math
//! \frac HS = 2.84 - 0.92\bigl(1-\cos\tfrac{\pi a}{R^*}\bigr), \qquad
//! a^2 = R^*\omega\Bigl(\frac x{1.9}\Bigr)^B, \quad B = 0.14\,e^{23S/E^*}
//! ```
//!
//! It jumps by half a percent where it begins, and beyond about 2000 ω_c its mean pressure falls, because its area grows too
//! fast. Limits: perfect plasticity, one body that flows; no rates, no waves.

use std::f64::consts::PI;

use fem_material::{FlowRule, FlowStress, Material};

use super::mdr::Mdr;
use super::mean_pressure::MeanPressure;
use super::power::{ContactLaw, power};
use super::published::hertz_stiffness;
use crate::error::{LawError, not_negative, positive, restitution as checked_restitution};
use crate::family::{LawContext, LawInput, LawInputError, LawValues};
use crate::hertz::HertzImpact;
use crate::numerics::gauss;
use crate::pair::Pair;
use crate::plastic_yield::{FirstYield, YieldingBody, largest_von_mises};

/// Dynamic hardness over yield strength.
const HARDNESS: f64 = 3.0;
/// Ratio of moduli from which the stiffer body, if no strength is known, is expected to yield after its partner.
const FAR_STIFFER: f64 = 2.0;
/// Interference over the critical one at which Jackson and Green's fit begins.
const FIT_BEGINS: f64 = 1.9;
/// Ratio of the ends of a panel of a quadrature.
const PANEL: f64 = 1.25;

/// The plastic part of a [`ContactLaw`], whose spring is the law until it first flows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticPlastic {
    radius: f64,
    modulus: f64,
    formula: Formula,
}

/// The loading of a law, with its parameters in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Formula {
    Thornton {
        pressure: f64,
    },
    Johnson {
        hardness: f64,
    },
    JacksonGreen {
        strength: f64,
        constraint: f64,
        /// Whether the rebound has the contact radius of the loading, Etsion's, or that of Hertz, Brake's.
        rebounds_flattened: bool,
    },
    MeanPressure(MeanPressure),
    Mdr(Mdr),
    /// Stiffness of the loading and of the rebound at most, N/m, and the approach at which that is reached, m.
    Springs {
        stiffness: f64,
        rebound: f64,
        until: f64,
    },
}

/// The elastic rebound from an approach: F = F_m ((δ − δ_r)/`length`)^`exponent`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rebound {
    /// Force at the beginning, N.
    pub force: f64,
    /// Approach that springs back, m.
    pub length: f64,
    pub exponent: f64,
}

impl Rebound {
    /// Returns the force, N, at a height above the dent, m.
    pub fn force_at(&self, height: f64) -> f64 {
        self.force * (height / self.length).max(0.0).powf(self.exponent)
    }

    /// Returns the energy that is left, J, at a height above the dent, m.
    pub fn energy_at(&self, height: f64) -> f64 {
        self.force_at(height) * height / (self.exponent + 1.0)
    }
}

impl ElasticPlastic {
    /// Returns the approach at which the formula of the loading changes, m; infinite for a law that has one formula.
    pub(crate) fn yield_approach(&self) -> f64 {
        match self.formula {
            Formula::Thornton { pressure } => {
                self.radius * (0.5 * PI * pressure / self.modulus).powi(2)
            }
            Formula::JacksonGreen { .. } => FIT_BEGINS * self.critical_interference(),
            Formula::MeanPressure(law) => law.yield_approach(),
            Formula::Mdr(law) => law.yield_approach(),
            Formula::Springs { until, .. } if until > 0.0 => until,
            Formula::Johnson { .. } | Formula::Springs { .. } => f64::INFINITY,
        }
    }

    /// Returns whether the law has a contact radius.
    pub(crate) fn has_contact_radius(&self) -> bool {
        !matches!(self.formula, Formula::Springs { .. })
    }

    /// Returns the contact radius of the loading at an approach, m.
    pub(crate) fn contact_radius(&self, approach: f64) -> f64 {
        let hertz = (self.radius * approach).sqrt();
        match self.formula {
            Formula::Johnson { .. } => (2.0 * self.radius * approach).sqrt(),
            Formula::JacksonGreen { strength, .. } => {
                let fit = approach / (FIT_BEGINS * self.critical_interference());
                let exponent = 0.14 * (23.0 * strength / self.modulus).exp();
                hertz * fit.max(1.0).powf(0.5 * exponent)
            }
            Formula::MeanPressure(law) => law.contact_radius(approach),
            Formula::Mdr(law) => law.contact_radius(approach),
            Formula::Thornton { .. } | Formula::Springs { .. } => hertz,
        }
    }

    /// ω_c of Jackson and Green, m.
    fn critical_interference(&self) -> f64 {
        match self.formula {
            Formula::JacksonGreen { strength, constraint, .. } => {
                self.radius * (0.5 * PI * constraint * strength / self.modulus).powi(2)
            }
            _ => f64::INFINITY,
        }
    }

    /// Returns the force of the loading beyond first yield, N, where the elastic spring has this force at the approach.
    fn plastic_force(&self, approach: f64, elastic: f64) -> f64 {
        match self.formula {
            // The spring at first yield has F_y = ⅔πp_yR*δ_y.
            Formula::Thornton { pressure } => {
                PI * pressure * self.radius * (approach - self.yield_approach() / 3.0)
            }
            Formula::JacksonGreen { strength, constraint, .. } => {
                let x = approach / self.critical_interference();
                let slope = PI * self.contact_radius(approach) / self.radius;
                let hardness = 2.84 - 0.92 * (1.0 - slope.cos());
                let critical = 4.0 / 3.0
                    * (self.radius / self.modulus).powi(2)
                    * (0.5 * PI * constraint * strength).powi(3);
                let fading = (-0.25 * x.powf(5.0 / 12.0)).exp() * x.powf(1.5);
                let growing = -(-x.powf(5.0 / 9.0) / 25.0).exp_m1() * x;
                critical * (fading + 4.0 * hardness / constraint * growing)
            }
            Formula::MeanPressure(law) => law.force(approach),
            Formula::Mdr(law) => law.force(approach),
            Formula::Springs { stiffness, rebound, until } if until > 0.0 => {
                stiffness * until + rebound * (approach - until)
            }
            Formula::Johnson { .. } | Formula::Springs { .. } => elastic,
        }
    }

    /// Returns the length, m, and the energy, J, of the rebound from an approach (m) at a force, N.
    fn rebound(&self, approach: f64, force: f64) -> (f64, f64) {
        match self.formula {
            Formula::Springs { stiffness, rebound, until } => {
                let share = if until > 0.0 { (approach / until).min(1.0) } else { 1.0 };
                let length = force / (stiffness + (rebound - stiffness) * share);
                (length, 0.5 * force * length)
            }
            Formula::MeanPressure(law) => law.rebound(approach),
            Formula::Mdr(law) => law.rebound(approach),
            Formula::Thornton { .. } | Formula::Johnson { .. } | Formula::JacksonGreen { .. } => {
                let is_hertz =
                    matches!(self.formula, Formula::JacksonGreen { rebounds_flattened: false, .. });
                let hertz = (self.radius * approach).sqrt();
                let radius = if is_hertz { hertz } else { self.contact_radius(approach) };
                let length = 0.75 * force / (self.modulus * radius);
                (length, 0.4 * force * length)
            }
        }
    }
}

impl ContactLaw {
    /// Returns the force of a first loading, N, at an approach ≥ 0, m, without a dashpot.
    pub(crate) fn loading_force(&self, approach: f64) -> f64 {
        let elastic = self.stiffness() * approach.powf(self.elastic_exponent());
        match self.elastic_plastic() {
            Some(law) if approach > law.yield_approach() => law.plastic_force(approach, elastic),
            _ => elastic,
        }
    }

    /// Returns the force of a first loading to an approach > 0, m, and the length (m) and the exponent of the rebound from there, in
    /// which the force is a power of the height above the dent; `None` for a law that does not dent.
    pub fn indentation(&self, approach: f64) -> Option<[f64; 3]> {
        let rebound =
            self.rebound(self.elastic_plastic()?, approach, self.loading_work(0.0, approach));
        Some([rebound.force, rebound.length, rebound.exponent])
    }

    /// Returns the approach at which a law that dents first yields, m; `None` for another law, and infinite where it dents at once.
    pub fn first_yield(&self) -> Option<f64> {
        Some(self.elastic_plastic()?.yield_approach())
    }

    /// Returns the work of a first loading, J, from an approach ≥ 0 to a larger one, m, without a dashpot.
    pub(crate) fn loading_work(&self, from: f64, to: f64) -> f64 {
        let yields = self.elastic_plastic().map_or(f64::INFINITY, ElasticPlastic::yield_approach);
        let exponent = self.elastic_exponent() + 1.0;
        let elastic =
            |approach: f64| self.stiffness() * approach.min(yields).powf(exponent) / exponent;
        let mut work = elastic(to) - elastic(from);
        let mut from = from.max(yields);
        while from < to {
            let next = (PANEL * from).min(to);
            work += gauss(from, next, |approach| self.loading_force(approach));
            from = next;
        }
        work
    }

    /// Returns the rebound from an approach > 0, m, of a law that dents, after this work of the loading, J.
    pub(crate) fn rebound(&self, law: &ElasticPlastic, approach: f64, work: f64) -> Rebound {
        let force = self.loading_force(approach);
        let (length, returned) = law.rebound(approach, force);
        let (length, returned) = (length.min(approach), returned.min(work));
        // F ℓ/(n + 1) is what returns.
        Rebound { force, length, exponent: force * length / returned - 1.0 }
    }
}

/// Returns Thornton's law of a pair and the contact pressure p_y at which it first yields, Pa, which is held from then on.
///
/// Thornton (1997), *J. Appl. Mech.* 64, 383.
///
/// # Errors
/// A pressure that is not positive and finite.
pub fn thornton(pair: &Pair, yield_pressure: f64) -> Result<ContactLaw, LawError> {
    let pressure = positive("yield_pressure", yield_pressure)?;
    dented(pair, (hertz_stiffness(pair), 1.5), Formula::Thornton { pressure })
}

/// Returns Johnson's fully plastic law of a pair and the dynamic hardness p_d, Pa, about three yield strengths.
///
/// Johnson (1985), *Contact Mechanics*, section 11.5.
///
/// # Errors
/// A hardness that is not positive and finite.
pub fn johnson(pair: &Pair, hardness: f64) -> Result<ContactLaw, LawError> {
    let hardness = positive("hardness", hardness)?;
    let stiffness = 2.0 * PI * pair.effective_radius() * hardness;
    dented(pair, (stiffness, 1.0), Formula::Johnson { hardness })
}

/// Returns Jackson and Green's law of a pair, and yield strength (Pa) and Poisson's ratio of the body that flows.
///
/// Force and radius of Jackson & Green (2005), *J. Tribol.* 127, 343; the hardness, a cosine of the contact radius, of Ghaednia, Brake,
/// Berryhill & Jackson (2019), *J. Tribol.*, eq. 28; the rebound of Etsion et al. (2005).
///
/// # Errors
/// A strength that is not positive and finite, a ratio outside (−1, 0.5].
pub fn jackson_green(
    pair: &Pair,
    yield_strength: f64,
    poissons_ratio: f64,
) -> Result<ContactLaw, LawError> {
    fitted_sphere(pair, yield_strength, poissons_ratio, true)
}

/// Returns the law of [`jackson_green`] with Brake's rebound: Hertz' of the curvature that has the force F_m at the
/// contact radius √(R\*δ_m).
///
/// Ghaednia, Brake, Berryhill & Jackson (2019), *J. Tribol.*, without hardening, and Brake (2015), *Int. J. Solids Struct.*
///
/// # Errors
/// Those of [`jackson_green`].
pub fn brake(
    pair: &Pair,
    yield_strength: f64,
    poissons_ratio: f64,
) -> Result<ContactLaw, LawError> {
    fitted_sphere(pair, yield_strength, poissons_ratio, false)
}

fn fitted_sphere(
    pair: &Pair,
    yield_strength: f64,
    poissons_ratio: f64,
    rebounds_flattened: bool,
) -> Result<ContactLaw, LawError> {
    let strength = positive("yield_strength", yield_strength)?;
    let constraint = 1.295 * (0.736 * checked_ratio(poissons_ratio)?).exp();
    let formula = Formula::JacksonGreen { strength, constraint, rebounds_flattened };
    dented(pair, (hertz_stiffness(pair), 1.5), formula)
}

/// Returns the mean-pressure law of a pair, and flow stress (Pa) and Poisson's ratio of the body that flows, with its share in the
/// flattening of a wide contact, 1 for a ball on a flat and 1/2 for like balls that both flow, and the share of an elastic partner
/// in the compliance 1/E\*, 0 for a rigid one or if both flow.
///
/// A fit to explicit finite elements of this program: the module `mean_pressure` has its equations.
///
/// # Errors
/// A strength that is not positive and finite, a ratio outside (−1, 0.5], a slope, an exponent or a share that is negative or not finite.
pub fn mean_pressure(
    pair: &Pair,
    flow: FlowStress,
    poissons_ratio: f64,
    [flattening_share, elastic_share]: [f64; 2],
) -> Result<ContactLaw, LawError> {
    let flow = FlowStress {
        yield_strength: positive("yield_strength", flow.yield_strength)?,
        modulus: not_negative("hardening", flow.modulus)?,
        strain: positive("hardening_strain", flow.strain)?,
        exponent: not_negative("hardening_exponent", flow.exponent)?,
    };
    let law = MeanPressure {
        radius: pair.effective_radius(),
        modulus: pair.contact_modulus(),
        flow,
        constraint: largest_von_mises(checked_ratio(poissons_ratio)?).recip(),
        flattening_share: not_negative("flattening_share", flattening_share)?,
        elastic_share: not_negative("elastic_share", elastic_share)?,
    };
    dented(pair, (hertz_stiffness(pair), 1.5), Formula::MeanPressure(law))
}

/// Returns the law of LAMMPS' `mdr` of a pair, and yield strength (Pa), Poisson's ratio and the radius of the smaller sphere
/// over that of the larger one, 0 for a sphere on a flat: the module `mdr` has its equations.
///
/// # Errors
/// A strength that is not positive and finite, a ratio outside (−1, 0.5], a ratio of the radii outside [0, 1].
pub fn mdr(
    pair: &Pair,
    yield_strength: f64,
    poissons_ratio: f64,
    radius_ratio: f64,
) -> Result<ContactLaw, LawError> {
    let strength = positive("yield_strength", yield_strength)?;
    if !(0.0..=1.0).contains(&radius_ratio) {
        let (quantity, range) = ("radius_ratio", "[0, 1]");
        return Err(LawError::OutOfRange { quantity, value: radius_ratio, range });
    }
    let law = Mdr::new(pair, strength, checked_ratio(poissons_ratio)?, radius_ratio);
    dented(pair, (hertz_stiffness(pair), 1.5), Formula::Mdr(law))
}

/// Returns the spring of a stiffness k₁, N/m, that springs back with k₁/e², which gives a restitution in (0, 1] at any speed.
///
/// Walton & Braun (1986), *J. Rheol.* 30, 949.
///
/// # Errors
/// A restitution outside (0, 1], a stiffness that is not positive and finite.
pub fn walton_braun(pair: &Pair, restitution: f64, stiffness: f64) -> Result<ContactLaw, LawError> {
    let e = checked_restitution(restitution)?;
    let stiffness = positive("k1", stiffness)?;
    let rebound = positive("stiffness of the rebound", stiffness / (e * e))?;
    dented(pair, (stiffness, 1.0), Formula::Springs { stiffness, rebound, until: 0.0 })
}

/// Returns Luding's law without adhesion: the spring of a stiffness k₁ springs back with a stiffness that grows with the
/// largest approach from k₁, N/m, to k_p, `ratio` times as much, at δ* = 2R*φ_f k_p/(k_p − k₁), where φ_f is the plasticity
/// depth. Beyond δ* the loading goes on with k_p and loses nothing more.
///
/// Luding (2008), *Granular Matter* 10, 235.
///
/// # Errors
/// A ratio below 1; a stiffness or a depth that is not positive and finite.
pub fn luding(pair: &Pair, ratio: f64, stiffness: f64, depth: f64) -> Result<ContactLaw, LawError> {
    if ratio.is_nan() || ratio < 1.0 {
        let (quantity, range) = ("kp_over_k1", "[1, infinity)");
        return Err(LawError::OutOfRange { quantity, value: ratio, range });
    }
    let (stiffness, depth) = (positive("k1", stiffness)?, positive("phi_f", depth)?);
    let rebound = positive("stiffness of the rebound", ratio * stiffness)?;
    let until = 2.0 * pair.effective_radius() * depth * (ratio / (ratio - 1.0));
    dented(pair, (stiffness, 1.0), Formula::Springs { stiffness, rebound, until })
}

fn checked_ratio(value: f64) -> Result<f64, LawError> {
    let (quantity, range) = ("nu", "(-1, 0.5]");
    let is_allowed = value > -1.0 && value <= 0.5;
    is_allowed.then_some(value).ok_or(LawError::OutOfRange { quantity, value, range })
}

/// Returns the law whose spring, K and γ, is followed until first yield.
fn dented(
    pair: &Pair,
    (stiffness, exponent): (f64, f64),
    formula: Formula,
) -> Result<ContactLaw, LawError> {
    let (radius, modulus) = (pair.effective_radius(), pair.contact_modulus());
    let law = ElasticPlastic { radius, modulus, formula };
    Ok(power(stiffness, exponent, 0.0, 0.0)?.with_elastic_plastic(law))
}

/// Returns p_y as given, or that of the body that yields first.
///
/// # Errors
/// Neither a strength nor a material with one is given.
pub fn thornton_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let pressure = match law.get("yield_pressure") {
        Some(pressure) => pressure,
        None => first_yield_of(law, context)?.1.pressure,
    };
    Ok((vec![pressure], context.pair))
}

/// Returns the hardness as given, or three times the yield strength.
///
/// # Errors
/// Those of [`thornton_values`].
pub fn johnson_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let hardness = match law.get("hardness") {
        Some(hardness) => hardness,
        None => HARDNESS * first_yield_of(law, context)?.1.body().yield_strength,
    };
    Ok((vec![hardness], context.pair))
}

/// Returns yield strength and Poisson's ratio as given, or those of the body that yields first.
///
/// # Errors
/// Those of [`thornton_values`].
pub fn jackson_green_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let YieldingBody { yield_strength, poissons_ratio, .. } =
        first_yield_of(law, context)?.1.body();
    Ok((vec![yield_strength, law.get("nu").unwrap_or(poissons_ratio)], context.pair))
}

/// Returns yield strength, Poisson's ratio, hardening and shares as given, or those of the body that yields first. Those of a
/// flow rule are at the rate of the contact.
///
/// # Errors
/// Those of [`thornton_values`].
pub fn mean_pressure_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let first = flow_of(law, context)?;
    let FlowStress { yield_strength, modulus, strain, exponent } = first.flow_stress();
    let parameters = vec![
        yield_strength,
        first.body().poissons_ratio,
        modulus,
        strain,
        exponent,
        first.flattening_share,
        first.elastic_share,
    ];
    Ok((parameters, context.pair))
}

/// Returns yield strength and Poisson's ratio as given, or those of the body that yields first, and the ratio of the radii.
///
/// # Errors
/// Those of [`thornton_values`].
pub fn mdr_values(law: &LawInput, context: &LawContext<'_>) -> LawValues {
    let (mut parameters, pair) = jackson_green_values(law, context)?;
    let [first, second] = context.radii;
    let ratio = first.min(second) / first.max(second);
    parameters.push(law.get("radius_ratio").unwrap_or(ratio));
    Ok((parameters, pair))
}

/// Returns the first yield of the body that yields, with the flow stress that the law and that body's material give: the impact of
/// elements that stand behind a law that dents.
///
/// # Errors
/// Those of [`thornton_values`].
pub fn flow_of(law: &LawInput, context: &LawContext<'_>) -> Result<FirstYield, LawInputError> {
    let (index, first) = first_yield_of(law, context)?;
    let rule = context.materials[index].and_then(Material::flow);
    let given = given_strength(law, first.body().poissons_ratio);
    let of_rule = |rule: &FlowRule, strain: f64, rate: f64| {
        let flow = rule.closed_form(strain, rate);
        given.map_or(flow, |strength| flow.with_yield_strength(strength))
    };
    let hardened = rule.map(|rule| first.hardened(|strain, rate| of_rule(rule, strain, rate)).0);
    let first = hardened.unwrap_or(first);
    let flow = first.flow_stress();
    let flow = FlowStress {
        modulus: law.get("hardening").unwrap_or(flow.modulus),
        strain: law.get("hardening_strain").unwrap_or(flow.strain),
        exponent: law.get("hardening_exponent").unwrap_or(flow.exponent),
        ..flow
    };
    let poissons_ratio = law.get("nu").unwrap_or(first.body().poissons_ratio);
    let mut first = first.of_flow(flow, poissons_ratio);
    first.flattening_share = law.get("flattening_share").unwrap_or(first.flattening_share);
    first.elastic_share = law.get("elastic_share").unwrap_or(first.elastic_share);
    Ok(first)
}

/// Returns index and first yield of the body that yields first. A strength that the law gives is that of the body that yields by
/// the strengths of the materials. Where neither has one it is that of both, without a body far stiffer than its partner.
fn first_yield_of(
    law: &LawInput,
    context: &LawContext<'_>,
) -> Result<(usize, FirstYield), LawInputError> {
    let hertz = HertzImpact::new(&context.pair, context.approach_speed)?;
    let own = context.yield_strengths;
    let moduli = context.materials.map(|material| material.map(|it| *it.instantaneous()));
    let body = |k: usize| {
        let modulus = moduli[k]?.plane_strain_modulus();
        let partner = moduli[1 - k].map_or(f64::INFINITY, |other| other.plane_strain_modulus());
        let is_soft = modulus < FAR_STIFFER * partner;
        let poissons_ratio = moduli[k]?.poissons_ratio();
        let given = given_strength(law, poissons_ratio).filter(|_| own == [None; 2] && is_soft);
        Some(YieldingBody {
            yield_strength: own[k].or(given)?,
            poissons_ratio,
            plane_strain_modulus: modulus,
            radius: context.radii[k],
        })
    };
    let found = FirstYield::earliest(&hertz, [body(0), body(1)]);
    let (index, first) = found.ok_or(LawInputError::Materials {
        message: "a law that dents needs a yield strength",
        help: "set material.NAME.yield_strength, or yield_strength in the law",
    })?;
    let given = given_strength(law, first.body().poissons_ratio);
    Ok((index, given.map_or(first, |strength| first.of_strength(strength))))
}

/// Returns the yield strength (Pa) that a law gives a body of a Poisson's ratio, by whichever of its keys.
fn given_strength(law: &LawInput, poissons_ratio: f64) -> Option<f64> {
    let of_hardness = || law.get("hardness").map(|hardness| hardness / HARDNESS);
    let of_pressure =
        || law.get("yield_pressure").map(|pressure| pressure * largest_von_mises(poissons_ratio));
    law.get("yield_strength").or_else(of_hardness).or_else(of_pressure)
}
