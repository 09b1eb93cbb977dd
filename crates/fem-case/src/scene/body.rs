//! One of the two bodies of a validated case: what it is, and how it moves.

use std::path::PathBuf;

use fem_laws::Partner;
use fem_material::Material;

/// One of the two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    pub(crate) velocity: f64,
    pub(crate) held: bool,
    pub(crate) yield_strength: Option<f64>,
    pub(crate) unpublished_loss: Option<String>,
}

impl Body {
    /// Letters, digits, `_` and `-`; unlike the other body's.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its shape and stuff.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Along +y at time 0, m/s.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Whether its mass centre does not move, whatever falls on it; of a sphere.
    pub fn is_held(&self) -> bool {
        self.held
    }

    /// Yield strength of its material, Pa, > 0, if the case gives one.
    pub fn yield_strength(&self) -> Option<f64> {
        self.yield_strength
    }

    /// The name of its material, without `lib:`, if that is of the library, which knows no loss of it, and the case gives none.
    pub fn unpublished_loss(&self) -> Option<&str> {
        self.unpublished_loss.as_deref()
    }

    /// Its material; a rigid body has none.
    pub fn material(&self) -> Option<&Material> {
        match &self.shape {
            Shape::Sphere { material, .. } | Shape::HalfSpace { material } => Some(material),
            Shape::Rigid { .. } | Shape::Wall => None,
        }
    }

    /// Its shape, made of another material; a rigid body stays one.
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

    /// Its shape as it is where it does not deform: of a sphere with its mass, of a half-space a wall.
    pub fn rigid(&self) -> Shape {
        match (&self.shape, self.mass()) {
            (Shape::Sphere { diameter, .. }, Some(mass)) => {
                Shape::Rigid { diameter: *diameter, mass }
            }
            (Shape::HalfSpace { .. }, _) => Shape::Wall,
            (shape, _) => shape.clone(),
        }
    }

    /// Its mass, kg; that of a wall and of a half-space has no end.
    pub fn mass(&self) -> Option<f64> {
        match &self.shape {
            Shape::Sphere { diameter, material, .. } => {
                Some(fem_laws::sphere_mass(*diameter, material.density()))
            }
            Shape::Rigid { mass, .. } => Some(*mass),
            Shape::HalfSpace { .. } | Shape::Wall => None,
        }
    }

    /// Its diameter, m; a wall has none, nor has a half-space.
    pub fn diameter(&self) -> Option<f64> {
        match self.shape {
            Shape::Sphere { diameter, .. } | Shape::Rigid { diameter, .. } => Some(diameter),
            Shape::HalfSpace { .. } | Shape::Wall => None,
        }
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
    /// A block that never ends.
    HalfSpace {
        /// Material of the body.
        material: Material,
    },
    /// A solid sphere that does not deform: no case writes it, an effect makes it of a stiff one.
    Rigid {
        /// Diameter, m, > 0.
        diameter: f64,
        /// Mass, kg, > 0.
        mass: f64,
    },
    /// A rigid plane of infinite mass.
    Wall,
}
