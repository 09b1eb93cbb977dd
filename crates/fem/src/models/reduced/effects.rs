//! What a reduced model has of each effect, and what it leaves out of a case that has it.

use fem_case::{Dissipation, Law, ModelChoice, Scene};
use fem_laws::laws::ContactLaw;

use crate::effects::{
    Answer, DashpotEffect, Effect, FiniteSizeEffect, FiniteStrain, Gravity, Verdict, Vibration,
    Viscoelasticity, decide as decide_all,
};
use crate::estimate::Estimate;
use crate::refusal::Refusal;

/// Longest relaxation time over the contact time up to which the contact is slow.
const SLOW_LIMIT: f64 = 0.1;

/// Verdicts and warnings; `law` is what a contact law has become.
pub(super) fn decide(
    scene: &Scene,
    estimate: &Estimate,
    law: Option<&ContactLaw>,
) -> Result<(Vec<Verdict>, Vec<String>), Refusal> {
    let model = scene.model();
    let is_slow_limit =
        matches!(model, ModelChoice::Law { law: Law::KuwabaraKono(Dissipation::Relaxation), .. });
    let (relaxation, mut warnings) = relaxation(scene, estimate, is_slow_limit);
    let is_finite = matches!(
        model,
        ModelChoice::Hertz { finite_size: true } | ModelChoice::Ting { finite_size: true, .. }
    );
    let rigid = "the bodies move as a whole: quasi-static contact".to_string();
    let answers: Vec<(&'static dyn Effect, Answer)> = vec![
        (&Viscoelasticity, relaxation),
        (&DashpotEffect, dashpot(model, law)),
        (&FiniteSizeEffect, Answer::Is(is_finite, finite_size(model))),
        (&FiniteStrain, Answer::Lacks),
        (&Vibration, Answer::Is(false, rigid)),
        (&Gravity, Answer::Lacks),
    ];
    let decisions = decide_all(scene, estimate, answers)?;
    warnings.extend(decisions.warnings);
    warnings.extend(slowness(scene, estimate).filter(|_| is_slow_limit));
    warnings.extend(Vibration::warning_of_rigid_bodies(estimate));
    if scene.snapshots().is_some() {
        let name = describe(model);
        warnings.push(format!("output.snapshots has no effect: {name} has no fields to draw"));
    }
    Ok((decisions.verdicts, warnings))
}

/// What the model has of the relaxation, and a warning if it has nothing of what is there.
fn relaxation(scene: &Scene, estimate: &Estimate, is_slow_limit: bool) -> (Answer, Vec<String>) {
    let need = Viscoelasticity.need(scene, estimate).unwrap_or_default();
    let knows_it = is_slow_limit || matches!(scene.model(), ModelChoice::Ting { .. });
    if !need.is_called_for || (knows_it && !is_slow_limit) {
        return (Answer::Computes { idle: "" }, Vec::new());
    }
    let reason = need.number;
    if is_slow_limit {
        let reason =
            format!("{reason}; the law has its slow limit, relaxed moduli and viscosities");
        return (Answer::Is(true, reason), Vec::new());
    }
    let name = describe(scene.model());
    let warning = format!(
        "{reason}, and {name} does not know it: it takes the instantaneous moduli. Model ting or \
         fem computes the relaxation"
    );
    (Answer::Is(false, format!("{reason}; not in {name}")), vec![warning])
}

fn describe(model: &ModelChoice) -> String {
    match model {
        ModelChoice::Law { law, .. } => format!("law {}", law.name()),
        _ => format!("model {}", model.name()),
    }
}

fn dashpot(model: &ModelChoice, law: Option<&ContactLaw>) -> Answer {
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
    Answer::Is(damping > 0.0, reason)
}

fn finite_size(model: &ModelChoice) -> String {
    match model {
        ModelChoice::Hertz { finite_size: true } | ModelChoice::Ting { finite_size: true, .. } => {
            "the spheres' own compliance is in series, to first order".to_string()
        }
        ModelChoice::Law { .. } => "a law's stiffness is given".to_string(),
        _ => "half-spaces; finite_size = true adds the spheres' own compliance".to_string(),
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
