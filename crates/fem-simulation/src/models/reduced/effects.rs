//! Support of reduced models for each effect, and the keys of a case that they do not read.

use fem_case::{ModelChoice, Scene, Spot, Switch};
use fem_laws::laws::ContactLaw;
use fem_material::engineering::number;

use crate::effects::{
    AdhesionEffect, DashpotEffect, Effect, FiniteSizeEffect, FiniteStrain, FrictionEffect, Gravity,
    MaterialLoss, PartnerWaves, PlasticFlow, PlateBending, RigidPartner, Support, SurfaceSlip,
    TangentialCoupling, Vibration, Viscoelasticity,
};
use crate::estimate::Estimate;

/// Longest relaxation time over the contact time up to which the contact is slow.
const SLOW_LIMIT: f64 = 0.1;

/// Returns the support of a scene's reduced model for an effect. The contact law, if there is one, describes its
/// dashpot.
pub(super) fn support(
    effect: &dyn Effect,
    scene: &Scene,
    estimate: &Estimate,
    law: Option<&ContactLaw>,
) -> Option<Support> {
    let is_ting = matches!(scene.model(), ModelChoice::Ting { .. });
    let dents = law.is_some_and(|law| law.elastic_plastic().is_some());
    Some(match effect.name() {
        Viscoelasticity::NAME if is_ting => Support::Inherent { idle: "" },
        Viscoelasticity::NAME => relaxation(scene, estimate),
        DashpotEffect::NAME => dashpot(scene.model(), law),
        FiniteSizeEffect::NAME => finite_size(scene, estimate),
        PlateBending::NAME => return PlateBending::of_model(scene),
        PartnerWaves::NAME if is_ting => {
            PartnerWaves::of_term(scene, estimate, PartnerWaves::radiating)
        }
        SurfaceSlip::NAME if is_ting => Support::Computes { idle: "" },
        Gravity::NAME => Support::Inherent { idle: "" },
        FrictionEffect::NAME => return FrictionEffect::of_model(scene, true),
        TangentialCoupling::NAME => return FrictionEffect::of_model(scene, false),
        AdhesionEffect::NAME if !AdhesionEffect::is_lacking(scene, scene.approach_speed()) => {
            return None;
        }
        PlasticFlow::NAME if dents => Support::Inherent { idle: "" },
        // The loss of a contact law is the user's.
        PlasticFlow::NAME if law.is_some() => return None,
        // The strain of a dent is that of its law.
        FiniteStrain::NAME if dents => return None,
        Vibration::NAME => Vibration::of_rigid_bodies(estimate),
        MaterialLoss::NAME if !MaterialLoss::is_lacking(scene, estimate) => return None,
        MaterialLoss::NAME
        | FiniteStrain::NAME
        | SurfaceSlip::NAME
        | PlasticFlow::NAME
        | AdhesionEffect::NAME
        | PartnerWaves::NAME
        | RigidPartner::NAME => Support::Lacks,
        _ => return None,
    })
}

/// Returns warnings about keys of the case that a reduced model does not read.
pub(super) fn unread_keys(scene: &Scene) -> Vec<String> {
    let name = describe(scene.model());
    let snapshots =
        scene.snapshots().filter(|asked| !asked.is_empty()).map(|_| ("snapshots", "to draw"));
    let probes = scene.probes().first().map(|_| ("probe", "to record"));
    let warning = |(key, what)| format!("output.{key} has no effect: {name} has no fields {what}");
    let fields = snapshots.into_iter().chain(probes).map(warning);
    fields.chain(no_dent(scene, &name)).collect()
}

/// Returns a warning for a ball that is to fall onto its own dent in a model that keeps none.
pub(in crate::models) fn no_dent(scene: &Scene, name: &str) -> Option<String> {
    let gravity = scene.gravity()?;
    (gravity.spot == Some(Spot::Same) && gravity.bounces > 1).then(|| {
        format!(
            "gravity.spot has no effect: {name} keeps no dent, and each contact is that of undented surfaces; use model fem"
        )
    })
}

/// Returns the support of a model that takes instantaneous moduli, or the limit of slow contacts, for relaxation.
fn relaxation(scene: &Scene, estimate: &Estimate) -> Support {
    let relevance = Viscoelasticity.relevance(scene, estimate).unwrap_or_default();
    let reason = relevance.number;
    let has_slow_limit =
        matches!(scene.model(), ModelChoice::Law { law, .. } if law.is_slow_limit());
    if has_slow_limit && relevance.is_needed {
        let reason =
            format!("{reason}; the law has its slow limit, relaxed moduli and viscosities");
        return Support::decided(true, reason).warning(slowness(scene, estimate));
    }
    if !relevance.is_needed {
        return Support::decided(false, reason);
    }
    if scene.effects().viscoelasticity == Some(Switch::On) {
        return Support::Lacks;
    }
    let name = describe(scene.model());
    let warning = format!(
        "{reason}, which {name} neglects: it uses the instantaneous moduli; use model ting, condensed or fem"
    );
    Support::decided(false, format!("{reason}; not in {name}")).warning([warning])
}

fn dashpot(model: &ModelChoice, law: Option<&ContactLaw>) -> Support {
    let name = describe(model);
    let Some(law) = law.filter(|law| law.damping() > 0.0) else {
        return Support::decided(false, format!("{name} has no dashpot"));
    };
    let exponent = law.damping_exponent();
    let power = match number(exponent + 1.0, 5).as_str() {
        "1" => String::new(),
        power => format!("^{power}"),
    };
    let overlap = match exponent {
        0.0 => String::new(),
        n => format!(" × overlap^{}", number(n, 5)),
    };
    let damping = number(law.damping(), 5);
    let reason = format!(
        "{name}: force = C{overlap} × speed against the motion, C = {damping} N s/m{power}"
    );
    Support::decided(true, reason)
}

fn finite_size(scene: &Scene, estimate: &Estimate) -> Support {
    let is_there = match scene.model() {
        ModelChoice::Hertz { finite_size } | ModelChoice::Ting { finite_size, .. } => *finite_size,
        _ => return Support::decided(false, "a law's stiffness is given"),
    };
    let reason = match is_there {
        true => "the spheres' own compliance is in series, to first order",
        false => "half-spaces; finite_size = true adds the spheres' own compliance",
    };
    FiniteSizeEffect::of_first_order(scene, estimate, (is_there, reason))
}

fn describe(model: &ModelChoice) -> String {
    match model {
        ModelChoice::Law { law, .. } => format!("law {}", law.family.name()),
        _ => format!("model {}", model.name()),
    }
}

/// Returns a warning if the contact is not slow compared with the relaxation.
fn slowness(scene: &Scene, estimate: &Estimate) -> Option<String> {
    let series = scene.bodies().iter().filter_map(|body| body.material()?.relaxation());
    let times = series.flat_map(|series| series.terms()).filter(|term| term.weight > 0.0);
    let longest = times.map(|term| term.relaxation_time).fold(0.0, f64::max);
    let ratio = longest / estimate.contact_time;
    (ratio > SLOW_LIMIT).then(|| {
        format!(
            "the longest relaxation time is {ratio:.2} contact times; above {SLOW_LIMIT} the slow \
             limit that kuwabara_kono takes from the materials does not hold: use model ting"
        )
    })
}
