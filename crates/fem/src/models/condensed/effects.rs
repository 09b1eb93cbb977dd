//! Which effects condensed bodies compute, and where their limits lie.

use fem_condensed::CondensedPair;

use super::Options;
use crate::case::Case;
use crate::effects::{Effect, MACH_LIMIT, finite_strain, percent, relaxation, scene_effects};
use crate::estimate::Estimate;
use crate::plan::Plan;

/// Approach speed over shear wave speed above which inertia shortens the contact by more than
/// 0.15 %: 0.05 % at 1.5e-3 and 0.45 % at 1.5e-2 were measured on the glass pair.
pub const QUASI_STATIC_LIMIT: f64 = 5e-3;
/// Modes that bring it back.
const ENOUGH_MODES: usize = 12;

/// What the model lacks at this speed: inertia without modes of vibration, shocks with them.
pub(super) fn speed_warnings(estimate: &Estimate, options: Options) -> Vec<String> {
    let mut warnings = Vec::new();
    if estimate.mach > QUASI_STATIC_LIMIT && options.vibration_modes < ENOUGH_MODES {
        warnings.push(format!(
            "the approach speed is {} of the shear wave speed; above {} the inertia of the bodies \
             counts: set model.condensed.vibration_modes = {ENOUGH_MODES}, or use model fem",
            percent(estimate.mach),
            percent(QUASI_STATIC_LIMIT),
        ));
    }
    if estimate.mach > MACH_LIMIT {
        warnings.push(format!(
            "the approach speed is {} of the shear wave speed; above {} shocks form that no mode of \
             vibration carries: use model fem, which warns of them as well",
            percent(estimate.mach),
            percent(MACH_LIMIT),
        ));
    }
    warnings
}

pub(super) fn decide(
    case: &Case,
    plan: &Plan,
    pair: &CondensedPair,
    options: Options,
) -> (Vec<Effect>, Vec<String>) {
    let (scene, estimate) = (&case.scene, &plan.estimate);
    // The plan warns of the scene first, for the explicit model, and then of the mesh.
    let n_scene = scene_effects(scene, estimate).1.len();
    let mut warnings: Vec<String> = plan.warnings.iter().skip(n_scene).cloned().collect();
    let relaxing = relaxation(scene, estimate);
    let (strain, strain_warning) = finite_strain(estimate);
    warnings.extend(strain_warning);
    warnings.extend(speed_warnings(estimate, options));
    let n_modes = pair.frequencies().map(<[f64]>::len);
    let spheres: Vec<(&str, usize)> = scene
        .bodies
        .iter()
        .zip(n_modes)
        .filter(|(body, _)| body.diameter().is_some())
        .map(|(body, n_modes)| (body.name.as_str(), n_modes))
        .collect();
    for (name, n_modes) in &spheres {
        if *n_modes < options.vibration_modes {
            warnings.push(format!(
                "the mesh of {name} resolves {n_modes} of the {} modes of vibration asked for, the \
                 others are left out: use a smaller mesh.contact_element_size for more",
                options.vibration_modes
            ));
        }
    }
    for key in ["time.step_factor", "time.mass_scaling"] {
        if case.gives(key) {
            warnings.push(format!("{key} has no effect: model condensed has no critical step"));
        }
    }
    if case.gives("contact.penalty_factor") && !options.penalty_springs {
        warnings.push(
            "contact.penalty_factor has no effect: contact is exact unless \
             model.condensed.penalty_springs = true"
                .to_string(),
        );
    }
    let effect = |name, active, reason| Effect { name, active, reason };
    let vibration = match options.vibration_modes {
        0 => format!("quasi-static: approach speed / shear wave speed = {:.1e}", estimate.mach),
        _ => {
            let counts = spheres.iter().map(|(name, n_modes)| format!("{n_modes} modes of {name}"));
            counts.collect::<Vec<_>>().join(", ")
        }
    };
    let search = format!(
        "{} points within {:.4e} m of the axis; free flight is not stepped",
        pair.n_points(),
        pair.candidate_radius()
    );
    let effects = vec![
        effect(
            "viscoelasticity",
            relaxing.is_some(),
            relaxing.unwrap_or_else(|| "no material relaxes".to_string()),
        ),
        effect("finite strain", false, strain),
        effect("vibration", options.vibration_modes > 0, vibration),
        effect(
            "penalty springs",
            options.penalty_springs,
            if options.penalty_springs {
                "those of the explicit model, at its Gauss points".to_string()
            } else {
                "the surfaces do not overlap at the nodes".to_string()
            },
        ),
        effect("contact search", true, search),
        effect("gravity", false, "the case has none".to_string()),
    ];
    (effects, warnings)
}
