//! One of the two bodies of a validated case: its shape, material and motion.

use std::path::PathBuf;

use fem_laws::{Partner, YieldingBody};
use fem_material::Material;

/// One of the two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    pub(crate) velocity: f64,
    pub(crate) held: bool,
    pub(crate) yield_strength: Option<f64>,
    pub(crate) surface_energy: Option<f64>,
    pub(crate) library_material: Option<&'static str>,
}

impl Body {
    /// Returns the name: letters, digits, `_` and `-`. The other body has another name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the shape with its material.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Returns the velocity along +y at time 0, m/s.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Returns whether the mass centre of a sphere is fixed.
    pub fn is_held(&self) -> bool {
        self.held
    }

    /// Returns the yield strength of the material, Pa, > 0, if the case gives one.
    pub fn yield_strength(&self) -> Option<f64> {
        self.yield_strength
    }

    /// Returns the surface energy of the material, J/m², > 0, if the case gives one.
    pub fn surface_energy(&self) -> Option<f64> {
        self.surface_energy
    }

    /// Returns the name of the material, without `lib:`, if it is one of the library.
    pub fn library_material(&self) -> Option<&'static str> {
        self.library_material
    }

    /// Returns the material; a rigid body has none.
    pub fn material(&self) -> Option<&Material> {
        match &self.shape {
            Shape::Sphere { material, .. } | Shape::HalfSpace { material } => Some(material),
            Shape::Rigid { .. } | Shape::Wall => None,
        }
    }

    /// Returns the shape with another material; a rigid body is unchanged.
    pub fn shape_of(&self, material: Material) -> Shape {
        match &self.shape {
            Shape::Sphere { diameter, mesh, .. } => {
                Shape::Sphere { diameter: *diameter, mesh: mesh.clone(), material }
            }
            Shape::HalfSpace { .. } => Shape::HalfSpace { material },
            Shape::Rigid { .. } | Shape::Wall => self.shape.clone(),
        }
    }

    /// Returns the body for closed forms, with instantaneous moduli.
    pub fn partner(&self) -> Partner {
        match &self.shape {
            Shape::Sphere { diameter, material, .. } if self.held => {
                Partner::solid_sphere(*diameter, material).held()
            }
            Shape::Sphere { diameter, material, .. } => Partner::solid_sphere(*diameter, material),
            Shape::HalfSpace { material } => Partner::half_space(material),
            Shape::Rigid { diameter, mass } => {
                let mass = if self.held { f64::INFINITY } else { *mass };
                let (radius, plane_strain_modulus) = (0.5 * diameter, f64::INFINITY);
                Partner::Sphere { radius, mass, plane_strain_modulus }
            }
            Shape::Wall => Partner::Wall,
        }
    }

    /// Returns the rigid counterpart of the shape: a rigid sphere of the same mass, or a wall for a half-space.
    pub fn rigid(&self) -> Shape {
        match (&self.shape, self.mass()) {
            (Shape::Sphere { diameter, .. }, Some(mass)) => {
                Shape::Rigid { diameter: *diameter, mass }
            }
            (Shape::HalfSpace { .. }, _) => Shape::Wall,
            (shape, _) => shape.clone(),
        }
    }

    /// Returns the mass, kg; a wall and a half-space have none.
    pub fn mass(&self) -> Option<f64> {
        match &self.shape {
            Shape::Sphere { diameter, material, .. } => {
                Some(fem_laws::sphere_mass(*diameter, material.density()))
            }
            Shape::Rigid { mass, .. } => Some(*mass),
            Shape::HalfSpace { .. } | Shape::Wall => None,
        }
    }

    /// Returns the diameter, m; a wall and a half-space have none.
    pub fn diameter(&self) -> Option<f64> {
        match self.shape {
            Shape::Sphere { diameter, .. } | Shape::Rigid { diameter, .. } => Some(diameter),
            Shape::HalfSpace { .. } | Shape::Wall => None,
        }
    }

    /// Returns the radius, m; infinite for a flat body.
    pub fn radius(&self) -> f64 {
        self.diameter().map_or(f64::INFINITY, |diameter| 0.5 * diameter)
    }

    /// Returns what decides when the body yields; `None` without a material or its yield strength.
    pub fn yielding(&self) -> Option<YieldingBody> {
        let moduli = self.material()?.instantaneous();
        Some(YieldingBody {
            yield_strength: self.yield_strength?,
            poissons_ratio: moduli.poissons_ratio(),
            plane_strain_modulus: moduli.plane_strain_modulus(),
            radius: self.radius(),
        })
    }
}

/// Shape of a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A solid sphere.
    Sphere {
        /// Diameter, m, > 0.
        diameter: f64,
        /// A mesh file instead of the built-in mesh.
        mesh: Option<PathBuf>,
        /// Material of the body.
        material: Material,
    },
    /// A deformable half-space.
    HalfSpace {
        /// Material of the body.
        material: Material,
    },
    /// A rigid sphere. No case gives one; the effect `rigid_partner` replaces a stiff sphere by it.
    Rigid {
        /// Diameter, m, > 0.
        diameter: f64,
        /// Mass, kg, > 0.
        mass: f64,
    },
    /// A rigid plane of infinite mass.
    Wall,
}
