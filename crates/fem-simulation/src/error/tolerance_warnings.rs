//! Warnings about missed tolerances and unresolved contacts, with the setting to change.

use fem_case::engineering::show;
use fem_collision::{Collision, QuantityOfInterest};
use fem_material::engineering::Unit;

use super::estimate::{ErrorEstimate, NotRefined};
use super::noise_floor::early_pressure_radius;
use super::refinement::{REFINEMENT_RATIOS, is_of_chatter, length, refinement_ratio};
use super::refinement_cost_bound::affordable_ratio;
use super::tolerance_check::{ToleranceMiss, missed};
use crate::plan::mesh_source::longest_contact_edge;
use crate::simulation::Simulation;

/// Larger ratios of element sizes are not advised: the error there is not known.
const MAX_RATIO: f64 = 100.0;
/// Elements across the contact below which a mesh does not resolve it.
pub const MIN_ACROSS: f64 = 3.0;
/// Characters of a warning that is read in one look.
const MAX_LENGTH: usize = 230;
/// Elements across the contact that are advised: most estimates are then below 1 %.
const ADVISED_ACROSS: f64 = 5.5;

/// Returns a warning that the mesh resolves a contact of this radius (m) by too few elements.
pub(crate) fn unresolved_warning(simulation: &Simulation, contact_radius: f64) -> Option<String> {
    let plan = &simulation.setup().elements.as_ref()?.plan;
    if !(contact_radius > 0.0 && contact_radius.is_finite()) {
        return None;
    }
    let edge = longest_contact_edge(simulation.model().meshes(), contact_radius)?;
    let across = contact_radius / edge;
    let size = advised_size(contact_radius);
    let advice = match plan.makes_meshes {
        true => format!("set mesh.contact_element_size = \"{size}\" or less, or leave it out"),
        false => format!("use meshes with edges of {size} or less there"),
    };
    (across < MIN_ACROSS).then(|| {
        format!(
            "the contact radius spans only {across:.1} elements ({MIN_ACROSS} are needed); {advice}"
        )
    })
}

/// Returns a warning that the mesh does not resolve an early peak of the pressure, if a finer mesh would not be too
/// expensive. The error bar has it in any case.
pub(crate) fn early_pressure_warning(
    simulation: &Simulation,
    collision: &Collision,
) -> Option<String> {
    let radius = early_pressure_radius(simulation, collision)?;
    let size = simulation.setup().elements.as_ref()?.plan.contact_element_size;
    let is_affordable = affordable_ratio(simulation) >= ADVISED_ACROSS * size / radius;
    is_affordable.then(|| {
        format!(
            "the pressure is largest early, when the contact radius is {} and spans few elements: the peak pressure is \
             not resolved; set mesh.contact_element_size = \"{}\"",
            show(radius, "m"),
            advised_size(radius)
        )
    })
}

/// Returns a warning that the tolerance is missed, with the reason and what to do.
pub(crate) fn tolerance_warning(
    simulation: &Simulation,
    collision: &Collision,
    errors: &ErrorEstimate,
) -> Option<String> {
    let plan = &simulation.setup().elements.as_ref()?.plan;
    let missed = missed(simulation, collision, errors);
    let Some(miss) = missed.first() else { return not_estimated(simulation, collision, errors) };
    // Contact chatter has a warning of its own, and the plan warns before the run if no mesh is fine enough.
    let is_scatter = matches!(errors.not_refined, Some(NotRefined::Scatter(_)));
    if is_of_chatter(miss, collision) || (is_scatter && plan.is_out_of_reach) {
        return None;
    }
    let finer = advised_ratio(&missed, collision, plan.contact_element_size);
    // A given size is kept in both bodies, unless the case asks for staggered meshes too.
    let staggered = if plan.finer_body.is_some() { " and mesh.staggered = true" } else { "" };
    let write = format!(
        "write mesh.contact_element_size = \"{}\"{staggered}",
        length(plan.contact_element_size / finer)
    );
    match &errors.not_refined {
        Some(NotRefined::Scatter(scatter)) => {
            let text = format!(
                "{}, of which {} remains on any mesh: raise accuracy.tolerance",
                miss.described(),
                miss.printed(*scatter)
            );
            return Some(with_others(text, &missed));
        }
        Some(NotRefined::TooExpensive { updates: Some(updates) }) if finer <= MAX_RATIO => {
            let text = format!(
                "{} because of the mesh, limited by its cost: write limits.element_updates = {:.0e}, or {write}",
                miss.described(),
                rounded_up(*updates)
            );
            return Some(with_others(text, &missed));
        }
        _ => {}
    }
    let (cause, remedy) = cause_and_remedy(errors.not_refined.as_ref(), finer, &write);
    let text = format!("{} because of {cause}: {remedy}raise accuracy.tolerance", miss.described());
    Some(with_others(text, &missed))
}

/// Returns the cause of an error of the mesh or of a setting, and what to do beside raising the tolerance; `write` says how to make the
/// elements `finer` by a ratio.
fn cause_and_remedy(
    not_refined: Option<&NotRefined>,
    finer: f64,
    write: &str,
) -> (&'static str, String) {
    let remedy = match not_refined {
        Some(NotRefined::Setting(setting)) => {
            return (setting.described(), format!("leave {} out, or ", setting.key()));
        }
        _ if finer > MAX_RATIO => {
            return ("the mesh, and no mesh is known to be fine enough", String::new());
        }
        Some(NotRefined::FromFile) => "use meshes that are finer at the contact, or ".to_string(),
        Some(NotRefined::Gravity) => {
            format!("with gravity the mesh is not refined automatically; {write}, or ")
        }
        Some(NotRefined::Stopped(why)) => format!("on a finer mesh {why}, or "),
        Some(NotRefined::Rejected(fault)) => match fault.key() {
            Some(key) if key.starts_with("limits.") => {
                format!("on a finer mesh {}; raise {key}, or ", fault.message())
            }
            _ => format!("on a finer mesh {}; {write}, or ", fault.message()),
        },
        _ => format!("{write}, or "),
    };
    ("the mesh", remedy)
}

/// Returns the advised element size for a contact radius (m), rounded down to two digits.
fn advised_size(contact_radius: f64) -> String {
    let size = contact_radius / ADVISED_ACROSS;
    let step = 10f64.powf(size.log10().floor() - 1.0);
    let size = (size / step).floor() * step;
    Unit::fitting(size, "m").with_digits(2).show(size)
}

/// Adds the misses after the first one to a warning: with their sizes if it stays short, else their names or number alone.
fn with_others(text: String, missed: &[ToleranceMiss]) -> String {
    let Some((first, others)) = missed.split_first().filter(|(_, others)| !others.is_empty())
    else {
        return text;
    };
    let listed = |of: &dyn Fn(&ToleranceMiss) -> String| {
        let others: Vec<String> = others.iter().map(of).collect();
        format!("{text}; also missed: {}", others.join(", "))
    };
    let whole = listed(&|other| other.described_after(first));
    let names = listed(&|other| other.quantity.name().to_string());
    let is_short = |text: &String| text.chars().count() <= MAX_LENGTH;
    let shortest = format!("{text}; also missed: {} more", others.len());
    [whole, names].into_iter().find(is_short).unwrap_or(shortest)
}

/// Returns the ratio by which elements of this size (m) must become smaller, as far as a mesh can help.
fn advised_ratio(missed: &[ToleranceMiss], collision: &Collision, size: f64) -> f64 {
    let of_mesh = missed.iter().filter(|miss| miss.is_of_mesh());
    let excess = of_mesh.map(ToleranceMiss::excess_of_mesh).fold(1.0, f64::max);
    // With few elements the errors oscillate with the place of the contact's edge between two nodes.
    let radius = collision.max_contact_radius.filter(|radius| *radius > 0.0);
    let of_few = radius.map_or(1.0, |radius| ADVISED_ACROSS * size / radius);
    refinement_ratio(excess).max(REFINEMENT_RATIOS[0]).max(of_few)
}

/// Returns a warning that the discretisation error is not estimated, if it should be.
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
        "the discretisation error is not estimated: the coarser reference runs did not finish; lower \
         body.N.approach_speed, or compare results of several mesh.contact_element_size"
            .to_string()
    })
}

/// Rounds up to one digit.
fn rounded_up(updates: u64) -> f64 {
    let power = 10f64.powf((updates as f64).log10().floor());
    (updates as f64 / power).ceil() * power
}
