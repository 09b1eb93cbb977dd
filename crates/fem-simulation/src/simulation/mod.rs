//! [`Simulation`]: a case joined with the model that computes it. It does not change after it is built.
//!
//! The modules that describe a simulation or its collision add methods: `error/refinement.rs` (the run within the
//! tolerance), `error/refinement_cost_bound.rs`, `results/summarise.rs`, `results/diagnostics.rs` (warnings).
//! [`stress`] has the stress fields.

pub(crate) mod checkpoint;
pub(crate) mod identity;
pub(crate) mod stress;

use std::borrow::Cow;
use std::sync::Arc;

use fem_case::schema::StartTable;
use fem_case::{Case, CaseError, CaseFile, ModelChoice, Scene};
use fem_collision::{
    Approach, Collision, Monitor, OutputRequest, OutputRequestError, SnapshotRequest,
};

use crate::effects::{
    Effect, EffectDecision, EffectDecisions, FiniteStrain, NeglectError, Support, decide,
    effect_named,
};
use crate::estimate::Estimate;
use crate::models::explicit::cost::{REFERENCE_UPDATES, needs_own_reference};
use crate::models::method::{Cost, ExpectedRun, Model, ModelSetup, SharedModels, start_stepper};
use crate::models::stepper::{RefinementLevel, RestartState, Stepper};
use crate::models::{ComputedScene, ModelCandidate};
use crate::plan::body_source::probes_of;
use crate::rejection::Rejection;
use crate::simulation::identity::identity_of;

/// A case that is ready to run.
#[derive(Clone, Debug)]
pub struct Simulation {
    case: Case,
    computed: ComputedScene,
    model: Arc<dyn Model>,
    setup: ModelSetup,
    request: OutputRequest,
    resolved: CaseFile,
    shared: SharedModels,
    /// Elements across a length over those of the planned mesh.
    pub(crate) refinement: f64,
    /// Coarser meshes that were not sufficient.
    pub(crate) levels: Vec<RefinementLevel>,
}

impl Simulation {
    /// Builds the model of a case.
    ///
    /// # Errors
    /// A case that the model rejects, with the place in the case.
    pub fn new(case: Case) -> Result<Self, CaseError> {
        Self::sharing(case, &SharedModels::default())
    }

    /// Builds the model of a case with the caches of other cases.
    ///
    /// # Errors
    /// Those of [`Simulation::new`].
    pub fn sharing(case: Case, shared: &SharedModels) -> Result<Self, CaseError> {
        Self::with_refinement(case, shared, 1.0, Vec::new())
    }

    /// Builds the model with this refinement of the planned mesh, after these coarser meshes.
    fn with_refinement(
        case: Case,
        shared: &SharedModels,
        refinement: f64,
        levels: Vec<RefinementLevel>,
    ) -> Result<Self, CaseError> {
        let scene = case.scene().clone().with_refinement(refinement);
        let of_case = |rejection: Rejection| rejection.in_case(&case);
        let computed = ComputedScene::sharing(&scene, shared).map_err(of_case)?;
        let model: Arc<dyn Model> = Arc::from(computed.model(shared).map_err(of_case)?);
        let setup = computed.setup_of(model.as_ref()).map_err(of_case)?;
        let plan = setup.elements.as_ref().map(|elements| &elements.plan);
        let resolved = computed.resolve(plan, case.file().clone()).map_err(of_case)?;
        let mut request = setup.request.clone();
        request.probes = probes_of(&scene, model.meshes()).map_err(of_case)?;
        Ok(Self {
            case,
            computed,
            model,
            setup,
            request,
            resolved,
            shared: shared.clone(),
            refinement,
            levels,
        })
    }

    /// Returns the simulation on a finer mesh, with the same output request.
    pub(crate) fn refined(
        &self,
        refinement: f64,
        levels: Vec<RefinementLevel>,
    ) -> Result<Self, CaseError> {
        let mut finer = Self::with_refinement(self.case.clone(), &self.shared, refinement, levels)?;
        let probes = std::mem::take(&mut finer.request.probes);
        finer.request = self.request.clone();
        if !self.request.probes.is_empty() {
            finer.request.probes = probes;
        }
        Ok(finer)
    }

    /// Returns the simulation on the mesh of a restart state.
    ///
    /// # Errors
    /// A mesh that the model rejects.
    pub fn on_mesh_of(self, state: &RestartState) -> Result<Self, CaseError> {
        match state.levels.is_empty() {
            true => Ok(self),
            false => self.refined(state.refinement, state.levels.clone()),
        }
    }

    /// Returns the restart state of a stepper, with the mesh of the simulation.
    pub fn restart_state_of(&self, stepper: &dyn Stepper) -> Option<RestartState> {
        let (refinement, levels) = (self.refinement, self.levels.clone());
        Some(RestartState { refinement, levels, ..stepper.restart_state()? })
    }

    /// Returns the case with every default filled in, without building its model.
    ///
    /// # Errors
    /// A case that the method rejects.
    pub fn resolve(case: &Case) -> Result<CaseFile, CaseError> {
        let resolve = |scene: ComputedScene| scene.resolve(None, case.file().clone());
        ComputedScene::of(case.scene())
            .and_then(resolve)
            .map_err(|rejection| rejection.in_case(case))
    }

    /// Returns what is expected of a run of a case.
    ///
    /// # Errors
    /// A case that the method rejects.
    pub fn expected_of(case: &Case) -> Result<ExpectedRun, CaseError> {
        let computed = ComputedScene::of(case.scene());
        computed.and_then(|scene| scene.expected()).map_err(|rejection| rejection.in_case(case))
    }

    /// Returns the case.
    pub fn case(&self) -> &Case {
        &self.case
    }

    /// Returns the model.
    pub fn model(&self) -> &dyn Model {
        self.model.as_ref()
    }

    /// Returns the candidate models, the cheapest first; empty if the case names its model.
    pub fn considered(&self) -> &[ModelCandidate] {
        &self.computed.selected.considered
    }

    /// Returns the warning that no model is known to meet the tolerance, if the case leaves the choice open.
    pub(crate) fn choice_warning(&self) -> Option<String> {
        self.computed.selected.warning.clone()
    }

    /// Returns the decisions on the case.
    pub fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    /// Returns the caches that models of several cases share.
    pub(crate) fn shared(&self) -> &SharedModels {
        &self.shared
    }

    /// Returns the output request.
    pub fn request(&self) -> &OutputRequest {
        &self.request
    }

    /// Returns the case with every default filled in, which runs to the same bits.
    pub fn resolved(&self) -> &CaseFile {
        &self.resolved
    }

    /// Returns why no mesh meets `accuracy.tolerance`, if the case asks for a smaller error than that of the finest mesh.
    pub fn out_of_reach(&self) -> Option<&str> {
        self.setup().elements.as_ref()?.plan.out_of_reach()
    }

    /// Replaces the output request of the case.
    ///
    /// # Errors
    /// More rows or snapshots than a run keeps, or invalid times.
    pub fn with_output_request(self, request: OutputRequest) -> Result<Self, OutputRequestError> {
        request.check()?;
        Ok(Self { request, ..self })
    }

    /// Returns the resolved case with another approach.
    pub fn resolved_at(&self, approach: &Approach) -> CaseFile {
        self.with_approach(self.resolved.clone(), approach)
    }

    /// Returns the identity of the case ([`case_identity`](crate::case_identity)) with this approach.
    pub fn input_digest(&self, approach: &Approach) -> String {
        identity_of(&self.with_approach(self.case.file().clone(), approach))
    }

    /// Returns a case file with this approach.
    pub(crate) fn with_approach(&self, mut file: CaseFile, approach: &Approach) -> CaseFile {
        if *approach != self.setup().approach {
            let [lower, upper] = approach.velocities();
            // A speed is toward the other body; a body at rest has 0, never -0.
            for (body, speed) in file.body.iter_mut().zip([lower, 0.0 - upper]) {
                body.approach_speed = Some(speed.into());
            }
            file.start = Some(StartTable { gap: Some(approach.gap().into()) });
        }
        file
    }

    /// Removes snapshots and probes from the output request. All other results keep their bits, and the resolved case too.
    #[must_use]
    pub fn without_snapshots(self) -> Self {
        let (snapshots, probes) = (SnapshotRequest::none(), Vec::new());
        Self { request: OutputRequest { snapshots, probes, ..self.request }, ..self }
    }

    /// Returns the coarser meshes before this one, the first one first.
    pub fn levels(&self) -> &[RefinementLevel] {
        &self.levels
    }

    /// Returns the element updates of the coarser reference run of explicit elements over those of the run; `None` if
    /// only condensed bodies are its reference.
    pub fn reference_updates(&self) -> Option<f64> {
        let setup = self.setup();
        let Cost::Steps { .. } = setup.cost else { return None };
        setup.elements.as_ref().filter(|elements| elements.plan.makes_meshes)?;
        let is_finite = setup.decisions.is_active(FiniteStrain::NAME);
        needs_own_reference(&setup.estimate, is_finite).then_some(REFERENCE_UPDATES)
    }

    /// Computes the collision.
    pub fn run(&self, monitor: &mut dyn Monitor) -> Collision {
        self.model.collide(&self.setup().approach, &self.request, monitor)
    }

    /// Starts the collision; the caller advances it.
    ///
    /// ```
    /// # use fem_case::schema::{BodyTable, MaterialTable, MeshTable};
    /// # use fem_case::{Case, CaseFile};
    /// # use fem_simulation::Simulation;
    /// # let ice = MaterialTable::from_youngs_modulus_poissons_ratio("917 kg/m^3", "9.3 GPa", 0.33);
    /// # let ball = BodyTable::sphere("ball", "2 cm", "ice").approaching("0.2 m/s");
    /// # let mut file = CaseFile::of_bodies(ball, BodyTable::wall("floor")).with_material("ice", ice);
    /// # file.mesh =
    /// #     Some(MeshTable { contact_element_size: Some("0.2 mm".into()), ..Default::default() });
    /// # let simulation = Simulation::new(Case::of(file)?)?;
    /// let mut stepper = simulation.start();
    /// while stepper.progress().fraction < 0.5 && stepper.advance(&mut ()) {}
    ///
    /// // The restart state may be written, and read by another process.
    /// let state = serde_json::to_string(&stepper.restart_state()).unwrap();
    /// let state = serde_json::from_str(&state).unwrap();
    /// let mut resumed = simulation.resume(state)?;
    /// while resumed.advance(&mut ()) {}
    /// assert_eq!(resumed.finish(), simulation.run(&mut ()));
    /// # Ok::<(), fem_case::CaseError>(())
    /// ```
    pub fn start(&self) -> Box<dyn Stepper> {
        start_stepper(&self.model, &self.setup().approach, &self.request)
    }

    /// Resumes the collision from a restart state, to the same bits.
    ///
    /// # Errors
    /// A restart state of another case, or a model without restart states.
    pub fn resume(&self, state: RestartState) -> Result<Box<dyn Stepper>, CaseError> {
        self.model.resume(state).map_err(|rejection| rejection.in_case(&self.case))
    }

    /// Returns the closed-form estimate for an approach of the case's bodies; `None` if it is not finite.
    pub fn estimate(&self, approach: &Approach) -> Option<Estimate> {
        let setup = self.setup();
        match *approach == setup.approach {
            true => Some(setup.estimate.clone()),
            false => setup.estimate.of_variant(&self.scene_of_model(), approach.speed()).ok(),
        }
    }

    /// Returns the support of the model for an effect of the case in a collision with this estimate.
    pub fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        self.computed.support(self.model(), effect, estimate)
    }

    /// Returns the change of a collision's quantities without an effect.
    pub fn neglect_error(
        &self,
        decision: &EffectDecision,
        estimate: &Estimate,
    ) -> Option<NeglectError> {
        effect_named(decision.name)?.neglect_error(&self.scene_of_model(), estimate)
    }

    /// Returns the scene with the selected model, if the case leaves the choice open.
    pub(crate) fn scene_of_model(&self) -> Cow<'_, Scene> {
        let scene = self.case.scene();
        match scene.model() {
            ModelChoice::Auto => Cow::Owned(
                scene.clone().with_model(self.computed.selected.regime.scene.model().clone()),
            ),
            _ => Cow::Borrowed(scene),
        }
    }

    /// Returns the effects that were on in a collision of the case's bodies, with reasons and warnings.
    pub fn decisions(&self, collision: &Collision) -> EffectDecisions {
        let (setup, scene) = (self.setup(), self.scene_of_model());
        let estimate = self.estimate(&collision.approach);
        let anew = estimate.as_ref().filter(|_| collision.approach != setup.approach);
        let decided = anew.and_then(|estimate| {
            decide(&scene, estimate, |effect| self.support(effect, estimate)).ok()
        });
        let mut decisions = decided.unwrap_or_else(|| setup.decisions.clone());
        decisions.update_from_result(&scene, estimate.as_ref(), collision);
        decisions
    }
}
