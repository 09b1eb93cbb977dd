//! The mean-pressure law of an elastic–plastic sphere: closed forms for explicit finite elements of this program.
//!
//! With the size s = (δ/R\*)^(1/2) of a contact, and s_y = πp_y/2E\* at first yield, the loading is Hertz' up to s_y and then
//! depends on L = ln(s/s_y) and, for contacts that are not small beside the sphere, on Δ = φ(s − s_y),
//!
//! ```math
//! F = \pi R^*\delta\,\sigma\,\frac{q_y + g(L;\,2.11, 0.89, q_y)}{1 + g(L;\,0.415, 2.32, 0)}\,A\,(1+0.85\Delta)\,
//!     e^{-0.444L\Delta-0.162L^2\Delta^2}\,\bigl[1 + 0.246\,\epsilon\,(1-e^{-0.634L})\bigr], \qquad q_y = \frac{2p_y}{3\sigma},
//! ```
//!
//! ```math
//! a^2 = R^*\delta\,A\,(1+0.425\Delta), \qquad A = 1 + \frac{g(L;\,0.415, 2.32, 0)}{1+n}, \qquad
//! g(L;\,B, m, g') = BL - (B - g')\frac{1 - e^{-mL}}m,
//! ```
//!
//! where g has the slope g′ at first yield, Hertz' one, and B far beyond. The mean pressure p_m = F/πa² rises from 1.07 σ at
//! first yield to 3.1 σ at L = 3.15, where F keeps it, and falls as the sphere flattens; the area grows to L = 4.5. φ is the share of
//! the bodies that flow in the flattening, and ε that of an elastic partner in the compliance 1/E\* ([`crate::FirstYield`] has both).
//!
//! σ is the flow stress, and n its exponent d ln σ/d ln ε, at the plastic strain 0.18 a/R\* of a contact whose material does not
//! harden. Tabor's representative strain of an indentation is 0.2 a/R (*The Hardness of Metals*, 1951). A material that hardens piles
//! up less around the contact, and is pressed over a smaller area.
//!
//! From the largest force the contact returns the energy W′ over the length ℓ of the approach, as a power of the rest of it,
//!
//! ```math
//! W' = \bigl[0.251 + 0.049\,e^{-0.571L}\bigr]e^{-0.918\Delta-3.18\Delta^2}\frac{F^2}{E^*a}, \qquad
//! \ell = \bigl[0.614 + 0.136\,e^{-1.10L}\bigr]e^{-1.16\Delta}\frac F{E^*a} .
//! ```
//!
//! The factor of W′ is 0.3 in a Hertz contact, 8/3π² = 0.27 under a uniform pressure and 1/4 under a flat punch. All numbers are a
//! least-squares fit to the impacts of `validation/data/flow_map.csv`, beside which `tests/it/flow_map.rs` states the errors.
//!
//! Limits: quasi-static; a/R\* below 0.6.

use std::f64::consts::PI;

use fem_material::FlowStress;

/// Representative plastic strain of a contact over a/R\*.
pub(crate) const REPRESENTATIVE_STRAIN: f64 = 0.18;

/// L from which the mean pressure of a small contact is constant, and from which its area no longer grows.
const FULLY_PLASTIC: f64 = 3.15;
const FULLY_PILED_UP: f64 = 4.5;

/// Largest exponents of the fits for wide contacts, which hold to about a half of them: beyond, the force still grows and
/// some energy returns.
const MAX_SOFTENING: f64 = 2.0;
const MAX_FADING: f64 = 4.0;

/// The law of a pair, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeanPressure {
    /// Effective radius R\*, m.
    pub radius: f64,
    /// Contact modulus E\*, Pa.
    pub modulus: f64,
    /// Flow stress over plastic strain, Pa; at strain 0 the yield strength Y.
    pub flow: FlowStress,
    /// Pressure of first yield over the yield strength.
    pub constraint: f64,
    /// Share of the bodies that flow in the flattening of a wide contact.
    pub flattening_share: f64,
    /// Share of the body that stays elastic in the compliance 1/E\*.
    pub elastic_share: f64,
}

/// A contact of a first loading.
struct Contact {
    /// Contact force, N.
    force: f64,
    /// Contact radius, m.
    radius: f64,
    /// Logarithm L of the size over that at first yield.
    log: f64,
    /// Size Δ beyond first yield, of the bodies that flow.
    width: f64,
}

impl MeanPressure {
    /// Returns the approach at first yield, m.
    pub fn yield_approach(&self) -> f64 {
        self.radius * self.yield_size(self.flow.yield_strength).powi(2)
    }

    /// Returns the contact radius, m, at an approach, m.
    pub fn contact_radius(&self, approach: f64) -> f64 {
        self.contact(approach).radius
    }

    /// Returns the force, N, at an approach, m.
    pub fn force(&self, approach: f64) -> f64 {
        self.contact(approach).force
    }

    /// Returns the length, m, and the energy, J, of the rebound from an approach, m.
    pub fn rebound(&self, approach: f64) -> (f64, f64) {
        let Contact { force, radius, log, width } = self.contact(approach);
        let fading = |limit: f64, hertz: f64, rate: f64, [first, second]: [f64; 2]| {
            let small = limit + (hertz - limit) * (-rate * log).exp();
            small * (-(width * (first + second * width)).min(MAX_FADING)).exp()
        };
        let unit = force / (self.modulus * radius);
        let length = unit * fading(0.6136, 0.75, 1.099, [1.1553, 0.0]);
        (length, unit * force * fading(0.2514, 0.3, 0.5714, [0.9181, 3.1796]))
    }

    /// s_y at a flow stress, Pa.
    fn yield_size(&self, strength: f64) -> f64 {
        0.5 * PI * self.constraint * strength / self.modulus
    }

    fn contact(&self, approach: f64) -> Contact {
        let size = (approach / self.radius).sqrt();
        let of_strength = |strength: f64, exponent: f64| {
            let yields = self.yield_size(strength);
            let log = (size / yields).max(1.0).ln();
            let width = self.flattening_share * (size - yields).max(0.0);
            let area = 1.0 + area_growth(log.min(FULLY_PILED_UP)) / (1.0 + exponent);
            (log, width, area, size * (area * (1.0 + 0.4253 * width)).sqrt())
        };
        // The contact radius depends little on the flow stress.
        let (.., perfect) = of_strength(self.flow.yield_strength, 0.0);
        let strain = REPRESENTATIVE_STRAIN * perfect;
        let strength = self.flow.at(strain);
        let (log, width, area, radius) = of_strength(strength, self.flow.exponent_at(strain));
        // Hertz' F/πR*δY at an approach that does not yield, and at first yield.
        let hertz = 4.0 / (3.0 * PI) * self.modulus * size / strength;
        let first = hertz.min(2.0 / 3.0 * self.constraint);
        let plastic = log.min(FULLY_PLASTIC);
        let pressure =
            (first + growth(plastic, 2.1094, 0.89, first)) / (1.0 + area_growth(plastic));
        let small = pressure * area;
        let softening = plastic * width * (0.4436 + 0.1616 * plastic * width);
        let wide = (1.0 + 0.8502 * width) * (-softening.min(MAX_SOFTENING)).exp();
        let beside_elastic = 1.0 - 0.246 * self.elastic_share * (-0.634 * log).exp_m1();
        Contact {
            force: PI * self.radius * approach * strength * small * wide * beside_elastic,
            radius: radius * self.radius,
            log,
            width,
        }
    }
}

/// Returns the growth of the area beyond Hertz' at L, without hardening.
fn area_growth(log: f64) -> f64 {
    growth(log, 0.4152, 2.3193, 0.0)
}

/// Returns BL − (B − g′)(1 − e^(−mL))/m at L.
fn growth(log: f64, slope: f64, rate: f64, first: f64) -> f64 {
    slope * log + (slope - first) * (-rate * log).exp_m1() / rate
}
