//! The impact on a plate by closed forms: whether the plate bends within the contact, and as what.
//!
//! Two numbers decide, with the contact time T: how many thicknesses a wave travels within that of Hertz, c₀T/h with
//! c₀ = √(E/ρ), and whether a surface wave comes back from the edge, 2r/c_R < T. While no wave returns from the far face, c_p T < 2h, the plate
//! is a half-space, exactly; far beyond it the plate is thin and a dashpot in series with the contact
//! ([`fem_laws::plate_mobility`]).

use fem_case::{Body, Plate, PlateSupport, Scene};
use fem_laws::{
    FreePlate, HertzImpact, LOSS_PER_LAMBDA, LawError, Pair, SINKING_LAMBDA, plate_lambda,
    plate_mobility, plate_wave_travel, rayleigh_wave_speed,
};
use fem_material::Material;

use crate::estimate::Estimate;
use crate::estimate::effective_modulus::left_at;

/// c₀T/h from which a plate is thin.
pub(crate) const THIN: f64 = 10.0;
/// Deflection over the thickness up to which a plate bends without stretching: linear theory holds "where the maximum deflection
/// does not exceed half the plate thickness" (Case, Chilver & Ross 1999, *Strength of Materials and Structures*, section 19.1).
pub(crate) const LARGE_DEFLECTION: f64 = 0.5;

/// How a plate answers an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlateRegime {
    /// Bending waves of thin-plate theory.
    Thin,
    /// Neither of the two limits.
    Between,
    /// No wave returns from the far face within the contact: a half-space.
    Thick,
}

impl PlateRegime {
    /// Returns the word used in results.
    pub fn word(self) -> &'static str {
        match self {
            Self::Thin => "thin",
            Self::Between => "between",
            Self::Thick => "thick",
        }
    }
}

/// A plate that is struck.
#[derive(Clone, Copy, Debug)]
pub struct PlateImpact<'a> {
    /// The plate and its name.
    pub body: &'a Body,
    /// Sizes and support.
    pub plate: &'a Plate,
    /// Zener's parameter λ of the impact.
    pub lambda: f64,
    /// Thicknesses that waves of the speed √(E/ρ) travel during Hertz' contact.
    pub thicknesses: f64,
    /// Contact times until a surface wave is back from the edge; infinite without an edge, 0 where the contact lasts.
    pub edge_return: f64,
    /// Deflection at the end of the contact over the thickness; 0 for a bonded plate and a half-space.
    pub deflection: f64,
    /// Relative error of the mobility of a plate that relaxes within the contact: half of its growth from a quarter of the contact to
    /// its end, and 0.3 of that before the middle, by 90 runs on plates of 2 to 6 mm beside explicit elements.
    pub relaxation_error: f64,
    /// How the plate answers.
    pub regime: PlateRegime,
}

impl<'a> PlateImpact<'a> {
    /// Returns the impact on the plate of a scene, if it has one.
    pub fn of(scene: &'a Scene, estimate: &Estimate) -> Option<Self> {
        let hertz = &estimate.effective.hertz;
        let contact_time = hertz.contact_time().max(estimate.contact_time);
        let (body, plate, whole) = plate_of(scene)?;
        let material = left_at(whole, estimate.effective.after);
        let way = |speed: f64| speed * contact_time;
        let thicknesses = plate_wave_travel(hertz, &material, plate.thickness);
        let mobility_at = |time: f64| plate_mobility(&left_at(whole, time), plate.thickness);
        let mobility = mobility_at(0.5 * contact_time);
        let grows = |from: f64, to: f64| {
            mobility_at(to * contact_time) / mobility_at(from * contact_time) - 1.0
        };
        let relaxation_error = 0.5 * grows(0.25, 1.0) + 0.3 * grows(0.0, 0.5);
        let lambda = plate_lambda(hertz, mobility);
        let is_thick = way(material.dilatational_wave_speed()) < 2.0 * plate.thickness;
        let regime = match thicknesses {
            _ if is_thick => PlateRegime::Thick,
            THIN.. => PlateRegime::Thin,
            _ => PlateRegime::Between,
        };
        let edge_return = match plate.diameter {
            None => f64::INFINITY,
            Some(_) if lambda >= SINKING_LAMBDA && !is_thick => 0.0,
            Some(diameter) => diameter / way(rayleigh_wave_speed(&material)),
        };
        // A dashpot moves by its mobility times the impulse.
        let momentum = hertz.pair().effective_mass() * hertz.approach_speed();
        let impulse = momentum * (1.0 + (-LOSS_PER_LAMBDA * lambda).exp());
        let deflection = match plate.support {
            PlateSupport::Free if !is_thick => mobility * impulse / plate.thickness,
            _ => 0.0,
        };
        Some(Self {
            body,
            plate,
            lambda,
            thicknesses,
            edge_return,
            deflection,
            relaxation_error,
            regime,
        })
    }

    /// Returns F/(E* h δ) of the plate's own modulus: the share of the approach δ by which its far face makes the contact stiffer
    /// than a half-space; 0 for a bonded plate.
    pub fn local_stiffening(&self, estimate: &Estimate) -> f64 {
        let Some(moduli) = self.body.material().map(Material::instantaneous) else { return 0.0 };
        let own = moduli.plane_strain_modulus();
        let sizes = &estimate.effective.sizes;
        match self.plate.support {
            PlateSupport::Free => {
                sizes.peak_force / (own * self.plate.thickness * sizes.max_approach)
            }
            PlateSupport::Bonded => 0.0,
        }
    }

    /// Returns whether the plate takes the ball with it, so that the contact lasts.
    pub fn lasts(&self) -> bool {
        self.lambda >= SINKING_LAMBDA
            && self.plate.support == PlateSupport::Free
            && self.regime != PlateRegime::Thick
    }

    /// Returns whether no wave returns within the contact from anywhere, so that the plate is a half-space.
    pub fn is_half_space(&self) -> bool {
        self.regime == PlateRegime::Thick && self.edge_return > 1.0
    }

    /// Returns the relative error of linear plate theory, to which stretching of the middle surface adds the square of the
    /// deflection; `None` beyond its limit.
    pub fn linear_theory_error(&self) -> Option<f64> {
        (self.deflection <= LARGE_DEFLECTION).then(|| self.deflection.powi(2))
    }

    /// Returns whether the plate can be a dashpot: it is free below, bends, and no wave returns from its edge.
    pub fn is_dashpot(&self) -> bool {
        self.plate.support == PlateSupport::Free && self.edge_return > 1.0
    }
}

/// Returns the plate of a scene, with its material.
fn plate_of(scene: &Scene) -> Option<(&Body, &Plate, &Material)> {
    let body = scene.bodies().iter().find(|body| body.plate().is_some())?;
    Some((body, body.plate()?, body.material()?))
}

/// Returns the plate of a scene, if it has one that is free below, with the moduli that are left in the middle of Hertz' contact: the
/// bending of a plate that relaxes creeps as the contact does.
pub fn free_plate(scene: &Scene) -> Option<FreePlate> {
    let (_, plate, material) = plate_of(scene)?;
    let hertz = || HertzImpact::new(&scene.pair().ok()?, scene.approach_speed()).ok();
    (plate.support == PlateSupport::Free).then(|| FreePlate {
        material: match material.relaxation().and_then(|_| hertz()) {
            Some(hertz) => left_at(material, 0.5 * hertz.contact_time()),
            None => material.clone(),
        },
        thickness: plate.thickness,
        diameter: plate.diameter.unwrap_or(f64::INFINITY),
    })
}

/// Returns the mobility of the plate of a scene as a thin one, m/(N s).
pub(crate) fn thin_plate_mobility(scene: &Scene) -> Option<f64> {
    free_plate(scene).map(|plate| plate.thin_mobility())
}

/// Returns the same with the finite thickness of the plate, at the approach speed of the scene, for a pair with instantaneous moduli.
///
/// # Errors
/// Numbers so extreme that Hertz' values leave the range of f64.
pub(crate) fn plate_mobility_of(scene: &Scene, pair: &Pair) -> Result<Option<f64>, LawError> {
    let Some(plate) = free_plate(scene) else { return Ok(None) };
    Ok(Some(plate.mobility(&HertzImpact::new(pair, scene.approach_speed())?)))
}
