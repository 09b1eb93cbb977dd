//! A case that is ready to run with finite elements.

use fem_explicit::{
    BodyInput, Collision, Model, ModelError, Monitor, RunSettings, Settings, Stop, collide,
    n_states,
};
use fem_mesh::Quality;

use crate::case::Case;
use crate::effects::{Effect, model_effects};
use crate::error::CaseError;
use crate::meshes::{build_meshes, half_disc, mesh_error};
use crate::plan::Plan;
use crate::scene::{Body, Shape};

/// Bytes an element of the built-in mesh takes: element blocks, some one node's
/// worth of vectors, and the ladder of states kept for snapshots.
const BYTES_PER_ELEMENT: u64 = 1_600;
/// Bytes a Prony term takes an element.
const BYTES_PER_BRANCH: u64 = 40;
/// Bytes a state kept for a snapshot takes an element: displacement, velocity,
/// effective displacement.
const BYTES_PER_STATE: u64 = 48;
/// Growth of the searched region when the contact leaves it.
const CANDIDATE_GROWTH: f64 = 1.5;

/// What a run will cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Elements of both bodies.
    pub elements: u64,
    /// Nodes of both bodies.
    pub nodes: u64,
    /// Steps until separation.
    pub steps: u64,
    /// Elements times steps.
    pub element_updates: u64,
    /// Bytes.
    pub memory: u64,
}

/// A case with its meshes and its model, ready to run.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The case.
    pub case: Case,
    /// What was decided.
    pub plan: Plan,
    /// Quality of each sphere's mesh.
    pub quality: [Option<Quality>; 2],
    /// The model.
    pub model: Model,
    /// What the run will cost.
    pub cost: Cost,
    /// Kept for a model with a larger searched region.
    inputs: [BodyInput; 2],
}

impl Problem {
    /// Decides, meshes, and builds the model.
    ///
    /// # Errors
    /// What the plan refuses; meshes that cannot be made or read; more elements,
    /// steps or memory than the limits allow.
    pub fn new(case: Case) -> Result<Self, CaseError> {
        let plan = Plan::of(&case)?;
        Self::with_plan(case, plan)
    }

    /// Meshes and builds the model of a plan that may have been changed.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub fn with_plan(case: Case, plan: Plan) -> Result<Self, CaseError> {
        if case.scene.model != crate::Model::Fem {
            let message = format!("model `{}` has no finite elements", case.scene.model.name());
            return Err(case.error_at(&case.scene.model.path(), message));
        }
        let meshes = build_meshes(&case, &plan)?;
        let quality = meshes.each_ref().map(|mesh| mesh.as_ref().map(Quality::of));
        let mut bodies = case.scene.bodies.iter().zip(meshes);
        let mut input = || match bodies.next() {
            Some((Body { shape: Shape::Sphere { material, .. }, velocity, .. }, Some(mesh))) => {
                BodyInput::Deformable { mesh, material: material.clone(), velocity: *velocity }
            }
            Some((body, _)) => BodyInput::Wall { velocity: body.velocity },
            None => BodyInput::Wall { velocity: 0.0 },
        };
        let inputs = [input(), input()];
        let model =
            Model::new(inputs.clone(), &settings(&plan)).map_err(|e| model_error(&case, &e))?;
        let cost = cost(&model, &plan);
        check_elements(&case, &plan, cost.elements)?;
        check_memory(&case, &plan, cost.elements, cost.memory)?;
        if cost.element_updates > plan.max_element_updates {
            return Err(case
                .error_at(
                    blamed(&case, "limits.element_updates"),
                    format!(
                        "the run would take {} steps of {} elements, {:.1e} element updates",
                        cost.steps, cost.elements, cost.element_updates as f64
                    ),
                )
                .with_help(format!(
                    "at most {:.1e} are allowed; use a larger contact_element_size or more \
                     time.mass_scaling, or raise limits.element_updates",
                    plan.max_element_updates as f64
                )));
        }
        Ok(Self { case, plan, quality, model, cost, inputs })
    }

    /// All effects, the plan's and the model's.
    pub fn effects(&self) -> Vec<Effect> {
        let mut effects = self.plan.effects.clone();
        effects.extend(model_effects(&self.model, &self.case.scene.bodies));
        effects
    }

    /// Runs until the bodies have separated. Should the contact outgrow the
    /// searched region, the run starts again with a larger one.
    pub fn run(&mut self, monitor: &mut dyn Monitor) -> Collision {
        loop {
            let collision = collide(&self.model, &self.run_settings(), monitor);
            match collision.stopped {
                Some(Stop::ContactBeyondCandidates { .. }) if self.enlarge_candidates() => {}
                _ => return collision,
            }
        }
    }

    fn run_settings(&self) -> RunSettings {
        RunSettings {
            expected_contact_time: self.plan.estimate.contact_time,
            expected_approach: self.plan.estimate.approach,
            history_rows: self.plan.history_rows,
            snapshots: self.plan.snapshots.clone(),
            max_time: self.plan.max_time,
        }
    }

    /// Whether the searched region could be made larger.
    fn enlarge_candidates(&mut self) -> bool {
        let before = self.model.interface().candidate_radius();
        self.plan.candidate_radius = CANDIDATE_GROWTH * before;
        match Model::new(self.inputs.clone(), &settings(&self.plan)) {
            Ok(model) if model.interface().candidate_radius() > before => {
                self.model = model;
                true
            }
            _ => false,
        }
    }
}

fn settings(plan: &Plan) -> Settings {
    Settings {
        contact_stiffness: plan.contact_stiffness,
        candidate_radius: plan.candidate_radius,
        step_factor: plan.step_factor,
        mass_scaling: plan.mass_scaling,
        gap: plan.gap,
    }
}

/// Refuses meshes that are too large before they are made.
pub(crate) fn check_size(case: &Case, plan: &Plan) -> Result<(), CaseError> {
    let mut elements = 0;
    let mut memory = 0;
    for body in &case.scene.bodies {
        if let Shape::Sphere { diameter, mesh: None, material } = &body.shape {
            let n = half_disc(plan, *diameter)
                .n_elements()
                .map_err(|error| mesh_error(case, &error))? as u64;
            let branches = material.relaxation().map_or(0, |series| series.terms().len()) as u64;
            elements += n;
            memory += n * (BYTES_PER_ELEMENT + branches * BYTES_PER_BRANCH);
        }
    }
    check_elements(case, plan, elements)?;
    check_memory(case, plan, elements, state_memory(plan, elements).saturating_add(memory))
}

fn state_memory(plan: &Plan, elements: u64) -> u64 {
    (elements * BYTES_PER_STATE).saturating_mul(n_states(&plan.snapshots) as u64)
}

fn check_elements(case: &Case, plan: &Plan, elements: u64) -> Result<(), CaseError> {
    if elements <= plan.max_elements {
        return Ok(());
    }
    let key = blamed(case, "limits.elements");
    let found = format!(
        "the meshes would have {elements} elements, {:.3e} m long at the contact",
        plan.contact_element_size
    );
    Err(case.error_at(key, found).with_help(format!(
        "at most {} are allowed; use a larger mesh.contact_element_size or raise limits.elements",
        plan.max_elements
    )))
}

fn check_memory(case: &Case, plan: &Plan, elements: u64, memory: u64) -> Result<(), CaseError> {
    if memory <= plan.max_memory {
        return Ok(());
    }
    let states = state_memory(plan, elements);
    let (key, remedy) = if states > memory / 2 {
        ("output.snapshots", "ask for fewer output.snapshots")
    } else {
        (blamed(case, "limits.memory"), "use a larger mesh.contact_element_size")
    };
    let megabytes = |bytes: u64| format!("{:.1} MB", bytes as f64 / 1e6);
    let found = format!(
        "the run would take about {} of memory, {} of it for snapshots",
        megabytes(memory),
        megabytes(states)
    );
    Err(case.error_at(key, found).with_help(format!(
        "at most {} are allowed; {remedy} or raise limits.memory",
        megabytes(plan.max_memory)
    )))
}

/// The element size if the case gives it, else the limit if that is given.
fn blamed<'a>(case: &Case, limit: &'a str) -> &'a str {
    let size = "mesh.contact_element_size";
    if !case.gives(size) && case.gives(limit) { limit } else { size }
}

fn model_error(case: &Case, error: &ModelError) -> CaseError {
    case.error_at("body", error.to_string())
}

fn cost(model: &Model, plan: &Plan) -> Cost {
    let elements = model.n_elements() as u64;
    let nodes = model.bodies().iter().map(|body| body.n_nodes() as u64).sum();
    let branches: u64 =
        model.bodies().iter().map(|body| body.n_elements() as u64 * body.n_branches() as u64).sum();
    let steps = (1.2 * plan.estimate.contact_time / model.time_step()).ceil();
    Cost {
        elements,
        nodes,
        steps: steps as u64,
        element_updates: (steps * elements as f64) as u64,
        memory: state_memory(plan, elements)
            .saturating_add(elements * BYTES_PER_ELEMENT + branches * BYTES_PER_BRANCH),
    }
}
