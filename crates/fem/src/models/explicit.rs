//! Explicit finite elements.

use fem_case::{Body, CaseFile, ModelChoice, Scene, Shape};
use fem_collision::{Approach, BodyInput, Collision, Monitor, Stop, Want};
use fem_contact::ContactInterface;
use fem_explicit::{Model as Bodies, Settings, collide};
use fem_material::{Material, PronySeries};
use fem_mesh::SphereMesh;

use super::region::until_it_fits;
use crate::approach::approach_of;
use crate::effects::{
    Answer, BulkViscosity, ContactSearch, Effect, FiniteStrain, Gravity, HourglassControl,
    MassScaling, MirrorSymmetry, Verdict, Viscoelasticity, decide,
};
use crate::estimate::Estimate;
use crate::limits::{check_elements, check_memory, check_updates, explicit_memory};
use crate::meshes::build_meshes;
use crate::method::{Cost, ElementSetup, Method, Model, Setup, Shared};
use crate::plan::Plan;
use crate::refusal::Refusal;

/// Growth of the searched region when the contact leaves it.
const CANDIDATE_GROWTH: f64 = 1.5;

/// Explicit finite elements, `[model] fem = {}`.
#[derive(Clone, Copy, Debug)]
pub struct ExplicitMethod;

/// Explicit finite elements, as a method.
pub const EXPLICIT: ExplicitMethod = ExplicitMethod;

impl Method for ExplicitMethod {
    fn name(&self) -> &'static str {
        "fem"
    }

    fn build(&self, scene: &Scene, _: &Shared) -> Result<Box<dyn Model>, Refusal> {
        Ok(Box::new(Explicit::new(scene)?))
    }

    fn price(&self, scene: &Scene) -> Result<u64, Refusal> {
        match Explicit::new(scene)?.setup.cost {
            Cost::Steps { element_updates, .. } => Ok(element_updates),
            _ => Ok(0),
        }
    }

    fn resolve(&self, scene: &Scene, file: CaseFile) -> Result<CaseFile, Refusal> {
        Ok(Plan::of(scene)?.resolve(file))
    }
}

/// A scene with meshes, masses and a time step.
#[derive(Clone, Debug)]
pub struct Explicit {
    /// What was decided on mesh, contact and time step.
    pub plan: Plan,
    /// Bodies and contact.
    pub bodies: Bodies,
    setup: Setup,
    scene: Scene,
    /// Kept for a model with a larger searched region.
    inputs: [BodyInput; 2],
}

impl Explicit {
    /// Decides, meshes, and builds the bodies.
    ///
    /// # Errors
    /// What the plan refuses; meshes that cannot be made or read; more elements, steps or memory
    /// than the limits allow.
    pub fn new(scene: &Scene) -> Result<Self, Refusal> {
        Self::with_plan(scene, Plan::of(scene)?)
    }

    /// Meshes and builds the bodies of a plan that may have been changed.
    ///
    /// # Errors
    /// As [`Explicit::new`].
    pub fn with_plan(scene: &Scene, plan: Plan) -> Result<Self, Refusal> {
        if *scene.model() != ModelChoice::Fem {
            let message = format!("model `{}` has no finite elements", scene.model().name());
            return Err(Refusal::new(scene.model().path(), message));
        }
        let meshes = build_meshes(scene, &plan)?;
        let inputs = inputs(scene, meshes);
        let approach = approach_of(scene)?;
        let bodies = Bodies::new(inputs.clone(), approach, &settings(&plan))
            .map_err(|error| Refusal::new("body", error.to_string()))?;
        let cost = cost(scene, &bodies, &plan)?;
        let (effects, mut warnings) = effects(scene, &plan.estimate, &bodies)?;
        warnings.extend(plan.warnings.iter().cloned());
        let setup = Setup {
            description: "model fem, explicit finite elements".to_string(),
            approach,
            want: plan.want(),
            estimate: plan.estimate,
            effects,
            warnings,
            cost,
            elements: Some(ElementSetup {
                plan: plan.clone(),
                has_springs: true,
                finer_steps: "lower time.step_factor",
            }),
        };
        Ok(Self { plan, bodies, setup, scene: scene.clone(), inputs })
    }

    /// Makes the bodies meet in another way.
    ///
    /// # Errors
    /// Bodies that do not approach, speeds without a finite estimate.
    fn meet(&mut self, approach: &Approach) -> Result<(), Stop> {
        if self.bodies.approach() == approach {
            return Ok(());
        }
        let not_made = |error: &dyn std::fmt::Display| Stop::NotMade(error.to_string());
        let estimate =
            Estimate::at(&self.scene, approach.speed()).map_err(|error| not_made(&error))?;
        let bodies = Bodies::new(self.inputs.clone(), *approach, &settings(&self.plan))
            .map_err(|error| not_made(&error))?;
        (self.plan.estimate, self.bodies) = (estimate, bodies);
        Ok(())
    }

    /// A larger searched region, if there is one.
    fn enlarge(&mut self) -> Result<(), Refusal> {
        let before = self.bodies.candidate_radius();
        self.plan.candidate_radius = CANDIDATE_GROWTH * before;
        let approach = *self.bodies.approach();
        let nothing_larger =
            || Refusal::new("body", "the searched region is as large as it can be");
        let bodies = Bodies::new(self.inputs.clone(), approach, &settings(&self.plan))
            .map_err(|_| nothing_larger())?;
        if bodies.candidate_radius() <= before {
            return Err(nothing_larger());
        }
        self.bodies = bodies;
        (self.setup.effects, _) = effects(&self.scene, &self.plan.estimate, &self.bodies)?;
        Ok(())
    }
}

impl Model for Explicit {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn collide(
        &mut self,
        approach: &Approach,
        want: &Want,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        if let Err(stop) = self.meet(approach) {
            return Collision::stopped(*approach, stop);
        }
        let run = |model: &Self| {
            collide(&model.bodies, model.plan.estimate.expectation(), want, &mut *monitor)
        };
        until_it_fits(self, run, |model, _| model.enlarge().map_err(|_| None))
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.bodies.bodies().each_ref().map(|body| body.mesh())
    }
}

fn inputs(scene: &Scene, meshes: [Option<SphereMesh>; 2]) -> [BodyInput; 2] {
    let mut meshes = meshes.into_iter();
    scene.bodies().each_ref().map(|body| match (body.shape(), meshes.next().flatten()) {
        (Shape::Sphere { material, .. }, Some(mesh)) => {
            BodyInput::Sphere { mesh, material: material.clone() }
        }
        _ => BodyInput::Wall,
    })
}

fn settings(plan: &Plan) -> Settings {
    Settings {
        contact_stiffness: plan.contact_stiffness,
        candidate_radius: plan.candidate_radius,
        step_factor: plan.step_factor,
        mass_scaling: plan.mass_scaling,
    }
}

/// What a run takes, within the limits.
fn cost(scene: &Scene, model: &Bodies, plan: &Plan) -> Result<Cost, Refusal> {
    let elements = model.n_elements() as u64;
    let nodes = model.bodies().iter().map(|body| body.n_nodes() as u64).sum();
    let branches: u64 = (model.bodies().iter().zip(scene.bodies()))
        .map(|(body, named)| body.n_elements() as u64 * n_branches(named))
        .sum();
    let steps = (1.2 * plan.estimate.contact_time / model.time_step()).ceil();
    let element_updates = (steps * elements as f64) as u64;
    let memory = explicit_memory(plan, elements, branches);
    check_elements(scene, plan, elements)?;
    check_memory(scene, plan, elements, memory)?;
    check_updates(scene, plan, steps as u64, elements, element_updates)?;
    Ok(Cost::Steps {
        elements,
        nodes,
        steps: steps as u64,
        element_updates,
        memory,
        time_step: model.time_step(),
        plain_time_step: model.plain_time_step(),
    })
}

/// Prony terms whose history is kept of a body.
fn n_branches(body: &Body) -> u64 {
    let series = body.material().and_then(Material::relaxation);
    let terms = series.into_iter().flat_map(PronySeries::terms);
    terms.filter(|term| term.weight > 0.0).count() as u64
}

/// What explicit elements have of each effect.
fn effects(
    scene: &Scene,
    estimate: &Estimate,
    model: &Bodies,
) -> Result<(Vec<Verdict>, Vec<String>), Refusal> {
    let hourglass = "elements with one mean stress need the stiffness of their bending modes";
    let search = format!(
        "{} integration points within {:.4e} m of the axis; free flight is not stepped",
        model.interface().map_or(0, ContactInterface::n_points),
        model.candidate_radius()
    );
    let (adds_mass, scaling) = mass_scaling(model, scene.bodies());
    let answers: Vec<(&'static dyn Effect, Answer)> = vec![
        (&Viscoelasticity, Answer::Computes { idle: "no history is kept" }),
        (&FiniteStrain, Answer::Lacks),
        (&MirrorSymmetry, Answer::Lacks),
        (&HourglassControl, Answer::Is(true, hourglass.to_string())),
        (&BulkViscosity, Answer::Lacks),
        (&Gravity, Answer::Lacks),
        (&ContactSearch, Answer::Is(true, search)),
        (&MassScaling, Answer::Is(adds_mass, scaling)),
    ];
    let decisions = decide(scene, estimate, answers)?;
    Ok((decisions.verdicts, decisions.warnings))
}

/// Whether mass is added, and to whom.
fn mass_scaling(model: &Bodies, bodies: &[Body; 2]) -> (bool, String) {
    let ratio = model.time_step() / model.plain_time_step();
    let added: Vec<String> = model
        .bodies()
        .iter()
        .zip(bodies)
        .filter(|(body, _)| body.added_mass() > 0.0)
        .map(|(body, named)| {
            format!("{:.1e} of the mass of {}", body.added_mass() / body.mass(), named.name())
        })
        .collect();
    match added.is_empty() {
        true => (false, "no mass is added".to_string()),
        false => (true, format!("adds {} for a {ratio:.1} times longer step", added.join(" and "))),
    }
}
