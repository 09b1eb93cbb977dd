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
        match self {
            Self::Pressure => "pressure",
            Self::Axial => "axial",
            Self::Radial => "radial",
            Self::Surface => "surface",
            Self::Hoop => "hoop",
        }
    }

    pub fn label(self) -> &'static str {
        match self {
            Self::Pressure => "contact pressure",
            Self::Axial => "σ_yy, axis",
            Self::Radial => "σ_rr, axis",
            Self::Surface => "σ_rr, surface",
            Self::Hoop => "σ_θθ, surface",
        }
    }
}

/// Returns the value over p₀ at a place over a.
pub fn closed_form(profile: Profile, place: f64, poissons_ratio: f64) -> f64 {
    match profile {
        Profile::Pressure => UNIT.pressure(place),
        Profile::Axial => UNIT.axis_stress(place, poissons_ratio).axial,
        Profile::Radial => UNIT.axis_stress(place, poissons_ratio).radial,
        Profile::Surface => surface_stress(place, poissons_ratio)[0],
        Profile::Hoop => surface_stress(place, poissons_ratio)[1],
    }
}

/// Returns ½|σ_rr − σ_yy| on the axis.
pub fn shear(depth: f64, poissons_ratio: f64) -> f64 {
    UNIT.axis_stress(depth, poissons_ratio).max_shear()
}

/// Returns σ_rr and σ_θθ on the surface (Johnson, *Contact Mechanics*, eqs. 3.42 and 3.44), inside and
/// outside of the contact:
///
/// ```math
/// \frac{\sigma_{rr}}{p_0} = \frac{1-2\nu}{3}\frac{a^2}{r^2}
///   \left[1-\left(1-\tfrac{r^2}{a^2}\right)^{3/2}\right] - \sqrt{1-\tfrac{r^2}{a^2}},
/// \qquad \frac{\sigma_{rr}}{p_0} = \frac{1-2\nu}{3}\frac{a^2}{r^2} ,
/// ```
/// ```math
/// \frac{\sigma_{rr}+\sigma_{\theta\theta}}{p_0} = -(1+2\nu)\sqrt{1-\tfrac{r^2}{a^2}},
/// \qquad \sigma_{rr}+\sigma_{\theta\theta} = 0 .
/// ```
fn surface_stress(r: f64, poissons_ratio: f64) -> [f64; 2] {
    let rim = UNIT.rim_tension(poissons_ratio);
    let square = r * r;
    let inside = (1.0 - square).max(0.0);
    // On the axis the bracket tends to 3/2 r²/a².
    let bracket = if square < 1e-12 { 1.5 } else { (1.0 - inside * inside.sqrt()) / square };
    let radial = rim * bracket - UNIT.pressure(r);
    [radial, -(1.0 + 2.0 * poissons_ratio) * UNIT.pressure(r) - radial]
}

/// Returns σ_rz below the surface, with z into the body.
pub fn shear_below(r: f64, z: f64) -> f64 {
    // σ_rz does not depend on Poisson's ratio.
    UNIT.stress(r, z, 0.0)[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Surface and axis meet in one point, the rim has Hertz' largest tension, and far away the field is that of
    /// Boussinesq's point force, σ_rr = (1−2ν)F/2πr².
    #[test]
    fn surface_stress_agrees_with_axis_rim_and_far_field() {
        for nu in [0.0, 0.244, 0.3, 0.5] {
            let surface = |r: f64| closed_form(Profile::Surface, r, nu);
            let axis = closed_form(Profile::Radial, 0.0, nu);
            assert!((closed_form(Profile::Hoop, 0.0, nu) - axis).abs() < 1e-15);
            assert!((surface(0.0) - axis).abs() < 1e-15);
            assert!((surface(1e-3) - axis).abs() < 1e-6);
            assert!((surface(1.0) - UNIT.rim_tension(nu)).abs() < 1e-15);
            let point = (1.0 - 2.0 * nu) * UNIT.force() / (2.0 * std::f64::consts::PI * 9.0);
            assert!((surface(3.0) - point).abs() < 1e-15);
        }
    }
}
