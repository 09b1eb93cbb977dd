//! Waves radiated into a body so large that they do not return within the contact, which takes energy. Elements include
//! them; Ting's model and condensed bodies have a radiation term; closed forms and contact laws lack them.
//!
//! Decided by the number of times that shear waves cross the body during the contact, T c_s/D. The loss is that of a
//! half-space ([`radiated_share`]).

use fem_case::engineering::number;
use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_collision::QuantityOfInterest;
use fem_laws::{HertzImpact, Ting, radiated_share};
use fem_material::Material;

use crate::effects::bodies::vibration::ENOUGH_MODES;
use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::{Relevance, percent};
use crate::effects::decision::simplified_scene::SimplifiedScene;
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, NamedEffect, PartnerWaves, PlateBending, is_needed};
use crate::effects::ting_prediction::{TingPrediction, relaxes};
use crate::estimate::effective_modulus::{EffectiveModuli, left_at};
use crate::estimate::{Estimate, Regime};
use crate::quantity_errors::QuantityErrors;

/// Above this T c_s/D waves return in time and give their energy back.
const RETURN_LIMIT: f64 = 2.0;
/// Below this T c_s/D no wave returns in time: the first ones, pressure waves, need c_s/c_p of twice the passage, 1.15 at
/// ν = 1/4. The loss of Ting's model with radiation differs from that of elements by 4 % below 0.6, and by 12 % at 0.93.
const RADIATION_LIMIT: f64 = 1.0;
/// Above this T c_s/D twelve modes of a body resolve its waves: the loss of condensed bodies with them differs from that of
/// elements by 5 % on spheres eight and ten times as large at 3 m/s, where it is 1.2 and 0.9.
const RESOLVED_BY_MODES: f64 = 0.8;
/// Largest energy of a radiating body's own motion over the loss at which the condensed model may move it as a whole.
const OWN_MOTION: f64 = 0.1;
/// Loss of restitution by waves above which a warning is given.
const SMALL_LOSS: f64 = 1e-4;

/// Relative error of a radiation term for elastic bodies.
const RADIATION_ERROR: f64 = 0.15;
/// Coefficient of the loss that radiation terms miss for relaxing bodies. The terms are smoothed over the times that waves
/// take across the contact at the instantaneous stiffness; bodies that relax to the share κ of it lose more by the square
/// of this times the radiated share of the energy over κ. Balls on blocks that keep 0.1: 0.8 of the loss of Ting's model
/// and 1.0 of that of condensed bodies are missing, where elements lose 0.027 of the restitution.
const LOSS_BY_SMOOTHING: f64 = 2.0;
/// Relative change of contact time and peak force over the change of restitution; 0.1 was found for balls on a
/// half-space of their own material at a/R* = 0.7.
const SHARE_OF_LOSS: f64 = 0.2;

impl PartnerWaves {
    /// Returns the materials of the bodies that radiate in a model with a radiation term: bodies whose waves do not return
    /// within the contact, as long as the loss is a correction, or the largest body if the case forces the effect. The
    /// materials are elastic, with the effective moduli of the contact.
    pub(crate) fn radiating(scene: &Scene, estimate: &Estimate) -> [Option<Material>; 2] {
        match scene.effects().partner_waves {
            Some(Switch::Off) => [None, None],
            Some(Switch::On) => {
                let crossed = crossed(scene, estimate);
                let passages = crossed.iter().flatten().map(|body| body.passage);
                let least = passages.fold(f64::INFINITY, f64::min);
                large(crossed, RADIATION_LIMIT.max(least.next_up()))
            }
            Some(Switch::Auto) | None => {
                let radiating = large(crossed(scene, estimate), RADIATION_LIMIT);
                let hertz = &estimate.effective.hertz;
                let shares = radiating.iter().flatten();
                let share: f64 = shares.map(|material| radiated_share(hertz, material)).sum();
                if share <= Ting::MAX_RADIATED_SHARE { radiating } else { [None, None] }
            }
        }
    }

    /// Returns the materials of the radiating bodies of the condensed model ([`PartnerWaves::radiating`]). A body that
    /// radiates must be so heavy that the energy of its own motion is small compared with the loss, since it moves as a
    /// whole without delay. Vibration modes replace the term.
    pub(crate) fn radiating_at_rest(scene: &Scene, estimate: &Estimate) -> [Option<Material>; 2] {
        let radiating = Self::radiating(scene, estimate);
        let is_forced = scene.effects().partner_waves == Some(Switch::On);
        let has_modes = n_modes(scene) > 0;
        let masses = scene.bodies().each_ref().map(|body| body.mass());
        [0, 1].map(|side: usize| {
            let material = radiating[side].clone()?;
            let (Some(own), Some(other)) = (masses[side], masses[1 - side]) else {
                return Some(material);
            };
            // e = e' + (1 + e') m/M of the two mass centres.
            let loss = lost(radiated_share(&estimate.effective.hertz, &material));
            let is_heavy = 2.0 * other / own < OWN_MOTION * loss;
            (!has_modes && (is_heavy || is_forced)).then_some(material)
        })
    }

    /// Returns the loss of restitution by waves that do not return in time, for elastic bodies.
    pub(crate) fn loss(scene: &Scene, estimate: &Estimate) -> f64 {
        lost(radiated(&crossed(scene, estimate), estimate))
    }

    /// Returns the loss of restitution by waves that return within the contact and stay in vibrations of elastic bodies.
    pub(in crate::effects) fn left_ringing(scene: &Scene, estimate: &Estimate) -> f64 {
        lost(taken(&crossed(scene, estimate), estimate, |passage| passage >= RETURN_LIMIT))
    }

    /// Returns the relative error of the radiation term.
    fn error_of_term(scene: &Scene, estimate: &Estimate) -> f64 {
        let missing = missing_of_term(&crossed(scene, estimate), estimate);
        RADIATION_ERROR + missing / (1.0 + missing)
    }

    /// Returns the support of a model whose radiation term includes these bodies.
    pub(crate) fn of_term(
        scene: &Scene,
        estimate: &Estimate,
        radiating: fn(&Scene, &Estimate) -> [Option<Material>; 2],
    ) -> Support {
        // A term that the case switches off is available.
        let switch = scene.effects().partner_waves.filter(|switch| *switch != Switch::Off);
        match radiating(&PartnerWaves.switched(scene, switch), estimate) {
            [None, None] => Support::Lacks,
            _ => Support::Computes { idle: "" },
        }
    }

    /// Returns the support of condensed bodies: the radiation term, or vibration modes that resolve the
    /// waves.
    pub(crate) fn of_condensed(scene: &Scene, estimate: &Estimate) -> Support {
        let mut crossed = crossed(scene, estimate).into_iter().flatten();
        let are_resolved = crossed.all(|body| body.passage >= RESOLVED_BY_MODES);
        if n_modes(scene) >= ENOUGH_MODES && are_resolved {
            return Support::Inherent { idle: "" };
        }
        Self::of_term(scene, estimate, Self::radiating_at_rest)
    }
}

/// Returns the number of vibration modes per body that a case asks condensed bodies for.
fn n_modes(scene: &Scene) -> usize {
    match scene.model() {
        ModelChoice::Condensed(options) => options.vibration_modes,
        _ => 0,
    }
}

/// Returns the materials of bodies with T c_s/D below a limit.
fn large(crossed: [Option<Crossed>; 2], limit: f64) -> [Option<Material>; 2] {
    crossed.map(|body| body.filter(|body| body.passage < limit).map(|body| body.material))
}

impl Effect for PartnerWaves {
    fn relevance(&self, scene: &Scene, estimate: &Estimate) -> Option<Relevance> {
        let crossed = crossed(scene, estimate);
        let share = radiated(&crossed, estimate);
        let largest =
            crossed.iter().flatten().min_by(|one, other| one.passage.total_cmp(&other.passage))?;
        let (name, least) = (largest.body.name(), largest.passage);
        let lost = lost(share);
        let term = Self::of_term(scene, estimate, Self::radiating) != Support::Lacks;
        let warning = (lost > SMALL_LOSS).then(|| {
            let why = match least > 0.0 {
                true => {
                    let crossed = passages(name, least, "only ");
                    format!("{crossed}, less than {RETURN_LIMIT}: they do not return")
                }
                false => passages(name, least, ""),
            };
            format!(
                "{why} and take {} of the energy, {} of the restitution, which {}; \
                 {} them",
                percent(share),
                number(lost, 2),
                match scene.model() {
                    // The loss of a law is the user's.
                    ModelChoice::Law { .. } => {
                        "the law has if it was fitted to measurements, and else leaves out"
                    }
                    _ => "this model leaves out",
                },
                if term && estimate.flow.is_none() {
                    "models fem and ting have"
                } else {
                    "model fem has"
                }
            )
        });
        Some(Relevance {
            is_needed: least < RETURN_LIMIT,
            number: passages(name, least, ""),
            if_not_needed: "no energy is radiated".to_string(),
            open_error: format!("radiated waves take {} of the restitution", number(lost, 2)),
            warning,
        })
    }

    /// Difference between Ting's impacts with and without radiation. Without a term, or if radiation is more than a
    /// correction, it is the loss of restitution by a half-space.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let switch = scene.effects().partner_waves.filter(|switch| *switch != Switch::Off);
        let regime = SimplifiedScene::quiet(self.switched(scene, switch), estimate)?;
        let Regime { scene: with, estimate } = &regime;
        if Self::radiating(with, estimate) != [None, None] {
            // A model without the term has the error of a model with it.
            let is_term = Self::radiating_at_rest(with, estimate) != [None, None];
            let whole = || estimate.regime_of(with.clone().with_model(ModelChoice::Fem));
            let own = if is_term { Ok(regime.clone()) } else { whole() };
            let without = estimate.regime_of(self.switched(with, Some(Switch::Off)));
            let impacts = [own, without].map(|regime| TingPrediction::of(&regime?, false));
            if let [Ok(one), Ok(without)] = impacts {
                let missing = missing_of_term(&crossed(with, estimate), estimate);
                let change = one.change_from(&without);
                let whole = |part: f64| (part * (1.0 + missing)).clamp(-1.0, 1.0);
                return Some(NeglectError { restitution: change.restitution.map(whole), ..change });
            }
            // Relaxation takes part of the energy of the waves.
            if relaxes(with) {
                return None;
            }
        }
        let share = radiated(&crossed(with, estimate), estimate);
        (share > 0.0).then(|| NeglectError::restitution(lost(share)))
    }

    /// A radiation term has a share of the error without it, and a mesh none. A result without the waves advises another model
    /// from a small loss on.
    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        let (scene, estimate) = (model.case, model.estimate);
        let is_lack = model.lacks(self);
        if !is_lack && *model.own.model() == ModelChoice::Fem {
            return Adequacy::FULL;
        }
        let share = if is_lack { 1.0 } else { Self::error_of_term(scene, estimate) };
        let error = model.error_without(self).map(|error| error.times(share));
        let is_off = scene.effects().partner_waves == Some(Switch::Off);
        let loss = Some(Self::loss(scene, estimate)).filter(|_| is_lack && !is_off);
        let advice = loss.filter(|lost| *lost > SMALL_LOSS).map(|lost| {
            format!("lacks partner waves, which take {} of the restitution", number(lost, 2))
        });
        Adequacy { error, is_lack: true, impossible: None, advice }
    }

    /// Elements have the waves in any case.
    fn is_never_off(&self, model: &ConsideredModel) -> bool {
        *model.own.model() == ModelChoice::Fem || is_needed(self, model.case, model.estimate)
    }

    /// The radiation term has a relative error; a mesh resolves the waves. The term and what is neglected without it leave
    /// out the motion of the whole body, which has no time to come about where waves cross it about once: elements lose
    /// between the term's loss and that of a half-space, at ν = 0.44 and T c_s/D = 0.98 1.6 times the term's.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let &EffectStatus { is_lacking, neglect_error } = status;
        let is_of_mesh = !is_lacking && *scene.model() == ModelChoice::Fem;
        let Some(neglect_error) = neglect_error.filter(|_| !is_of_mesh) else {
            return QuantityErrors::ZERO;
        };
        let part = if is_lacking { 1.0 } else { Self::error_of_term(scene, estimate) };
        // Closed forms may give the loss alone.
        let others = SHARE_OF_LOSS * neglect_error.restitution.unwrap_or(f64::NAN);
        let shares = NeglectError::shares(estimate, others, others);
        let complete = NeglectError {
            contact_time_s: neglect_error.contact_time_s.or(shares.contact_time_s),
            peak_force_n: neglect_error.peak_force_n.or(shares.peak_force_n),
            ..neglect_error
        };
        let own_motion =
            neglect_error.restitution.map(|loss| Self::loss(scene, estimate) - loss.abs());
        let of_restitution = QuantityErrors::ZERO
            .with(QuantityOfInterest::Restitution, own_motion.unwrap_or(0.0).max(0.0));
        complete.of_all_quantities(estimate).times(part).plus(of_restitution)
    }
}

/// Returns how often shear waves cross a body within the contact, as text.
fn passages(name: &str, passages: f64, only: &str) -> String {
    match passages {
        0.0 => format!("waves do not return from {name}, which has no far side"),
        0.01.. => format!("shear waves cross {name} {only}{passages:.2} times during the contact"),
        _ => format!(
            "shear waves cross {name} {only}{} times during the contact",
            number(passages, 1)
        ),
    }
}

/// A body that waves cross.
struct Crossed<'a> {
    body: &'a Body,
    /// Elastic material with the effective moduli of the contact.
    material: Material,
    /// T c_s/D, zero for a half-space and for a plate from whose far face no wave returns.
    passage: f64,
}

/// Returns the bodies that waves cross, which are those with a material, but for a plate that bends.
fn crossed<'a>(scene: &'a Scene, estimate: &Estimate) -> [Option<Crossed<'a>>; 2] {
    let EffectiveModuli { after, hertz, .. } = &estimate.effective;
    let bends = PlateBending::is_needed(scene, estimate);
    scene.bodies().each_ref().map(|body| {
        if body.plate().is_some() && bends {
            return None;
        }
        let material = left_at(body.material()?, *after);
        let way = hertz.contact_time() * material.shear_wave_speed();
        let passage = body.diameter().map_or(0.0, |diameter| way / diameter);
        Some(Crossed { body, material, passage })
    })
}

/// Returns the relative error of the radiation term of relaxing bodies, zero for elastic ones. See
/// [`LOSS_BY_SMOOTHING`].
fn missing_of_term(crossed: &[Option<Crossed>; 2], estimate: &Estimate) -> f64 {
    let modulus = |hertz: &HertzImpact| hertz.pair().contact_modulus();
    let kept = modulus(&estimate.effective.hertz) / modulus(&estimate.hertz);
    (LOSS_BY_SMOOTHING * radiated(crossed, estimate)).powi(2) * (kept.powi(-2) - 1.0).max(0.0)
}

/// Returns the share of the energy that is radiated into bodies from which no wave returns in time.
fn radiated(crossed: &[Option<Crossed>; 2], estimate: &Estimate) -> f64 {
    taken(crossed, estimate, |passage| passage < RETURN_LIMIT)
}

/// Returns the share of the energy that waves leave in bodies whose number of passages counts.
fn taken(crossed: &[Option<Crossed>; 2], estimate: &Estimate, counts: fn(f64) -> bool) -> f64 {
    let hertz = &estimate.effective.hertz;
    let bodies = crossed.iter().flatten().filter(|body| counts(body.passage));
    bodies.map(|body| radiated_share(hertz, &body.material) * kept(body.passage)).sum()
}

/// Returns the share of a half-space's loss that a body keeps. Elements kept 0.35 of it at T c_s/D = 1.45, 0.023 at 2.99,
/// 0.010 and 0.006 at 4.4 and 4.6, and 0.003 at 8.0, for balls of a tenth to two thirds of the size of a softer body.
fn kept(passage: f64) -> f64 {
    passage.max(RADIATION_LIMIT).powi(-3)
}

/// Returns the loss of restitution that belongs to a share of the energy.
fn lost(share: f64) -> f64 {
    1.0 - (1.0 - share).max(0.0).sqrt()
}
