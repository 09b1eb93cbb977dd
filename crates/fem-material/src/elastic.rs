//! Elastic moduli of an isotropic solid, from any two of its constants.
//!
//! The bulk modulus K and the shear modulus G are stored. Both are positive for every stable solid, and all others
//! follow from them without cancellation, also if Poisson's ratio ν is near 1/2 or −1.
//!
//! ```math
//! E = \frac{9KG}{3K+G}, \quad \nu = \frac{3K-2G}{2(3K+G)}, \quad \lambda = K - \tfrac23 G,
//! \quad M = K + \tfrac43 G, \quad \frac{E}{1-\nu^2} = \frac{4G(3K+G)}{3K+4G}
//! ```
//!
//! Stability (a positive energy for every strain) is K > 0 and G > 0, that is −1 < ν < 1/2.

use crate::error::{MaterialError, positive};

/// Any two of the four elastic constants; Pa, Poisson's ratio without unit.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ModuliInput {
    /// Young's modulus E.
    pub youngs_modulus: Option<f64>,
    /// Shear modulus G.
    pub shear_modulus: Option<f64>,
    /// Bulk modulus K.
    pub bulk_modulus: Option<f64>,
    /// Poisson's ratio ν.
    pub poissons_ratio: Option<f64>,
}

impl ModuliInput {
    fn given(&self) -> Vec<&'static str> {
        [
            ("youngs_modulus", self.youngs_modulus),
            ("shear_modulus", self.shear_modulus),
            ("bulk_modulus", self.bulk_modulus),
            ("poissons_ratio", self.poissons_ratio),
        ]
        .into_iter()
        .filter_map(|(name, value)| value.map(|_| name))
        .collect()
    }
}

/// Moduli of a stable isotropic elastic solid, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticModuli {
    bulk_modulus: f64,
    shear_modulus: f64,
}

impl ElasticModuli {
    /// Creates the moduli from exactly two constants.
    ///
    /// # Errors
    /// Fewer or more than two, a modulus that is not positive and finite, ν outside (−1, 1/2)
    /// or moduli that imply such a ν.
    pub fn from_two(input: ModuliInput) -> Result<Self, MaterialError> {
        let ModuliInput { youngs_modulus, shear_modulus, bulk_modulus, poissons_ratio } = input;
        match (youngs_modulus, shear_modulus, bulk_modulus, poissons_ratio) {
            (Some(e), None, None, Some(nu)) => Self::from_youngs_modulus_poissons_ratio(e, nu),
            (None, Some(g), None, Some(nu)) => Self::from_shear_modulus_poissons_ratio(g, nu),
            (None, None, Some(k), Some(nu)) => Self::from_bulk_modulus_poissons_ratio(k, nu),
            (Some(e), Some(g), None, None) => Self::from_youngs_shear(e, g),
            (Some(e), None, Some(k), None) => Self::from_youngs_bulk(e, k),
            (None, Some(g), Some(k), None) => Self::from_bulk_shear(k, g),
            _ => Err(MaterialError::ModuliCount { given: input.given() }),
        }
    }

    /// Creates the moduli from K and G; every positive pair is a stable solid.
    ///
    /// # Errors
    /// A modulus that is not positive and finite.
    pub fn from_bulk_shear(bulk_modulus: f64, shear_modulus: f64) -> Result<Self, MaterialError> {
        Ok(Self {
            bulk_modulus: positive("bulk_modulus", bulk_modulus)?,
            shear_modulus: positive("shear_modulus", shear_modulus)?,
        })
    }

    /// Creates the moduli from E and ν: G = E/2(1+ν), K = E/3(1−2ν).
    ///
    /// # Errors
    /// E that is not positive and finite, ν outside (−1, 1/2).
    pub fn from_youngs_modulus_poissons_ratio(
        youngs_modulus: f64,
        poissons_ratio: f64,
    ) -> Result<Self, MaterialError> {
        let e = positive("youngs_modulus", youngs_modulus)?;
        let nu = stable_poissons_ratio(poissons_ratio)?;
        Self::from_bulk_shear(e / (3.0 * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
    }

    fn from_shear_modulus_poissons_ratio(g: f64, nu: f64) -> Result<Self, MaterialError> {
        let g = positive("shear_modulus", g)?;
        let nu = stable_poissons_ratio(nu)?;
        Self::from_bulk_shear(g * (2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu))), g)
    }

    fn from_bulk_modulus_poissons_ratio(k: f64, nu: f64) -> Result<Self, MaterialError> {
        let k = positive("bulk_modulus", k)?;
        let nu = stable_poissons_ratio(nu)?;
        Self::from_bulk_shear(k, k * (3.0 * (1.0 - 2.0 * nu) / (2.0 * (1.0 + nu))))
    }

    /// Creates the moduli with K = EG/3(3G−E); ν < 1/2 is E < 3G.
    fn from_youngs_shear(e: f64, g: f64) -> Result<Self, MaterialError> {
        let e = positive("youngs_modulus", e)?;
        let g = positive("shear_modulus", g)?;
        if e >= 3.0 * g {
            return Err(MaterialError::ImpliedPoissonsRatio {
                youngs_modulus: e,
                other: "shear_modulus",
                other_value: g,
                implied: e / (2.0 * g) - 1.0,
                limit: 3.0 * g,
            });
        }
        Self::from_bulk_shear(e / 3.0 * (g / (3.0 * g - e)), g)
    }

    /// Creates the moduli with G = 3KE/(9K−E); ν > −1 is E < 9K.
    fn from_youngs_bulk(e: f64, k: f64) -> Result<Self, MaterialError> {
        let e = positive("youngs_modulus", e)?;
        let k = positive("bulk_modulus", k)?;
        if e >= 9.0 * k {
            return Err(MaterialError::ImpliedPoissonsRatio {
                youngs_modulus: e,
                other: "bulk_modulus",
                other_value: k,
                implied: 0.5 - e / (6.0 * k),
                limit: 9.0 * k,
            });
        }
        Self::from_bulk_shear(k, 3.0 * e * (k / (9.0 * k - e)))
    }

    /// Returns the bulk modulus K: pressure per relative loss of volume.
    pub fn bulk_modulus(&self) -> f64 {
        self.bulk_modulus
    }

    /// Returns the shear modulus G.
    pub fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }

    /// Returns Young's modulus E.
    pub fn youngs_modulus(&self) -> f64 {
        youngs_modulus(self.bulk_modulus, self.shear_modulus)
    }

    /// Returns Poisson's ratio ν.
    pub fn poissons_ratio(&self) -> f64 {
        poissons_ratio(self.bulk_modulus, self.shear_modulus)
    }

    /// Returns Lamé's first parameter λ; negative for ν < 0.
    pub fn lame_lambda(&self) -> f64 {
        self.bulk_modulus - 2.0 / 3.0 * self.shear_modulus
    }

    /// Returns the P-wave modulus M = λ + 2G: stress per strain with fixed sides.
    pub fn p_wave_modulus(&self) -> f64 {
        self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus
    }

    /// Returns E/(1−ν²), the modulus with which a body enters Hertz' contact.
    pub fn plane_strain_modulus(&self) -> f64 {
        let (k, g) = (self.bulk_modulus, self.shear_modulus);
        4.0 * g * ((3.0 * k + g) / (3.0 * k + 4.0 * g))
    }

    /// Returns (1−2ν)/G, the tangential compliance of a surface under a pressure; 0 for an incompressible solid.
    pub fn tangential_compliance(&self) -> f64 {
        (self.bulk_modulus + self.shear_modulus / 3.0).recip()
    }
}

/// Returns E for K > 0 and G ≥ 0.
pub(crate) fn youngs_modulus(k: f64, g: f64) -> f64 {
    9.0 * g * (k / (3.0 * k + g))
}

/// Returns ν for K > 0 and G ≥ 0.
pub(crate) fn poissons_ratio(k: f64, g: f64) -> f64 {
    (3.0 * k - 2.0 * g) / (2.0 * (3.0 * k + g))
}

fn stable_poissons_ratio(value: f64) -> Result<f64, MaterialError> {
    if value > -1.0 && value < 0.5 {
        Ok(value)
    } else {
        Err(MaterialError::PoissonsRatio { value })
    }
}
