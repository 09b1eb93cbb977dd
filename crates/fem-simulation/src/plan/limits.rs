//! `[limits]`: a run that exceeds a limit is rejected before it starts.

use std::ops::RangeInclusive;

use fem_case::{ModelChoice, PlateSupport, Scene, Shape};
use fem_explicit::n_states;
use fem_material::engineering::show;
use fem_mesh::MeshError;

use crate::effects::{BulkViscosity, FiniteStrain};
use crate::estimate::mach;
use crate::plan::Plan;
use crate::plan::mesh_source::{graded_plate, half_disc, mesh_rejection, quarter_disc};
use crate::rejection::Rejection;

/// Growth of the elements below which it is the reason of their number.
const SLOW_GROWTH: f64 = 1.01;
/// Step factors that do not make a run ten times as long as the default.
const USUAL_STEPS: RangeInclusive<f64> = 0.1..=1.0;
/// Penalty factors that change neither the steps nor the contact time tenfold.
const USUAL_SPRINGS: RangeInclusive<f64> = 0.01..=100.0;

/// Bytes per element of the generated mesh: element blocks, vectors of about one node, and the states kept for snapshots.
const BYTES_PER_ELEMENT: u64 = 1_600;
/// Bytes per element and Prony term.
const BYTES_PER_BRANCH: u64 = 40;
/// Bytes per element of a state kept for a snapshot: displacement, velocity, effective displacement.
const BYTES_PER_STATE: u64 = 48;
/// Bytes per element and Prony term at finite strain, with three pairs of flow variables in place of one.
const BYTES_PER_FINITE_BRANCH: u64 = BYTES_PER_BRANCH + 32;
/// Bytes per element of finite strain: force and work of the contact's dashpots, and of relaxation at the end of a step.
const BYTES_PER_FINITE_ELEMENT: u64 = 120;
/// Bytes per element of bulk viscosity: its blocks, force, work and means.
const BYTES_PER_VISCOUS_ELEMENT: u64 = 190;

/// Returns the bytes of a run of explicit elements; `branches` is the sum of all elements' Prony terms.
pub(crate) fn explicit_memory(scene: &Scene, plan: &Plan, elements: u64, branches: u64) -> u64 {
    let whole = mach(scene, scene.approach_speed() / plan.speed_share);
    let is_finite = FiniteStrain::is_on(scene, &plan.estimate);
    let is_viscous = BulkViscosity::is_on(scene, whole, is_finite);
    let viscous = if is_viscous { elements * BYTES_PER_VISCOUS_ELEMENT } else { 0 };
    let (branch, finite) = match is_finite {
        true => (BYTES_PER_FINITE_BRANCH, elements * BYTES_PER_FINITE_ELEMENT),
        false => (BYTES_PER_BRANCH, 0),
    };
    let fields = elements * BYTES_PER_ELEMENT + branches * branch + finite + viscous;
    state_memory(plan, elements).saturating_add(fields)
}

/// Checks that explicit elements can have meshes of a scene, whichever model it names.
pub(crate) fn check_size_of_elements(scene: &Scene) -> Result<(), Rejection> {
    let scene = scene.clone().with_model(ModelChoice::Fem);
    check_size(&scene, &Plan::of(&scene)?)
}

/// Checks the size of meshes before they are generated.
pub(crate) fn check_size(scene: &Scene, plan: &Plan) -> Result<(), Rejection> {
    let (mut elements, mut branches) = (0, 0);
    for (side, body) in scene.bodies().iter().enumerate() {
        let made = match body.shape() {
            Shape::Sphere { diameter, mesh: None, material } => {
                Some((half_disc(plan, side, *diameter).n_elements(), material))
            }
            Shape::HalfSpace { material } => {
                Some((quarter_disc(plan, side).n_elements(), material))
            }
            Shape::Plate { plate, material } => {
                Some((graded_plate(plan, side, plate, material).n_elements(), material))
            }
            Shape::Sphere { mesh: Some(_), .. } | Shape::Rigid { .. } | Shape::Wall => None,
        };
        if let Some((n, material)) = made {
            let is_bonded = body.plate().is_some_and(|plate| plate.support == PlateSupport::Bonded);
            let n = n.map_err(|error| match error {
                MeshError::TooLarge(_) => {
                    blame_growth(scene, mesh_rejection(&error, side, material, is_bonded))
                }
                _ => mesh_rejection(&error, side, material, is_bonded),
            })? as u64;
            elements += n;
            branches += n * material.relaxation().map_or(0, |series| series.terms().len()) as u64;
        }
    }
    check_elements(scene, plan, elements)?;
    let memory = match scene.model() {
        // The factors have a bound of their own.
        ModelChoice::Condensed(_) => state_memory(plan, elements),
        _ => explicit_memory(scene, plan, elements, branches),
    };
    check_memory(scene, plan, elements, memory)
}

fn state_memory(plan: &Plan, elements: u64) -> u64 {
    (elements * BYTES_PER_STATE).saturating_mul(n_states(&plan.snapshots) as u64)
}

/// Checks the number of elements.
///
/// # Errors
/// More elements than the limit; the error points at mesh.contact_element_size or limits.elements.
pub(crate) fn check_elements(scene: &Scene, plan: &Plan, elements: u64) -> Result<(), Rejection> {
    if elements <= plan.max_elements {
        return Ok(());
    }
    let key = blamed(scene, "limits.elements", scene.limits().elements);
    let found = format!(
        "the meshes would have {elements} elements, whose edges at the contact are {} long",
        show(plan.contact_element_size, "m")
    );
    let rejection = Rejection::new(key, found).with_help(format!(
        "at most {} are allowed; use a larger mesh.contact_element_size or raise limits.elements",
        plan.max_elements
    ));
    Err(blame_growth(scene, rejection))
}

/// Checks the memory of a run (bytes).
///
/// # Errors
/// More memory than the limit; the error points at output.snapshots, mesh.contact_element_size or limits.memory.
pub(crate) fn check_memory(
    scene: &Scene,
    plan: &Plan,
    elements: u64,
    memory: u64,
) -> Result<(), Rejection> {
    if memory <= plan.max_memory {
        return Ok(());
    }
    let states = state_memory(plan, elements);
    let (key, remedy) = if states > memory / 2 {
        ("output.snapshots", "ask for fewer output.snapshots")
    } else {
        let key = blamed(scene, "limits.memory", scene.limits().memory);
        (key, "use a larger mesh.contact_element_size")
    };
    let megabytes = |bytes: u64| format!("{:.1} MB", bytes as f64 / 1e6);
    let found = format!(
        "the run would take about {} of memory, {} of it for snapshots",
        megabytes(memory),
        megabytes(states)
    );
    Err(Rejection::new(key, found).with_help(format!(
        "at most {} are allowed; {remedy} or raise limits.memory",
        megabytes(plan.max_memory)
    )))
}

/// Checks the number of element updates.
///
/// # Errors
/// More element updates than the limit; the error points at mesh.contact_element_size or limits.element_updates, or at the
/// key that makes the steps many.
pub(crate) fn check_updates(
    scene: &Scene,
    plan: &Plan,
    steps: f64,
    elements: u64,
) -> Result<(), Rejection> {
    let element_updates = steps * elements as f64;
    // A value that is not a number exceeds every limit.
    if element_updates <= plan.max_element_updates as f64 {
        return Ok(());
    }
    let found = format!(
        "the run would take {steps:.1e} steps of {elements} elements, {element_updates:.1e} element \
         updates"
    );
    let allowed = format!("at most {:.1e} are allowed", plan.max_element_updates as f64);
    Err(match unusual_step(scene) {
        Some((key, help)) => Rejection::new(key, found)
            .with_help(format!("{allowed}; {help}, or raise limits.element_updates")),
        None => {
            let key = blamed(scene, "limits.element_updates", scene.limits().element_updates);
            Rejection::new(key, found).with_help(format!(
                "{allowed}; use a larger mesh.contact_element_size or more time.mass_scaling, or raise \
                 limits.element_updates"
            ))
        }
    })
}

/// Names `mesh.growth` as the cause of many elements if it is very small.
fn blame_growth(scene: &Scene, rejection: Rejection) -> Rejection {
    match scene.mesh().growth {
        Some(growth) if growth < SLOW_GROWTH => {
            Rejection::new("mesh.growth", rejection.message).with_help(format!(
                "elements grow too slowly; use a mesh.growth of at least {SLOW_GROWTH}, or leave it out"
            ))
        }
        _ => rejection,
    }
}

/// Returns the key whose value is far from the default and makes the steps many, with advice.
fn unusual_step(scene: &Scene) -> Option<(&'static str, &'static str)> {
    let is_unusual = |value: Option<f64>, usual: RangeInclusive<f64>| {
        value.is_some_and(|value| !usual.contains(&value))
    };
    if is_unusual(scene.step_factor(), USUAL_STEPS) {
        let help = "time.step_factor makes the steps far shorter than needed; leave it out";
        return Some(("time.step_factor", help));
    }
    is_unusual(scene.penalty_factor(), USUAL_SPRINGS).then_some((
        "contact.penalty_factor",
        "contact.penalty_factor is far from its default and makes the time step very short; leave it out",
    ))
}

/// Returns the key to name: the limit if the case gives it and not the element size, else the element size.
fn blamed(scene: &Scene, limit: &'static str, given: Option<u64>) -> &'static str {
    let has_size = scene.mesh().contact_element_size.is_some();
    if !has_size && given.is_some() { limit } else { "mesh.contact_element_size" }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem_case::Case;
    use std::path::Path;

    use crate::simulation::Simulation;

    const BALL: &str = include_str!("../../../../cases/soft_sphere.toml");

    /// Compares the planned memory of a run with the bytes of its state late in the contact.
    fn planned_and_used(switch: &str, terms: usize) -> [f64; 2] {
        let term = "{ weight = 0.01, relaxation_time = '3 ms' }";
        let set = [
            format!("effects.finite_strain='{switch}'"),
            "effects.bulk_viscosity='off'".to_string(),
            "effects.viscoelasticity='on'".to_string(),
            "output.snapshots=[]".to_string(),
            "mesh.contact_element_size='0.8 mm'".to_string(),
            format!("material.rubber.relaxation.terms=[{}]", vec![term; terms].join(",")),
        ];
        let case = Case::parse("ball.toml", BALL, Path::new("."), &set).unwrap();
        let plan = Plan::of(case.scene()).unwrap();
        let simulation = Simulation::new(case).unwrap();
        let n = simulation.model().meshes()[1].unwrap().quads().len() as u64;
        let counted = explicit_memory(simulation.case().scene(), &plan, n, n * terms as u64);
        let mut stepper = simulation.start();
        while stepper.progress().fraction < 0.1 && stepper.advance(&mut ()) {}
        let kept = postcard::to_stdvec(&stepper.restart_state().unwrap().contact).unwrap().len();
        [counted as f64, kept as f64]
    }

    /// The restart state has eight bytes per number, as the run itself.
    #[test]
    fn the_memory_of_finite_strain_is_planned() {
        for terms in [1, 6] {
            let (off, on) = (planned_and_used("off", terms), planned_and_used("on", terms));
            let [planned, used] = [0, 1].map(|k| on[k] - off[k]);
            assert!(
                used > 0.0 && (1.0..1.5).contains(&(planned / used)),
                "{terms}: {planned} {used}"
            );
        }
    }
}
