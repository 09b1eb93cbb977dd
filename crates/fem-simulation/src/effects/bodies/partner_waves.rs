//! Waves that a contact sends into a body so large that they do not come back within the contact: they
//! take energy along. Elements have them; Ting's model and condensed bodies have the loss as a term of their
//! own; closed forms and laws have not.
//!
//! Decided by the contact time over the time that shear waves take through a body, T c_s/D. The loss is
//! that of a half-space ([`radiated_share`]).

use fem_case::engineering::number;
use fem_case::{Body, ModelChoice, Scene, Switch};
use fem_laws::{HertzImpact, Ting, radiated_share};
use fem_material::Material;

use crate::effects::bodies::vibration::ENOUGH_MODES;
use crate::effects::effect::computed_scene::ComputedScene;
use crate::effects::effect::model_form_error::{EffectStatus, ModelFormError};
use crate::effects::effect::neglect_error::NeglectError;
use crate::effects::effect::relevance::{Relevance, percent};
use crate::effects::effect::support::Support;
use crate::effects::effect::{Effect, NamedEffect, PartnerWaves};
use crate::effects::ting_prediction::{TingPrediction, relaxes};
use crate::estimate::Estimate;
use crate::estimate::effective_modulus::{EffectiveModuli, left_at};

/// Above this T c_s/D waves come back in time and give back what they took.
const RETURN_LIMIT: f64 = 2.0;
/// Below this T c_s/D nothing comes back in time: pressure waves, the first, take c_s/c_p of twice the
/// passage, 1.15 at ν = 1/4. Ting's model with what a half-space takes is within 4 % of the loss of elements
/// below 0.6, and within 12 % at 0.93.
const RADIATION_LIMIT: f64 = 1.0;
/// Above this T c_s/D twelve modes of a body carry its waves: condensed bodies with them lose what elements
/// do within 5 % on spheres eight and ten times as large at 3 m/s, at 1.2 and 0.9.
const RESOLVED_BY_MODES: f64 = 0.8;
/// Share of the loss that a radiating body's own motion may be where it moves at once.
const OWN_MOTION: f64 = 0.1;
/// Loss of restitution by waves that is worth a warning.
const SMALL_LOSS: f64 = 1e-4;

/// Relative error of a radiation term for elastic bodies.
const RADIATION_ERROR: f64 = 0.15;
/// Terms are smoothed over some of the times that waves take across the contact, for the stiffness that bodies have
/// at once: of those that relax to the share κ of it they take too little by this times the share of the energy
/// that waves take, over κ, squared. Balls on blocks that keep 0.1: 0.8 of what Ting's model takes and 1.0 of what
/// condensed bodies do are missing, where elements lose 0.027 of the restitution.
const SMOOTHED: f64 = 2.0;
/// Change of contact time and peak force over that of the restitution: 0.1 of balls on a half-space of their
/// own material at a/R* = 0.7.
const SHARE_OF_LOSS: f64 = 0.2;

impl PartnerWaves {
    /// The materials of bodies that radiate, of a model that has their loss as a term: those whose waves do
    /// not come back within the contact, as long as the loss is a correction; and the largest body in
    /// any case where the case forces it. As they are to waves of the contact: elastic, with what is left of their
    /// moduli in it.
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

    /// As [`PartnerWaves::radiating`], of condensed bodies. One that radiates moves as a whole at once there:
    /// only if it is so heavy that its own motion, part of the waves' energy, is next to nothing of the
    /// loss. Modes of vibration are a sphere's own waves, and in place of the term.
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

    /// Restitution that waves which do not come back in time take of elastic bodies.
    pub(crate) fn loss(scene: &Scene, estimate: &Estimate) -> f64 {
        lost(radiated(&crossed(scene, estimate), estimate))
    }

    /// Restitution that waves take which come back within the contact, but not in its time: of elastic bodies, in
    /// whose vibrations it stays.
    pub(in crate::effects) fn left_ringing(scene: &Scene, estimate: &Estimate) -> f64 {
        lost(taken(&crossed(scene, estimate), estimate, |passage| passage >= RETURN_LIMIT))
    }

    /// Returns the relative error of the radiation term.
    pub(crate) fn error_of_term(scene: &Scene, estimate: &Estimate) -> f64 {
        let missing = missing_of_term(&crossed(scene, estimate), estimate);
        RADIATION_ERROR + missing / (1.0 + missing)
    }

    /// Returns the answer of a model whose radiation term includes these bodies.
    pub(crate) fn of_term(
        scene: &Scene,
        estimate: &Estimate,
        radiating: fn(&Scene, &Estimate) -> [Option<Material>; 2],
    ) -> Support {
        // Where it is switched off it is there to be switched off.
        let switch = scene.effects().partner_waves.filter(|switch| *switch != Switch::Off);
        match radiating(&PartnerWaves.switched(scene, switch), estimate) {
            [None, None] => Support::Lacks,
            _ => Support::Computes { idle: "" },
        }
    }

    /// Returns the answer of condensed bodies: the radiation term, or vibration modes that resolve the
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
            format!(
                "{name} is so large that waves from the contact do not come back within it (contact \
                 time × shear wave speed / diameter = {least:.2}, below {RETURN_LIMIT}): they take \
                 {} of the energy, {} of the restitution, which this model leaves out; {} \
                 them",
                percent(share),
                number(lost, 2),
                if term { "models fem and ting have" } else { "model fem has" }
            )
        });
        Some(Relevance {
            is_called_for: least < RETURN_LIMIT,
            number: format!(
                "contact time × shear wave speed / diameter of {name} = {least:.2}, the times that a wave \
                 crosses it within the contact"
            ),
            otherwise: "waves come back within the contact".to_string(),
            left_open: format!("they take {} of the restitution", number(lost, 2)),
            warning,
        })
    }

    /// Between Ting's impacts with and without; where they are no term, or no correction any more, what
    /// a half-space takes of the restitution.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let switch = scene.effects().partner_waves.filter(|switch| *switch != Switch::Off);
        let with = ComputedScene::quiet(&self.switched(scene, switch))?;
        let without = self.switched(&with, Some(Switch::Off));
        let speed = estimate.hertz.approach_speed();
        let estimate = Estimate::at(&with, speed).ok()?;
        if Self::radiating(&with, &estimate) != [None, None] {
            // A model without the term lacks what another one has.
            let is_term = Self::radiating_at_rest(&with, &estimate) != [None, None];
            let whole = with.clone().with_model(ModelChoice::Fem);
            let own = if is_term { &with } else { &whole };
            let impacts = [own, &without].map(|scene| TingPrediction::of(scene, speed, false));
            if let [Ok(one), Ok(without)] = impacts {
                let missing = missing_of_term(&crossed(&with, &estimate), &estimate);
                let told = one.change_from(&without);
                let whole = |part: f64| (part * (1.0 + missing)).clamp(-1.0, 1.0);
                return Some(NeglectError { restitution: told.restitution.map(whole), ..told });
            }
            // What relaxes takes part of what the waves would.
            if relaxes(&with) {
                return None;
            }
        }
        let share = radiated(&crossed(&with, &estimate), &estimate);
        (share > 0.0).then(|| NeglectError::restitution(lost(share)))
    }

    /// The radiation term has a relative error; a mesh resolves the waves.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> ModelFormError {
        let &EffectStatus { is_lacking, neglect_error } = status;
        let is_of_mesh = !is_lacking && *scene.model() == ModelChoice::Fem;
        let Some(neglect_error) = neglect_error.filter(|_| !is_of_mesh) else {
            return ModelFormError::NOTHING;
        };
        let part = if is_lacking { 1.0 } else { Self::error_of_term(scene, estimate) };
        // Where closed forms tell the loss alone.
        let others = SHARE_OF_LOSS * neglect_error.restitution.unwrap_or(f64::NAN);
        let shares = NeglectError::shares(estimate, others, others);
        let told = NeglectError {
            contact_time_s: neglect_error.contact_time_s.or(shares.contact_time_s),
            peak_force_n: neglect_error.peak_force_n.or(shares.peak_force_n),
            ..neglect_error
        };
        ModelFormError::of(&told, estimate).times(part)
    }
}

/// A body that waves cross.
struct Crossed<'a> {
    body: &'a Body,
    /// Elastic, with what is left of its moduli in the contact.
    material: Material,
    /// T c_s/D; nothing comes back from a half-space.
    passage: f64,
}

/// The bodies that waves cross: those of a material.
fn crossed<'a>(scene: &'a Scene, estimate: &Estimate) -> [Option<Crossed<'a>>; 2] {
    let EffectiveModuli { after, hertz, .. } = &estimate.effective;
    scene.bodies().each_ref().map(|body| {
        let material = left_at(body.material()?, *after);
        let way = hertz.contact_time() * material.shear_wave_speed();
        let passage = body.diameter().map_or(0.0, |diameter| way / diameter);
        Some(Crossed { body, material, passage })
    })
}

/// Returns the relative error of the radiation term of relaxing bodies, zero for elastic ones. See
/// [`SMOOTHED`].
fn missing_of_term(crossed: &[Option<Crossed>; 2], estimate: &Estimate) -> f64 {
    let modulus = |hertz: &HertzImpact| hertz.pair().contact_modulus();
    let kept = modulus(&estimate.effective.hertz) / modulus(&estimate.hertz);
    (SMOOTHED * radiated(crossed, estimate)).powi(2) * (kept.powi(-2) - 1.0).max(0.0)
}

/// Share of the energy that bodies take along from which nothing comes back in time.
fn radiated(crossed: &[Option<Crossed>; 2], estimate: &Estimate) -> f64 {
    taken(crossed, estimate, |passage| passage < RETURN_LIMIT)
}

/// Share of the energy that bodies of such passages keep.
fn taken(crossed: &[Option<Crossed>; 2], estimate: &Estimate, counts: fn(f64) -> bool) -> f64 {
    let hertz = &estimate.effective.hertz;
    let bodies = crossed.iter().flatten().filter(|body| counts(body.passage));
    bodies.map(|body| radiated_share(hertz, &body.material) * kept(body.passage)).sum()
}

/// Share of what a half-space takes that a body keeps: elements lost 0.35 of it at T c_s/D = 1.45, 0.023 at 2.99, 0.010
/// and 0.006 at 4.4 and 4.6, and 0.003 at 8.0, balls of a tenth to two thirds of its size on a softer one.
fn kept(passage: f64) -> f64 {
    passage.max(RADIATION_LIMIT).powi(-3)
}

/// Returns the loss of restitution that belongs to a share of the energy.
fn lost(share: f64) -> f64 {
    1.0 - (1.0 - share).max(0.0).sqrt()
}
