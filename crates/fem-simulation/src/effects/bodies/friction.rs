//! Friction between the surfaces, and what it changes of the contact along the axis.
//!
//! An oblique impact has the tangential half of its contact ([`fem_laws::TangentialContact`]), computed as if the bodies were alike.
//! Unlike ones, of Dundurs' β, slip on each other along r too, which takes part of the friction: below the speed at which they slide
//! throughout, nothing uncoupled is reliable. Without any slip their contact is stiffer along the axis by the factor
//! ln[(1+β)/(1−β)]/2β (Spence, *J. Elasticity* 5, 1975, 297), of which friction gives a part: the contact is shorter by up to two fifths
//! of that.

use fem_case::engineering::number;
use fem_case::{Body, Scene};

use crate::effects::decision::neglect_error::{EffectStatus, NeglectError};
use crate::effects::decision::relevance::Relevance;
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, FrictionEffect, TangentialCoupling};
use crate::estimate::Estimate;
use crate::quantity_errors::QuantityErrors;

/// Dundurs' |β| up to which bodies slide on each other as like ones do.
const SMALL_BETA: f64 = 0.05;

/// How far the materials of two bodies couple normal and tangential contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coupling {
    /// Dundurs' second parameter β, of its size.
    pub beta: f64,
    /// Tangential over normal stiffness of the contact.
    pub stiffness_ratio: f64,
}

impl Coupling {
    /// Returns whether the error of an uncoupled impact is unknown at ψ₁, the velocity of the patch over that at which it slides, in
    /// units of the compliances.
    pub fn is_unknown(&self, psi: f64) -> bool {
        self.beta > SMALL_BETA && psi < 1.0
    }
}

impl FrictionEffect {
    /// Returns the coupling of a scene's bodies, with instantaneous moduli.
    pub(crate) fn coupling(scene: &Scene) -> Coupling {
        let of = |body: &Body| {
            body.material().map_or([0.0; 2], |material| {
                let moduli = material.instantaneous();
                let (nu, shear) = (moduli.poissons_ratio(), moduli.shear_modulus());
                [(1.0 - nu) / shear, (1.0 - 0.5 * nu) / shear]
            })
        };
        let [[n1, s1], [n2, s2]] = scene.bodies().each_ref().map(of);
        Coupling {
            beta: scene.surface_slip().dundurs_beta().abs(),
            stiffness_ratio: (n1 + n2) / (s1 + s2),
        }
    }
}

impl FrictionEffect {
    /// Returns the support of a model for friction and what belongs to it, in a scene that has friction or is oblique.
    pub(crate) fn of_model(scene: &Scene, computes: bool) -> Option<Support> {
        let is_there = scene.friction() > 0.0 || scene.is_oblique();
        is_there.then_some(if computes { Support::Inherent { idle: "" } } else { Support::Lacks })
    }
}

impl Effect for FrictionEffect {
    fn relevance(&self, scene: &Scene, _: &Estimate) -> Option<Relevance> {
        let friction = scene.friction();
        let is_needed = friction > 0.0 && scene.is_oblique();
        (friction > 0.0 || scene.is_oblique()).then(|| Relevance {
            is_needed,
            number: format!("coefficient of friction = {}", number(friction, 3)),
            if_not_needed: match friction > 0.0 {
                true => "the bodies meet head-on".to_string(),
                false => "surfaces without friction".to_string(),
            },
            open_error: "the tangential half of the impact is open".to_string(),
            warning: None,
        })
    }

    /// Stiffer contact of unlike bodies whose surfaces do not slip at all, the most that friction does along the axis.
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let beta = Self::coupling(scene).beta;
        if scene.friction() == 0.0 || beta == 0.0 {
            return None;
        }
        let share = 0.4 * (beta.atanh() / beta - 1.0);
        Some(NeglectError::shares(estimate, -share, share))
    }

    /// No model has the friction of a contact along the axis.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        _: &EffectStatus,
    ) -> QuantityErrors {
        match self.neglect_error(scene, estimate) {
            Some(error) => error.of_all_quantities(estimate),
            None => QuantityErrors::ZERO,
        }
    }

    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        let is_needed = model.case.friction() > 0.0 && model.case.is_oblique();
        let impossible = (is_needed && model.lacks(self))
            .then(|| "it has no friction in an oblique impact".to_string());
        Adequacy { impossible, ..Adequacy::FULL }
    }
}

impl Effect for TangentialCoupling {
    fn relevance(&self, scene: &Scene, _: &Estimate) -> Option<Relevance> {
        if scene.friction() == 0.0 || !scene.is_oblique() {
            return None;
        }
        let beta = FrictionEffect::coupling(scene).beta;
        let ratio = match beta > 0.0 {
            true => format!(", friction / β = {}", number(scene.friction() / beta, 3)),
            false => String::new(),
        };
        Some(Relevance {
            is_needed: beta > SMALL_BETA,
            number: format!("Dundurs' β = {}{ratio}", number(beta, 2)),
            if_not_needed: "the bodies slide on each other as like ones do".to_string(),
            open_error: "the rebound of a patch that sticks is open".to_string(),
            warning: None,
        })
    }

    /// It is part of the errors of the tangential half alone.
    fn model_form_error(&self, _: &Scene, _: &Estimate, _: &EffectStatus) -> QuantityErrors {
        QuantityErrors::ZERO
    }
}
