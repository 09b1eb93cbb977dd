//! Hertz' stress field in units of the contact radius a and the pressure p₀.

use fem_laws::HertzPressure;

const UNIT: HertzPressure = HertzPressure { contact_radius: 1.0, peak_pressure: 1.0 };

/// A field that is compared along a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Contact pressure against the distance from the axis.
    Pressure,
    /// σ_yy on the axis against the depth.
    Axial,
    /// σ_rr on the axis against the depth.
    Radial,
    /// σ_rr on the surface against the distance from the axis.
    Surface,
    /// σ_θθ on the surface against the distance from the axis.
    Hoop,
}

impl Profile {
    pub const ALL: [Self; 5] =
        [Self::Pressure, Self::Axial, Self::Radial, Self::Surface, Self::Hoop];

    pub fn name(self) -> &'static str {
        self.row()[0]
    }

    pub fn label(self) -> &'static str {
        self.row()[1]
    }

    fn row(self) -> [&'static str; 2] {
        match self {
            Self::Pressure => ["pressure", "contact pressure"],
            Self::Axial => ["axial", "σ_yy, axis"],
            Self::Radial => ["radial", "σ_rr, axis"],
            Self::Surface => ["surface", "σ_rr, surface"],
            Self::Hoop => ["hoop", "σ_θθ, surface"],
        }
    }
}

/// Returns the value over p₀ at a place over a.
pub fn closed_form(profile: Profile, place: f64, poissons_ratio: f64) -> f64 {
    match profile {
        Profile::Pressure => UNIT.pressure(place),
        Profile::Axial => UNIT.axis_stress(place, poissons_ratio).axial,
        Profile::Radial => UNIT.axis_stress(place, poissons_ratio).radial,
        Profile::Surface => UNIT.stress(place, 0.0, poissons_ratio)[0],
        Profile::Hoop => UNIT.stress(place, 0.0, poissons_ratio)[2],
    }
}

/// Returns ½|σ_rr − σ_yy| on the axis.
pub fn shear(depth: f64, poissons_ratio: f64) -> f64 {
    UNIT.axis_stress(depth, poissons_ratio).max_shear()
}

/// Returns σ_rz below the surface, with z into the body.
pub fn shear_below(r: f64, z: f64) -> f64 {
    // σ_rz does not depend on Poisson's ratio.
    UNIT.stress(r, z, 0.0)[3]
}
