//! Support of condensed bodies for each effect, and the keys of a case that they do not read.

use fem_case::{CondensedOptions, Scene};
use fem_condensed::CondensedPair;

use super::options;
use crate::effects::{
    AdhesionEffect, ContactSearch, Effect, FiniteStrain, FrictionEffect, Gravity, MaterialLoss,
    MirrorSymmetry, PartnerWaves, PenaltySprings, PlasticFlow, PlateBending, RigidPartner, Support,
    SurfaceSlip, TangentialCoupling, Vibration, Viscoelasticity,
};
use crate::estimate::Estimate;
use crate::models::reduced::effects::no_dent;

/// Returns the support of a scene's condensed bodies for an effect; without the bodies, as far as it is known before
/// they are condensed.
pub(super) fn support(
    effect: &dyn Effect,
    scene: &Scene,
    estimate: &Estimate,
    pair: Option<&CondensedPair>,
) -> Option<Support> {
    let options = options(scene);
    Some(match effect.name() {
        Viscoelasticity::NAME => Support::Inherent { idle: "" },
        Gravity::NAME => Support::Inherent { idle: "" },
        FrictionEffect::NAME => return FrictionEffect::of_model(scene, true),
        TangentialCoupling::NAME => return FrictionEffect::of_model(scene, false),
        SurfaceSlip::NAME => Support::Computes { idle: "" },
        PlateBending::NAME => return PlateBending::of_model(scene),
        PartnerWaves::NAME => PartnerWaves::of_condensed(scene, estimate),
        Vibration::NAME => {
            let spheres = pair.map(|pair| modes_of_spheres(scene, pair)).unwrap_or_default();
            Vibration::of_modes(estimate, options.vibration_modes, &spheres)
        }
        PenaltySprings::NAME => match options.penalty_springs {
            true => Support::decided(true, "those of the explicit model, at its Gauss points"),
            false => Support::decided(false, "the surfaces do not overlap at the nodes"),
        },
        ContactSearch::NAME => ContactSearch::within(&pair?.candidate_region()),
        MirrorSymmetry::NAME if pair.is_none() => MirrorSymmetry::support_by_elements(scene),
        MaterialLoss::NAME if !MaterialLoss::is_lacking(scene, estimate) => return None,
        MaterialLoss::NAME
        | FiniteStrain::NAME
        | PlasticFlow::NAME
        | AdhesionEffect::NAME
        | MirrorSymmetry::NAME
        | RigidPartner::NAME => Support::Lacks,
        _ => return None,
    })
}

/// Returns the number of vibration modes of each sphere, by name.
fn modes_of_spheres<'a>(scene: &'a Scene, pair: &CondensedPair) -> Vec<(&'a str, usize)> {
    let n_modes = pair.frequencies().map(<[f64]>::len);
    let bodies = scene.bodies().iter().zip(n_modes);
    let spheres = bodies.filter(|(body, _)| body.diameter().is_some());
    spheres.map(|(body, n_modes)| (body.name(), n_modes)).collect()
}

/// Returns the keys that the case sets and condensed bodies do not read.
pub(super) fn unread_keys(scene: &Scene, options: CondensedOptions) -> Vec<String> {
    let mut warnings: Vec<String> = no_dent(scene, "model condensed").into_iter().collect();
    for (key, value) in
        [("time.step_factor", scene.step_factor()), ("time.mass_scaling", scene.mass_scaling())]
    {
        if value.is_some() {
            warnings.push(format!("{key} has no effect: model condensed has no critical step"));
        }
    }
    if scene.contact_method().is_some() {
        let what = if options.penalty_springs {
            "the condensed model has penalty springs at Gauss points only"
        } else {
            "contact is exact"
        };
        warnings.push(format!("contact.method has no effect: {what}"));
    }
    if scene.penalty_factor().is_some() && !options.penalty_springs {
        warnings.push(
            "contact.penalty_factor has no effect: contact is exact unless \
             model.condensed.penalty_springs = true"
                .to_string(),
        );
    }
    warnings
}
