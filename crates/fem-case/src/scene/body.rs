//! One of the two bodies of a validated case: its shape, material and motion.

use std::path::PathBuf;

use fem_laws::{Partner, YieldingBody};
use fem_material::{Material, ShiftLaw};

use crate::schema::PlateSupport;
use crate::source::toml_syntax::{join, quote_key};

/// One of the two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    pub(crate) own_mass: Option<f64>,
    pub(crate) velocity: f64,
    pub(crate) tangential_velocity: f64,
    pub(crate) spin: f64,
    pub(crate) held: bool,
    pub(crate) yield_strength: Option<f64>,
    pub(crate) is_elastic: bool,
    pub(crate) surface_energy: Option<f64>,
    pub(crate) material_name: Option<String>,
    pub(crate) library_material: Option<&'static str>,
    pub(crate) measured: Option<MeasuredBand>,
}

/// What is known of the data from which a relaxation comes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasuredBand {
    /// Temperature at which the relaxation times of the case hold, K.
    pub reference_temperature: Option<f64>,
    /// Temperature of the body, K, if the times are shifted to it.
    pub temperature: Option<f64>,
    /// The law of that shift.
    pub shift: Option<ShiftLaw>,
    /// The lowest and the highest frequency at the temperature of the body at which the moduli are measured, Hz.
    pub frequencies: Option<[f64; 2]>,
    /// Frequencies at that temperature (Hz), rising, with the standard uncertainty of the loss modulus over its value.
    pub loss_uncertainty: Vec<(f64, f64)>,
    /// Young's modulus of the series at its highest frequencies, Pa.
    pub youngs_modulus: Option<f64>,
    /// The shear modulus of the series at its highest frequencies, Pa.
    pub shear_modulus: Option<f64>,
}

impl MeasuredBand {
    /// Returns log10 a_T of the body's temperature: of its relaxation times over those of the case; 0 without a shift.
    pub fn log10_shift(&self) -> f64 {
        let shift = || {
            let (temperature, reference) = (self.temperature?, self.reference_temperature?);
            self.shift.as_ref()?.log10_shift(temperature, reference)
        };
        shift().unwrap_or(0.0)
    }
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

    /// Returns the velocity across the axis at time 0, along the same x for both bodies, m/s.
    pub fn tangential_velocity(&self) -> f64 {
        self.tangential_velocity
    }

    /// Returns the angular velocity at time 0, right-handed about x × y, rad/s.
    pub fn spin(&self) -> f64 {
        self.spin
    }

    /// Returns whether the mass centre of a sphere is fixed.
    pub fn is_held(&self) -> bool {
        self.held
    }

    /// Returns the yield strength of the material, Pa, > 0, if the case gives one.
    pub fn yield_strength(&self) -> Option<f64> {
        self.yield_strength
    }

    /// Returns whether the case says that the material is meant to be elastic but for the relaxation and the strength that it gives.
    pub fn is_meant_elastic(&self) -> bool {
        self.is_elastic
    }

    /// Returns the surface energy of the material, J/m², > 0, if the case gives one.
    pub fn surface_energy(&self) -> Option<f64> {
        self.surface_energy
    }

    /// Returns what is known of the data of the material's relaxation; `None` without a relaxation.
    pub fn measured(&self) -> Option<&MeasuredBand> {
        self.measured.as_ref()
    }

    /// Returns the name of the material in the case; a wall has none.
    pub fn material_name(&self) -> Option<&str> {
        self.material_name.as_deref()
    }

    /// Returns the name of the material, without `lib:`, if it is one of the library.
    pub fn library_material(&self) -> Option<&'static str> {
        self.library_material
    }

    /// Returns the dotted key of a number of the material in the case: `material.steel.yield_strength`.
    pub fn material_key(&self, key: &str) -> String {
        let name = self.material_name.as_deref().unwrap_or("NAME");
        join(&join("material", &quote_key(name)), key)
    }

    /// Returns the material; a rigid body has none.
    pub fn material(&self) -> Option<&Material> {
        match &self.shape {
            Shape::Sphere { material, .. }
            | Shape::HalfSpace { material }
            | Shape::Plate { material, .. } => Some(material),
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
            Shape::Plate { plate, .. } => Shape::Plate { plate: *plate, material },
            Shape::Rigid { .. } | Shape::Wall => self.shape.clone(),
        }
    }

    /// Returns the plate, if the body is one.
    pub fn plate(&self) -> Option<&Plate> {
        match &self.shape {
            Shape::Plate { plate, .. } => Some(plate),
            _ => None,
        }
    }

    /// Returns the body for closed forms, with instantaneous moduli; a plate is a half-space to the contact.
    pub fn partner(&self) -> Partner {
        let sphere = |diameter: f64, plane_strain_modulus| {
            let mass = self.mass().filter(|_| !self.held).unwrap_or(f64::INFINITY);
            Partner::Sphere { radius: 0.5 * diameter, mass, plane_strain_modulus }
        };
        match &self.shape {
            Shape::Sphere { diameter, material, .. } => {
                sphere(*diameter, material.instantaneous().plane_strain_modulus())
            }
            Shape::HalfSpace { material } | Shape::Plate { material, .. } => {
                Partner::half_space(material)
            }
            Shape::Rigid { diameter, .. } => sphere(*diameter, f64::INFINITY),
            Shape::Wall => Partner::Wall,
        }
    }

    /// Returns the rigid counterpart of the shape: a rigid sphere of the same mass, or a wall for a half-space or a plate.
    pub fn rigid(&self) -> Shape {
        match (&self.shape, self.mass()) {
            (Shape::Sphere { diameter, .. }, Some(mass)) => {
                Shape::Rigid { diameter: *diameter, mass }
            }
            (Shape::HalfSpace { .. } | Shape::Plate { .. }, _) => Shape::Wall,
            (shape, _) => shape.clone(),
        }
    }

    /// Returns the mass that the case gives a sphere in place of that of its material, kg.
    pub fn own_mass(&self) -> Option<f64> {
        self.own_mass
    }

    /// Returns the mean density of a sphere, kg/m³: that of the material, or of the mass that the case gives.
    pub fn mean_density(&self) -> Option<f64> {
        let of_own = || Some(self.own_mass? / fem_laws::sphere_mass(self.diameter()?, 1.0));
        of_own().or_else(|| Some(self.material()?.density()))
    }

    /// Returns the mass, kg; a flat body has none, since it does not move as a whole.
    pub fn mass(&self) -> Option<f64> {
        self.own_mass.or_else(|| match &self.shape {
            Shape::Sphere { diameter, material, .. } => {
                Some(fem_laws::sphere_mass(*diameter, material.density()))
            }
            Shape::Rigid { mass, .. } => Some(*mass),
            Shape::HalfSpace { .. } | Shape::Plate { .. } | Shape::Wall => None,
        })
    }

    /// Returns the diameter of a sphere, m; a flat body has none.
    pub fn diameter(&self) -> Option<f64> {
        match self.shape {
            Shape::Sphere { diameter, .. } | Shape::Rigid { diameter, .. } => Some(diameter),
            Shape::HalfSpace { .. } | Shape::Plate { .. } | Shape::Wall => None,
        }
    }

    /// Returns the radius, m; infinite for a flat body.
    pub fn radius(&self) -> f64 {
        self.diameter().map_or(f64::INFINITY, |diameter| 0.5 * diameter)
    }

    /// Returns what decides when the body yields; `None` without a material or its yield strength.
    pub fn yielding(&self) -> Option<YieldingBody> {
        self.yielding_at(self.yield_strength?)
    }

    /// Returns what decides when the body yields with a yield strength (Pa); `None` without a material.
    pub fn yielding_at(&self, yield_strength: f64) -> Option<YieldingBody> {
        let moduli = self.material()?.instantaneous();
        Some(YieldingBody {
            yield_strength,
            poissons_ratio: moduli.poissons_ratio(),
            plane_strain_modulus: moduli.plane_strain_modulus(),
            radius: self.radius(),
        })
    }
}

/// Sizes and support of a plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// Thickness, m, > 0.
    pub thickness: f64,
    /// Diameter, m, > 0; `None` is unbounded.
    pub diameter: Option<f64>,
    /// Support of the face away from the contact.
    pub support: PlateSupport,
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
    /// A deformable plate.
    Plate {
        /// Sizes and support.
        plate: Plate,
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
