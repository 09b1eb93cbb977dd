//! Two colliding bodies as one: the effective radius, mass and modulus of their contact.
//!
//! ```math
//! \frac1{R^*} = \frac1{R_1}+\frac1{R_2}, \qquad \frac1{m^*} = \frac1{m_1}+\frac1{m_2}, \qquad
//! \frac1{E^*} = \frac{1-\nu_1^2}{E_1}+\frac{1-\nu_2^2}{E_2}
//! ```
//!
//! Bordbar & Hyppänen (2007), eqs. 15–17; moduli are the instantaneous ones. Infinite quantities drop out
//! of their sums: radius, mass and modulus of a rigid wall, radius and mass of a half-space, the modulus of
//! a rigid sphere.

use std::f64::consts::PI;

use fem_material::Material;

use crate::error::{LawError, positive, positive_or_infinite};

/// One of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Partner {
    /// A solid sphere.
    Sphere {
        /// Radius R, m.
        radius: f64,
        /// Mass m, kg; infinite if it does not move as a whole within the contact: held, or so large
        /// that waves do not come back ([`restitution_of_mass_centres`]).
        mass: f64,
        /// Plane strain modulus E/(1−ν²), Pa; infinite if the sphere is rigid.
        plane_strain_modulus: f64,
    },
    /// A block that never ends, at rest: flat and immovable as a wall, but not rigid.
    HalfSpace {
        /// Plane strain modulus E/(1−ν²), Pa.
        plane_strain_modulus: f64,
    },
    /// A rigid, immovable plane.
    Wall,
}

impl Partner {
    /// Creates a solid sphere from a diameter (m) and a material. [`Pair::new`] checks the diameter.
    pub fn solid_sphere(diameter: f64, material: &Material) -> Self {
        Self::Sphere {
            radius: 0.5 * diameter,
            mass: sphere_mass(diameter, material.density()),
            plane_strain_modulus: material.instantaneous().plane_strain_modulus(),
        }
    }

    /// Creates a half-space of a material.
    pub fn half_space(material: &Material) -> Self {
        Self::HalfSpace { plane_strain_modulus: material.instantaneous().plane_strain_modulus() }
    }

    /// Holds this sphere in its place; other bodies do not move anyway.
    #[must_use]
    pub fn held(self) -> Self {
        match self {
            Self::Sphere { radius, plane_strain_modulus, .. } => {
                Self::Sphere { radius, mass: f64::INFINITY, plane_strain_modulus }
            }
            other => other,
        }
    }

    /// Returns the plane strain modulus E/(1−ν²), Pa; infinite for a rigid body.
    pub fn plane_strain_modulus(&self) -> f64 {
        match *self {
            Self::Sphere { plane_strain_modulus, .. }
            | Self::HalfSpace { plane_strain_modulus } => plane_strain_modulus,
            Self::Wall => f64::INFINITY,
        }
    }

    /// Returns radius, mass and modulus.
    fn checked(&self) -> Result<[f64; 3], LawError> {
        match *self {
            Self::Sphere { radius, mass, plane_strain_modulus } => Ok([
                positive("radius", radius)?,
                positive_or_infinite("mass", mass)?,
                positive_or_infinite("plane_strain_modulus", plane_strain_modulus)?,
            ]),
            Self::HalfSpace { plane_strain_modulus } => {
                let modulus = positive("plane_strain_modulus", plane_strain_modulus)?;
                Ok([f64::INFINITY, f64::INFINITY, modulus])
            }
            Self::Wall => Ok([f64::INFINITY; 3]),
        }
    }
}

/// Returns ρπD³/6, kg, of a solid sphere of diameter D (m) and density ρ (kg/m³).
pub fn sphere_mass(diameter: f64, density: f64) -> f64 {
    density * PI * diameter.powi(3) / 6.0
}

/// Returns the shares s of two bodies in the compliance of a contact, from their own compliances, such as 1/E′, in any
/// unit; nothing of a rigid one. At most one is.
pub fn compliance_shares([first, second]: [f64; 2]) -> [f64; 2] {
    [first / (first + second), second / (first + second)]
}

/// Returns the restitution of the mass centres of a body and a large partner, of the mass ratio m/M, from that of
/// the body alone, e′.
///
/// Until waves come back the partner is a half-space to the contact: it moves nowhere as a whole, and the
/// body's collision is that with an infinite mass. Its mass centre has the impulse m v (1+e′) all the same,
/// so that e = e′ + (1+e′) m/M. The energy of its motion is part of the waves' energy.
pub fn restitution_of_mass_centres(restitution: f64, mass_ratio: f64) -> f64 {
    restitution + (1.0 + restitution) * mass_ratio
}

/// Effective radius, mass and modulus of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    effective_radius: f64,
    effective_mass: f64,
    contact_modulus: f64,
}

impl Pair {
    /// Creates a pair of two bodies; either order gives the same bits.
    ///
    /// # Errors
    /// Two walls; no sphere; two rigid bodies; two that cannot move; a radius that is not positive and
    /// finite, a mass or modulus that is not positive.
    pub fn new(first: Partner, second: Partner) -> Result<Self, LawError> {
        if first == Partner::Wall && second == Partner::Wall {
            return Err(LawError::TwoWalls);
        }
        let ([r1, m1, e1], [r2, m2, e2]) = (first.checked()?, second.checked()?);
        if r1.min(r2).is_infinite() {
            return Err(LawError::NoSphere);
        }
        if e1.min(e2).is_infinite() {
            return Err(LawError::TwoRigidBodies);
        }
        if m1.min(m2).is_infinite() {
            return Err(LawError::NothingMoves);
        }
        Ok(Self {
            effective_radius: in_series(r1, r2),
            effective_mass: positive("effective mass", in_series(m1, m2))?,
            contact_modulus: in_series(e1, e2),
        })
    }

    /// Returns this pair with a share of its modulus, for instance after relaxation.
    ///
    /// # Errors
    /// A share that is not positive and finite.
    pub fn with_modulus_share(self, share: f64) -> Result<Self, LawError> {
        let contact_modulus = self.contact_modulus * positive("share of the modulus", share)?;
        Ok(Self { contact_modulus: positive("contact_modulus", contact_modulus)?, ..self })
    }

    /// Returns the effective radius R*, m.
    pub fn effective_radius(&self) -> f64 {
        self.effective_radius
    }

    /// Returns the effective mass m*, kg.
    pub fn effective_mass(&self) -> f64 {
        self.effective_mass
    }

    /// Returns the contact modulus E*, Pa.
    pub fn contact_modulus(&self) -> f64 {
        self.contact_modulus
    }
}

/// Returns 1/(1/a + 1/b), at most one of them infinite, without overflow.
fn in_series(a: f64, b: f64) -> f64 {
    let (smaller, larger) = (a.min(b), a.max(b));
    smaller / (1.0 + smaller / larger)
}
