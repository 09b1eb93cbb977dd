//! Lengthening of a contact by compliant penalty springs.

use crate::plan::Plan;

/// Ratios below this are neglected: the estimate is not more accurate.
const MIN_LENGTHENING: f64 = 1.05;
/// Integration steps over Hertz' approach.
const INTEGRATION_STEPS: f64 = 400.0;

/// Returns the contact time over that without springs, within a tenth; 1 for stiff springs. The contact time grows like the
/// largest approach.
///
/// Springs of stiffness k per area overlap by o when the bodies themselves approach by δ,
/// ```math
/// o = \frac{F}{\pi k (R \delta + R o)},
/// ```
/// which is the mean pressure of Hertz' contact over k for stiff springs, and Winkler's foundation under a sphere,
/// F = π k R o² (Johnson 1985, § 4.3), for soft ones. Bodies and springs together store the kinetic energy.
pub(crate) fn lengthening(plan: &Plan) -> f64 {
    let ratio = ratio(plan);
    if ratio > MIN_LENGTHENING { ratio } else { 1.0 }
}

/// Returns the relative lengthening by springs softer than the default; `None` for default springs, whose compliance is
/// part of the discretisation error.
pub(crate) fn softness(plan: &Plan) -> Option<f64> {
    plan.has_soft_springs().then(|| ratio(plan) - 1.0)
}

/// Returns the ratio without the bound [`MIN_LENGTHENING`]; 1 if it is not a number.
fn ratio(plan: &Plan) -> f64 {
    let hertz = &plan.estimate.hertz;
    let (stiff, radius) = (hertz.max_approach(), hertz.pair().effective_radius());
    let per_area = plan.contact_stiffness / plan.contact_element_size;
    let overlap = |approach: f64, force: f64| {
        let rest = 4.0 * force / (std::f64::consts::PI * per_area * radius);
        0.5 * (approach.hypot(rest.sqrt()) - approach)
    };
    let all = 0.4 * hertz.peak_force() * stiff;
    let (mut whole, mut force, mut energy) = (0.0, 0.0, 0.0);
    for k in 1..=INTEGRATION_STEPS as usize {
        if energy >= all {
            break;
        }
        let approach = stiff * k as f64 / INTEGRATION_STEPS;
        let next = hertz.force(approach);
        let after = approach + overlap(approach, next);
        energy += 0.5 * (force + next) * (after - whole);
        (force, whole) = (next, after);
    }
    let ratio = whole / stiff;
    if ratio.is_finite() { ratio.max(1.0) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use fem_case::Case;

    use super::*;

    /// The contact time over Hertz' agrees with explicit elements of 40 µm in the glass pair (claim `hard`).
    #[test]
    fn soft_springs_lengthen_the_contact() {
        let text = include_str!("../../../../cases/glass_0.5ms_elastic.toml");
        for (factor, measured) in [(1e-3, 1.74), (1e-2, 1.15), (0.1, 1.0), (1.0, 1.0), (1e3, 1.0)] {
            let set = [
                format!("contact.penalty_factor={factor}"),
                "mesh.contact_element_size='40 um'".to_string(),
            ];
            let case = Case::parse("glass.toml", text, Path::new("."), &set).unwrap();
            let found = lengthening(&Plan::of_case(&case).unwrap());
            assert!((found / measured - 1.0).abs() < 0.1, "{factor}: {found}");
        }
    }
}
