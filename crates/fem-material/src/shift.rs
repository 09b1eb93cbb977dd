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
}
