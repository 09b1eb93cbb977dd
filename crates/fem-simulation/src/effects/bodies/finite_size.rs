//! A sphere deforms otherwise than the half-space of Hertz: its own compliance is in series, to first order. A plate that bends
//! has its thickness with it ([`fem_laws::plate_thickness_factor`]).

use fem_case::{Body, Scene};
use fem_collision::QuantityOfInterest;

use crate::effects::decision::neglect_error::EffectStatus;
use crate::effects::decision::neglect_error::NeglectError;
use crate::effects::decision::relevance::percent;
use crate::effects::decision::simplified_scene::SimplifiedScene;
use crate::effects::decision::support::{Adequacy, ConsideredModel, Support};
use crate::effects::decision::{Effect, FiniteSizeEffect, Vibration};
use crate::effects::ting_prediction::{TingPrediction, relaxed_loss};
use crate::estimate::plate_impact::thin_plate_mobility;
use crate::estimate::viscous_flow::widest_contact;
use crate::estimate::{Estimate, Regime};
use crate::quantity_errors::QuantityErrors;

/// Coefficient of (a/R*)² in the errors of contact time and peak force: Ting's model with finite size agrees with finite
/// elements to 0.02 % at a/R* = 0.05.
const SECOND_ORDER: f64 = 0.1;

/// Relative error of the half-space pressure over strain times 1 − 2ν.
const PRESSURE_ERROR_PER_STRAIN: f64 = 0.15;

/// Largest share of the spheres' own compliance in Hertz' approach up to which its first order has errors of 1 % in contact
/// time and force, and half-spaces without it errors of 5 %. Poisson's ratios below −0.9 exceed it.
const MAX_SHARE: f64 = 0.1;

/// Largest share up to which the error is estimated; spheres up to 0.18 were compared.
const MAX_KNOWN: f64 = 0.25;

impl FiniteSizeEffect {
    /// Returns the support of a model that includes the first order of the effect, or does not, with the
    /// reason.
    pub(crate) fn of_first_order(
        scene: &Scene,
        estimate: &Estimate,
        (is_there, reason): (bool, &str),
    ) -> Support {
        let share = Self::share(scene, estimate).unwrap_or_default();
        let warning = (share > MAX_SHARE).then(|| {
            let inaccurate = match is_there {
                true => "the first order, which this model uses, is not accurate",
                false => "half-spaces, which this model uses, are not accurate",
            };
            format!(
                "the spheres' own compliance adds {} to Hertz' approach; above {} {inaccurate}: use model {}",
                percent(share),
                percent(MAX_SHARE),
                Vibration::models_that_serve(estimate)
            )
        });
        Support::decided(is_there, reason).warning(warning)
    }

    /// Returns the error of neglecting the effect for contacts that are too wide for its first order: a share s of the
    /// approach changes the stiffness by (1 − s)^(−3/2), and contact time and force follow with the power 2/5. For spheres
    /// that relax to 3 % and less it gives 6 to 12 % where 5 to 10 % were computed. The loss of restitution by relaxation and
    /// to a plate changes with the contact time, and the thickness of the plate adds its own change.
    fn by_stiffness(regime: &Regime, estimate: &Estimate) -> Option<NeglectError> {
        let scene = &regime.scene;
        let share = Self::share(scene, estimate).filter(|share| *share < MAX_KNOWN)?;
        let change = 0.6 * share;
        let by_size = NeglectError::shares(estimate, change, change);
        if thin_plate_mobility(scene).is_none() {
            let restitution = Some(change * relaxed_loss(scene, estimate));
            return Some(NeglectError { restitution, ..by_size });
        }
        let thin = TingPrediction::of(regime, false).ok()?;
        let by_thickness = TingPrediction::on_thick_plate(regime).ok()?.change_from(&thin);
        let restitution = Some(change * (1.0 - thin.restitution));
        Some(NeglectError { restitution, ..by_size }.plus(&by_thickness))
    }

    /// Returns the largest relative error of the half-space pressure.
    fn of_pressure(scene: &Scene, estimate: &Estimate) -> f64 {
        let materials = scene.bodies().iter().filter_map(Body::material);
        let sideways =
            materials.map(|material| 1.0 - 2.0 * material.instantaneous().poissons_ratio());
        PRESSURE_ERROR_PER_STRAIN * sideways.fold(0.0, f64::max) * estimate.strain
    }

    /// Returns the share of the spheres' own compliance in Hertz' approach, with the effective moduli.
    fn share(scene: &Scene, estimate: &Estimate) -> Option<f64> {
        let hertz = &estimate.effective.hertz;
        let size = estimate.effective.elastic_equivalent(scene).finite_size().ok()?;
        let added = size.added_approach(hertz.peak_force(), hertz.max_contact_radius());
        Some((added / hertz.max_approach()).abs())
    }
}

impl Effect for FiniteSizeEffect {
    fn neglect_error(&self, scene: &Scene, estimate: &Estimate) -> Option<NeglectError> {
        let regime = SimplifiedScene::quiet(scene.clone(), estimate)?;
        let [with, without] = [true, false].map(|size| TingPrediction::of(&regime, size).ok());
        match with.zip(without) {
            Some((with, without)) => Some(with.change_from(&without)),
            None => Self::by_stiffness(&regime, estimate),
        }
    }

    /// A model with the first order cannot compute a contact that is too wide for it.
    fn adequacy(&self, model: &ConsideredModel) -> Adequacy {
        if !matches!((model.support)(self), Some(Support::Is { active: true, .. })) {
            return model.with_or_without(self);
        }
        let (scene, estimate) = (model.case, model.estimate);
        let error = self.model_form_error(scene, estimate, &EffectStatus::default());
        let size = scene.finite_size().ok();
        let fault = size.and_then(|size| size.check(widest_contact(scene, estimate)).err());
        let impossible = fault.map(|fault| fault.to_string());
        Adequacy { error: Some(error), impossible, ..Adequacy::FULL }
    }

    /// A model with the first order has the error of the second. The pressure has the error of half-spaces in any case.
    fn model_form_error(
        &self,
        scene: &Scene,
        estimate: &Estimate,
        status: &EffectStatus,
    ) -> QuantityErrors {
        let second_order = SECOND_ORDER * estimate.strain.powi(2);
        let of_size = match status.is_lacking {
            true => status.neglect_error.unwrap_or_default(),
            false => NeglectError::shares(estimate, second_order, second_order),
        };
        let of_size = of_size.of_all_quantities(estimate);
        let pressure = Self::of_pressure(scene, estimate) * estimate.effective.sizes.peak_pressure;
        match of_size.size(QuantityOfInterest::PeakPressure) {
            Some(size) => of_size.with(QuantityOfInterest::PeakPressure, size + pressure),
            None => of_size,
        }
    }
}
