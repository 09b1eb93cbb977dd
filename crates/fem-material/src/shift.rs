//! Shift of relaxation times with temperature: time–temperature superposition.
//!
//! All relaxation times of a thermorheologically simple material have the same factor a_T,
//!
//! ```math
//! \tau_k(T) = a_T\,\tau_k(T_r), \qquad
//! \log_{10} a_T = -\frac{C_1\,(T-T_r)}{C_2+T-T_r} \quad\text{or}\quad
//! \ln a_T = \Theta\left(\frac1T-\frac1{T_r}\right)
//! ```
//!
//! by Williams, Landel & Ferry, *J. Am. Chem. Soc.* 77 (1955) 3701, or by Arrhenius with the activation energy R Θ.
//!
//! Limits: the first law has a pole at T_r − C_2, below which it has no value. A table is interpolated linearly and has no value
//! outside.

/// The temperature of 0 °C, K.
pub const ZERO_CELSIUS: f64 = 273.15;
/// The gas constant, J/(mol K), exact by the SI of 2019.
pub const GAS_CONSTANT: f64 = 8.314_462_618_153_24;

/// How relaxation times depend on temperature.
#[derive(Debug, Clone, PartialEq)]
pub enum ShiftLaw {
    /// The law of Williams, Landel and Ferry.
    Wlf {
        /// The first constant, C₁.
        c1: f64,
        /// The second constant, C₂, K.
        c2: f64,
    },
    /// The law of Arrhenius.
    Arrhenius {
        /// Activation energy over the gas constant, Θ, K.
        activation_temperature: f64,
    },
    /// Temperatures (K), rising, with log₁₀ a_T.
    Table(Vec<(f64, f64)>),
}

impl ShiftLaw {
    /// Returns log₁₀ a_T at a temperature for a reference temperature (K); `None` where the law has no value.
    pub fn log10_shift(&self, temperature: f64, reference: f64) -> Option<f64> {
        let value = match self {
            Self::Wlf { c1, c2 } => {
                let rise = temperature - reference;
                // Both sides of the pole have the sign of C₂.
                let is_valid = (c2 + rise) * c2 > 0.0;
                is_valid.then(|| -c1 * rise / (c2 + rise))?
            }
            Self::Arrhenius { activation_temperature } => {
                activation_temperature * (temperature.recip() - reference.recip())
                    / std::f64::consts::LN_10
            }
            Self::Table(rows) => {
                let k = rows.partition_point(|row| row.0 < temperature);
                match (k.checked_sub(1).and_then(|k| rows.get(k)), rows.get(k)) {
                    (_, Some(row)) if row.0 == temperature => row.1,
                    (Some(below), Some(above)) => {
                        let share = (temperature - below.0) / (above.0 - below.0);
                        below.1 + share * (above.1 - below.1)
                    }
                    _ => return None,
                }
            }
        };
        value.is_finite().then_some(value)
    }

    /// Returns the temperature (K) at which log₁₀ a_T has a value; `None` if there is no such temperature above 0 K.
    pub fn temperature(&self, log10_shift: f64, reference: f64) -> Option<f64> {
        let temperature = match self {
            Self::Wlf { c1, c2 } => reference - c2 * log10_shift / (c1 + log10_shift),
            Self::Arrhenius { activation_temperature } => {
                let inverse = log10_shift * std::f64::consts::LN_10 / activation_temperature;
                (reference.recip() + inverse).recip()
            }
            Self::Table(rows) => rows.windows(2).find_map(|pair| {
                let share = (log10_shift - pair[0].1) / (pair[1].1 - pair[0].1);
                let is_inside = (0.0..=1.0).contains(&share);
                is_inside.then(|| pair[0].0 + share * (pair[1].0 - pair[0].0))
            })?,
        };
        // Beyond the pole, or the plateau far above it, the law takes no such value.
        let again = self.log10_shift(temperature, reference)?;
        let is_sound =
            temperature > 0.0 && (again - log10_shift).abs() < 1e-6 * (1.0 + again.abs());
        is_sound.then_some(temperature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_temperature_of_a_shift_is_its_inverse() {
        let table = ShiftLaw::Table(vec![(260.0, 3.0), (280.0, 1.0), (300.0, -1.0)]);
        for law in [
            ShiftLaw::Wlf { c1: 17.44, c2: 51.6 },
            ShiftLaw::Arrhenius { activation_temperature: 2e4 },
            table,
        ] {
            for temperature in [265.0, 280.0, 299.0] {
                let log10 = law.log10_shift(temperature, 290.0).unwrap();
                let again = law.temperature(log10, 290.0).unwrap();
                assert!((again - temperature).abs() < 1e-9, "{law:?}: {again}");
            }
        }
        // Far above the reference the law of Williams, Landel and Ferry tends to −C1.
        assert_eq!(ShiftLaw::Wlf { c1: 10.0, c2: 50.0 }.temperature(-11.0, 290.0), None);
        assert_eq!(ShiftLaw::Table(vec![(260.0, 3.0), (280.0, 1.0)]).temperature(5.0, 270.0), None);
    }
}
