//! Explicit finite elements.

pub(crate) mod cost;

use std::borrow::Cow;
use std::sync::Arc;

use fem_case::{Body, CaseFile, ModelChoice, Scene};
use fem_collision::{
    Approach, BodyInput, Collision, Ending, Monitor, OutputRequest, Phase, Progress,
    STEPS_BETWEEN_REPORTS, StaticContact, Stop,
};
use fem_explicit::{
    ExplicitBodies, ModelError, ModelParts, NodeForce, Run, Settings, SmallStrainContact,
    ViscosityCoefficients, Weight,
};
use fem_mesh::SphereMesh;

use self::cost::cost;
use super::condensed::static_contact::of_elements;
use super::mirrored::whole_or_half;
use super::own_frame::OwnFrame;
use crate::effects::{
    AdhesionEffect, BulkViscosity, ContactSearch, Effect, FiniteStrain, FrictionEffect, Gravity,
    HourglassControl, MassScaling, MaterialLoss, MirrorSymmetry, PartnerWaves, PlasticFlow,
    PlateBending, RateDependence, RigidPartner, Support, SurfaceSlip, Viscoelasticity, decide,
};
use crate::estimate::approach::{approach_of, expected_duration, frame_of};
use crate::estimate::quasi_static::surfaces_slip;
use crate::estimate::{Estimate, Regime, mach};
use crate::models::method::{ElementSetup, Method, Model, ModelSetup, SharedModels, estimate_at};
use crate::models::stepper::{RestartState, Stepper, stopped, to_the_end};
use crate::plan::body_source::BodySource;
use crate::plan::contact_method::{ContactNoiseAdvice, ignored_method_warning};
use crate::plan::{Plan, candidate_radius};
use crate::rejection::Rejection;

/// Growth factor of the candidate region if the contact leaves it.
const CANDIDATE_GROWTH: f64 = 1.5;

/// Explicit finite elements, `[model] fem = {}`.
#[derive(Clone, Copy, Debug)]
pub struct ExplicitMethod;

impl Method for ExplicitMethod {
    fn name(&self) -> &'static str {
        "fem"
    }

    fn build(&self, regime: &Regime, _: &SharedModels) -> Result<Box<dyn Model>, Rejection> {
        whole_or_half(regime, Explicit::with_plan)
    }

    fn support(&self, effect: &dyn Effect, scene: &Scene, estimate: &Estimate) -> Option<Support> {
        support(effect, scene, estimate, None)
    }

    fn resolve(
        &self,
        regime: &Regime,
        plan: Option<&Plan>,
        file: CaseFile,
    ) -> Result<CaseFile, Rejection> {
        let is_finite = FiniteStrain::is_on(&regime.scene, &regime.estimate);
        let mut file = Plan::known(plan, regime)?.resolve(file);
        // Contact between deformed surfaces has springs of its own.
        if let Some(contact) = file.contact.as_mut().filter(|_| is_finite) {
            contact.method = None;
        }
        Ok(file)
    }
}

/// A scene with meshes, masses and a time step.
#[derive(Clone, Debug)]
pub struct Explicit {
    setup: ModelSetup,
    made: Arc<RebuildData>,
    /// Frame in which the scene's bodies are computed.
    frame: OwnFrame,
    /// Bodies and contact at the approach of the scene.
    bodies: Arc<ExplicitBodies>,
}

/// Sources of the bodies.
#[derive(Clone, Debug)]
struct RebuildData {
    regime: Regime,
    settings: Settings,
    /// Element size at the contact, m.
    contact_element_size: f64,
    method: SmallStrainContact,
    /// Penalty factor of the contact springs over the default.
    penalty_factor: f64,
    /// Speed of these bodies over that of the whole scene ([`Plan::speed_share`]).
    speed_share: f64,
    inputs: [BodyInput; 2],
}

impl Explicit {
    /// Plans the run, makes the meshes and builds the bodies.
    ///
    /// # Errors
    /// A scene that the plan rejects; meshes that cannot be made or read; more elements, steps or memory than the limits
    /// allow.
    pub fn new(scene: &Scene) -> Result<Self, Rejection> {
        Self::with_plan(scene, Plan::of(scene)?)
    }

    /// Meshes and builds the bodies of a plan that may have been changed.
    ///
    /// # Errors
    /// As [`Explicit::new`].
    pub fn with_plan(scene: &Scene, plan: Plan) -> Result<Self, Rejection> {
        if *scene.model() != ModelChoice::Fem {
            return Err(Rejection::chose_another(scene, "fem"));
        }
        FiniteStrain::check(scene, &plan.estimate)?;
        let approach = approach_of(scene)?;
        let made = RebuildData {
            regime: Regime { scene: scene.clone(), estimate: plan.estimate.clone() },
            settings: settings(scene, &plan),
            contact_element_size: plan.contact_element_size,
            method: method(plan.contact_method),
            penalty_factor: plan.penalty_factor,
            speed_share: plan.speed_share,
            inputs: inputs(scene, &plan)?,
        };
        let frame = made.own_frame(&approach).map_err(rejected)?;
        let bodies = made.bodies(frame.own(), plan.candidate_radius).map_err(rejected)?;
        let cost = cost(scene, &bodies, &plan)?;
        let support = |effect: &dyn Effect| support(effect, scene, &plan.estimate, Some(&bodies));
        let decisions = decide(scene, &plan.estimate, support)?;
        let setup = ModelSetup {
            description: "model fem, explicit finite elements".to_string(),
            approach,
            request: plan.request(),
            estimate: plan.estimate.clone(),
            decisions,
            unread_key_warnings: {
                let said = ignored_method_warning(scene, bodies.changes_stiffness());
                let has_spot = scene.gravity().is_some_and(|gravity| gravity.spot.is_some());
                let spot = (has_spot && !scene.flows())
                    .then(|| "gravity.spot has no effect: no body flows here".to_string());
                plan.warnings.iter().cloned().chain(said).chain(spot).collect()
            },
            cost,
            elements: Some(ElementSetup {
                noise_advice: ContactNoiseAdvice::of_elements(scene, &plan),
                plan,
                has_springs: true,
                moved_share: moved_share(scene, &bodies),
            }),
        };
        Ok(Self { setup, made: Arc::new(made), frame, bodies: Arc::new(bodies) })
    }

    /// Returns bodies and contact at the approach of the scene.
    pub fn bodies(&self) -> &ExplicitBodies {
        &self.bodies
    }

    /// Returns bodies and contact that computed a collision, with its approach and candidate region.
    ///
    /// # Errors
    /// A collision of other bodies.
    pub fn bodies_of(&self, collision: &Collision) -> Result<Arc<ExplicitBodies>, ModelError> {
        let candidate_region = collision.candidate_region.unwrap_or(self.bodies.candidate_region());
        let frame = self.made.own_frame(&collision.approach)?;
        self.bodies_at(frame.own(), candidate_region.radius)
    }

    /// Returns bodies with an approach in their own frame and a candidate radius, m, which may be the model's own.
    fn bodies_at(
        &self,
        approach: &Approach,
        radius: f64,
    ) -> Result<Arc<ExplicitBodies>, ModelError> {
        if *approach == *self.frame.own() && radius == self.bodies.candidate_radius() {
            return Ok(self.bodies.clone());
        }
        self.made.bodies(approach, radius).map(Arc::new)
    }

    /// Returns the bodies of a run with an approach in their own frame. Bodies that meet again have the parts that were
    /// chosen for their first contact.
    fn bodies_of_run(
        &self,
        run: &fem_explicit::RunState,
        approach: Approach,
    ) -> Result<Arc<ExplicitBodies>, ModelError> {
        let bodies = self.bodies_at(run.made_for(), run.candidate_radius())?;
        Ok(match approach == *run.made_for() {
            true => bodies,
            false => Arc::new(bodies.approaching(approach)),
        })
    }

    /// Begins a collision.
    fn stepper(&self, approach: &Approach, request: &OutputRequest) -> Box<dyn Stepper> {
        match request.check().map_err(Stop::from).and_then(|()| self.meeting(approach)) {
            Ok((bodies, frame, estimate)) => {
                let run = Run::new(bodies, estimate.expectation(), &frame.request(request));
                ExplicitStepper::of(&self.made, frame, &estimate, run)
            }
            Err(stop) => stopped(*approach, stop),
        }
    }

    /// Returns the bodies at an approach, their frame, and the closed-form estimate.
    fn meeting(
        &self,
        approach: &Approach,
    ) -> Result<(Arc<ExplicitBodies>, OwnFrame, Cow<'_, Estimate>), Stop> {
        if *approach == self.setup.approach {
            return Ok((self.bodies.clone(), self.frame, Cow::Borrowed(&self.setup.estimate)));
        }
        let not_made = |error: ModelError| Stop::NotMade(error.to_string());
        let frame = self.made.own_frame(approach).map_err(not_made)?;
        let estimate = estimate_at(&self.made.regime, approach.speed())?;
        let radius = candidate_radius(&estimate, self.made.contact_element_size);
        let bodies = self.made.bodies(frame.own(), radius).map_err(not_made)?;
        Ok((Arc::new(bodies), frame, estimate))
    }
}

impl RebuildData {
    /// Returns the frame in which bodies with this approach are computed.
    fn own_frame(&self, approach: &Approach) -> Result<OwnFrame, ModelError> {
        let masses = frame_of(&self.regime.scene, approach, 0.0).masses;
        Ok(OwnFrame::of(approach, masses)?)
    }

    /// Builds bodies with a candidate radius, m, and the parts that the effects need.
    fn bodies(
        &self,
        approach: &Approach,
        candidate_radius: f64,
    ) -> Result<ExplicitBodies, ModelError> {
        let settings = Settings { candidate_radius, ..self.settings };
        let parts = self.parts(approach.speed())?;
        ExplicitBodies::with_parts(self.inputs.clone(), *approach, &settings, parts)
    }

    /// Returns the parts that effects add to the step in addition to stress, at the approach speed (m/s) of these bodies.
    fn parts(&self, approach_speed: f64) -> Result<ModelParts, ModelError> {
        let scene = &self.regime.scene;
        let mut parts = ModelParts {
            method: self.method,
            penalty_factor: self.penalty_factor,
            held: scene.bodies().each_ref().map(Body::is_held),
            surface_slip: surfaces_slip(scene),
            ..ModelParts::default()
        };
        if let Ok(estimate) = self.regime.at(approach_speed) {
            parts.finite_strain = FiniteStrain::laws(scene, &estimate);
            parts.finite_strain_within = FiniteStrain::within(scene, &estimate);
        }
        let is_finite = parts.finite_strain != [None; 2];
        let speed = approach_speed / self.speed_share;
        if BulkViscosity::is_on(scene, mach(scene, speed), is_finite) {
            for (input, forces) in self.inputs.iter().zip(&mut parts.node_forces) {
                forces.extend(bulk_viscosity(input, speed)?);
            }
        }
        if let Some(gravity) = scene.gravity() {
            let weight: Box<dyn NodeForce> = Box::new(Weight::new(gravity.acceleration));
            parts.node_forces[1].push(weight);
        }
        Ok(parts)
    }

    /// Returns these bodies with a larger candidate region, if there is one.
    fn larger(&self, bodies: &ExplicitBodies) -> Option<ExplicitBodies> {
        let before = bodies.candidate_radius();
        let larger = self.bodies(bodies.approach(), CANDIDATE_GROWTH * before).ok()?;
        (larger.candidate_radius() > before).then_some(larger)
    }
}

impl Model for Explicit {
    fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    fn support(&self, effect: &dyn Effect, _: &Estimate) -> Option<Support> {
        support(effect, &self.made.regime.scene, &self.setup.estimate, Some(&self.bodies))
    }

    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        monitor.enter(Phase::Collision);
        to_the_end(self.stepper(approach, request), monitor)
    }

    fn start(&self, approach: &Approach, request: &OutputRequest) -> Option<Box<dyn Stepper>> {
        Some(self.stepper(approach, request))
    }

    fn resume(&self, state: RestartState) -> Result<Box<dyn Stepper>, Rejection> {
        let rejected = |error: ModelError| Rejection::new("model.fem", error.to_string());
        let RestartState { contact: run, bounces, approach: met, .. } = state;
        let frame = self.made.own_frame(&met).map_err(rejected)?;
        if bounces.is_some() || run.approach() != frame.own() {
            return Err(rejected(ModelError::ForeignRestartState));
        }
        let bodies = self.bodies_of_run(&run, *frame.own()).map_err(rejected)?;
        let run = Run::resume(bodies, run).map_err(rejected)?;
        let estimate = self.made.regime.at(met.speed());
        let estimate = estimate.map_err(|error| Rejection::new("body", error.to_string()))?;
        Ok(ExplicitStepper::of(&self.made, frame, &estimate, run))
    }

    fn again(
        &self,
        before: &RestartState,
        approach: &Approach,
        request: &OutputRequest,
    ) -> Result<Box<dyn Stepper>, Stop> {
        let not_made = |error: ModelError| Stop::NotMade(error.to_string());
        let run = &before.contact;
        let frame = self.made.own_frame(approach).map_err(not_made)?;
        let estimate = estimate_at(&self.made.regime, approach.speed())?;
        let bodies = self.bodies_of_run(run, *frame.own()).map_err(not_made)?;
        let run = Run::again(bodies, estimate.expectation(), &frame.request(request), run);
        Ok(ExplicitStepper::of(&self.made, frame, &estimate, run.map_err(not_made)?))
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection> {
        of_elements(&self.made.regime.scene, force)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.bodies.bodies().each_ref().map(|body| body.mesh())
    }
}

/// A collision of explicit elements under way: a run that restarts if the contact outgrows the candidate region.
struct ExplicitStepper {
    made: Arc<RebuildData>,
    frame: OwnFrame,
    /// Time of the run, in seconds.
    duration: f64,
    run: Run<Arc<ExplicitBodies>>,
}

impl ExplicitStepper {
    fn of(
        made: &Arc<RebuildData>,
        frame: OwnFrame,
        estimate: &Estimate,
        run: Run<Arc<ExplicitBodies>>,
    ) -> Box<dyn Stepper> {
        let duration = expected_duration(&made.regime.scene, estimate, frame.approach());
        Box::new(Self { made: made.clone(), frame, duration, run })
    }
}

impl Stepper for ExplicitStepper {
    fn advance(&mut self, monitor: &mut dyn Monitor) -> bool {
        match self.run.advance(STEPS_BETWEEN_REPORTS) {
            None => return true,
            Some(Ending::Stopped(Stop::ContactBeyondCandidates { .. })) => {}
            Some(_) => return false,
        }
        let state = self.run.restart_state();
        if state.made_for() != self.run.model().approach() {
            return false;
        }
        let Some(larger) = self.made.larger(self.run.model()) else { return false };
        monitor.enter(Phase::Collision);
        self.run = Run::new(Arc::new(larger), state.expected(), &state.request().clone());
        true
    }

    fn progress(&self) -> Progress {
        let progress = self.run.progress();
        let elapsed = progress.time - self.run.model().approach().first_touch();
        let fraction = Progress::share(elapsed, self.duration);
        self.frame.progress(Progress { fraction, ..progress })
    }

    fn restart_state(&self) -> Option<RestartState> {
        let contact = self.run.restart_state().clone();
        let (approach, refinement, levels) = (*self.frame.approach(), 1.0, Vec::new());
        Some(RestartState { contact, bounces: None, approach, refinement, levels })
    }

    fn finish(self: Box<Self>) -> Collision {
        self.frame.collision(self.run.finish())
    }
}

/// Returns the rejection of a scene whose bodies cannot be built.
fn rejected(error: ModelError) -> Rejection {
    let rejection = Rejection::new("body", error.to_string());
    match error {
        ModelError::NoStep { .. } => rejection.with_help(
            "check material.NAME.youngs_modulus, material.NAME.density and body.N.sphere.diameter, and \
             their units",
        ),
        _ => rejection,
    }
}

/// Returns the bulk viscosity of a body's elements, which are compressed at most at the approach speed, m/s.
fn bulk_viscosity(input: &BodyInput, speed: f64) -> Result<Option<Box<dyn NodeForce>>, ModelError> {
    let (Some(mesh), Some(material)) = (input.mesh(), input.material()) else { return Ok(None) };
    let usual = ViscosityCoefficients::default();
    Ok(Some(Box::new(fem_explicit::BulkViscosity::new(mesh, material, usual, speed)?)))
}

fn inputs(scene: &Scene, plan: &Plan) -> Result<[BodyInput; 2], Rejection> {
    let [lower, upper] = BodySource::of_scene(scene, plan)?;
    Ok([lower.build(0)?, upper.build(1)?])
}

fn settings(scene: &Scene, plan: &Plan) -> Settings {
    Settings {
        contact_stiffness: plan.contact_stiffness,
        candidate_radius: plan.candidate_radius,
        step_factor: plan.step_factor,
        mass_scaling: plan.mass_scaling,
        mass_times: MassScaling::times(scene),
    }
}

fn method(planned: fem_case::ContactMethod) -> SmallStrainContact {
    match planned {
        fem_case::ContactMethod::Massless => SmallStrainContact::Massless,
        fem_case::ContactMethod::Penalty => SmallStrainContact::Penalty,
        fem_case::ContactMethod::NodeToSurface => SmallStrainContact::NodeToSurface,
    }
}

/// Returns the support of explicit elements for an effect; without the bodies, as far as it is known before they are
/// meshed.
fn support(
    effect: &dyn Effect,
    scene: &Scene,
    estimate: &Estimate,
    bodies: Option<&ExplicitBodies>,
) -> Option<Support> {
    Some(match effect.name() {
        Viscoelasticity::NAME => Support::Inherent { idle: "" },
        HourglassControl::NAME => {
            let why = "one-point elements need stiffness against hourglass modes";
            Support::decided(true, why)
        }
        ContactSearch::NAME => ContactSearch::within(&bodies?.candidate_region()),
        MassScaling::NAME => mass_scaling(scene, bodies?),
        MirrorSymmetry::NAME if bodies.is_none() => MirrorSymmetry::support_by_elements(scene),
        PlateBending::NAME => return PlateBending::of_model(scene),
        PartnerWaves::NAME | Gravity::NAME => Support::Inherent { idle: "" },
        FrictionEffect::NAME => return FrictionEffect::of_model(scene, false),
        BulkViscosity::NAME => Support::Computes { idle: "" },
        FiniteStrain::NAME => FiniteStrain::of_elements(scene, estimate),
        // Contact between deformed surfaces has it.
        SurfaceSlip::NAME if FiniteStrain::is_on(scene, estimate) => Support::Inherent { idle: "" },
        SurfaceSlip::NAME => Support::Computes { idle: "" },
        MaterialLoss::NAME if !MaterialLoss::is_lacking(scene, estimate) => return None,
        MaterialLoss::NAME | AdhesionEffect::NAME | MirrorSymmetry::NAME | RigidPartner::NAME => {
            Support::Lacks
        }
        PlasticFlow::NAME => PlasticFlow::of_elements(scene, estimate),
        RateDependence::NAME => return RateDependence::of_elements(scene, estimate),
        _ => return None,
    })
}

/// Returns the decision on mass scaling with the moved masses.
fn mass_scaling(scene: &Scene, model: &ExplicitBodies) -> Support {
    let masses = model.bodies().each_ref().map(|body| Some(body.mass()).filter(|m| m.is_finite()));
    let added = model.bodies().each_ref().map(|body| Some(body.moved_mass()));
    MassScaling::of(scene, masses, added, model.time_step() / model.plain_time_step())
}

/// Returns the larger moved mass over the lighter body's mass, corrected for the factor on stiffer bodies.
fn moved_share(scene: &Scene, model: &ExplicitBodies) -> f64 {
    let lightest = model.bodies().iter().map(|body| body.mass()).fold(f64::INFINITY, f64::min);
    let shares = model.bodies().iter().map(|body| body.moved_mass() / lightest);
    shares.zip(MassScaling::times(scene)).map(|(share, times)| share / times).fold(0.0, f64::max)
}
