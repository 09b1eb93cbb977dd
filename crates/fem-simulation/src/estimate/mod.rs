//! Closed-form estimates of a collision before the run.

pub(crate) mod approach;
pub(crate) mod effective_modulus;
pub(crate) mod plastic_flow;
pub(crate) mod plate_impact;
pub(crate) mod quasi_static;
pub(crate) mod semi_infinite_partner;
pub(crate) mod viscous_flow;

use std::borrow::Cow;

use fem_case::{Body, ModelChoice, Scene};
use fem_collision::Expectation;
use fem_laws::{HertzImpact, ImpactQuantities, LawError, Pair, Partner};
use fem_material::engineering::{number, show};
use fem_material::{ElasticModuli, Material};

use crate::estimate::effective_modulus::{EffectiveModuli, sizes_of};
use crate::estimate::plastic_flow::flowing_impact;
use crate::estimate::plate_impact::{PlateImpact, thin_plate_mobility};
use crate::estimate::quasi_static::KnownImpacts;
use crate::rejection::Rejection;

/// Least share of a modulus in the estimate: a relaxing body is stopped by its first, stiff response.
const MIN_MODULUS: f64 = 0.05;
/// Loss of the moduli during the contact above which Ting's impact gives the effective moduli, and viscosity stops the bodies.
const LARGE_LOSS_OF_MODULI: f64 = 0.5;
/// Contact radius over effective radius from which strains are large: they fall little up to the body's end.
pub(crate) const LARGE_STRAIN: f64 = 0.1;

/// Closed-form estimates of a collision, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Hertz' impact with instantaneous moduli.
    pub hertz: HertzImpact,
    /// The impact of a body that flows plastically, by closed forms; `None` if none does or the model is elastic.
    pub flow: Option<ImpactQuantities>,
    /// Contact time with plastic flow, or with the moduli relaxed to the middle of the contact, s.
    pub contact_time: f64,
    /// Largest approach with plastic flow, or with the moduli relaxed to the middle of the contact, m.
    pub approach: f64,
    /// Largest contact radius with plastic flow, or with the moduli relaxed to the middle of the contact, m.
    pub contact_radius: f64,
    /// Whether a plate bends under the impact.
    pub bends: bool,
    /// Smallest radius of a sphere of the scene, m.
    pub smallest_radius: f64,
    /// Largest contact radius over effective radius, a measure of the strain.
    pub strain: f64,
    /// Approach speed over the slowest shear wave speed.
    pub mach: f64,
    /// Equivalent speed ratio of bulk waves that are slower than shear waves (`ringing`); 0 unless Poisson's ratio is
    /// negative.
    pub ringing: f64,
    /// Share of its modulus that the more relaxing body loses during the contact, Σ g (1 − exp(−T/τ)).
    pub relaxed: f64,
    /// The contact with effective moduli, by which effects are judged; Hertz' contact for elastic bodies.
    pub effective: EffectiveModuli,
    /// Speed ratio [`Estimate::mach`] with the effective moduli.
    pub effective_mach: f64,
    /// Speed ratio [`Estimate::ringing`] with the effective moduli.
    pub effective_ringing: f64,
    /// The impacts that are known of the scene and its variants.
    pub(crate) impacts: KnownImpacts,
}

impl Estimate {
    /// Returns the expected contact time and approach for the run.
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
    /// Those of [`Estimate::of`].
    pub fn at(scene: &Scene, speed: f64) -> Result<Self, LawError> {
        Self::with_known(scene, speed, KnownImpacts::default())
    }

    /// Returns the estimate of a variant of the scene at an approach speed (m/s), with the impacts that are known already.
    ///
    /// # Errors
    /// Those of [`Estimate::of`].
    pub(crate) fn of_variant(&self, scene: &Scene, speed: f64) -> Result<Self, LawError> {
        Self::with_known(scene, speed, self.impacts.clone())
    }

    /// Returns a variant of the scene in its regime at the speed of this estimate.
    ///
    /// # Errors
    /// Those of [`Estimate::of`].
    pub(crate) fn regime_of(&self, scene: Scene) -> Result<Regime, LawError> {
        let estimate = self.of_variant(&scene, self.hertz.approach_speed())?;
        Ok(Regime { scene, estimate })
    }

    fn with_known(scene: &Scene, speed: f64, impacts: KnownImpacts) -> Result<Self, LawError> {
        let hertz = HertzImpact::new(&pair_at(scene, 0.0, MIN_MODULUS)?, speed)?;
        let relaxed_impact = relaxed_to_middle(scene, hertz);
        let spheres = scene.bodies().iter().filter_map(Body::diameter);
        let is_elastic = matches!(
            scene.model(),
            ModelChoice::Condensed(_) | ModelChoice::Ting { .. } | ModelChoice::Hertz { .. }
        );
        // A plate takes part of the force and lengthens the contact.
        let bent = thin_plate_mobility(scene).and_then(|_| {
            let impact = impacts.on_half_spaces(scene, hertz.pair(), speed).ok()?;
            let last = impact.history.last().map_or(0.0, |instant| instant.time);
            let sizes = sizes_of(&impact, &relaxed_impact);
            Some(ImpactQuantities { contact_time: sizes.contact_time.max(last), ..sizes })
        });
        // A ball that sinks in with its plate is stopped as an elastic one is.
        let stopped = bent.map_or(relaxed_impact.contact_time(), |bent| bent.contact_time);
        let flow = flowing_impact(scene, &hertz, None).filter(|_| !is_elastic);
        let flow = flow.map(|impact| match impact.quantities.contact_time.is_finite() {
            true => impact.quantities,
            false => ImpactQuantities { contact_time: stopped, ..impact.quantities },
        });
        let sizes = flow.or(bent).unwrap_or_else(|| ImpactQuantities::from(&relaxed_impact));
        let contact_radius = sizes.max_contact_radius;
        let contact_time = relaxed_impact.contact_time();
        let relaxed = scene.bodies().iter().filter_map(|body| body.material()?.relaxation());
        let relaxed =
            relaxed.map(|series| 1.0 - series.relaxation(contact_time)).fold(0.0, f64::max);
        let effective = match relaxed > LARGE_LOSS_OF_MODULI {
            true => EffectiveModuli::much(scene, &hertz, &impacts).ok(),
            false => None,
        };
        let middle = if relaxed > 0.0 { 0.5 * contact_time } else { 0.0 };
        let mut effective =
            effective.unwrap_or_else(|| EffectiveModuli::little(&relaxed_impact, middle));
        if let Some(bent) = bent {
            effective.sizes = bent;
        }
        let twin = effective.elastic_equivalent(scene);
        let mut estimate = Self {
            hertz,
            flow,
            contact_time: sizes.contact_time,
            approach: sizes.max_approach,
            contact_radius,
            bends: false,
            smallest_radius: 0.5 * spheres.fold(f64::INFINITY, f64::min),
            strain: contact_radius / hertz.pair().effective_radius(),
            mach: mach(scene, speed),
            ringing: ringing(scene, hertz.contact_time()),
            relaxed,
            effective,
            effective_mach: mach(&twin, speed),
            effective_ringing: ringing(&twin, effective.hertz.contact_time()),
            impacts,
        };
        estimate.bends =
            PlateImpact::of(scene, &estimate).is_some_and(|plate| !plate.is_half_space());
        Ok(estimate)
    }
}

/// A scene for which a model is built, and its estimate.
#[derive(Clone, Debug)]
pub struct Regime {
    /// The scene of the collision.
    pub scene: Scene,
    /// Closed-form estimate of its collision.
    pub estimate: Estimate,
}

impl Regime {
    /// Estimates a scene.
    ///
    /// # Errors
    /// Those of [`Estimate::of`], as a fault of the scene; masses out of the range of f64.
    pub fn of(scene: Scene) -> Result<Self, Rejection> {
        Self::with_known(scene, KnownImpacts::default())
    }

    /// Estimates a variant of the scene, with the impacts that are known already.
    ///
    /// # Errors
    /// Those of [`Regime::of`].
    pub(crate) fn variant(&self, scene: Scene) -> Result<Self, Rejection> {
        Self::with_known(scene, self.estimate.impacts.clone())
    }

    /// Returns the estimate of the scene at an approach speed, m/s.
    ///
    /// # Errors
    /// Those of [`Estimate::of`].
    pub(crate) fn at(&self, speed: f64) -> Result<Cow<'_, Estimate>, LawError> {
        match speed == self.estimate.hertz.approach_speed() {
            true => Ok(Cow::Borrowed(&self.estimate)),
            false => self.estimate.of_variant(&self.scene, speed).map(Cow::Owned),
        }
    }

    /// Estimates a scene with the impacts that are known already.
    ///
    /// # Errors
    /// Those of [`Regime::of`].
    pub(crate) fn with_known(scene: Scene, known: KnownImpacts) -> Result<Self, Rejection> {
        let rejected = |why: String| {
            Rejection::new("body", format!("the collision cannot be estimated: {why}"))
                .with_help("check sizes, densities, moduli and speeds, and their units")
        };
        // An infinite mass would count as a wall, and products of masses must be finite too.
        let bodies = scene.bodies().iter().enumerate();
        let mut masses = bodies.filter_map(|(k, body)| Some((k, body, body.mass()?)));
        if let Some((k, body, mass)) = masses.find(|(_, _, mass)| !(mass * mass).is_normal()) {
            let (density, diameter) = (body.material().map(Material::density), body.diameter());
            // The factor that is farther from 1 in SI, by its power in the mass, is the likely cause.
            let far = |value: Option<f64>| value.map_or(0.0, |value| value.log10().abs());
            let is_density = far(density) > 3.0 * far(diameter);
            let (part, of) = match is_density {
                true => {
                    ("material", format!("density is {} kg/m^3", number(density.unwrap_or(0.0), 4)))
                }
                false => (
                    "sphere.diameter",
                    format!("diameter is {}", show(diameter.unwrap_or(0.0), "m")),
                ),
            };
            let mut rejection = rejected(format!(
                "the mass of {} is {} kg, since its {of}; its square must be a number",
                body.name(),
                number(mass, 4)
            ));
            rejection.key = format!("body.{k}.{part}");
            return Err(rejection);
        }
        match Estimate::with_known(&scene, scene.approach_speed(), known) {
            Ok(estimate) => Ok(Self { scene, estimate }),
            Err(error) => Err(rejected(error.to_string())),
        }
    }
}

/// Returns Hertz' impact of a scene with the moduli relaxed to the middle of its contact. The contact time depends weakly on the
/// moduli: a few passes converge.
fn relaxed_to_middle(scene: &Scene, hertz: HertzImpact) -> HertzImpact {
    let relaxed = |impact: &HertzImpact| {
        let pair = pair_at(scene, 0.5 * impact.contact_time(), MIN_MODULUS).ok()?;
        HertzImpact::new(&pair, impact.approach_speed()).ok()
    };
    std::iter::successors(Some(hertz), relaxed).take(9).last().unwrap_or(hertz)
}

/// Returns a speed (m/s) over the slowest shear wave speed of a scene's bodies.
pub(crate) fn mach(scene: &Scene, speed: f64) -> f64 {
    let materials = scene.bodies().iter().filter_map(Body::material);
    speed / materials.map(|m| m.shear_wave_speed()).fold(f64::INFINITY, f64::min)
}

/// Diameters that bulk waves travel in a contact whose vibrations are those of an impact at the shear wave speed.
const DIAMETERS_OF_RINGING: f64 = 1.05;

/// Returns the equivalent speed ratio of a scene in a contact of this duration (s): the approach speed over the shear wave
/// speed at which bodies with faster bulk waves would vibrate as much.
///
/// A body that is far stiffer in shear than in compression has a small and short contact, during which it does not follow
/// as a whole. The vibration energy grows with the fifth power of its diameter over the path of the bulk waves,
/// √(3K/2ρ) T, as for other bodies, whose T goes with v^(−1/5). The factor is fitted to elements of the glass pair with
/// ν = −0.99, which lose 0.7 % of the restitution; with ν = −0.9 it gives 1.3e-4 where elements lose 1.5e-4.
fn ringing(scene: &Scene, contact_time: f64) -> f64 {
    let of_body = |body: &Body| {
        let (material, diameter) = (body.material()?, body.diameter()?);
        let bulk = (1.5 * material.instantaneous().bulk_modulus() / material.density()).sqrt();
        let is_slow = bulk < material.shear_wave_speed();
        is_slow.then(|| (DIAMETERS_OF_RINGING * diameter / (bulk * contact_time)).powi(5).min(1.0))
    };
    scene.bodies().iter().filter_map(of_body).fold(0.0, f64::max)
}

/// Returns the pair with the moduli at a time (s) after a sudden load, at least a share `least` of the instantaneous ones.
pub(crate) fn pair_at(scene: &Scene, time: f64, least: f64) -> Result<Pair, LawError> {
    let [first, second] = scene.bodies().each_ref().map(|body| {
        let mut partner = body.partner();
        if let (
            Partner::Sphere { plane_strain_modulus, .. }
            | Partner::HalfSpace { plane_strain_modulus },
            Some(material),
        ) = (&mut partner, body.material())
        {
            *plane_strain_modulus = modulus_at(material, time, least);
        }
        partner
    });
    Pair::new(first, second)
}

/// Returns the plane strain modulus E/(1 − ν²), Pa, at a time (s) after a sudden load, with this least share.
fn modulus_at(material: &Material, time: f64, least: f64) -> f64 {
    let now = material.instantaneous();
    let bulk = material.bulk_modulus_at(time).max(least * now.bulk_modulus());
    let shear = material.shear_modulus_at(time).max(least * now.shear_modulus());
    ElasticModuli::from_bulk_shear(bulk, shear).map_or(0.0, |moduli| moduli.plane_strain_modulus())
}
