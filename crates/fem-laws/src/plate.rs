//! A thin plate that is struck: its bending waves carry energy away.
//!
//! A force F on an infinite thin plate moves the point under it like a dashpot,
//!
//! ```math
//! \dot w = \beta F, \qquad \beta = \frac1{8\sqrt{D\rho h}}, \qquad D = \frac{Eh^3}{12(1-\nu^2)},
//! ```
//!
//! for any course of the force (Zener 1941, *Phys. Rev.* 59, 669). With Hertz' contact of stiffness K in series, in units of
//! the length ℓ = (m/K)^(2/5) v^(4/5) and the time ℓ/v, the impact of a ball depends on one number,
//!
//! ```math
//! \ddot u + \Bigl(1+\lambda\frac{\mathrm d}{\mathrm dt}\Bigr)u^{3/2} = 0, \qquad
//! \lambda = \beta m\,(K/m)^{2/5}v^{1/5},
//! ```
//!
//! and e ≈ exp(−1.730 λ) at small λ: a soft dashpot takes λ∫u³dt of Hertz' motion, 1 − e = ⅘ (5/4)^(8/5) B(8/5, ½) λ with Euler's beta
//! function B. At large λ the plate stops the ball slowly, under a force of v/λ, until the contact is so
//! soft that it parts: e = 0.679 λ⁻⁵. From [`SINKING_LAMBDA`] on the models take that as 0.
//!
//! Limits: the plate is thin against the distance that waves travel in the contact time T, and no wave returns from its edge
//! within it. A plate of finite thickness loses more, by shear, by the inertia of its own deformation and finally by waves into the
//! bulk. Explicit elements of this program (`validation/data/plate_map.csv`) lose as much as thin plates whose mobility is larger by the factor
//!
//! ```math
//! f = 1 + 2.2\,x\sqrt{1-\nu^2} + 28\,x^{3.8}, \qquad x = \frac h{c_0T}, \quad c_0 = \sqrt{E/\rho},
//! ```
//!
//! with Hertz' T, up to the thickness from which no wave returns and the plate is a half-space: [`plate_thickness_factor`].

use fem_material::Material;

use crate::error::LawError;
use crate::hertz::HertzImpact;
use crate::numerics::power;

/// λ from which a ball sinks in with the plate: the restitution by Zener's equation, 0.679 λ⁻⁵, is then below
/// [`MIN_RESTITUTION`](crate::MIN_RESTITUTION).
pub const SINKING_LAMBDA: f64 = 3.7;

/// d ln e/dλ at small λ, ⅘ (5/4)^(8/5) B(8/5, ½).
pub const LOSS_PER_LAMBDA: f64 = 1.7302;

/// Returns the point mobility β of an infinite thin plate, m/(N s), with the instantaneous moduli; `thickness` is in metres.
pub fn plate_mobility(material: &Material, thickness: f64) -> f64 {
    let stiffness = material.instantaneous().plane_strain_modulus() * thickness.powi(3) / 12.0;
    (8.0 * (stiffness * material.density() * thickness).sqrt()).recip()
}

/// Returns the distance that waves of the speed √(E/ρ) of a plate travel during Hertz' contact, over its thickness (m): c₀T/h.
pub fn plate_wave_travel(hertz: &HertzImpact, material: &Material, thickness: f64) -> f64 {
    let modulus = material.instantaneous().youngs_modulus();
    (modulus / material.density()).sqrt() * hertz.contact_time() / thickness
}

/// A plate, free on its lower face, that a body strikes.
#[derive(Debug, Clone, PartialEq)]
pub struct FreePlate {
    /// Material of the plate.
    pub material: Material,
    /// Thickness h, m.
    pub thickness: f64,
    /// Diameter, m; infinite for a plate without an edge.
    pub diameter: f64,
}

impl FreePlate {
    /// Returns the point mobility of a thin plate without an edge, m/(N s).
    pub fn thin_mobility(&self) -> f64 {
        plate_mobility(&self.material, self.thickness)
    }

    /// Returns the same with the plate's finite thickness in an impact, m/(N s).
    pub fn mobility(&self, hertz: &HertzImpact) -> f64 {
        let travel = plate_wave_travel(hertz, &self.material, self.thickness);
        self.thin_mobility() * plate_thickness_factor(&self.material, travel)
    }

    /// Returns [`FreePlate::mobility`]; `None` if no wave returns from the lower
    /// face within the contact, which leaves a half-space.
    ///
    /// # Errors
    /// Surface waves come back from the edge within the contact.
    pub fn mobility_in(&self, hertz: &HertzImpact) -> Result<Option<f64>, LawError> {
        let Self { material, diameter, .. } = self;
        let contact_time = hertz.contact_time();
        let value = crate::rayleigh_wave_speed(material) * contact_time / diameter;
        if value > 1.0 {
            let quantity = "way of surface waves within the contact / diameter of the plate";
            return Err(LawError::OutsideValidity { quantity, value, limit: 1.0 });
        }
        Ok((!self.is_half_space(hertz)).then(|| self.mobility(hertz)))
    }

    /// Returns whether no wave returns from the lower face within Hertz' contact.
    pub fn is_half_space(&self, hertz: &HertzImpact) -> bool {
        self.material.dilatational_wave_speed() * hertz.contact_time() < 2.0 * self.thickness
    }
}

/// Returns the factor by which a plate's finite thickness enlarges its mobility, for c₀T/h: a fit to explicit elements, whose relative
/// error in the loss 1 − e is [`plate_thickness_error`].
pub fn plate_thickness_factor(material: &Material, wave_travel: f64) -> f64 {
    let (x, nu) = (wave_travel.recip(), material.instantaneous().poissons_ratio());
    1.0 + 2.2 * x * (1.0 - nu * nu).sqrt() + 28.0 * power(x, 3.8)
}

/// Returns the relative error of the loss on a plate with that factor: 2 % of thin plates, 10 % where waves travel two thicknesses.
pub fn plate_thickness_error(wave_travel: f64) -> f64 {
    0.015 + 0.2 / wave_travel
}

/// Returns what a strongly damped contact adds to the relative error of the contact time on a plate, for Zener's λ. Above about 1.4 the ball
/// hardly separates, and explicit elements part earlier: at λ = 2.3, 3.9 and 8.2 by 5, 11 and 33 % of the contact time.
pub fn plate_slow_contact_error(lambda: f64) -> f64 {
    0.07 * (lambda - 1.3).max(0.0)
}

/// Returns Zener's λ of an impact on a plate of this mobility, m/(N s).
pub fn plate_lambda(hertz: &HertzImpact, mobility: f64) -> f64 {
    let mass = hertz.pair().effective_mass();
    let rate = power(hertz.stiffness() / mass, 0.4) * power(hertz.approach_speed(), 0.2);
    mobility * mass * rate
}
