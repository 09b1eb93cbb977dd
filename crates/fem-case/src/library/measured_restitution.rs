//! Measured restitutions of a material of the library: a power law over the approach speed,
//!
//! ```math
//! e(v) = \min\left(1,\; e_1 \left(\frac{v}{v_1}\right)^{p}\right),
//! ```
//!
//! within the speeds of the measurement. The exponent p is 0 for a restitution that does not depend on the speed.

use serde::Deserialize;

use crate::engineering::show;
use crate::quantity::{Number, Quantity, Speed};

/// Number of points that stand for a law.
const N_POINTS: usize = 12;

/// A measured restitution with its source and its conditions.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredRestitution {
    /// Name among those of the material: `bridges-1984`.
    pub name: String,
    /// Source of the numbers.
    pub source: String,
    /// The bodies and their surfaces.
    pub bodies: String,
    /// Size of the bodies, if the source gives it.
    pub size: Option<String>,
    /// Temperature, if the source gives it.
    pub temperature: Option<String>,
    /// Slowest and fastest approach speed.
    speeds: [Quantity<Speed>; 2],
    /// Restitution at the reference speed, with its standard deviation if the source gives one.
    restitution: Quantity<Number>,
    /// Speed v₁ of that restitution.
    reference_speed: Option<Quantity<Speed>>,
    /// Exponent p of the speed.
    #[serde(default)]
    exponent: f64,
}

impl MeasuredRestitution {
    /// Returns the slowest and the fastest measured approach speed, m/s.
    pub fn speeds(&self) -> (f64, f64) {
        let [slowest, fastest] = self.speeds.each_ref().map(si);
        (slowest, fastest)
    }

    /// Returns the restitution at an approach speed (m/s), at most 1; `None` outside the measured speeds.
    ///
    /// ```
    /// let ice = &fem_case::library::materials()["ice"].measured[0];
    /// assert_eq!(ice.at(0.01), Some(0.32));
    /// assert_eq!(ice.at(1.0), None);
    /// ```
    pub fn at(&self, speed: f64) -> Option<f64> {
        let (slowest, fastest) = self.speeds();
        // Speeds of a table are rounded.
        let is_measured = speed >= slowest * (1.0 - 1e-9) && speed <= fastest * (1.0 + 1e-9);
        is_measured.then(|| self.law(speed).min(1.0))
    }

    fn law(&self, speed: f64) -> f64 {
        let reference = self.reference_speed.as_ref().map_or(speed, si);
        si(&self.restitution) * (speed / reference).powf(self.exponent)
    }

    /// Returns the standard deviation of the restitutions, if the source gives one.
    pub fn scatter(&self) -> Option<f64> {
        self.restitution.measured().ok()?.1
    }

    /// Returns speeds in equal ratios over the measured range, m/s, and their restitutions: twelve points, or one for a
    /// single speed. Speeds at which the law exceeds 1 are left out.
    pub fn points(&self) -> Vec<(f64, f64)> {
        let (slowest, fastest) = self.speeds();
        let n = if slowest == fastest { 1 } else { N_POINTS };
        let step = (fastest / slowest).ln() / (n.max(2) - 1) as f64;
        let speeds = (0..n).map(|k| slowest * (step * k as f64).exp());
        let points = speeds.map(|speed| (speed, self.law(speed)));
        points.filter(|(_, restitution)| *restitution <= 1.0).collect()
    }

    /// Returns the law as text: `e = 0.32 (v / 1 cm/s)^-0.234, 0.2 mm/s to 50 mm/s`.
    pub fn law_text(&self) -> String {
        let plain = |text: String| text.replace('"', "");
        let restitution = plain(self.restitution.to_string());
        let law = match &self.reference_speed {
            Some(reference) => plain(format!("{restitution} (v / {reference})^{}", self.exponent)),
            None => restitution,
        };
        let (slowest, fastest) = self.speeds();
        let [from, to] = [slowest, fastest].map(|speed| show(speed, "m/s"));
        let range =
            if slowest == fastest { format!("at {from}") } else { format!("{from} to {to}") };
        format!("e = {law}, {range}")
    }
}

/// Returns the number of a quantity of the library, whose tests read all of them.
fn si<K: crate::QuantityKind>(quantity: &Quantity<K>) -> f64 {
    quantity.si().unwrap_or(f64::NAN)
}
