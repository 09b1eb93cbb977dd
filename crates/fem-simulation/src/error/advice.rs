//! Warnings about tolerances that are missed, and about meshes that do not resolve the contact.

use fem_case::engineering::show;
use fem_collision::{Collision, QuantityOfInterest};
use fem_material::engineering::Unit;

use super::estimator::{ErrorEstimate, early_pressure_radius};
use super::refinement::{FALL, NotRefined, ROOM, STEPS, is_of_chatter, length};
use super::tolerance_check::{ToleranceMiss, missed};
use crate::plan::mesh_source::longest_contact_edge;
use crate::simulation::Simulation;

/// Elements across the contact with which errors fall as usual; with fewer they fall with [`FALL_OF_FEW`].
const FEW: f64 = 4.5;
const FALL_OF_FEW: f64 = 3.0;
/// A larger ratio of element sizes is not advised: the error there is not known.
const MOST_ADVISED: f64 = 100.0;
/// Elements across the contact below which a mesh is named as too coarse before the run.
const FEWEST: f64 = 3.0;
/// Elements across the contact that are advised: most estimates are then below 1 %.
const ADVISED: f64 = 5.5;

/// Returns the widest contact radius of a finished collision (m). A contact of the poles alone or of less than an element
/// has no radius of its own: the expected one counts.
pub(crate) fn widest_contact(simulation: &Simulation, collision: &Collision) -> Option<f64> {
    let radius = collision.max_contact_radius.filter(|_| collision.is_complete())?;
    let size = simulation.setup().elements.as_ref()?.plan.contact_element_size;
    let expected = simulation.estimate(collision)?.contact_radius;
    Some(if radius > 0.0 && expected >= size { radius } else { expected })
}

/// Returns whether the contact of a finished collision is narrower than an element.
pub(crate) fn is_unresolved(simulation: &Simulation, collision: &Collision) -> bool {
    let radius = widest_contact(simulation, collision);
    let edge = radius.and_then(|radius| longest_contact_edge(simulation.model().meshes(), radius));
    radius.zip(edge).is_some_and(|(radius, edge)| radius < edge)
}

/// Returns a warning that the mesh resolves a contact of this radius (m) by too few elements.
pub(crate) fn unresolved_warning(simulation: &Simulation, contact_radius: f64) -> Option<String> {
    let plan = &simulation.setup().elements.as_ref()?.plan;
    if !(contact_radius > 0.0 && contact_radius.is_finite()) {
        return None;
    }
    let edge = longest_contact_edge(simulation.model().meshes(), contact_radius)?;
    let across = contact_radius / edge;
    let size = show(contact_radius / ADVISED, "m");
    let advice = match plan.makes_meshes {
        true => format!("set mesh.contact_element_size = \"{size}\" or less, or leave it out"),
        false => format!("use meshes with edges of {size} or less there"),
    };
    (across < FEWEST).then(|| {
        format!("the contact radius is resolved by only {across:.1} elements of the mesh; {advice}")
    })
}

/// Returns a warning that the mesh does not resolve an early peak of the pressure.
pub(crate) fn early_pressure_warning(
    simulation: &Simulation,
    collision: &Collision,
) -> Option<String> {
    let radius = early_pressure_radius(simulation, collision)?;
    let size = Unit::fitting(radius / ADVISED, "m").with_digits(2).show(radius / ADVISED);
    Some(format!(
        "the pressure is largest early, when the contact radius is {} and spans few elements: the peak pressure is not \
         resolved; set mesh.contact_element_size = \"{size}\"",
        show(radius, "m")
    ))
}

/// Returns a warning that the tolerance is missed, with the reason and what to do.
pub(crate) fn tolerance_warning(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Option<String> {
    let plan = &simulation.setup().elements.as_ref()?.plan;
    let missed = missed(simulation, collision, errors);
    let Some(miss) = missed.first() else {
        return not_estimated(simulation, collision, errors);
    };
    // Contact chatter has a warning of its own.
    if is_of_chatter(miss, collision) {
        return None;
    }
    let finer = refinement_needed(simulation, &missed, collision);
    let others: Vec<String> = missed[1..].iter().map(|other| other.after(miss)).collect();
    let others = match others.is_empty() {
        true => String::new(),
        false => format!("; also missed: {}", others.join(", ")),
    };
    let what = miss.in_words();
    let mut cause = "the mesh";
    let size = length(plan.contact_element_size / finer);
    let write = format!("write mesh.contact_element_size = \"{size}\"");
    let remedy = match &errors.not_refined {
        // The plan says so before the run.
        Some(NotRefined::Scatter(_)) if plan.is_out_of_reach => return None,
        Some(NotRefined::Scatter(scatter)) => {
            return Some(format!(
                "{what}, and by {} on any mesh: allow more in accuracy.tolerance{others}",
                miss.number(*scatter)
            ));
        }
        Some(NotRefined::Setting(setting)) => {
            cause = setting.in_words();
            format!("leave {} out", setting.key())
        }
        _ if finer > MOST_ADVISED => {
            return Some(format!(
                "{what} because of {cause}, and no mesh is known to be enough: allow more in \
                 accuracy.tolerance{others}"
            ));
        }
        Some(NotRefined::FromFile) => "use meshes that are finer at the contact".to_string(),
        Some(NotRefined::Gravity) => {
            format!("elements of contacts under gravity are not made finer; {write}")
        }
        Some(NotRefined::TooExpensive { updates: Some(updates) }) => format!(
            "a finer mesh would take {:.1e} element updates; write limits.element_updates = {:.0e}, or {write}",
            *updates as f64,
            rounded_up(*updates)
        ),
        Some(NotRefined::Stopped(why)) => format!("on a finer mesh {why}"),
        Some(NotRefined::Rejected(fault)) => match fault.key() {
            Some(key) if key.starts_with("limits.") => {
                format!("on a finer mesh {}; raise {key}", fault.message())
            }
            _ => format!("on a finer mesh {}; {write}", fault.message()),
        },
        None | Some(NotRefined::Given | NotRefined::TooExpensive { updates: None }) => write,
    };
    Some(format!(
        "{what} because of {cause}: {remedy}, or allow more in accuracy.tolerance{others}"
    ))
}

/// Returns the ratio by which elements would have to be smaller, as far as a mesh can help.
fn refinement_needed(
    simulation: &Simulation,
    missed: &[ToleranceMiss],
    collision: &Collision,
) -> f64 {
    let of_mesh = missed.iter().filter(|miss| miss.is_of_mesh());
    let excess = of_mesh.map(ToleranceMiss::excess_of_mesh).fold(1.0, f64::max);
    let elements = simulation.setup().elements.as_ref();
    let size = elements.map(|elements| elements.plan.contact_element_size);
    let radius = collision.max_contact_radius.filter(|radius| *radius > 0.0);
    let across = radius.zip(size).map_or(FEW, |(radius, size)| radius / size);
    let to_usual = (FEW / across).max(1.0);
    let (excess, of_few) = (ROOM * excess, to_usual.powf(FALL_OF_FEW));
    let ratio = match excess < of_few {
        true => excess.powf(1.0 / FALL_OF_FEW),
        false => to_usual * (excess / of_few).powf(1.0 / FALL),
    };
    // With few elements the errors swing with the place of the contact's edge between two nodes.
    ratio.max(STEPS[0]).max(ADVISED / across)
}

/// Returns a warning that the discretisation error is not estimated, where it should be.
fn not_estimated(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Option<String> {
    let should_be = collision.is_complete()
        && collision.element_updates.is_some()
        && simulation.setup().elements.as_ref()?.plan.makes_meshes;
    let is_estimated = errors.discretisation(QuantityOfInterest::PeakForce).is_some();
    (should_be && !is_estimated).then(|| {
        "the discretisation error is not estimated: on coarser meshes the bodies did not come through the \
         collision; lower body.N.approach_speed, or compare results of several mesh.contact_element_size"
            .to_string()
    })
}

/// Rounds up to one digit.
fn rounded_up(updates: u64) -> f64 {
    let power = 10f64.powf((updates as f64).log10().floor());
    (updates as f64 / power).ceil() * power
}
