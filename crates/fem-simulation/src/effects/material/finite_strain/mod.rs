//! Large strains and rotations, with the energy that a material stores beyond Hooke's law
//! ([`HyperelasticLaw`]).
//!
//! Decided by what leaving it out would change ([`Departure`]), which depends on the law, on Poisson's
//! ratio and on the strain of the body, its share of the contact radius over the effective radius. Beyond
//! the first order, the slope k, it depends on how flat a sphere is, a/R_b, if that is more:
//!
//! ```math
//! s_b = w_b \frac{a}{R^*}, \qquad w_b = \frac{E^*}{E_b/(1-\nu_b^2)}, \qquad
//! g_b = \max\Bigl(s_b, \frac a{R_b}\Bigr), \qquad
//! \frac{\Delta T}{T} = \sum_b w_b \Bigl[\left.\frac{\Delta T}{T}\right|_{\text{wall}}(g_b) - k\,(g_b - s_b)\Bigr]
//! ```
//!
//! so that half of a collision of like bodies is as strained as the whole. A body that hardly strains
//! stays at small strain beside one that does. The loss 1 − e that waves take away into a half-space or a
//! large partner goes as the contact time to the power of −2, and adds 2 (1 − e) ΔT/T.
//!
//! Held against runs at a/R* from 0.1 to 0.7 and ν of 0.2 and 0.45, of like, softer, stiffer and steel balls
//! on a half-space, unlike ones of a size, and like ones of sizes 1:3 (`validation/finite_strain_tables.md`): where it matters
//! never less than a third of what is found, and at most three times as much but of half-spaces at ν = 0.2 or
//! pressed by a harder ball, and where a change has turned its sign.

mod departure;
mod measured;
mod strained;

use fem_case::engineering::show;
use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_collision::{Collision, QuantityOfInterest};
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;

use self::departure::Departure;
use self::strained::Strained;
use crate::effects::effect::model_form_error::{EffectStatus, ModelFormError};
use crate::effects::effect::neglect_error::NeglectError;
use crate::effects::effect::relevance::{Relevance, percent};
use crate::effects::effect::support::Support;
use crate::effects::effect::{Effect, FiniteStrain, PartnerWaves};
use crate::effects::ting_prediction::relaxed_loss;
use crate::estimate::Estimate;
use crate::rejection::Rejection;

/// What laws differ by is said from this share of the contact time on.
const ROUNDING: f64 = 5e-5;
/// d ln(1 − e) over −d ln T of what relaxes, about.
const RELAXED_OVER_TIME: f64 = 0.5;
/// What large strains change of that loss at most, over the square of how flat a body is: 1.0 % of it was found at
/// 0.2, 3.6 % at 0.35, of either sign, of spheres on a wall at ν from 0 to 0.49, whatever became of the contact time.
const OF_RELAXED_LOSS: f64 = 0.3;
/// The same of what waves take: energy as T⁻³, of the impulse as it is.
const RADIATED_OVER_TIME: f64 = 2.0;

/// Contact radius over effective radius from which on all elements of a body are at finite strain: it ends where
/// strains have hardly fallen.
const FLAT: f64 = 0.1;
/// Approach speed over that of shear waves from which on they are, too: waves bring strains of its size anywhere.
const SLOW: f64 = 1e-3;
/// Share of what a case allows of a number that may be left out in elements far from the contact. Of elastic glass
/// 7 % of what finite strain changes of the peak force was left out beyond two contact radii, 2.8 % beyond three and
/// 0.5 % beyond five and a half: 0.6 to 0.9 of (a/R)³.
const LEFT_FAR_AWAY: f64 = 0.03;
/// Contact radii within which all elements are at finite strain, whatever the case allows.
const NEAREST: f64 = 3.0;

impl FiniteStrain {
    /// The laws of both bodies of a scene whose strains are those of an estimate; `None` of one that is
    /// computed at small strain.
    pub fn laws(scene: &Scene, estimate: &Estimate) -> [Option<HyperelasticLaw>; 2] {
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

    /// Distance from first touch (m) within which elements are at finite strain: what it changes falls with the
    /// third power of that distance over the contact radius (`fem-explicit/src/stress/partly_finite.rs`). None
    /// where all are: where the case forces it on, in flat contacts and beside waves.
    pub(crate) fn within(scene: &Scene, estimate: &Estimate) -> Option<f64> {
        let is_near = estimate.strain < FLAT && estimate.mach < SLOW && !is_forced_on(scene);
        let change = departure(scene, estimate).over(&scene.accuracy());
        let radii = (change / LEFT_FAR_AWAY).cbrt().max(NEAREST);
        is_near.then_some(radii * estimate.contact_radius)
    }

    /// A scene that is forced to large strain must be one that the elements bear.
    ///
    /// # Errors
    /// A Poisson's ratio too near 1/2, or too many terms of relaxation.
    pub(crate) fn check(scene: &Scene, estimate: &Estimate) -> Result<(), Rejection> {
        let mut strained = Strained::of_both(scene, estimate).into_iter().flatten();
        let unborne = strained.find(|strained| !strained.is_borne());
        let Some(strained) = unborne.filter(|_| is_forced_on(scene)) else { return Ok(()) };
        let message = format!("finite strain is forced on, and {}", strained.not_borne());
        let help = "change the material, or write \"auto\" or \"off\"";
        Err(Rejection::new("effects.finite_strain", message).with_help(help))
    }

    /// Returns the answer of explicit elements.
    pub(crate) fn of_elements(scene: &Scene, estimate: &Estimate) -> Support {
        let strained = Strained::of_both(scene, estimate).into_iter().flatten();
        let mut unborne =
            strained.filter(|strained| !strained.is_borne() && strained.matters(scene));
        let is_open = scene.effects().finite_strain.is_none_or(|switch| switch == Switch::Auto);
        let is_asked = is_open && is_called_for(scene, estimate);
        let Some(strained) = unborne.next().filter(|_| is_asked) else {
            let answer = Self::of_stability(scene, estimate);
            let answer = answer.or_else(|| Self::of_nearness(scene, estimate));
            return answer.unwrap_or(Support::Computes { idle: "" });
        };
        let why = format!("called for, but {}", strained.not_borne());
        let neglect_error = FiniteStrain.neglect_error(scene, estimate).unwrap_or_default();
        let warning = format!("{} is {why}; small strain leaves out {neglect_error}", Self::NAME);
        let active = Self::laws(scene, estimate).iter().any(Option::is_some);
        Support::is(active, why).warning([warning])
    }
}

impl FiniteStrain {
    /// Returns the text for a scene with finite strain near the contact only.
    fn of_nearness(scene: &Scene, estimate: &Estimate) -> Option<Support> {
        (Self::laws(scene, estimate) != [None; 2]).then_some(())?;
        let within = Self::within(scene, estimate)?;
        let is_partial = |body: &Body| body.diameter().is_none_or(|diameter| diameter > within);
        scene
            .bodies()
            .iter()
            .any(|body| body.material().is_some() && is_partial(body))
            .then_some(())?;
        let number = FiniteStrain.relevance(scene, estimate)?.number;
        let nearness = format!(
            "elements within {} of first touch, {:.1} contact radii, have it, and those farther away stay at small \
             strain, which leaves out at most {} % of the tolerance",
            show(within, "m"),
            within / estimate.contact_radius,
            100.0 * LEFT_FAR_AWAY,
        );
        Some(Support::is(true, format!("{number}; {nearness}")))
    }

    /// Returns the text for a scene whose laws are expected to lose stability.
    fn of_stability(scene: &Scene, estimate: &Estimate) -> Option<Support> {
        let computed = Self::laws(scene, estimate);
        if !is_called_for(scene, estimate) || computed == [None; 2] {
            return None;
        }
        let pressure = estimate.hertz.peak_pressure();
        let both = Strained::of_both(scene, estimate).into_iter().zip(computed);
        let mut unstable = both.filter_map(|(body, law)| {
            law?;
            body.filter(|body| body.gives_way(pressure))
        });
        let Strained { name, material, .. } = unstable.next()?;
        let warning = format!(
            "{}, the law of {name}, is foretold to lose its stability under the contact's pressure: elements give \
             way, and the run may stop; name another material.NAME.hyperelastic, as neo-hooke, which is stable at \
             any deformation",
            material.law().name()
        );
        let number = FiniteStrain.relevance(scene, estimate)?.number;
        Some(Support::is(true, number).warning([warning]))
    }
}

/// Returns the error of neglecting it for elastic bodies, as magnitudes.
fn departure(scene: &Scene, estimate: &Estimate) -> Departure {
    let both = Strained::of_both(scene, estimate).into_iter().flatten();
    with_waves(scene, estimate, both.map(|strained| strained.departure).sum())
}

/// Adds the changed radiation of a longer or shorter contact.
fn with_waves(scene: &Scene, estimate: &Estimate, change: Departure) -> Departure {
    let loss = PartnerWaves::loss(scene, estimate);
    let restitution = change.restitution + RADIATED_OVER_TIME * loss * change.contact_time;
    Departure { restitution, ..change }
}

/// Adds the changed loss by relaxation.
fn with_relaxation(scene: &Scene, estimate: &Estimate, change: Departure) -> Departure {
    let lost = RELAXED_OVER_TIME * relaxed_loss(scene, estimate) * change.contact_time;
    Departure { restitution: change.restitution + lost, ..change }
}

/// Returns the spread of the contact time over the laws that the case leaves open, as a share.
fn spread(scene: &Scene, estimate: &Estimate) -> f64 {
    Strained::of_both(scene, estimate).iter().flatten().map(Strained::spread).sum()
}

fn is_forced_on(scene: &Scene) -> bool {
    scene.effects().finite_strain == Some(Switch::On)
}

/// Returns whether neglecting it would exceed the case's tolerance, or cannot be estimated.
fn is_called_for(scene: &Scene, estimate: &Estimate) -> bool {
    is_beyond(scene, estimate) || departure(scene, estimate).over(&scene.accuracy()) > 1.0
}

/// Returns whether a body is flatter than all reference spheres.
fn is_beyond(scene: &Scene, estimate: &Estimate) -> bool {
    let both = Strained::of_both(scene, estimate);
    both.iter().flatten().any(Strained::is_beyond)
}

/// Returns the error of neglecting it, as text.
fn in_words(scene: &Scene, estimate: &Estimate) -> String {
    match is_beyond(scene, estimate) {
        true => "an amount that cannot be estimated".to_string(),
        false => departure(scene, estimate).in_words(),
    }
}

/// Returns the laws of the bodies, and how much they would matter if the case names none.
fn laws_in_words(scene: &Scene, estimate: &Estimate) -> String {
    let materials: Vec<&Material> = scene.bodies().iter().filter_map(Body::material).collect();
    let mut names: Vec<&str> = materials.iter().map(|material| material.law().name()).collect();
    names.dedup();
    let names = names.join(" and ");
    let spread = spread(scene, estimate);
    match spread > ROUNDING {
        false => names,
        true => format!(
            "{names}, which the case does not say: laws differ by {} {} of the contact time",
            if is_beyond(scene, estimate) { "more than" } else { "up to" },
            percent(spread)
        ),
    }
}

impl Effect for FiniteStrain {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let open = in_words(scene, estimate);
        let is_called_for = is_called_for(scene, estimate);
        let warning = is_called_for.then(|| {
            format!(
                "the contact radius is {} of the effective radius, where small strain is off by \
                 {open}; explicit elements (model.fem) have finite strain",
                percent(estimate.strain),
            )
        });
        Some(Relevance {
            is_called_for,
            number: format!(
                "contact radius / effective radius = {:.3}, law {}{}",
                estimate.strain,
                laws_in_words(scene, estimate),
                match is_beyond(scene, estimate) {
                    true => ", flatter than closed forms foretell anything of",
                    false => "",
                }
            ),
            otherwise: format!("small strain leaves out {open}"),
            left_open: format!("{open} is left out"),
            warning,
        })
    }

    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        if is_beyond(scene, estimate) {
            return Some(NeglectError::default());
        }
        let change = with_relaxation(scene, estimate, departure(scene, estimate));
        let shares = NeglectError::shares(estimate, change.contact_time, change.peak_force);
        Some(NeglectError { restitution: Some(change.restitution), ..shares })
    }

    /// Of small strain all that it leaves out by any law that the materials may follow; of finite strain what
    /// their laws may differ from those that were computed where the case names none.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> ModelFormError {
        let computed = if status.is_lacking { [None; 2] } else { Self::laws(scene, estimate) };
        let both = Strained::of_both(scene, estimate);
        let both =
            || both.iter().zip(computed).filter_map(|(body, law)| Some((body.as_ref()?, law)));
        // Of a law that is named and computed nothing is left.
        if both().any(|(body, law)| body.is_beyond() && body.may_differ_from(law)) {
            return ModelFormError::default();
        }
        let change = both().map(|(body, law)| body.model_form_error(law)).sum();
        let change = with_waves(scene, estimate, change);
        let Departure { restitution, contact_time, peak_force, peak_pressure } =
            with_relaxation(scene, estimate, change);
        let left_small = both().filter(|(_, law)| law.is_none());
        let flattened: f64 =
            left_small.map(|(body, _)| body.share * body.deformation.flatness.powi(2)).sum();
        let lost = OF_RELAXED_LOSS * flattened * relaxed_loss(scene, estimate);
        let shares = NeglectError::shares(estimate, contact_time, peak_force);
        let sizes = &estimate.effective.sizes;
        // F = πa² times the mean pressure.
        let radius = 0.5 * (peak_force + peak_pressure) * sizes.max_contact_radius;
        ModelFormError::of(&shares, estimate)
            .with(QuantityOfInterest::Restitution, restitution.abs() + lost)
            .with(QuantityOfInterest::MaxContactRadius, radius)
            .with(QuantityOfInterest::PeakPressure, peak_pressure * sizes.peak_pressure)
            .checked()
    }

    /// The estimate warns before the run; this warns of the strains that occurred.
    fn warnings_of_result(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        collision: &Collision,
    ) -> Vec<String> {
        let radius = estimate.hertz.pair().effective_radius();
        let strain = collision.max_contact_radius.unwrap_or_default() / radius;
        let found = Estimate { strain, ..*estimate };
        let is_news = !is_called_for(scene, estimate) && is_called_for(scene, &found);
        let is_small = Self::laws(scene, estimate) == [None; 2];
        let remedy = match scene.model() {
            ModelChoice::Fem => "force finite strain on (effects.finite_strain)",
            _ => "use model fem, which has finite strain",
        };
        let news = (is_news && is_small).then(|| {
            format!(
                "the contact radius grew to {:.0} % of the effective radius, where small strain is off \
                 by {}; {remedy}",
                100.0 * strain,
                in_words(scene, &found)
            )
        });
        let spread = spread(scene, &found);
        // A contact that does not end has no time to change.
        let has_end = collision.contact_time.is_some();
        let law = (has_end && spread > scene.accuracy().contact_time).then(|| {
            format!(
                "how the materials go on beyond Hooke's law changes the contact time by {} {}, and the case does \
                 not say: name a law (material.NAME.hyperelastic)",
                if is_beyond(scene, &found) { "more than" } else { "up to" },
                percent(spread)
            )
        });
        news.into_iter().chain(law).collect()
    }
}
