//! Large strains and rotations, with the energy that a material stores beyond Hooke's law
//! ([`HyperelasticLaw`]).
//!
//! Decided by what leaving it out would change ([`Departure`]), which depends on the law, on Poisson's
//! ratio and on the strain of the body, a share of the contact radius over the effective radius:
//!
//! ```math
//! s_b = w_b \frac{a}{R^*}, \qquad w_b = \frac{E^*}{E_b/(1-\nu_b^2)}, \qquad
//! \frac{\Delta T}{T} = \sum_b w_b \left.\frac{\Delta T}{T}\right|_{\text{wall}}(s_b)
//! ```
//!
//! so that half of a collision of like bodies is as strained as the whole. A body that hardly strains
//! stays at small strain beside one that does.

mod departure;
mod measured;

use fem_case::{Body, EffectsTable, Scene, Switch};
use fem_collision::Collision;
use fem_explicit::MOST_FINITE_STRAIN_TERMS;
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;

use self::departure::Departure;
use super::answer::Answer;
use super::effect::Effect;
use super::left_out::LeftOut;
use super::need::{Need, percent};
use crate::estimate::Estimate;
use crate::expected::Expected;
use crate::refusal::Refusal;

/// Contact radius over the effective radius beyond which nothing is foretold.
const LARGEST_STRAIN: f64 = 1.0;
/// Largest Poisson's ratio that the elements bear at large strain: beyond it the volume is nearly
/// fixed and the step of time next to nothing.
const LARGEST_POISSONS_RATIO: f64 = 0.495;
/// Share of the tolerance below which a body's own strain is left small.
const OWN_SHARE: f64 = 0.1;

/// Large strains and rotations.
#[derive(Clone, Copy, Debug)]
pub struct FiniteStrain;

impl FiniteStrain {
    /// Its name in results.
    pub const NAME: &'static str = "finite strain";

    /// The laws of both bodies of a scene whose strains are those of an estimate; `None` of one that is
    /// computed at small strain.
    pub(crate) fn laws(scene: &Scene, estimate: &Estimate) -> [Option<HyperelasticLaw>; 2] {
        let is_called_for = is_called_for(scene, estimate);
        let is_finite = |strained: &Strained| match scene.effects().finite_strain {
            Some(Switch::On) => true,
            Some(Switch::Off) => false,
            None | Some(Switch::Auto) => {
                is_called_for && strained.is_borne() && strained.matters(scene)
            }
        };
        let of_both = Strained::of_both(scene, estimate);
        of_both.map(|strained| Some(strained.filter(is_finite)?.material.law()))
    }

    /// A scene that is forced to large strain must be one that the elements bear.
    ///
    /// # Errors
    /// A Poisson's ratio too near 1/2, or too many terms of relaxation.
    pub(crate) fn check(scene: &Scene, estimate: &Estimate) -> Result<(), Refusal> {
        let mut strained = Strained::of_both(scene, estimate).into_iter().flatten();
        let unborne = strained.find(|strained| !strained.is_borne());
        let Some(strained) = unborne.filter(|_| is_forced_on(scene)) else { return Ok(()) };
        let message = format!("finite strain is forced on, and {}", strained.not_borne());
        let help = "change the material, or write \"auto\" or \"off\"";
        Err(Refusal::new("effects.finite_strain", message).with_help(help))
    }

    /// What explicit elements have of it.
    pub(crate) fn of_elements(scene: &Scene, estimate: &Estimate) -> Answer {
        let strained = Strained::of_both(scene, estimate).into_iter().flatten();
        let mut unborne =
            strained.filter(|strained| !strained.is_borne() && strained.matters(scene));
        let is_open = scene.effects().finite_strain.is_none_or(|switch| switch == Switch::Auto);
        let is_asked = is_open && is_called_for(scene, estimate);
        let Some(strained) = unborne.next().filter(|_| is_asked) else {
            return Answer::Computes { idle: "" };
        };
        let why = format!("called for, but {}", strained.not_borne());
        let left_out = FiniteStrain.left_out(scene, estimate).unwrap_or_default();
        let warning = format!("{} is {why}; small strain leaves out {left_out}", Self::NAME);
        let active = Self::laws(scene, estimate).iter().any(Option::is_some);
        Answer::is(active, why).warning([warning])
    }
}

/// A body that gives way, of which finite strain changes something.
struct Strained<'a> {
    name: &'a str,
    material: &'a Material,
    /// What its own strain changes of the collision.
    departure: Departure,
    /// How far laws are apart in what it changes of the contact time, as a share.
    spread: f64,
}

impl<'a> Strained<'a> {
    /// Both bodies of a scene; `None` of a rigid one.
    fn of_both(scene: &'a Scene, estimate: &Estimate) -> [Option<Self>; 2] {
        let compliance = |body: &Body| {
            body.material().map_or(0.0, |m| 1.0 / m.instantaneous().plane_strain_modulus())
        };
        let sum: f64 = scene.bodies().iter().map(compliance).sum();
        scene.bodies().each_ref().map(|body| {
            let material = body.material()?;
            let share = compliance(body) / sum;
            let nu = material.instantaneous().poissons_ratio();
            let strain = share * estimate.strain;
            let departure = share * Departure::up_to(material.law(), nu, strain);
            let times = HyperelasticLaw::ALL
                .map(|law| share * Departure::on_a_wall(law, nu, strain).contact_time);
            let (least, most) = times
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(*t), b.max(*t)));
            Some(Self { name: body.name(), material, departure, spread: most - least })
        })
    }

    /// Whether elements bear it at large strain.
    fn is_borne(&self) -> bool {
        // Made of two moduli it is rounded.
        let nu = self.material.instantaneous().poissons_ratio();
        nu <= LARGEST_POISSONS_RATIO + 1e-9 && self.n_terms() <= MOST_FINITE_STRAIN_TERMS
    }

    /// Prony terms whose history would be kept.
    fn n_terms(&self) -> usize {
        self.material.relaxation().map_or(0, |series| series.terms().len())
    }

    fn not_borne(&self) -> String {
        let n_terms = self.n_terms();
        if n_terms > MOST_FINITE_STRAIN_TERMS {
            return format!(
                "{} relaxes with {n_terms} terms, of which elements bear {MOST_FINITE_STRAIN_TERMS} at \
                 large strain",
                self.name
            );
        }
        let nu = (self.material.instantaneous().poissons_ratio() * 1e9).round() / 1e9;
        format!(
            "Poisson's ratio {nu} of {} is above {LARGEST_POISSONS_RATIO}, the largest that elements \
             bear at large strain",
            self.name
        )
    }

    /// Whether its own strain is worth its price.
    fn matters(&self, scene: &Scene) -> bool {
        self.departure.over(&scene.accuracy()) > OWN_SHARE
    }
}

/// What leaving it out changes.
fn departure(scene: &Scene, estimate: &Estimate) -> Departure {
    let both = Strained::of_both(scene, estimate).into_iter().flatten();
    both.map(|strained| strained.departure).sum()
}

/// How far laws are apart in the contact time, as a share.
fn spread(scene: &Scene, estimate: &Estimate) -> f64 {
    Strained::of_both(scene, estimate).into_iter().flatten().map(|strained| strained.spread).sum()
}

fn is_forced_on(scene: &Scene) -> bool {
    scene.effects().finite_strain == Some(Switch::On)
}

/// Whether leaving it out would change more than the case allows.
fn is_called_for(scene: &Scene, estimate: &Estimate) -> bool {
    departure(scene, estimate).over(&scene.accuracy()) > 1.0
}

/// What leaving it out changes, in words.
fn in_words(scene: &Scene, estimate: &Estimate) -> String {
    match estimate.strain > LARGEST_STRAIN {
        true => "an amount that nothing foretells".to_string(),
        false => departure(scene, estimate).in_words(),
    }
}

/// The laws of a scene's bodies, and how much they would matter if nobody gave them.
fn laws_in_words(scene: &Scene, estimate: &Estimate) -> String {
    let materials: Vec<&Material> = scene.bodies().iter().filter_map(Body::material).collect();
    let mut names: Vec<&str> = materials.iter().map(|material| material.law().name()).collect();
    names.dedup();
    let names = names.join(" and ");
    match materials.iter().all(|material| material.named_law().is_some()) {
        true => names,
        false => format!(
            "{names}, which the case does not say: laws differ by up to {} of the contact time",
            percent(spread(scene, estimate))
        ),
    }
}

impl Effect for FiniteStrain {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn switch(&self, effects: &EffectsTable) -> Option<Switch> {
        effects.finite_strain
    }

    fn need(&self, scene: &Scene, estimate: &Estimate) -> Option<Need> {
        let open = in_words(scene, estimate);
        let is_called_for = is_called_for(scene, estimate);
        let warning = is_called_for.then(|| {
            format!(
                "the contact radius is {} of the effective radius, where small strain is off by \
                 {open}; explicit elements (model.fem) have finite strain",
                percent(estimate.strain),
            )
        });
        Some(Need {
            is_called_for,
            number: format!(
                "contact radius / effective radius = {:.3}, law {}",
                estimate.strain,
                laws_in_words(scene, estimate)
            ),
            otherwise: format!("small strain leaves out {open}"),
            left_open: format!("{open} is left out"),
            warning,
        })
    }

    fn left_out(&self, scene: &Scene, estimate: &Estimate) -> Option<LeftOut> {
        if estimate.strain > LARGEST_STRAIN {
            return Some(LeftOut::default());
        }
        let Departure { restitution, contact_time, peak_force, .. } = departure(scene, estimate);
        let shares = LeftOut::shares(estimate, contact_time, peak_force);
        // What relaxes loses with the time that it has, if less than in proportion.
        let impact = Expected::of(scene, estimate.hertz.approach_speed(), false).ok();
        let loss = impact.map_or(0.0, |impact| 1.0 - impact.restitution);
        let restitution = restitution.abs() + 0.5 * (loss * contact_time).abs();
        Some(LeftOut { restitution: Some(restitution), ..shares })
    }

    /// The estimate warns of what it expects; this is what came.
    fn after(&self, scene: &Scene, estimate: &Estimate, collision: &Collision) -> Vec<String> {
        let radius = estimate.hertz.pair().effective_radius();
        let strain = collision.max_contact_radius.unwrap_or_default() / radius;
        let found = Estimate { strain, ..*estimate };
        let is_news = !is_called_for(scene, estimate) && is_called_for(scene, &found);
        let is_small = Self::laws(scene, estimate) == [None; 2];
        let news = (is_news && is_small).then(|| {
            format!(
                "the contact radius grew to {:.0} % of the effective radius, where small strain is off \
                 by {}; force finite strain on (effects.finite_strain)",
                100.0 * strain,
                in_words(scene, &found)
            )
        });
        let spread = spread(scene, &found);
        let mut materials = scene.bodies().iter().filter_map(Body::material);
        let is_unnamed = materials.any(|material| material.named_law().is_none());
        let matters = spread > scene.accuracy().contact_time;
        let law = (is_unnamed && matters).then(|| {
            format!(
                "how the materials go on beyond Hooke's law changes the contact time by up to {}, and \
                 the case does not say: name a law (material.NAME.hyperelastic)",
                percent(spread)
            )
        });
        news.into_iter().chain(law).collect()
    }
}
