//! Hyperelastic laws by name, and the stress at a point.

use super::ellipticity::least_acoustic_stiffness;
use super::hencky::Hencky;
use super::kinematics::{Strain, first_piola};
use super::neo_hooke::NeoHooke;
use super::neo_hooke_ln::NeoHookeLn;
use super::number::{Number, inverse_cube_root};
use super::principal::{PrincipalAxes, PrincipalStiffness, Response};
use super::saint_venant_kirchhoff::SaintVenantKirchhoff;
use super::tensor::{AxisymmetricTensor, SymmetricTensor};
use crate::elastic::ElasticModuli;

/// The stored energy at finite strain; all laws have the moduli K and G at small strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HyperelasticLaw {
    /// G/2 (J^(−2/3) tr b − 3) + K/2 (J − 1)².
    #[default]
    NeoHooke,
    /// G/2 (tr b − 3) − G ln J + λ/2 ln²J.
    NeoHookeLn,
    /// K/2 ln²J + G |dev ln V|².
    Hencky,
    /// λ/2 (tr E)² + G E:E, with Green's strain E.
    SaintVenantKirchhoff,
}

impl HyperelasticLaw {
    /// All laws, the default first.
    pub const ALL: [Self; 4] =
        [Self::NeoHooke, Self::NeoHookeLn, Self::Hencky, Self::SaintVenantKirchhoff];

    /// Returns the name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::NeoHooke => "neo-hooke",
            Self::NeoHookeLn => "neo-hooke-ln",
            Self::Hencky => "hencky",
            Self::SaintVenantKirchhoff => "saint-venant-kirchhoff",
        }
    }

    /// Returns whether the law is elliptic at all deformations for any moduli: polyconvex with the growth of
    /// neo-Hooke's (Hartmann & Neff 2003).
    pub fn is_always_elliptic(self) -> bool {
        self == Self::NeoHooke
    }
}

/// Error: a point is inverted, J = det F is not positive.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the material is turned inside out: its volume is {jacobian:?} times the undeformed one")]
pub struct Inverted {
    /// J = det F; NaN if the displacement is not finite.
    pub jacobian: f64,
}

/// A hyperelastic solid: a law and its moduli.
///
/// Deformation is given as the displacement gradient H, F = 1 + H: at small strain F − 1 would
/// lose digits. Energies are those of the undeformed volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hyperelastic {
    law: HyperelasticLaw,
    bulk: f64,
    shear: f64,
}

impl Hyperelastic {
    /// Creates a law with these moduli at small strain.
    pub fn new(law: HyperelasticLaw, moduli: &ElasticModuli) -> Self {
        Self { law, bulk: moduli.bulk_modulus(), shear: moduli.shear_modulus() }
    }

    /// Returns this law with the given shares of K and G.
    pub(super) fn scaled(&self, bulk: f64, shear: f64) -> Self {
        Self { law: self.law, bulk: bulk * self.bulk, shear: shear * self.shear }
    }

    /// Returns the law of the stored energy.
    pub fn law(&self) -> HyperelasticLaw {
        self.law
    }

    /// Returns the bulk modulus K at small strain, Pa.
    pub fn bulk_modulus(&self) -> f64 {
        self.bulk
    }

    /// Returns the shear modulus G at small strain, Pa.
    pub fn shear_modulus(&self) -> f64 {
        self.shear
    }

    /// Returns the energy per undeformed volume W, J/m³.
    ///
    /// # Errors
    /// det F is not positive.
    #[inline]
    pub fn energy(&self, h: &AxisymmetricTensor) -> Result<f64, Inverted> {
        Ok(self.energy_of(&upright(h)?))
    }

    /// Returns the first Piola-Kirchhoff stress P = ∂W/∂F, Pa: force by undeformed area.
    ///
    /// # Errors
    /// det F is not positive.
    #[inline]
    pub fn first_piola(&self, h: &AxisymmetricTensor) -> Result<AxisymmetricTensor, Inverted> {
        let strain = upright(h)?;
        Ok(self.first_piola_of(h, &strain))
    }

    /// Returns the first Piola-Kirchhoff stress, Pa, and J − 1, on one number or on lanes. It is valid
    /// where J − 1 > −1, which the caller has to check.
    #[inline(always)]
    pub fn first_piola_unchecked<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
    ) -> (AxisymmetricTensor<N>, N) {
        let strain = Strain::of(h);
        (self.first_piola_of(h, &strain), strain.volume_change)
    }

    /// Returns the energy per undeformed volume, J/m³, like [`Hyperelastic::first_piola_unchecked`].
    #[inline(always)]
    pub fn energy_unchecked<N: Number>(&self, h: &AxisymmetricTensor<N>) -> N {
        self.energy_of(&Strain::of(h))
    }

    #[inline(always)]
    fn first_piola_of<N: Number>(
        &self,
        h: &AxisymmetricTensor<N>,
        strain: &Strain<N>,
    ) -> AxisymmetricTensor<N> {
        // The hourglass energy of an element needs this root for every law.
        let y = inverse_cube_root(N::splat(1.0) + strain.volume_change);
        first_piola(&self.kirchhoff(strain), h, y * y * y)
    }

    /// Returns the Cauchy stress σ = P Fᵀ/J, Pa: force by deformed area.
    ///
    /// # Errors
    /// det F is not positive.
    #[inline]
    pub fn cauchy(&self, h: &AxisymmetricTensor) -> Result<SymmetricTensor, Inverted> {
        let strain = upright(h)?;
        Ok(self.kirchhoff(&strain).times(1.0 / (1.0 + strain.volume_change)))
    }

    /// Returns A = ∂P/∂F, Pa, of the components rr, ry, yr, yy, tt; symmetric.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn tangent(&self, h: &AxisymmetricTensor) -> Result<[[f64; 5]; 5], Inverted> {
        upright(h)?;
        let axes = PrincipalAxes::of(h);
        Ok(self.principal_stiffness(axes.stretches).tangent(&axes))
    }

    /// Returns the least stiffness of a wave superposed on a deformation, Pa: [`least_acoustic_stiffness`]. The law is
    /// elliptic where it is positive.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn least_acoustic_stiffness(&self, h: &AxisymmetricTensor) -> Result<f64, Inverted> {
        let tangent = self.tangent(h)?;
        let plane = std::array::from_fn(|i| std::array::from_fn(|j| tangent[i][j]));
        Ok(least_acoustic_stiffness(&plane))
    }

    /// Returns an upper bound of the largest eigenvalue of ∂P/∂F, exact to 1e-6, Pa.
    ///
    /// # Errors
    /// det F is not positive.
    pub fn largest_stiffness(&self, h: &AxisymmetricTensor) -> Result<f64, Inverted> {
        upright(h)?;
        Ok(self.principal_stiffness(PrincipalAxes::of(h).stretches).largest_eigenvalue())
    }

    fn principal_stiffness(&self, stretches: [f64; 3]) -> PrincipalStiffness {
        PrincipalStiffness::new(stretches, &self.principal(stretches))
    }

    #[inline(always)]
    pub(super) fn energy_of<N: Number>(&self, strain: &Strain<N>) -> N {
        let Self { law, bulk, shear } = *self;
        match law {
            HyperelasticLaw::NeoHooke => {
                NeoHooke { bulk: N::splat(bulk), shear: N::splat(shear) }.energy_of(strain)
            }
            HyperelasticLaw::NeoHookeLn => NeoHookeLn { bulk, shear }.energy(strain),
            HyperelasticLaw::Hencky => Hencky { bulk, shear }.energy(strain),
            HyperelasticLaw::SaintVenantKirchhoff => {
                SaintVenantKirchhoff { bulk, shear }.energy(strain)
            }
        }
    }

    #[inline(always)]
    pub(super) fn kirchhoff<N: Number>(&self, strain: &Strain<N>) -> SymmetricTensor<N> {
        let Self { law, bulk, shear } = *self;
        match law {
            HyperelasticLaw::NeoHooke => {
                NeoHooke { bulk: N::splat(bulk), shear: N::splat(shear) }.kirchhoff(strain)
            }
            HyperelasticLaw::NeoHookeLn => NeoHookeLn { bulk, shear }.kirchhoff(strain),
            HyperelasticLaw::Hencky => Hencky { bulk, shear }.kirchhoff(strain),
            HyperelasticLaw::SaintVenantKirchhoff => {
                SaintVenantKirchhoff { bulk, shear }.kirchhoff(strain)
            }
        }
    }

    fn principal(&self, stretches: [f64; 3]) -> Response {
        let Self { law, bulk, shear } = *self;
        match law {
            HyperelasticLaw::NeoHooke => NeoHooke { bulk, shear }.principal(stretches),
            HyperelasticLaw::NeoHookeLn => NeoHookeLn { bulk, shear }.principal(stretches),
            HyperelasticLaw::Hencky => Hencky { bulk, shear }.principal(stretches),
            HyperelasticLaw::SaintVenantKirchhoff => {
                SaintVenantKirchhoff { bulk, shear }.principal(stretches)
            }
        }
    }
}

/// Returns the strain of a displacement gradient, if J, its plane part and the hoop stretch are positive and finite.
#[inline]
pub(super) fn upright(h: &AxisymmetricTensor) -> Result<Strain, Inverted> {
    let strain = Strain::of(h);
    if strain.volume_change > -1.0 && strain.volume_change.is_finite() && h.tt > -1.0 {
        Ok(strain)
    } else {
        Err(Inverted { jacobian: 1.0 + strain.volume_change })
    }
}
