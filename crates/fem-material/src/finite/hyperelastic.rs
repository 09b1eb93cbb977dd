//! A law beyond Hooke by its name, and the stress of a point.

use super::neo_hooke::NeoHooke;
use super::tensor::AxisymmetricTensor;
use crate::elastic::ElasticModuli;

/// Which energy a solid stores at finite strain; all have the moduli K and G at small strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HyperelasticLaw {
    /// G/2 (J^(−2/3) tr b − 3) + K/2 (J − 1)².
    #[default]
    NeoHooke,
}

/// A point that is deformed inside out: J = det F is not positive.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the material is turned inside out: its volume is {jacobian:?} times the undeformed one")]
pub struct Inverted {
    /// J = det F, or no number where the displacement is none.
    pub jacobian: f64,
}

/// A hyperelastic solid: a law and its moduli.
///
/// Deformation is given as the displacement gradient H, F = 1 + H: at small strain F − 1 would
/// have lost digits. Stress is J/m³ of the undeformed body by displacement gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hyperelastic {
    law: HyperelasticLaw,
    bulk: f64,
    shear: f64,
}

impl Hyperelastic {
    /// Of a law that has these moduli at small strain.
    pub fn new(law: HyperelasticLaw, moduli: &ElasticModuli) -> Self {
        Self { law, bulk: moduli.bulk_modulus(), shear: moduli.shear_modulus() }
    }

    /// The law.
    pub fn law(&self) -> HyperelasticLaw {
        self.law
    }

    /// First Piola-Kirchhoff stress P = ∂W/∂F, Pa.
    ///
    /// # Errors
    /// det F is not positive.
    #[inline]
    pub fn first_piola(&self, h: &AxisymmetricTensor) -> Result<AxisymmetricTensor, Inverted> {
        let Self { law, bulk, shear } = *self;
        match law {
            HyperelasticLaw::NeoHooke => upright(NeoHooke { bulk, shear }.first_piola(h)),
        }
    }

    /// Energy per undeformed volume W, J/m³.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn energy(&self, h: &AxisymmetricTensor) -> Result<f64, Inverted> {
        let Self { law, bulk, shear } = *self;
        match law {
            HyperelasticLaw::NeoHooke => upright(NeoHooke { bulk, shear }.energy(h)),
        }
    }
}

/// What came with a J − 1, if J is positive; a J that is no number is not.
#[inline]
fn upright<T>((value, volume_change): (T, f64)) -> Result<T, Inverted> {
    if volume_change > -1.0 && volume_change.is_finite() {
        Ok(value)
    } else {
        Err(Inverted { jacobian: 1.0 + volume_change })
    }
}
