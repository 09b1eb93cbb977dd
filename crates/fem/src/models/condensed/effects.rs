//! What condensed bodies have of each effect, and what of the case they do not read.

use fem_case::{CondensedOptions, Scene};
use fem_condensed::CondensedPair;

use crate::effects::{
    Answer, ContactSearch, Effect, FiniteStrain, Gravity, PenaltySprings, Verdict, Vibration,
    Viscoelasticity, decide as decide_all,
};
use crate::plan::Plan;
use crate::refusal::Refusal;

/// Verdicts and warnings.
pub(super) fn decide(
    scene: &Scene,
    plan: &Plan,
    pair: &CondensedPair,
    options: CondensedOptions,
) -> Result<(Vec<Verdict>, Vec<String>), Refusal> {
    let estimate = &plan.estimate;
    let n_modes = pair.frequencies().map(<[f64]>::len);
    let spheres: Vec<(&str, usize)> = scene
        .bodies()
        .iter()
        .zip(n_modes)
        .filter(|(body, _)| body.diameter().is_some())
        .map(|(body, n_modes)| (body.name(), n_modes))
        .collect();
    let vibration = match options.vibration_modes {
        0 => format!("quasi-static: approach speed / shear wave speed = {:.1e}", estimate.mach),
        _ => {
            let counts = spheres.iter().map(|(name, n_modes)| format!("{n_modes} modes of {name}"));
            counts.collect::<Vec<_>>().join(", ")
        }
    };
    let springs = match options.penalty_springs {
        true => "those of the explicit model, at its Gauss points",
        false => "the surfaces do not overlap at the nodes",
    };
    let search = format!(
        "{} points within {:.4e} m of the axis; free flight is not stepped",
        pair.n_points(),
        pair.candidate_radius()
    );
    let answers: Vec<(&'static dyn Effect, Answer)> = vec![
        (&Viscoelasticity, Answer::Computes { idle: "" }),
        (&FiniteStrain, Answer::Lacks),
        (&Vibration, Answer::Is(options.vibration_modes > 0, vibration)),
        (&PenaltySprings, Answer::Is(options.penalty_springs, springs.to_string())),
        (&ContactSearch, Answer::Is(true, search)),
        (&Gravity, Answer::Lacks),
    ];
    let decisions = decide_all(scene, estimate, answers)?;
    let mut warnings = plan.warnings.clone();
    warnings.extend(decisions.warnings);
    warnings.extend(Vibration::warnings_of_modes(estimate, options.vibration_modes));
    warnings.extend(unresolved_modes(&spheres, options));
    warnings.extend(unread_keys(scene, options));
    Ok((decisions.verdicts, warnings))
}

/// Modes that were asked for and that the meshes are too coarse for.
fn unresolved_modes(spheres: &[(&str, usize)], options: CondensedOptions) -> Vec<String> {
    let unresolved = spheres.iter().filter(|(_, n_modes)| *n_modes < options.vibration_modes);
    let warning = |(name, n_modes): &(&str, usize)| {
        format!(
            "the mesh of {name} resolves {n_modes} of the {} modes of vibration asked for, the \
             others are left out: use a smaller mesh.contact_element_size for more",
            options.vibration_modes
        )
    };
    unresolved.map(warning).collect()
}

fn unread_keys(scene: &Scene, options: CondensedOptions) -> Vec<String> {
    let mut warnings = Vec::new();
    for (key, value) in
        [("time.step_factor", scene.step_factor()), ("time.mass_scaling", scene.mass_scaling())]
    {
        if value.is_some() {
            warnings.push(format!("{key} has no effect: model condensed has no critical step"));
        }
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
