//! Which effects a reduced model computes, and what it leaves out of a case that has it.

use fem_laws::laws::ContactLaw;

use crate::case::Case;
use crate::effects::{Effect, MACH_LIMIT, finite_strain, percent, relaxation};
use crate::estimate::Estimate;
use crate::model::{Dissipation, Law, Model};

/// Longest relaxation time over the contact time up to which the contact is slow.
const SLOW_LIMIT: f64 = 0.1;

/// Effects and warnings; `law` is what a contact law has become.
pub(super) fn decide(
    case: &Case,
    estimate: &Estimate,
    law: Option<&ContactLaw>,
) -> (Vec<Effect>, Vec<String>) {
    let scene = &case.scene;
    let model = &scene.model;
    let mut warnings = Vec::new();
    let relaxing = relaxation(scene, estimate);
    let is_slow_limit =
        matches!(model, Model::Law { law: Law::KuwabaraKono(Dissipation::Relaxation), .. });
    let knows_relaxation = is_slow_limit || matches!(model, Model::Ting { .. });
    let reason = match &relaxing {
        None => "no material relaxes".to_string(),
        Some(reason) if is_slow_limit => {
            format!("{reason}; the law has its slow limit, relaxed moduli and viscosities")
        }
        Some(reason) if knows_relaxation => reason.clone(),
        Some(reason) => {
            let name = describe(model);
            warnings.push(format!(
                "{reason}, and {name} does not know it: it takes the instantaneous moduli. Model \
                 ting or fem computes the relaxation"
            ));
            format!("{reason}; not in {name}")
        }
    };
    let viscoelasticity = relaxing.is_some() && knows_relaxation;
    let is_finite =
        matches!(model, Model::Hertz { finite_size: true } | Model::Ting { finite_size: true, .. });
    let (strain, strain_warning) = finite_strain(estimate);
    warnings.extend(strain_warning);
    warnings.extend(slowness(case, estimate).filter(|_| is_slow_limit));
    if estimate.mach > MACH_LIMIT {
        warnings.push(format!(
            "the approach speed is {} of the shear wave speed; above {} the bodies vibrate, which \
             this model leaves out",
            percent(estimate.mach),
            percent(MACH_LIMIT),
        ));
    }
    if case.gives("output.snapshots") {
        let name = describe(model);
        warnings.push(format!("output.snapshots has no effect: {name} has no fields to draw"));
    }
    let effect = |name, active, reason| Effect { name, active, reason };
    let effects = vec![
        effect("viscoelasticity", viscoelasticity, reason),
        dashpot(model, law),
        effect("finite size", is_finite, finite_size(model)),
        effect("finite strain", false, strain),
        effect("vibration", false, "the bodies move as a whole: quasi-static contact".to_string()),
        effect("gravity", false, "the case has none".to_string()),
    ];
    (effects, warnings)
}

fn describe(model: &Model) -> String {
    match model {
        Model::Law { law, .. } => format!("law {}", law.name()),
        _ => format!("model {}", model.name()),
    }
}

fn dashpot(model: &Model, law: Option<&ContactLaw>) -> Effect {
    let damping = law.map_or(0.0, ContactLaw::damping);
    let name = describe(model);
    let reason = match law {
        Some(law) if damping > 0.0 => format!(
            "{name}: C = {damping:.4e} N s/m^{:.4} at the exponent n = {:.4}",
            law.damping_exponent() + 1.0,
            law.damping_exponent()
        ),
        _ => format!("{name} has none here"),
    };
    Effect { name: "dashpot", active: damping > 0.0, reason }
}

fn finite_size(model: &Model) -> String {
    match model {
        Model::Hertz { finite_size: true } | Model::Ting { finite_size: true, .. } => {
            "the spheres' own compliance is in series, to first order".to_string()
        }
        Model::Law { .. } => "a law's stiffness is given".to_string(),
        _ => "half-spaces; finite_size = true adds the spheres' own compliance".to_string(),
    }
}

/// A warning if the contact is not slow next to the relaxation.
fn slowness(case: &Case, estimate: &Estimate) -> Option<String> {
    let series = case.scene.bodies.iter().filter_map(|body| body.material()?.relaxation());
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
