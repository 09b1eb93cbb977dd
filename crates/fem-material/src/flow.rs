//! Plastic flow: the flow stress of a metal over its equivalent plastic strain and the rate of that strain.
//!
//! ```math
//! \sigma_Y(\varepsilon, \dot\varepsilon) = Y(\varepsilon)\, \left[1 + C \ln\max(\dot\varepsilon/\dot\varepsilon_0, 1)\right],
//! \qquad Y(\varepsilon) = Y_0 + H\varepsilon, \quad Y_0 (1 + \varepsilon/\varepsilon_s)^n, \quad \text{or a table}
//! ```
//!
//! with von Mises' equivalent plastic strain ε, which is the axial one of a tensile test, and true (Cauchy's) stress. The
//! power law is Swift's (1952, Journal of the Mechanics and Physics of Solids 1:1); the factor of the rate is that of
//! Johnson & Cook (1983, Proceedings of the 7th International Symposium on Ballistics, 541), which is left at 1 below the
//! reference rate. [`ElasticPlastic`](crate::finite::ElasticPlastic) uses the rule at finite strain.

use crate::error::{MaterialError, not_negative, positive};

/// Largest number of rows of a table of flow stress.
pub const MAX_FLOW_ROWS: usize = 64;

/// Part of a plastic strain at which Swift's law has the value of a table, besides that strain itself.
const INNER: f64 = 0.125;
/// Logarithms of ε/ε_s between which that law is sought: from a straight line to a plateau.
const LOGS_OF_STRAIN_OVER_REFERENCE: (f64, f64) = (-7.0, 60.0);

/// A point of a table: the flow stress at an equivalent plastic strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlowPoint {
    /// Equivalent plastic strain.
    pub plastic_strain: f64,
    /// Flow stress, true stress at the reference rate, Pa.
    pub flow_stress: f64,
}

/// How the flow stress depends on the equivalent plastic strain.
#[derive(Debug, Clone, PartialEq)]
pub enum Hardening {
    /// Y₀ + H ε; H = 0 is perfect plasticity.
    Linear {
        /// Flow stress at first yield Y₀, Pa.
        yield_strength: f64,
        /// Slope H, at least 0, Pa.
        modulus: f64,
    },
    /// Y₀ (1 + ε/ε_s)ⁿ.
    Swift {
        /// Flow stress at first yield Y₀, Pa.
        yield_strength: f64,
        /// Reference strain ε_s.
        strain: f64,
        /// Exponent n, above 0 and at most 1.
        exponent: f64,
    },
    /// Straight lines between points, the first at strain 0; beyond the last the flow stress is constant.
    Table(Vec<FlowPoint>),
}

/// The factor 1 + C ln(ε̇/ε̇₀) of the flow stress at plastic strain rates above ε̇₀.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateFactor {
    /// Coefficient C, at least 0.
    pub coefficient: f64,
    /// Reference rate ε̇₀, 1/s.
    pub reference_rate: f64,
}

impl RateFactor {
    /// Returns the factor of the flow stress at a plastic strain rate, 1/s.
    pub fn at(&self, rate: f64) -> f64 {
        1.0 + self.coefficient * (rate / self.reference_rate).max(1.0).ln()
    }
}

/// A checked flow rule: isotropic hardening and, for a rate-dependent material, the factor of the rate.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowRule {
    curve: FlowCurve,
    rate: Option<RateFactor>,
}

/// The flow stress over plastic strain, as the return map reads it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FlowCurve {
    /// Straight lines: each starts at a strain, the first at 0, and the last has no end.
    Lines(Vec<FlowLine>),
    /// Swift's power law.
    Swift { yield_strength: f64, strain: f64, exponent: f64 },
}

/// A straight part of the flow stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FlowLine {
    /// Plastic strain at its start.
    pub start: f64,
    /// Flow stress of the line at plastic strain 0, Pa.
    pub at_zero: f64,
    /// Slope of the flow stress over plastic strain, Pa.
    pub slope: f64,
}

/// A flow stress in closed form, Y (1 + ε/ε_s)ⁿ + H ε: Swift's law and a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlowStress {
    /// Flow stress at first yield Y, Pa.
    pub yield_strength: f64,
    /// Slope H of the line, Pa.
    pub modulus: f64,
    /// Reference strain ε_s, above 0.
    pub strain: f64,
    /// Exponent n, at least 0; 0 without Swift's law.
    pub exponent: f64,
}

impl FlowStress {
    /// Returns the flow stress of a perfectly plastic material with a yield strength, Pa.
    pub fn perfect(yield_strength: f64) -> Self {
        Self { yield_strength, modulus: 0.0, strain: 1.0, exponent: 0.0 }
    }

    /// Returns the flow stress (Pa) at an equivalent plastic strain.
    pub fn at(&self, plastic_strain: f64) -> f64 {
        self.power_law(plastic_strain) + self.modulus * plastic_strain
    }

    /// Returns d ln σ/d ln ε at an equivalent plastic strain: the exponent of the power law that has the same value and slope.
    pub fn exponent_at(&self, plastic_strain: f64) -> f64 {
        let swift = self.exponent * plastic_strain / (self.strain + plastic_strain);
        let slope = swift * self.power_law(plastic_strain) + self.modulus * plastic_strain;
        slope / self.at(plastic_strain)
    }

    /// Returns a multiple of the flow stress.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        let Self { yield_strength, modulus, .. } = self;
        Self { yield_strength: factor * yield_strength, modulus: factor * modulus, ..self }
    }

    /// Returns the flow stress with another yield strength (Pa), the same line, and Swift's law in proportion.
    #[must_use]
    pub fn with_yield_strength(self, yield_strength: f64) -> Self {
        Self { yield_strength, ..self }
    }

    fn power_law(&self, plastic_strain: f64) -> f64 {
        self.yield_strength * (self.exponent * (plastic_strain / self.strain).ln_1p()).exp()
    }
}

impl FlowRule {
    /// Creates a flow rule; without a rate factor the flow stress does not depend on the rate.
    ///
    /// # Errors
    /// A strength or a strain that is not positive and finite, a slope or a coefficient below 0, an exponent outside
    /// 0 < n ≤ 1; a table that is empty, longer than [`MAX_FLOW_ROWS`], does not start at strain 0, whose strains do not
    /// increase, or whose stresses decrease (softening localises in a band that depends on the mesh).
    pub fn new(hardening: Hardening, rate: Option<RateFactor>) -> Result<Self, MaterialError> {
        if let Some(RateFactor { coefficient, reference_rate }) = rate {
            not_negative("flow.rate.johnson_cook.c", coefficient)?;
            positive("flow.rate.johnson_cook.reference_rate", reference_rate)?;
        }
        Ok(Self { curve: FlowCurve::new(hardening)?, rate })
    }

    /// Creates the rule of a perfectly plastic material with a yield strength, Pa.
    ///
    /// # Errors
    /// A strength that is not positive and finite.
    pub fn perfect(yield_strength: f64) -> Result<Self, MaterialError> {
        Self::new(Hardening::Linear { yield_strength, modulus: 0.0 }, None)
    }

    /// Returns the flow stress (Pa) at an equivalent plastic strain and a rate of it, 1/s.
    pub fn flow_stress(&self, plastic_strain: f64, rate: f64) -> f64 {
        self.curve.flow_stress(plastic_strain) * self.rate.map_or(1.0, |factor| factor.at(rate))
    }

    /// Returns the flow stress at a rate (1/s) in closed form: exactly if the rule is a line or Swift's law. A table becomes Swift's
    /// law with the table's values at 0, at a plastic strain and at a part of that; a chord, if its slope does not fall.
    pub fn closed_form(&self, plastic_strain: f64, rate: f64) -> FlowStress {
        let factor = self.rate.map_or(1.0, |own| own.at(rate));
        self.curve.closed_form(plastic_strain).times(factor)
    }

    /// Returns the flow stress at first yield and at most the reference rate, Pa.
    pub fn yield_strength(&self) -> f64 {
        self.curve.flow_stress(0.0)
    }

    /// Returns the factor of the rate; `None` for a material that does not depend on it.
    pub fn rate(&self) -> Option<RateFactor> {
        self.rate
    }

    pub(crate) fn curve(&self) -> &FlowCurve {
        &self.curve
    }
}

impl FlowCurve {
    fn new(hardening: Hardening) -> Result<Self, MaterialError> {
        Ok(match hardening {
            Hardening::Linear { yield_strength, modulus } => {
                let at_zero = positive("flow.yield_strength", yield_strength)?;
                let slope = not_negative("flow.hardening.modulus", modulus)?;
                Self::Lines(vec![FlowLine { start: 0.0, at_zero, slope }])
            }
            Hardening::Swift { yield_strength, strain, exponent } => {
                positive("flow.yield_strength", yield_strength)?;
                positive("flow.hardening.swift.strain", strain)?;
                if !(exponent > 0.0 && exponent <= 1.0) {
                    return Err(MaterialError::HardeningExponent { value: exponent });
                }
                Self::Swift { yield_strength, strain, exponent }
            }
            Hardening::Table(points) => Self::Lines(lines_of(&points)?),
        })
    }

    fn closed_form(&self, plastic_strain: f64) -> FlowStress {
        let perfect = FlowStress::perfect(self.flow_stress(0.0));
        match *self {
            Self::Swift { strain, exponent, .. } => FlowStress { strain, exponent, ..perfect },
            Self::Lines(ref lines) if lines.len() == 1 => {
                FlowStress { modulus: lines[0].slope, ..perfect }
            }
            Self::Lines(_) => self.swift_through(plastic_strain, perfect),
        }
    }

    /// Returns Swift's law through the flow stress at 0, at a plastic strain and at [`INNER`] of it: the ratio of both
    /// growths of ln σ, ln(1 + x INNER)/ln(1 + x) with x = ε/ε_s, falls from 1 to INNER as ε_s grows.
    fn swift_through(&self, plastic_strain: f64, perfect: FlowStress) -> FlowStress {
        let growth = |strain: f64| (self.flow_stress(strain) / perfect.yield_strength).ln();
        let [inner, outer] = [INNER * plastic_strain, plastic_strain].map(growth);
        if inner <= INNER * outer {
            let rise = self.flow_stress(plastic_strain) - perfect.yield_strength;
            return FlowStress { modulus: rise / plastic_strain, ..perfect };
        }
        let ratio = |log: f64| (INNER * log.exp()).ln_1p() / log.exp().ln_1p();
        let (mut low, mut high) = LOGS_OF_STRAIN_OVER_REFERENCE;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if ratio(middle) < inner / outer { low = middle } else { high = middle }
        }
        let over = low.exp();
        let (strain, exponent) = (plastic_strain / over, outer / over.ln_1p());
        FlowStress { strain, exponent, ..perfect }
    }

    fn flow_stress(&self, plastic_strain: f64) -> f64 {
        match self {
            Self::Lines(lines) => {
                let after = lines.partition_point(|line| line.start <= plastic_strain);
                let FlowLine { at_zero, slope, .. } = lines[after.max(1) - 1];
                at_zero + slope * plastic_strain
            }
            Self::Swift { yield_strength, strain, exponent } => {
                yield_strength * (exponent * (plastic_strain / strain).ln_1p()).exp()
            }
        }
    }
}

/// Returns the lines between the points of a table, and the level one beyond the last point.
fn lines_of(points: &[FlowPoint]) -> Result<Vec<FlowLine>, MaterialError> {
    if points.is_empty() || points.len() > MAX_FLOW_ROWS {
        return Err(MaterialError::FlowRows { found: points.len() });
    }
    let mut lines = Vec::with_capacity(points.len());
    for (row, point) in points.iter().enumerate() {
        let FlowPoint { plastic_strain, flow_stress } = *point;
        let before = row.checked_sub(1).map(|before| points[before]);
        let is_next = before.map_or(plastic_strain == 0.0, |p| plastic_strain > p.plastic_strain);
        if !(is_next && plastic_strain.is_finite()) {
            return Err(MaterialError::FlowStrain { row, value: plastic_strain });
        }
        let least = before.map_or(f64::MIN_POSITIVE, |p| p.flow_stress);
        if !(flow_stress >= least && flow_stress.is_finite()) {
            return Err(MaterialError::FlowStress { row, value: flow_stress });
        }
        let slope = points.get(row + 1).map_or(0.0, |next| {
            (next.flow_stress - flow_stress) / (next.plastic_strain - plastic_strain)
        });
        let at_zero = flow_stress - slope * plastic_strain;
        lines.push(FlowLine { start: plastic_strain, at_zero, slope });
    }
    Ok(lines)
}
