//! Which effects a scene calls for, and the number that decided.

use crate::estimate::Estimate;
use crate::scene::{Body, Scene};

/// Above this a/R the small-strain model is in doubt: that of a glass impact at 3 m/s.
const SMALL_STRAIN_LIMIT: f64 = 0.1;
/// Share of the contact time that small strain leaves open, over a/R: what contact along each body's
/// own normal instead of the common one changes, 0.2 % at a/R = 0.048 and 1.4 % at 0.30 (glass).
const OPEN_SHARE: f64 = 0.045;
/// Above this share of the shear wave speed an impact sends shocks.
pub(crate) const MACH_LIMIT: f64 = 0.02;

/// An effect and the reason why it is on or off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Effect {
    /// What it is called.
    pub name: &'static str,
    /// Whether the run computes it.
    pub active: bool,
    /// The number that decided.
    pub reason: String,
}

/// The effects of a scene, and warnings about those that it calls for and this
/// program does not have.
pub(crate) fn scene_effects(scene: &Scene, estimate: &Estimate) -> (Vec<Effect>, Vec<String>) {
    let mut effects = Vec::new();
    let mut warnings = Vec::new();
    let mut effect = |name, active, reason| effects.push(Effect { name, active, reason });

    let relaxation = relaxation(scene, estimate);
    let (active, reason) = match relaxation {
        Some(reason) => (true, reason),
        None => (false, "no material relaxes; no history is kept".to_string()),
    };
    effect("viscoelasticity", active, reason);

    let (reason, warning) = finite_strain(estimate);
    effect("finite strain", false, reason);
    warnings.extend(warning);

    let [first, second] = &scene.bodies;
    let identical = match (first.diameter(), second.diameter()) {
        (Some(a), Some(b)) => a == b && first.material() == second.material(),
        _ => false,
    };
    effect(
        "mirror symmetry",
        false,
        if identical {
            "the bodies are identical; both are computed all the same".to_string()
        } else {
            "the bodies differ".to_string()
        },
    );
    effect(
        "hourglass control",
        true,
        "elements with one mean stress need the stiffness of their bending modes".to_string(),
    );

    let mach = estimate.mach;
    effect(
        "bulk viscosity",
        false,
        format!(
            "approach speed / shear wave speed = {mach:.1e}; {}",
            if mach > MACH_LIMIT {
                "called for, but not available in this version"
            } else {
                "no shocks to spread"
            }
        ),
    );
    if mach > MACH_LIMIT {
        warnings.push(format!(
            "the approach speed is {} of the shear wave speed; above {} shocks form that this \
             version does not spread",
            percent(mach),
            percent(MACH_LIMIT),
        ));
    }
    effect("gravity", false, "the case has none".to_string());
    (effects, warnings)
}

/// Which bodies relax and by how much, if any does.
pub(crate) fn relaxation(scene: &Scene, estimate: &Estimate) -> Option<String> {
    let relaxing: Vec<&str> = scene
        .bodies
        .iter()
        .filter(|body| body.material().is_some_and(|m| m.relaxation().is_some()))
        .map(|body| body.name.as_str())
        .collect();
    (!relaxing.is_empty()).then(|| {
        format!(
            "{} relax{}: {} of the modulus is lost over one contact time",
            relaxing.join(" and "),
            if relaxing.len() == 1 { "es" } else { "" },
            percent(estimate.relaxed),
        )
    })
}

/// The size of the strain, and a warning if it is large.
pub(crate) fn finite_strain(estimate: &Estimate) -> (String, Option<String>) {
    let strain = estimate.strain;
    let open = percent(OPEN_SHARE * strain);
    let is_large = strain > SMALL_STRAIN_LIMIT;
    let reason = format!(
        "contact radius / effective radius = {strain:.3}; {}",
        if is_large {
            format!(
                "called for, but not available in this version; {open} of the contact time is open"
            )
        } else {
            format!("small strain leaves about {open} of the contact time open")
        }
    );
    let warning = is_large.then(|| {
        format!(
            "the contact radius is {} of the effective radius; above {} the small-strain model \
             is in doubt (about {open} of the contact time), and finite strain is not available in \
             this version",
            percent(strain),
            percent(SMALL_STRAIN_LIMIT),
        )
    });
    (reason, warning)
}

/// Effects that the built model decides.
pub(crate) fn model_effects(model: &fem_explicit::Model, bodies: &[Body; 2]) -> Vec<Effect> {
    let interface = model.interface();
    let search = format!(
        "{} integration points within {:.4e} m of the axis; free flight is not stepped",
        interface.n_points(),
        interface.candidate_radius()
    );
    let ratio = model.time_step() / model.plain_time_step();
    let added: Vec<String> = model
        .bodies()
        .iter()
        .zip(bodies)
        .filter(|(body, _)| body.added_mass() > 0.0)
        .map(|(body, named)| {
            format!("{:.1e} of the mass of {}", body.added_mass() / body.mass(), named.name)
        })
        .collect();
    let scaling = if added.is_empty() {
        "no mass is added".to_string()
    } else {
        format!("adds {} for a {ratio:.1} times longer step", added.join(" and "))
    };
    vec![
        Effect { name: "contact search", active: true, reason: search },
        Effect { name: "mass scaling", active: !added.is_empty(), reason: scaling },
    ]
}

pub(crate) fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}
