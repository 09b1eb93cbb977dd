//! Large strains and rotations with a hyperelastic law ([`HyperelasticLaw`]).
//!
//! Decided by the change of the collision ([`Departure`]), a function of the law, Poisson's ratio, and the strain s of the
//! body, its share of the contact radius over the effective radius. Terms beyond the first order, with the slope k, depend
//! on the flatness a/R_b of a sphere instead, if that is larger:
//!
//! ```math
//! s_b = w_b \frac{a}{R^*}, \qquad w_b = \frac{E^*}{E_b/(1-\nu_b^2)}, \qquad
//! g_b = \max\Bigl(s_b, \frac a{R_b}\Bigr), \qquad
//! \frac{\Delta T}{T} = \sum_b w_b \Bigl[\left.\frac{\Delta T}{T}\right|_{\text{wall}}(g_b) - k\,(g_b - s_b)\Bigr]
//! ```
//!
//! Half of a collision of like bodies is thus as strained as the whole. A body that strains little stays at small strain
//! next to one that strains more. The loss 1 − e by radiated waves is proportional to T⁻² and adds 2 (1 − e) ΔT/T.
//!
//! Compared with runs at a/R* from 0.1 to 0.7 and ν of 0.2 and 0.45, of like, softer, stiffer and steel balls on a
//! half-space, unlike balls of one size, and like balls of sizes 1:3 (`validation/finite_strain_tables.md`). Where it
//! matters, the estimate is between a third and three times the computed change; it is larger for half-spaces at ν = 0.2 or
//! under a harder ball, and where a change has reversed its sign.

mod body_strain;
mod departure;
mod measured;

use fem_case::engineering::show;
use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_collision::{Collision, QuantityOfInterest};
use fem_material::Material;
use fem_material::finite::HyperelasticLaw;

use self::body_strain::BodyStrain;
use self::departure::Departure;
use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, FiniteStrain, PartnerWaves};
use crate::effects::ting_prediction::relaxed_loss;
use crate::estimate::{Estimate, LARGE_STRAIN};
use crate::quantity_errors::QuantityErrors;
use crate::rejection::Rejection;

/// Smallest difference between laws that is reported, as a share of the contact time.
const MIN_REPORTED_SPREAD: f64 = 5e-5;
/// Approximate ratio of d ln(1 − e) to −d ln T for the loss by relaxation.
const RELAXED_OVER_TIME: f64 = 0.5;
/// Largest relative change of that loss by large strain over the square of the flatness: 1.0 % was found at 0.2 and 3.6 %
/// at 0.35, of either sign, for spheres on a wall at ν from 0 to 0.49 with any change of the contact time.
const OF_RELAXED_LOSS: f64 = 0.3;
/// The same ratio for the loss by waves: their energy is proportional to T⁻³ at the same impulse.
const RADIATED_OVER_TIME: f64 = 2.0;

/// Approach speed over the shear wave speed from which all elements are, too, since waves carry strains of this size
/// through the body.
const MACH_OF_ALL_ELEMENTS: f64 = 1e-3;
/// Largest error by elements far from the contact that stay at small strain, as a share of the tolerance. For elastic glass
/// 7 % of the change of the peak force came from beyond two contact radii, 2.8 % from beyond three and 0.5 % from beyond
/// five and a half: 0.6 to 0.9 of (a/R)³.
const LEFT_FAR_AWAY: f64 = 0.03;
/// Number of contact radii within which all elements are at finite strain, at any tolerance and where a body flows: with 3 the
/// restitution after flow is that of bodies that are at finite strain throughout, with 1.5 it is wrong by 5 %.
const MIN_RADIUS_OVER_CONTACT: f64 = 3.0;

impl FiniteStrain {
    /// Returns the laws of both bodies at the strains of an estimate; `None` for a body that is computed at small strain.
    pub fn laws(scene: &Scene, estimate: &Estimate) -> [Option<HyperelasticLaw>; 2] {
        let is_needed = is_needed(scene, estimate);
        let is_finite = |strained: &BodyStrain| match scene.effects().finite_strain {
            // Plastic flow is computed at finite strain alone.
            _ if strained.material.flow().is_some() => true,
            Some(Switch::On) => true,
            Some(Switch::Off) => false,
            None | Some(Switch::Auto) => {
                is_needed && strained.is_supported() && strained.matters(scene)
            }
        };
        let of_both = BodyStrain::of_both(scene, estimate);
        of_both.map(|strained| Some(strained.filter(is_finite)?.material.law()))
    }

    /// Returns whether a body is computed at finite strain.
    pub(crate) fn is_on(scene: &Scene, estimate: &Estimate) -> bool {
        Self::laws(scene, estimate) != [None; 2]
    }

    /// Returns the distance from first touch (m) within which elements are at finite strain; the change by farther
    /// elements falls with its third power (`fem-explicit/src/stress/partly_finite.rs`). It is `None` if all elements
    /// are: if the case forces the effect on, in flat contacts and with waves.
    pub(crate) fn within(scene: &Scene, estimate: &Estimate) -> Option<f64> {
        if is_forced_on(scene) {
            return None;
        }
        if scene.flows() {
            return Some(MIN_RADIUS_OVER_CONTACT * estimate.contact_radius);
        }
        let is_near = estimate.strain < LARGE_STRAIN && estimate.mach < MACH_OF_ALL_ELEMENTS;
        let change = departure(scene, estimate).over(&scene.accuracy());
        let radii = (change / LEFT_FAR_AWAY).cbrt().max(MIN_RADIUS_OVER_CONTACT);
        is_near.then_some(radii * estimate.contact_radius)
    }

    /// Checks that elements can compute a scene at forced large strain.
    pub(crate) fn check(scene: &Scene, estimate: &Estimate) -> Result<(), Rejection> {
        let flows = scene.flows();
        if flows && scene.effects().finite_strain == Some(Switch::Off) {
            let message =
                "finite strain is forced off, and plastic flow is computed at finite strain alone";
            let help = "write \"auto\" or \"on\", or effects.plastic_flow = \"off\" beside it";
            return Err(Rejection::new("effects.finite_strain", message).with_help(help));
        }
        let mut strained = BodyStrain::of_both(scene, estimate).into_iter().flatten();
        let is_on =
            |strained: &BodyStrain| is_forced_on(scene) || strained.material.flow().is_some();
        let unsupported = strained.find(|strained| !strained.is_supported() && is_on(strained));
        let Some(strained) = unsupported else { return Ok(()) };
        let (why, key) = match flows {
            true => ("plastic flow is computed at finite strain", "effects.plastic_flow"),
            false => ("finite strain is forced on", "effects.finite_strain"),
        };
        let message = format!("{why}, and {}", strained.why_unsupported());
        let help = "change the material, or write \"auto\" or \"off\"";
        Err(Rejection::new(key, message).with_help(help))
    }

    /// Returns the support of explicit elements.
    pub(crate) fn of_elements(scene: &Scene, estimate: &Estimate) -> Support {
        let strained = BodyStrain::of_both(scene, estimate).into_iter().flatten();
        let mut unsupported =
            strained.filter(|strained| !strained.is_supported() && strained.matters(scene));
        let is_open = scene.effects().finite_strain.is_none_or(|switch| switch == Switch::Auto);
        let is_asked = is_open && is_needed(scene, estimate);
        let Some(strained) = unsupported.next().filter(|_| is_asked) else {
            let support = Self::of_stability(scene, estimate);
            let support = support.or_else(|| Self::of_nearness(scene, estimate));
            return support.unwrap_or(Support::Computes { idle: "" });
        };
        let why = format!("needed, but {}", strained.why_unsupported());
        let neglect_error = FiniteStrain.neglect_error(scene, estimate).unwrap_or_default();
        let warning = format!("{} is {why}; small strain leaves out {neglect_error}", Self::NAME);
        let active = Self::laws(scene, estimate).iter().any(Option::is_some);
        Support::decided(active, why).warning([warning])
    }
}

impl FiniteStrain {
    /// Returns the text for a scene with finite strain near the contact only.
    fn of_nearness(scene: &Scene, estimate: &Estimate) -> Option<Support> {
        let within = Self::is_on(scene, estimate).then(|| Self::within(scene, estimate))??;
        let is_partial = |body: &Body| body.diameter().is_none_or(|diameter| diameter > within);
        scene
            .bodies()
            .iter()
            .any(|body| body.material().is_some() && is_partial(body))
            .then_some(())?;
        let number = FiniteStrain.relevance(scene, estimate)?.number;
        let nearness = format!(
            "elements within {} of first touch, {:.1} contact radii, are at finite strain; the others stay at small \
             strain, with an error of at most {} % of the tolerance",
            show(within, "m"),
            within / estimate.contact_radius,
            100.0 * LEFT_FAR_AWAY,
        );
        Some(Support::decided(true, format!("{number}; {nearness}")))
    }

    /// Returns the text for a scene whose laws are expected to lose stability.
    fn of_stability(scene: &Scene, estimate: &Estimate) -> Option<Support> {
        let computed = Self::laws(scene, estimate);
        if !is_needed(scene, estimate) || computed == [None; 2] {
            return None;
        }
        let pressure = estimate.hertz.peak_pressure();
        let both = BodyStrain::of_both(scene, estimate).into_iter().zip(computed);
        let mut unstable = both.filter_map(|(body, law)| {
            law?;
            body.filter(|body| body.is_unstable(pressure))
        });
        let BodyStrain { name, material, .. } = unstable.next()?;
        let warning = format!(
            "{}, the law of {name}, is expected to lose its stability under the contact's pressure, and the \
             run may stop; use another material.NAME.hyperelastic, such as neo-hooke, which is always stable",
            material.law().name()
        );
        let number = FiniteStrain.relevance(scene, estimate)?.number;
        Some(Support::decided(true, number).warning([warning]))
    }
}

/// Returns the error of neglecting it for elastic bodies, as magnitudes.
fn departure(scene: &Scene, estimate: &Estimate) -> Departure {
    let both = BodyStrain::of_both(scene, estimate).into_iter().flatten();
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
    BodyStrain::of_both(scene, estimate).iter().flatten().map(BodyStrain::spread).sum()
}

fn is_forced_on(scene: &Scene) -> bool {
    scene.effects().finite_strain == Some(Switch::On)
}

/// Returns whether neglecting it would exceed the case's tolerance, or cannot be estimated.
fn is_needed(scene: &Scene, estimate: &Estimate) -> bool {
    is_beyond(scene, estimate) || departure(scene, estimate).over(&scene.accuracy()) > 1.0
}

/// Returns whether a body is flatter than all reference spheres.
fn is_beyond(scene: &Scene, estimate: &Estimate) -> bool {
    let both = BodyStrain::of_both(scene, estimate);
    both.iter().flatten().any(BodyStrain::is_beyond)
}

/// Returns the error of neglecting it, as text.
fn error_text(scene: &Scene, estimate: &Estimate) -> String {
    match is_beyond(scene, estimate) {
        true => "an amount that cannot be estimated".to_string(),
        false => departure(scene, estimate).as_text(),
    }
}

/// Returns the laws of the bodies, and how much they would matter if the case names none.
fn laws_text(scene: &Scene, estimate: &Estimate) -> String {
    let materials: Vec<&Material> = scene.bodies().iter().filter_map(Body::material).collect();
    let mut names: Vec<&str> = materials.iter().map(|material| material.law().name()).collect();
    names.dedup();
    let names = names.join(" and ");
    let spread = spread(scene, estimate);
    match spread > MIN_REPORTED_SPREAD {
        false => format!("law {names}"),
        true => format!(
            "law {names} by default (other laws change the contact time by {} {})",
            if is_beyond(scene, estimate) { "more than" } else { "up to" },
            percent(spread)
        ),
    }
}

impl Effect for FiniteStrain {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let open = error_text(scene, estimate);
        let (is_needed, laws) = (is_needed(scene, estimate), laws_text(scene, estimate));
        let warning = is_needed.then(|| {
            format!(
                "the contact radius is {} of the effective radius, where small strain is off by \
                 {open}; explicit elements (model.fem) have finite strain",
                percent(estimate.strain),
            )
        });
        Some(Relevance {
            is_needed,
            number: format!(
                "{}contact radius / effective radius = {:.3}{}{}",
                if estimate.flow.is_some() { "plastic flow needs it; " } else { "" },
                estimate.strain,
                if is_needed { format!(", {laws}") } else { String::new() },
                match is_beyond(scene, estimate) {
                    true => "; the contact is too wide for an estimate by closed forms",
                    false => "",
                }
            ),
            if_not_needed: format!("small strain suffices: it leaves out {open}; {laws}"),
            open_error: format!("{open} is left out"),
            warning,
        })
    }

    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        if is_beyond(scene, estimate) {
            return Some(NeglectError::default());
        }
        let change = with_relaxation(scene, estimate, departure(scene, estimate));
        let shares = NeglectError::shares(estimate, change.contact_time, change.peak_force);
        Some(NeglectError { restitution: Some(change.restitution.min(1.0)), ..shares })
    }

    /// At small strain it is the largest change by any law that the materials may follow. At finite strain it is the
    /// largest difference from the computed law, if the case does not name it.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        // The elastic strain of bodies that flow stays near that of first yield.
        if estimate.flow.is_some() {
            return QuantityErrors::ZERO;
        }
        let computed = if status.is_lacking { [None; 2] } else { Self::laws(scene, estimate) };
        let both = BodyStrain::of_both(scene, estimate);
        let both =
            || both.iter().zip(computed).filter_map(|(body, law)| Some((body.as_ref()?, law)));
        // A law that is named and computed has no error.
        let is_open =
            |body: &BodyStrain, law| body.possible_laws().iter().any(|one| Some(*one) != law);
        if both().any(|(body, law)| body.is_beyond() && is_open(body, law)) {
            return QuantityErrors::default();
        }
        let change = both().map(|(body, law)| body.law_error(law)).sum();
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
        shares
            .of_all_quantities(estimate)
            .with(QuantityOfInterest::Restitution, restitution.abs() + lost)
            .with(QuantityOfInterest::MaxContactRadius, radius)
            .with(QuantityOfInterest::PeakPressure, peak_pressure * sizes.peak_pressure)
            .checked()
    }

    /// Small strain is no difference between models where elements use it, too, and the spread over possible laws is the same
    /// in all models.
    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        let estimate = model.estimate;
        if !Self::is_on(model.case, estimate) || !model.lacks(self) {
            return Adequacy::FULL;
        }
        let error = model.error_by(self, |change| change.of_all_quantities(estimate));
        Adequacy { error, is_lack: true, ..Adequacy::FULL }
    }

    /// Warns of the strains that occurred; the estimate warns before the run.
    fn warnings_of_result(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        collision: &Collision,
    ) -> Vec<String> {
        if estimate.flow.is_some()
            || matches!(scene.model(), ModelChoice::Law { law, .. } if law.family.is_elastic_plastic())
        {
            return Vec::new();
        }
        let radius = estimate.hertz.pair().effective_radius();
        let strain = collision.max_contact_radius.unwrap_or_default() / radius;
        let found = Estimate { strain, ..estimate.clone() };
        let is_larger = !is_needed(scene, estimate) && is_needed(scene, &found);
        let is_small = !Self::is_on(scene, estimate);
        let advice = match scene.model() {
            ModelChoice::Fem => "force finite strain on (effects.finite_strain)",
            _ => "use model fem, which has finite strain",
        };
        let strain_warning = (is_larger && is_small).then(|| {
            format!(
                "the contact radius grew to {:.0} % of the effective radius, where small strain is off \
                 by {}; {advice}",
                100.0 * strain,
                error_text(scene, &found)
            )
        });
        let spread = spread(scene, &found);
        // A contact that does not end has no contact time.
        let has_end = collision.contact_time.is_some();
        let law = (has_end && spread > scene.accuracy().contact_time).then(|| {
            format!(
                "at this strain elastic laws differ by {} {} in contact time: choose one, {}",
                if is_beyond(scene, &found) { "more than" } else { "up to" },
                percent(spread),
                softest_without_law(scene)
                    .map_or(String::new(), |body| body.material_key("hyperelastic"))
            )
        });
        strain_warning.into_iter().chain(law).collect()
    }
}

/// Returns the most compliant body whose material names no elastic law.
fn softest_without_law(scene: &Scene) -> Option<&Body> {
    let bodies = scene.bodies().iter().filter_map(|body| Some((body, body.material()?)));
    let open = bodies.filter(|(_, material)| material.named_law().is_none());
    let modulus = |material: &Material| material.instantaneous().youngs_modulus();
    open.min_by(|a, b| modulus(a.1).total_cmp(&modulus(b.1))).map(|(body, _)| body)
}
