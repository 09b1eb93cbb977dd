//! When a Hertz contact first yields, and what closed forms say of impacts beyond: for a warning of
//! elastic models, not for a computation of plastic flow.
//!
//! The largest von Mises stress of a Hertz contact lies on the axis below the surface (Johnson,
//! *Contact Mechanics*, eq. 3.45),
//!
//! ```math
//! \frac{\sigma_M}{p_0} = \max_\zeta\left|\frac{3}{2(1+\zeta^2)} - (1+\nu)(1-\zeta\arctan\tfrac1\zeta)\right|,
//! ```
//!
//! 0.62 at ν = 0.3, so the contact first yields at p₀ = 1.6 Y, and p₀ ∝ v^(2/5) gives the speed. Beyond
//! it the law of the mean pressure ([`mean_pressure`](crate::laws::mean_pressure())) gives the impact of an elastic–perfectly plastic sphere, with
//! its error beside finite elements.

use std::f64::consts::PI;

use fem_material::FlowStress;

use crate::dent_impact;
use crate::error::LawError;
use crate::hertz::{HertzImpact, HertzPressure};
use crate::impact::{Impact, ImpactQuantities};
use crate::law_impact::LawImpact;
use crate::laws::{ContactLaw, REPRESENTATIVE_STRAIN, hertz, mean_pressure};
use crate::pair::Pair;
use crate::plate::FreePlate;

/// Depths over the contact radius between which the largest stress lies, for any ν.
const DEPTHS: (f64, f64) = (0.0, 1.5);
/// Relative errors of the mean-pressure law beside the elements of `validation/data/flow_map.csv`, in small contacts.
const ERRORS: [f64; 6] = [0.02, 0.02, 0.03, 0.03, 0.025, 0.15];
/// Factor on these errors beside a partner that stays elastic.
const ERROR_BESIDE_ELASTIC: f64 = 2.0;
/// Growth of these errors with the cube of the contact radius over R\*.
const ERROR_OF_WIDE_CONTACTS: f64 = 0.3;
/// The same by hardening at 1000 times the speed of first yield, from this exponent of the flow stress over strain on.
const ERRORS_OF_HARDENING: [f64; 6] = [0.04, 0.02, 0.055, 0.02, 0.02, 0.15];
const FULL_HARDENING: f64 = 0.1;
/// Speed over that of first yield from which the errors grow, and by how much each ten times.
const FASTEST_OF_MAP: f64 = 1000.0;
const ERROR_PER_DECADE: f64 = 0.01;
/// Pressure of first yield of the harder body over that of the softer one, below which both flow.
const BOTH_FLOW: f64 = 1.25;
/// Passes that find the flow stress at the strain and the rate of the contact, and the speed of first yield on a plate.
const N_PASSES: usize = 4;
/// Rate that counts for restitution and force over the mean rate of the loading: both are decided shortly before the turn. Elements with
/// Y = 1 GPa and C = 0.02 at 1 m/s rebound and press as those with 1.067 Y and no rate, which a fortieth of the mean rate gives; at 10 m/s with 1.085 Y.
const RATE_BEFORE_THE_TURN: f64 = 0.025;
/// Tolerance of impacts on a plate.
const TOLERANCE_ON_PLATE: f64 = 1e-6;

/// The properties of a body on which its first yield depends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldingBody {
    /// Yield strength, Pa.
    pub yield_strength: f64,
    /// Poisson's ratio of the body.
    pub poissons_ratio: f64,
    /// Plane strain modulus E/(1−ν²), Pa.
    pub plane_strain_modulus: f64,
    /// Radius, m; infinite for a flat body.
    pub radius: f64,
}

/// First yield of one of two bodies in an impact of elastic bodies: Hertz', or one on a thin plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstYield {
    /// Pressure on the axis at which the body yields, Pa.
    pub pressure: f64,
    /// Approach speed from which on the impact reaches it, m/s.
    pub speed: f64,
    /// Share of the bodies that flow in the flattening of a wide contact. With the shares κ of both bodies in the curvature
    /// 1/R\* it is (1 + κ)/2 of one that flows, 1 of a ball on a flat, and κ₁² + κ₂² if both flow, 1/2 of like balls.
    pub flattening_share: f64,
    /// Share of the other body in the compliance 1/E\* if it does not flow.
    pub elastic_share: f64,
    body: YieldingBody,
    flow: FlowStress,
    hertz: HertzImpact,
    /// The impact of bodies that do not yield.
    elastic: ImpactQuantities,
    /// Mobility of a plate in series as a thin one, m/(N s); 0 without a plate.
    plate_mobility: f64,
    /// The same with the thickness of the plate, as elastic contacts have it.
    thick_plate_mobility: f64,
}

/// Returns σ_M/p₀, the largest von Mises stress on the axis of a Hertz contact over the peak pressure, at a
/// Poisson's ratio.
pub fn largest_von_mises(poissons_ratio: f64) -> f64 {
    let unit = HertzPressure { contact_radius: 1.0, peak_pressure: 1.0 };
    let stress = |depth: f64| 2.0 * unit.axis_stress(depth, poissons_ratio).max_shear();
    // The stress has one maximum there: thirds of the range that cannot hold it are left out.
    let (mut low, mut high) = DEPTHS;
    for _ in 0..100 {
        let [left, right] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if stress(left) < stress(right) { low = left } else { high = right }
    }
    stress(0.5 * (low + high))
}

impl FirstYield {
    /// Returns the first yield of a perfectly plastic body in an impact with one that does not yield.
    pub fn new(hertz: &HertzImpact, body: YieldingBody) -> Self {
        let pressure = body.yield_strength / largest_von_mises(body.poissons_ratio);
        let flattening_share = 0.5 * (1.0 + hertz.pair().effective_radius() / body.radius);
        let elastic_share =
            (1.0 - hertz.pair().contact_modulus() / body.plane_strain_modulus).max(0.0);
        Self {
            pressure,
            speed: hertz.approach_speed() * (pressure / hertz.peak_pressure()).powf(2.5),
            flattening_share,
            elastic_share,
            body,
            flow: FlowStress::perfect(body.yield_strength),
            hertz: *hertz,
            elastic: ImpactQuantities::from(hertz),
            plate_mobility: 0.0,
            thick_plate_mobility: 0.0,
        }
    }

    /// Puts a plate in series with the contact as a thin one, whose waves lower force and pressure. A plate from whose lower face no
    /// wave returns within Hertz' contact is a half-space.
    ///
    /// # Errors
    /// Results that leave the range of f64.
    pub fn with_plate(self, plate: &FreePlate) -> Result<Self, LawError> {
        if plate.is_half_space(&self.hertz) {
            return Ok(self);
        }
        let mobility = plate.thin_mobility();
        let thick_plate_mobility = plate.mobility(&self.hertz);
        let elastic = elastic_on_plate(self.hertz.pair(), mobility, self.hertz.approach_speed())?;
        Ok(Self { elastic, plate_mobility: mobility, thick_plate_mobility, ..self }.with_speed())
    }

    /// Returns the index of the body that yields first, of those with a yield strength, and its first yield.
    pub fn earliest(
        hertz: &HertzImpact,
        bodies: [Option<YieldingBody>; 2],
    ) -> Option<(usize, Self)> {
        let [first, second] = bodies.map(|body| Some(Self::new(hertz, body?)));
        let found = [first, second].into_iter().enumerate();
        let found = found.filter_map(|(index, yields)| Some((index, yields?)));
        let (index, earliest) = found.min_by(|(_, a), (_, b)| a.pressure.total_cmp(&b.pressure))?;
        let other = if index == 0 { second } else { first };
        // From like bodies to one that flows alone, linear in the ratio of the pressures.
        let ratio = other.map_or(f64::INFINITY, |other| other.pressure / earliest.pressure);
        let alone = ((ratio - 1.0) / (BOTH_FLOW - 1.0)).min(1.0);
        let radius = hertz.pair().effective_radius();
        let both = [first, second].into_iter().flatten();
        let of_both: f64 = both.map(|it| (radius / it.body.radius).powi(2)).sum();
        let between =
            |both: f64, own: f64| if alone < 1.0 { both + alone * (own - both) } else { own };
        let flattening_share = between(of_both, earliest.flattening_share);
        let elastic_share = between(0.0, earliest.elastic_share);
        Some((index, Self { flattening_share, elastic_share, ..earliest }))
    }

    /// Returns the body that yields.
    pub fn body(&self) -> YieldingBody {
        self.body
    }

    /// Returns its flow stress over plastic strain.
    pub fn flow_stress(&self) -> FlowStress {
        self.flow
    }

    /// Returns the first yield of a body with a flow stress over plastic strain, given in closed form by a strain and a rate (1/s) at
    /// which it has to hold, and the rate of the plastic strain.
    ///
    /// The strain is the representative one of the largest contact, and it is reached in half of the contact time.
    pub fn hardened(&self, flow: impl Fn(f64, f64) -> FlowStress) -> (Self, f64) {
        let (mut first, mut rate) = (*self, 0.0);
        for _ in 0..N_PASSES {
            let impact = first.impact();
            let size = impact.max_contact_radius / self.hertz.pair().effective_radius();
            let strain = REPRESENTATIVE_STRAIN * size;
            // On a plate the rebound may take far longer than the loading.
            let on_plate = (self.plate_mobility > 0.0).then(|| self.hertz.contact_time());
            rate = 2.0 * strain / on_plate.unwrap_or(impact.contact_time);
            let flow = flow(strain, RATE_BEFORE_THE_TURN * rate);
            first = self.of_flow(flow, self.body.poissons_ratio);
        }
        (first, rate)
    }

    /// Returns the impact of bodies that do not yield.
    pub fn elastic(&self) -> ImpactQuantities {
        self.elastic
    }

    /// Returns the peak pressure of the elastic impact over that of first yield.
    pub fn ratio(&self) -> f64 {
        self.elastic.peak_pressure / self.pressure
    }

    /// Returns the impact by the mean-pressure law; that of elastic bodies if the body does not yield.
    pub fn impact(&self) -> ImpactQuantities {
        self.impact_on_plate(self.plate_mobility).unwrap_or(self.elastic)
    }

    /// Returns the impact by the mean-pressure law on a plate of this mobility, m/(N s); `None` if the body does not yield.
    fn impact_on_plate(&self, mobility: f64) -> Option<ImpactQuantities> {
        if self.ratio() <= 1.0 {
            return None;
        }
        let (pair, speed) = (self.hertz.pair(), self.hertz.approach_speed());
        let shares = [self.flattening_share, self.elastic_share];
        let law = mean_pressure(pair, self.flow, self.body.poissons_ratio, shares).ok()?;
        let dent = law.elastic_plastic()?;
        let found = match mobility > 0.0 {
            true => on_plate(pair, law, mobility, speed).map(|impact| {
                impact.quantities(impact.peak_force / (PI * impact.max_contact_radius.powi(2)))
            }),
            false => dent_impact::quantities(pair, (&law, dent), speed),
        };
        let found = found.ok()?;
        Some(ImpactQuantities { peak_pressure: found.peak_pressure.max(self.pressure), ..found })
    }

    /// Returns the relative errors of the impact by the law beside finite elements, in the order of
    /// [`ImpactQuantities::in_order`]: those of a half-space, and the change by the thickness of a plate, which the law leaves out.
    pub fn errors(&self, impact: &ImpactQuantities) -> [f64; 6] {
        let over = self.hertz.approach_speed() / self.speed;
        let beyond = (over - 1.0).clamp(0.0, 1.0);
        let size = impact.max_contact_radius / self.hertz.pair().effective_radius();
        let beside = if self.elastic_share > 0.0 { ERROR_BESIDE_ELASTIC } else { 1.0 };
        let exponent = self.flow.exponent_at(REPRESENTATIVE_STRAIN * size);
        // That of hardening grows up to the fastest impacts of the map.
        let share = over.max(1.0).log10() / FASTEST_OF_MAP.log10();
        let hardening = (exponent / FULL_HARDENING).min(1.0) * share.min(1.0);
        let faster = (over / FASTEST_OF_MAP).log10().max(0.0);
        let thick = (self.plate_mobility > 0.0)
            .then(|| self.impact_on_plate(self.thick_plate_mobility))
            .flatten()
            .unwrap_or(*impact)
            .in_order();
        let thin = impact.in_order();
        std::array::from_fn(|k| {
            let small = ERRORS[k] + ERRORS_OF_HARDENING[k] * hardening;
            let wide = ERROR_OF_WIDE_CONTACTS * size.powi(3) + ERROR_PER_DECADE * faster;
            let by_thickness =
                if thick[k] == thin[k] { 0.0 } else { (thick[k] / thin[k] - 1.0).abs() };
            beside * beyond * (small + wide) + by_thickness
        })
    }

    /// Returns the first yield at another yield strength, Pa.
    pub fn of_strength(&self, yield_strength: f64) -> Self {
        self.of_flow(self.flow.with_yield_strength(yield_strength), self.body.poissons_ratio)
    }

    /// Returns the first yield at another flow stress and Poisson's ratio of the body.
    pub fn of_flow(&self, flow: FlowStress, poissons_ratio: f64) -> Self {
        let yield_strength = flow.yield_strength;
        let body = YieldingBody { yield_strength, poissons_ratio, ..self.body };
        let pressure = yield_strength / largest_von_mises(poissons_ratio);
        Self { pressure, body, flow, ..*self }.with_speed()
    }

    /// Returns this with the speed of first yield: p₀ grows as v^(2/5) without a plate, as v^(1/3) on one that takes all of the force.
    fn with_speed(self) -> Self {
        let over = |elastic: &ImpactQuantities| (self.pressure / elastic.peak_pressure).powf(2.5);
        let mut speed = self.hertz.approach_speed() * over(&self.elastic);
        let passes = if self.plate_mobility > 0.0 { N_PASSES } else { 0 };
        for _ in 0..passes {
            match elastic_on_plate(self.hertz.pair(), self.plate_mobility, speed) {
                Ok(elastic) => speed *= over(&elastic),
                Err(_) => break,
            }
        }
        Self { speed, ..self }
    }

    /// Returns the smallest and largest value of every quantity within its error, of a yield strength with an uncertainty, Pa.
    pub fn range(&self, uncertainty: f64) -> [ImpactQuantities; 2] {
        let strength = self.body.yield_strength;
        let uncertainty = uncertainty.min(0.9 * strength);
        let ends = [strength - uncertainty, strength + uncertainty].map(|strength| {
            let first = self.of_strength(strength);
            let impact = first.impact();
            (impact.in_order(), first.errors(&impact))
        });
        [-1.0, 1.0].map(|sign: f64| {
            let [restitution, contact_time, peak_force, max_approach, radius, peak_pressure] =
                std::array::from_fn(|k| {
                    let [one, other] =
                        ends.map(|(impact, errors)| impact[k] * (1.0 + sign * errors[k]));
                    if sign > 0.0 { one.max(other) } else { one.min(other) }
                });
            let restitution = restitution.clamp(0.0, 1.0);
            let max_contact_radius = radius;
            ImpactQuantities {
                restitution,
                contact_time,
                peak_force,
                max_approach,
                max_contact_radius,
                peak_pressure,
            }
        })
    }

    /// Returns the largest changes from the elastic impact within the error, in the order of [`ImpactQuantities::in_order`]: the
    /// absolute one of the restitution and the relative ones of the other quantities.
    pub fn change(&self) -> [f64; 6] {
        let [one, other] = self.range(0.0).map(|impact| impact.change_from(&self.elastic));
        std::array::from_fn(|k| if one[k].abs() > other[k].abs() { one[k] } else { other[k] })
    }
}

/// Returns the impact of elastic bodies on a plate of a mobility, m/(N s), at a speed, m/s.
fn elastic_on_plate(pair: &Pair, mobility: f64, speed: f64) -> Result<ImpactQuantities, LawError> {
    let impact = on_plate(pair, hertz(pair)?, mobility, speed)?;
    // Hertz' pressure under the largest force: p₀ = 2aE*/πR*.
    let elongation = impact.max_contact_radius / pair.effective_radius();
    Ok(impact.quantities(2.0 / PI * pair.contact_modulus() * elongation))
}

/// Returns the impact by a law on a plate of a mobility, m/(N s), at a speed, m/s.
fn on_plate(pair: &Pair, law: ContactLaw, mobility: f64, speed: f64) -> Result<Impact, LawError> {
    let model = LawImpact::new(pair, law).with_tolerance(TOLERANCE_ON_PLATE)?;
    model.with_plate(mobility)?.impact(speed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::Partner;

    /// Davies (1949), Johnson, section 4.2: 0.31 p₀ of shear at ν = 0.3, so yield at 1.60 Y by von
    /// Mises; Green (2005) fits Y C(ν) with C = 1.295 exp(0.736 ν) within 1 %.
    #[test]
    fn first_yield_by_von_mises() {
        assert!((largest_von_mises(0.3) / 2.0 - 0.310).abs() < 5e-4);
        assert!((1.0 / largest_von_mises(0.3) - 1.61).abs() < 0.01);
        for nu in [0.0, 0.1, 0.2, 0.3, 0.4, 0.5] {
            let fit = 1.295 * f64::exp(0.736 * nu);
            assert!((1.0 / largest_von_mises(nu) / fit - 1.0).abs() < 0.01, "{nu}");
        }
        // It has a maximum for every material that there is.
        for nu in [-0.999, -0.5] {
            let found = largest_von_mises(nu);
            assert!(found > 0.5 && found < 1.6, "{nu}: {found}");
        }
    }

    /// Like steel spheres with a modulus of 210 GPa, of a diameter (m), at a speed (m/s), with a yield strength, Pa.
    fn steel(diameter: f64, speed: f64, yield_strength: f64) -> FirstYield {
        let radius = 0.5 * diameter;
        let mass = crate::pair::sphere_mass(diameter, 7850.0);
        let sphere = || Partner::Sphere { radius, mass, plane_strain_modulus: 210e9 / 0.91 };
        let pair = Pair::new(sphere(), sphere()).unwrap();
        let body = YieldingBody {
            yield_strength,
            poissons_ratio: 0.3,
            plane_strain_modulus: 210e9 / 0.91,
            radius,
        };
        FirstYield::new(&HertzImpact::new(&pair, speed).unwrap(), body)
    }

    /// At first yield the impact is Hertz', from either side, and it departs from it the more the faster the impact; the
    /// contact time is shorter at first and longer later.
    #[test]
    fn impacts_depart_from_first_yield_on() {
        let speed_of_yield = steel(10e-3, 1.0, 235e6).speed;
        let change = |times: f64| steel(10e-3, times * speed_of_yield, 235e6).change();
        assert_eq!(change(0.999), [0.0; 6]);
        assert!(change(1.0001).iter().all(|change| change.abs() < 1e-3), "{:?}", change(1.0001));
        let mut last = [0.0; 6];
        for times in [1.5, 3.0, 10.0, 30.0, 100.0, 1000.0] {
            let now = change(times);
            for k in [0, 2, 3, 4, 5] {
                assert!(now[k].abs() > last[k], "{times}: {now:?} {last:?}");
            }
            last = now.map(f64::abs);
        }
    }

    fn energy_at(speed: f64, pair: &Pair) -> f64 {
        0.5 * pair.effective_mass() * speed * speed
    }

    /// Two steel spheres of 5 mm at 5 m/s, as in Johnson, section 11.5: yield at some cm/s.
    #[test]
    fn steel_spheres_yield_at_the_published_speed() {
        let first = steel(5e-3, 5.0, 1e9);
        let pair = *first.hertz.pair();
        // p₀ at first yield, in both of two ways.
        let at_yield = HertzImpact::new(&pair, first.speed).unwrap();
        assert!((at_yield.peak_pressure() / first.pressure - 1.0).abs() < 1e-12);
        // Johnson, eq. 11.36: ½mv² = 53 R³Y⁵/E*⁴, with p₀ = 1.60 Y for 1.61 Y, a ratio of 1.04 to the
        // fifth power, and a rounded 53.
        let energy = energy_at(first.speed, &pair);
        let johnson = 53.0 * pair.effective_radius().powi(3) * 1e9f64.powi(5)
            / pair.contact_modulus().powi(4);
        assert!((energy / johnson - 1.0).abs() < 0.06, "{}", energy / johnson);
        // Slower than first yield nothing is lost.
        let slow = steel(5e-3, 0.5 * first.speed, 1e9);
        let found = slow.impact();
        assert_eq!((found.restitution, slow.errors(&found)), (1.0, [0.0; 6]));
    }
}
