//! What a reduced model has of each effect, and what it leaves out of a case that has it.

use fem_case::{ModelChoice, Scene, Snapshots, Switch};

use crate::effects::{
    DashpotEffect, Effect, FiniteSizeEffect, FiniteStrain, Gravity, PartnerWaves, PlasticYield,
    RigidPartner, Support, SurfaceSlip, Vibration, Viscoelasticity,
};
use crate::estimate::Estimate;

/// What one reduced model has that another lacks.
#[derive(Clone, Debug)]
pub(in crate::models) struct Traits {
    /// What it has of the relaxation.
    pub relaxation: Relaxation,
    /// Its dashpot, in words; none where it has none.
    pub dashpot: Option<String>,
    /// Whether it has surfaces that slip on each other, as a term of its own.
    pub slip: bool,
    /// Whether it has the waves that do not come back, as a term of its own.
    pub waves: bool,
    /// Whether it has the spheres' own compliance, and why.
    pub finite_size: (bool, &'static str),
}

/// What a reduced model has of the relaxation of the materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::models) enum Relaxation {
    /// All of it.
    Whole,
    /// Its limit for slow contacts, relaxed moduli and viscosities.
    SlowLimit,
    /// Nothing: the moduli are instantaneous.
    Nothing,
}

/// Longest relaxation time over the contact time up to which the contact is slow.
const SLOW_LIMIT: f64 = 0.1;

/// What a reduced model has of each effect.
pub(super) fn has(
    effect: &dyn Effect,
    scene: &Scene,
    estimate: &Estimate,
    traits: &Traits,
) -> Option<Support> {
    Some(match effect.name() {
        Viscoelasticity::NAME => relaxation(scene, estimate, traits.relaxation),
        DashpotEffect::NAME => dashpot(scene.model(), traits.dashpot.as_deref()),
        FiniteSizeEffect::NAME => match (scene.model(), traits.finite_size) {
            (ModelChoice::Law { .. }, (is_there, reason)) => Support::is(is_there, reason),
            (_, finite_size) => FiniteSizeEffect::of_first_order(scene, estimate, finite_size),
        },
        PartnerWaves::NAME if traits.waves => {
            PartnerWaves::of_term(scene, estimate, PartnerWaves::radiating)
        }
        Gravity::NAME => Support::Inherent { idle: "" },
        Vibration::NAME => Vibration::of_rigid_bodies(estimate),
        SurfaceSlip::NAME if traits.slip => Support::Computes { idle: "" },
        FiniteStrain::NAME
        | SurfaceSlip::NAME
        | PlasticYield::NAME
        | PartnerWaves::NAME
        | RigidPartner::NAME => Support::Lacks,
        _ => return None,
    })
}

/// What the case gives and a reduced model does not read.
pub(super) fn unread_keys(scene: &Scene) -> Vec<String> {
    let name = describe(scene.model());
    // Who asks for none has them.
    let is_asked = |asked: &&Snapshots| match asked {
        Snapshots::Labels(labels) => !labels.is_empty(),
        Snapshots::Count(n) => *n > 0,
        Snapshots::Times(times) => !times.is_empty(),
    };
    let snapshots = scene.snapshots().filter(is_asked).map(|_| ("snapshots", "to draw"));
    let probes = scene.probes().first().map(|_| ("probe", "to tell of"));
    let warning = |(key, what)| format!("output.{key} has no effect: {name} has no fields {what}");
    snapshots.into_iter().chain(probes).map(warning).collect()
}

/// What the model has of the relaxation.
fn relaxation(scene: &Scene, estimate: &Estimate, has: Relaxation) -> Support {
    let relevance = Viscoelasticity.relevance(scene, estimate).unwrap_or_default();
    if !relevance.is_called_for {
        return Support::Inherent { idle: "" };
    }
    if has == Relaxation::Nothing && scene.effects().viscoelasticity == Some(Switch::On) {
        return Support::Lacks;
    }
    let reason = relevance.number;
    match has {
        Relaxation::Whole => Support::Inherent { idle: "" },
        Relaxation::SlowLimit => {
            let reason =
                format!("{reason}; the law has its slow limit, relaxed moduli and viscosities");
            Support::is(true, reason).warning(slowness(scene, estimate))
        }
        Relaxation::Nothing => {
            let name = describe(scene.model());
            let warning = format!(
                "{reason}, and {name} does not know it: it takes the instantaneous moduli. Model \
                 ting or fem computes the relaxation"
            );
            Support::is(false, format!("{reason}; not in {name}")).warning([warning])
        }
    }
}

fn dashpot(model: &ModelChoice, dashpot: Option<&str>) -> Support {
    let name = describe(model);
    match dashpot {
        Some(dashpot) => Support::is(true, format!("{name}: {dashpot}")),
        None => Support::is(false, format!("{name} has none here")),
    }
}

fn describe(model: &ModelChoice) -> String {
    match model {
        ModelChoice::Law { law, .. } => format!("law {}", law.family.name()),
        _ => format!("model {}", model.name()),
    }
}

/// A warning if the contact is not slow next to the relaxation.
fn slowness(scene: &Scene, estimate: &Estimate) -> Option<String> {
    let series = scene.bodies().iter().filter_map(|body| body.material()?.relaxation());
    let times = series.flat_map(|series| series.terms()).filter(|term| term.weight > 0.0);
    let longest = times.map(|term| term.relaxation_time).fold(0.0, f64::max);
    let ratio = longest / estimate.contact_time;
    (ratio > SLOW_LIMIT).then(|| {
        format!(
            "the longest relaxation time is {ratio:.2} contact times; above {SLOW_LIMIT} the slow \
             limit that kuwabara_kono takes from the materials is in doubt, and model ting is not"
        )
    })
}
