//! Cost of a run with explicit elements, within the limits.

use fem_case::{Body, Scene};
use fem_explicit::ExplicitBodies;
use fem_material::{Material, PronySeries};

use crate::effects::{BulkViscosity, FiniteStrain, MACH_LIMIT};
use crate::estimate::approach::expected_duration;
use crate::estimate::{Estimate, LARGE_STRAIN, mach};
use crate::models::condensed::cost::{MAX_BYTES, expected_bytes};
use crate::models::method::Cost;
use crate::plan::Plan;
use crate::plan::limits::{check_elements, check_memory, check_updates, explicit_memory};
use crate::plan::penalty_compliance::lengthening;
use crate::rejection::Rejection;

/// Seconds per element update on one core of 3 GHz, from docs/effects.md. Other machines differ by a factor.
struct UpdateSeconds {
    /// Seconds without relaxation.
    plain: f64,
    /// Additional seconds per Prony term.
    of_term: f64,
}

impl UpdateSeconds {
    const AT_SMALL_STRAIN: Self = Self { plain: 6e-9, of_term: 1e-9 };
    /// Includes the bounds of the time step.
    const AT_FINITE_STRAIN: Self = Self { plain: 20e-9, of_term: 7e-9 };

    fn of(&self, n_terms: f64) -> f64 {
        self.plain + n_terms * self.of_term
    }
}

/// Additional seconds per element update with bulk viscosity.
const SECONDS_OF_BULK_VISCOSITY: f64 = 5e-9;
/// Seconds per step of springs between deformed surfaces.
const SECONDS_OF_MOVED_CONTACT: f64 = 6e-6;
/// Seconds of the condensed reference runs per element.
const SECONDS_OF_CONDENSED_REFERENCE: f64 = 30e-6;

/// Returns the cost of a run, within the limits.
pub(super) fn cost(scene: &Scene, model: &ExplicitBodies, plan: &Plan) -> Result<Cost, Rejection> {
    let elements = model.n_elements() as u64;
    let nodes = model.bodies().iter().map(|body| body.n_nodes() as u64).sum();
    let branches: u64 = (model.bodies().iter().zip(scene.bodies()))
        .map(|(body, named)| body.n_elements() as u64 * n_branches(named))
        .sum();
    let duration = expected_duration(scene, &plan.estimate, model.approach()) * lengthening(plan);
    let steps = (duration / model.time_step()).ceil();
    let element_updates = (steps * elements as f64) as u64;
    let memory = explicit_memory(scene, plan, elements, branches);
    check_elements(scene, plan, elements)?;
    check_memory(scene, plan, elements, memory)?;
    check_updates(scene, plan, steps, elements)?;
    Ok(Cost::Steps {
        elements,
        nodes,
        steps: steps as u64,
        element_updates,
        seconds: with_reference_runs(
            scene,
            plan,
            elements,
            steps * seconds_a_step(scene, model, plan),
        ),
        memory,
        reference_memory: reference_memory(scene, model, plan),
        time_step: model.time_step(),
        plain_time_step: model.plain_time_step(),
    })
}

/// Element updates of the reference run with elements twice as long over those of the collision.
pub(crate) const REFERENCE_UPDATES: f64 = 0.125;

/// Returns whether the discretisation error of explicit elements needs a reference run of explicit elements: condensed
/// bodies have neither large strains nor waves, do not flow, and have no plate that bends. At twice the limit of the speed the
/// error is 1.4 % of the contact time for rubber on a wall, where they have 0.3 %.
pub(crate) fn needs_own_reference(estimate: &Estimate, is_at_finite_strain: bool) -> bool {
    let Estimate { mach, strain, flow, bends, .. } = *estimate;
    // A strain that is NaN counts as large.
    let is_large = is_at_finite_strain && (strain.is_nan() || strain >= LARGE_STRAIN);
    is_large || bends || mach >= MACH_LIMIT || flow.is_some()
}

/// Adds the reference runs to the seconds of a run.
fn with_reference_runs(scene: &Scene, plan: &Plan, elements: u64, seconds: f64) -> f64 {
    let is_finite = FiniteStrain::is_on(scene, &plan.estimate);
    let of_condensed = SECONDS_OF_CONDENSED_REFERENCE * elements as f64;
    match needs_own_reference(&plan.estimate, is_finite) {
        _ if !plan.makes_meshes => seconds,
        true => (1.0 + REFERENCE_UPDATES) * seconds + of_condensed,
        false => seconds + of_condensed,
    }
}

/// Returns the bytes of the condensed reference runs, the largest of which has elements of half the length and keeps its factors
/// where the run has snapshots, whose stress it judges; `None` if they are not made.
fn reference_memory(scene: &Scene, model: &ExplicitBodies, plan: &Plan) -> Option<u64> {
    let [lower, upper] = scene.bodies();
    let [of_lower, of_upper] = model.bodies().each_ref().map(|body| 4 * body.n_elements() as u64);
    let draws = scene.snapshots().is_none_or(|asked| !asked.is_empty());
    let are_allowed = MAX_BYTES * (of_lower + of_upper) <= plan.max_memory;
    (plan.makes_meshes && are_allowed)
        .then(|| expected_bytes([(lower, of_lower), (upper, of_upper)], draws))
}

/// Returns the seconds per step of both bodies.
fn seconds_a_step(scene: &Scene, model: &ExplicitBodies, plan: &Plan) -> f64 {
    let is_finite = model.changes_stiffness();
    let whole = mach(scene, scene.approach_speed() / plan.speed_share);
    let viscous =
        if BulkViscosity::is_on(scene, whole, is_finite) { SECONDS_OF_BULK_VISCOSITY } else { 0.0 };
    let seconds = model.bodies().iter().zip(scene.bodies()).map(|(body, named)| {
        let branches = n_branches(named) as f64;
        let small = UpdateSeconds::AT_SMALL_STRAIN.of(branches);
        let finite = UpdateSeconds::AT_FINITE_STRAIN.of(branches);
        let [n, n_finite] = [body.n_elements(), body.n_finite_elements()].map(|n| n as f64);
        n * (small + viscous) + n_finite * (finite - small)
    });
    let of_contact = if is_finite { SECONDS_OF_MOVED_CONTACT } else { 0.0 };
    seconds.sum::<f64>() + of_contact
}

/// Returns the number of Prony terms of a body that have a history.
fn n_branches(body: &Body) -> u64 {
    let series = body.material().and_then(Material::relaxation);
    let terms = series.into_iter().flat_map(PronySeries::terms);
    terms.filter(|term| term.weight > 0.0).count() as u64
}
