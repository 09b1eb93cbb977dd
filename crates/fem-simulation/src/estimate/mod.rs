//! Closed-form estimates of a collision before the run.

pub(crate) mod approach;
pub(crate) mod duration;
pub(crate) mod effective_modulus;
pub(crate) mod quasi_static;
pub(crate) mod semi_infinite_partner;
pub(crate) mod viscous_flow;

use fem_case::{Body, Scene, Shape};
use fem_collision::Expectation;
use fem_laws::{HertzImpact, LawError, Pair, Partner};
use fem_material::engineering::number;
use fem_material::{ElasticModuli, Material};

use crate::estimate::effective_modulus::EffectiveModuli;
use crate::rejection::Rejection;

/// Least share of a modulus that the estimate counts with: a body that relaxes
/// within the contact is stopped by its first, stiff response.
const LEAST_MODULUS: f64 = 0.05;
/// Bodies that lose more of their moduli over the contact are met by what Ting's impact tells.
const MUCH: f64 = 0.5;

/// Closed-form estimates of a collision, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Hertz with instantaneous moduli.
    pub hertz: HertzImpact,
    /// Contact time with the moduli relaxed to the middle of the contact, s.
    pub contact_time: f64,
    /// Largest approach with the moduli relaxed to the middle of the contact, m.
    pub approach: f64,
    /// Largest contact radius with the moduli relaxed to the middle of the contact, m.
    pub contact_radius: f64,
    /// Smallest radius of a sphere of the scene, m.
    pub smallest_radius: f64,
    /// Largest contact radius over effective radius: the size of the strain.
    pub strain: f64,
    /// Approach speed over the slowest shear wave speed.
    pub mach: f64,
    /// What bulk waves that are slower than those of shear are worth as such a share: 0 of bodies without, of
    /// which Poisson's ratio is not negative.
    pub ringing: f64,
    /// Σ g (1 − exp(−T/τ)) of the body that relaxes most: the share of its
    /// modulus that is lost over the contact.
    pub relaxed: f64,
    /// The contact as relaxation makes it, by which effects are judged: Hertz' of elastic bodies.
    pub effective: EffectiveModuli,
    /// As [`Estimate::mach`], of the moduli that the contact meets.
    pub effective_mach: f64,
    /// As [`Estimate::ringing`], of the moduli that the contact meets.
    pub effective_ringing: f64,
}

impl Estimate {
    /// Returns the estimate of a scene for which a model is built.
    ///
    /// # Errors
    /// As [`Estimate::of`], as a fault of the scene; masses that no f64 holds.
    pub fn checked(scene: &Scene) -> Result<Self, Rejection> {
        let refused = |why: String| {
            Rejection::new("body", format!("the collision cannot be estimated: {why}"))
                .with_help("check sizes, densities, moduli and speeds, and their units")
        };
        // What overflows would count as a wall, and products of masses have to be numbers too.
        let bodies = scene.bodies().iter().enumerate();
        let mut masses = bodies.filter_map(|(k, body)| Some((k, body, body.mass()?)));
        if let Some((k, body, mass)) = masses.find(|(_, _, mass)| !(mass * mass).is_normal()) {
            let (density, diameter) = (body.material().map(Material::density), body.diameter());
            // Whichever is farther from 1 in SI, by the power it has in the mass.
            let far = |value: Option<f64>| value.map_or(0.0, |value| value.log10().abs());
            let is_density = far(density) > 3.0 * far(diameter);
            let (part, of) = match is_density {
                true => {
                    ("material", format!("density is {} kg/m^3", number(density.unwrap_or(0.0), 4)))
                }
                false => (
                    "sphere.diameter",
                    format!("diameter is {} m", number(diameter.unwrap_or(0.0), 4)),
                ),
            };
            let mut refusal = refused(format!(
                "the mass of {} is {} kg, since its {of}; its square must be a number",
                body.name(),
                number(mass, 4)
            ));
            refusal.key = format!("body.{k}.{part}");
            return Err(refusal);
        }
        Self::of(scene).map_err(|error| refused(error.to_string()))
    }

    /// What a run is told to expect.
    pub fn expectation(&self) -> Expectation {
        Expectation { contact_time: self.contact_time, approach: self.approach }
    }

    /// Returns the closed-form estimate of a scene.
    ///
    /// # Errors
    /// Numbers so extreme that Hertz' values leave the range of f64.
    pub fn of(scene: &Scene) -> Result<Self, LawError> {
        Self::at(scene, scene.approach_speed())
    }

    /// Returns the closed-form estimate at another approach speed (m/s).
    ///
    /// # Errors
    /// As [`Estimate::of`].
    pub fn at(scene: &Scene, speed: f64) -> Result<Self, LawError> {
        let hertz = HertzImpact::new(&pair_at(scene, 0.0, LEAST_MODULUS)?, speed)?;
        let mut relaxed_impact = hertz;
        // The contact time hardly depends on the moduli; a few passes settle it.
        for _ in 0..8 {
            let half = 0.5 * relaxed_impact.contact_time();
            let pair = pair_at(scene, half, LEAST_MODULUS);
            match pair.and_then(|pair| HertzImpact::new(&pair, speed)) {
                Ok(next) => relaxed_impact = next,
                Err(_) => break,
            }
        }
        let spheres = || scene.bodies().iter().filter_map(Body::diameter);
        let smallest_radius = 0.5 * spheres().fold(f64::INFINITY, f64::min);
        let contact_radius = relaxed_impact.max_contact_radius();
        let materials = || scene.bodies().iter().filter_map(Body::material);
        let contact_time = relaxed_impact.contact_time();
        let relaxed = materials()
            .filter_map(|material| material.relaxation())
            .map(|series| 1.0 - series.relaxation(contact_time))
            .fold(0.0, f64::max);
        let effective = match relaxed > MUCH {
            true => EffectiveModuli::much(scene, &hertz).ok(),
            false => None,
        };
        let middle = if relaxed > 0.0 { 0.5 * contact_time } else { 0.0 };
        let effective =
            effective.unwrap_or_else(|| EffectiveModuli::little(&relaxed_impact, middle));
        let twin = effective.twin(scene);
        Ok(Self {
            hertz,
            contact_time,
            approach: relaxed_impact.max_approach(),
            contact_radius,
            smallest_radius,
            strain: contact_radius / hertz.pair().effective_radius(),
            mach: mach(scene, speed),
            ringing: ringing(scene, hertz.contact_time()),
            relaxed,
            effective,
            effective_mach: mach(&twin, speed),
            effective_ringing: ringing(&twin, effective.hertz.contact_time()),
        })
    }
}

/// A speed (m/s) over the slowest shear wave speed of a scene's bodies.
pub(crate) fn mach(scene: &Scene, speed: f64) -> f64 {
    let materials = scene.bodies().iter().filter_map(Body::material);
    speed / materials.map(|m| m.shear_wave_speed()).fold(f64::INFINITY, f64::min)
}

/// Diameters that bulk waves go in a contact of which the inertia takes as much as of one at the shear wave
/// speed.
const RINGING: f64 = 1.05;

/// Approach speed over that of shear waves at which bodies whose bulk waves are the faster ones would ring as much as
/// those of a scene, in a contact of so long (s).
///
/// A body that is far stiffer against shear than against pressure touches by a small spot and for a short time, in
/// which it does not follow as a whole. What stays in it goes with the fifth power of its size over the way of
/// its waves, √(3K/2ρ) T, as it does of other bodies, whose T goes with v^(−1/5); the factor is that of the glass
/// pair with ν = −0.99, of which elements keep 0.7 % of the restitution, and gives 1.3e-4 of 1.5e-4 with −0.9.
fn ringing(scene: &Scene, contact_time: f64) -> f64 {
    let of_body = |body: &Body| {
        let (material, diameter) = (body.material()?, body.diameter()?);
        let bulk = (1.5 * material.instantaneous().bulk_modulus() / material.density()).sqrt();
        let is_slow = bulk < material.shear_wave_speed();
        is_slow.then(|| (RINGING * diameter / (bulk * contact_time)).powi(5).min(1.0))
    };
    scene.bodies().iter().filter_map(of_body).fold(0.0, f64::max)
}

/// The pair with moduli as they are `time` (s) after a sudden load, and no less than a share of what they are at once.
///
/// # Errors
/// Numbers that make no pair.
pub(crate) fn pair_at(scene: &Scene, time: f64, least: f64) -> Result<Pair, LawError> {
    let [first, second] = scene.bodies().each_ref().map(|body| match body.shape() {
        Shape::Sphere { diameter, material, .. } => {
            let mass = fem_laws::sphere_mass(*diameter, material.density());
            let plane_strain_modulus = modulus_at(material, time, least);
            let sphere = Partner::Sphere { radius: 0.5 * diameter, mass, plane_strain_modulus };
            if body.is_held() { sphere.held() } else { sphere }
        }
        Shape::HalfSpace { material } => {
            Partner::HalfSpace { plane_strain_modulus: modulus_at(material, time, least) }
        }
        Shape::Rigid { .. } | Shape::Wall => body.partner(),
    });
    Pair::new(first, second)
}

/// E/(1 − ν²), Pa, of a material `time` (s) after a sudden load, of moduli that keep at least a share.
fn modulus_at(material: &Material, time: f64, least: f64) -> f64 {
    let now = material.instantaneous();
    let bulk = material.bulk_modulus_at(time).max(least * now.bulk_modulus());
    let shear = material.shear_modulus_at(time).max(least * now.shear_modulus());
    ElasticModuli::from_bulk_shear(bulk, shear).map_or(0.0, |moduli| moduli.plane_strain_modulus())
}
