//! A case with the model that computes it, whichever that is.

pub(crate) mod checkpoint;
pub(crate) mod identity;

use std::borrow::Cow;
use std::convert::Infallible;
use std::sync::Arc;

use fem_case::engineering::show;
use fem_case::schema::StartTable;
use fem_case::{Case, CaseError, CaseFile, ModelChoice, Quantity, Scene};
use fem_collision::{
    Approach, Collision, Monitor, OutputRequest, OutputRequestError, SnapshotRequest,
};

use crate::effects::FiniteStrain;
use crate::effects::{EFFECTS, Effect, EffectDecision, EffectDecisions, NeglectError, decide};
use crate::error::{
    ErrorEstimate, ErrorEstimator, RefinementBound, RefinementLevel, refined_because,
    refinement_bound, unresolved_warning,
};
use crate::estimate::{Estimate, mach};
use crate::models::explicit::cost::{REFERENCE_UPDATES, needs_own_reference};
use crate::models::method::{Cost, Model, ModelSetup, SharedModels};
use crate::models::restart_state::RestartState;
use crate::models::stepper::{Stepper, begun};
use crate::models::{ModelCandidate, SelectedModel, chosen, model_of, price_of, resolved};
use crate::plan::body_source::probes_of;
use crate::plan::penalty_compliance::softness;
use crate::rejection::Rejection;
use crate::results::diagnostics::diagnose;
use crate::results::{RunCost, Summary};
use crate::simulation::identity::identity_of;

/// The collision of a case, by the model that it asks for, within its tolerance.
///
/// # Errors
/// What the model refuses, at its place in the case.
///
/// ```
/// use fem_case::schema::{BodyTable, MaterialTable, ModelTable};
/// use fem_case::{Case, CaseFile};
///
/// let steel = MaterialTable::from_youngs_modulus_poissons_ratio("7850 kg/m^3", "210 GPa", 0.3);
/// let ball = BodyTable::sphere("ball", "1 cm", "steel").approaching("1 m/s");
/// let case = Case::of(
///     CaseFile::of_bodies(ball, BodyTable::wall("floor"))
///         .with_material("steel", steel)
///         .with_model(ModelTable::hertz()),
/// )?;
/// let collision = fem_simulation::collide(&case)?;
/// assert_eq!(collision.restitution, Some(1.0));
/// // T = 2.943 δ / v with the largest approach δ = (15 m v² / (16 E* √R))^(2/5), at 1 m/s.
/// let (mass, modulus, radius) = (4.110e-3, 230.8e9, 5e-3_f64);
/// let hertz = 2.943 * (15.0 * mass / (16.0 * modulus * radius.sqrt())).powf(0.4);
/// assert!((collision.contact_time.unwrap() / hertz - 1.0).abs() < 1e-3);
/// # Ok::<(), fem_case::CaseError>(())
/// ```
pub fn collide(case: &Case) -> Result<Collision, CaseError> {
    Ok(Simulation::new(case.clone())?.run_within_tolerance(&mut ()).collision)
}

/// A collision within the tolerance of its case, as far as that can be met.
#[derive(Debug)]
pub struct ComputedCollision {
    /// The simulation that computed it, on the last mesh.
    pub simulation: Simulation,
    /// Its result.
    pub collision: Collision,
    /// Its estimated errors.
    pub errors: ErrorEstimate,
}

impl ComputedCollision {
    /// Returns all warnings about the collision.
    pub fn warnings(&self) -> Vec<String> {
        self.simulation.warnings_with(&self.collision, &self.errors)
    }

    /// Returns the summary with all warnings, without cost and files.
    pub fn summary(&self) -> Summary {
        let Self { simulation, collision, errors } = self;
        let (spent, warnings) = (RunCost::default(), self.warnings());
        Summary::of(simulation, collision, errors, spent, warnings, Vec::new())
    }
}

/// A case that is ready to run.
#[derive(Debug)]
pub struct Simulation {
    case: Case,
    model: Arc<dyn Model>,
    chosen: Option<SelectedModel>,
    request: OutputRequest,
    resolved: CaseFile,
    shared: SharedModels,
    /// Elements across a length over those that the plan takes at first.
    pub(crate) refinement: f64,
    /// Coarser meshes that did not do.
    pub(crate) levels: Vec<RefinementLevel>,
}

impl Simulation {
    /// Builds the model that the case asks for.
    ///
    /// # Errors
    /// What the model refuses, at its place in the case.
    pub fn new(case: Case) -> Result<Self, CaseError> {
        Self::sharing(case, &SharedModels::default())
    }

    /// Builds the model that the case asks for; what other cases have made already is taken from
    /// `shared`.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub fn sharing(case: Case, shared: &SharedModels) -> Result<Self, CaseError> {
        Self::at(case, shared, 1.0, Vec::new())
    }

    /// The case with so many times the elements across a length, which these meshes were too coarse for.
    fn at(
        case: Case,
        shared: &SharedModels,
        refinement: f64,
        levels: Vec<RefinementLevel>,
    ) -> Result<Self, CaseError> {
        let scene = case.scene().clone().with_refinement(refinement);
        let of_case = |refusal: Rejection| refusal.in_case(&case);
        let model: Arc<dyn Model> = Arc::from(model_of(&scene, shared).map_err(of_case)?);
        let resolved = resolved(&scene, case.file().clone()).map_err(of_case)?;
        let chosen = chosen(&scene).map_err(of_case)?;
        let mut request = model.setup().request.clone();
        request.probes = probes_of(&scene, model.meshes()).map_err(of_case)?;
        Ok(Self {
            case,
            model,
            chosen,
            request,
            resolved,
            shared: shared.clone(),
            refinement,
            levels,
        })
    }

    /// The same on a finer mesh, asked for the same.
    pub(crate) fn refined(
        &self,
        refinement: f64,
        levels: Vec<RefinementLevel>,
    ) -> Result<Self, CaseError> {
        let mut finer = Self::at(self.case.clone(), &self.shared, refinement, levels)?;
        let probes = std::mem::take(&mut finer.request.probes);
        finer.request = self.request.clone();
        if !self.request.probes.is_empty() {
            finer.request.probes = probes;
        }
        Ok(finer)
    }

    /// As it was when a course of its case left this memory: on the mesh that it had then.
    ///
    /// # Errors
    /// What the model refuses.
    pub fn as_in(self, memory: &RestartState) -> Result<Self, CaseError> {
        match memory.levels.is_empty() {
            true => Ok(self),
            false => self.refined(memory.refinement, memory.levels.clone()),
        }
    }

    /// What a course of it knows, with the mesh that it has.
    pub fn restart_state_of(&self, course: &dyn Stepper) -> Option<RestartState> {
        let (refinement, levels) = (self.refinement, self.levels.clone());
        Some(RestartState { refinement, levels, ..course.memory()? })
    }

    /// The case with every default filled in, without the cost of building its model.
    ///
    /// # Errors
    /// What the method refuses before it makes anything.
    pub fn resolve(case: &Case) -> Result<CaseFile, CaseError> {
        resolved(case.scene(), case.file().clone()).map_err(|refusal| refusal.in_case(case))
    }

    /// Element updates to come; as the method's own meter counts them, or an estimate.
    ///
    /// # Errors
    /// What the method refuses before it makes anything.
    pub fn price(case: &Case) -> Result<u64, CaseError> {
        price_of(case.scene()).map_err(|refusal| refusal.in_case(case))
    }

    /// The case.
    pub fn case(&self) -> &Case {
        &self.case
    }

    /// What computes it.
    pub fn model(&self) -> &dyn Model {
        self.model.as_ref()
    }

    /// Which models were considered, from the cheapest to the dearest; none where the case names its own.
    pub fn considered(&self) -> &[ModelCandidate] {
        self.chosen.as_ref().map_or(&[], |chosen| &chosen.considered)
    }

    /// What the user should know before the run.
    pub fn warnings_before(&self) -> Vec<String> {
        let own = self.mesh_warning().into_iter().chain(self.springs_warning());
        let own = own.chain(self.cheaper());
        let scene = self.case.scene();
        let of_scene = scene.implausible_numbers().into_iter().chain(scene.unpublished_loss());
        of_scene
            .chain(self.shear_waves_warning())
            .chain(self.choice_warning())
            .chain(self.setup().warnings())
            .chain(own)
            .collect()
    }

    /// Returns a warning that the mesh resolves the expected contact by too few elements.
    pub fn mesh_warning(&self) -> Option<String> {
        unresolved_warning(self, self.setup().estimate.contact_radius)
    }

    /// That explicit elements fold where bodies meet faster than shear waves leave the contact.
    fn shear_waves_warning(&self) -> Option<String> {
        let scene = self.scene_of_model();
        let mach = mach(&scene, scene.approach_speed());
        (mach > 1.0 && *scene.model() == ModelChoice::Fem).then(|| {
            format!(
                "the approach speed is {mach:.1} times that of the shear waves, √(G/ρ): above 1 the flank of a body \
                 may fold onto the other one, which stops the run; lower body.N.approach_speed, or check the moduli \
                 and their units"
            )
        })
    }

    /// That springs softer than the usual ones give way, by how much, and what helps.
    fn springs_warning(&self) -> Option<String> {
        let elements = self.setup().elements.as_ref().filter(|elements| elements.has_springs)?;
        let longer = softness(&elements.plan)?;
        (longer > self.case.scene().accuracy().contact_time).then(|| {
            format!(
                "springs of contact.penalty_factor = {} are compliant: the contact lasts about {:.0} % longer; write \
                 contact.penalty_factor = 1",
                elements.plan.penalty_factor,
                100.0 * longer
            )
        })
    }

    /// Returns all warnings about a collision: those before it, those of its result, and those of its model.
    pub fn warnings_with(&self, collision: &Collision, errors: &ErrorEstimate) -> Vec<String> {
        let scene = self.case.scene();
        let mut warnings = scene.implausible_numbers();
        warnings.extend(scene.unpublished_loss());
        warnings.extend(self.choice_warning());
        warnings.extend(self.decisions(collision).warnings);
        warnings.extend(self.setup().unread.iter().cloned());
        warnings.extend(diagnose(self, collision, errors));
        warnings.extend(collision.warnings.iter().cloned());
        warnings
    }

    /// Estimates the errors of a collision by reference runs, and returns all warnings about it.
    pub fn warnings(&self, collision: &Collision) -> Vec<String> {
        self.warnings_with(collision, &self.estimate_errors(collision))
    }

    /// Estimates the errors of a collision by reference runs.
    pub fn estimate_errors(&self, collision: &Collision) -> ErrorEstimate {
        ErrorEstimator::default().estimate(self, collision)
    }

    /// Returns the summary of a collision, with its errors and all warnings, without its cost and files.
    pub fn summary(&self, collision: &Collision) -> Summary {
        let errors = self.estimate_errors(collision);
        let warnings = self.warnings_with(collision, &errors);
        Summary::of(self, collision, &errors, RunCost::default(), warnings, Vec::new())
    }

    /// That the run takes long, and that the condensed model, which has fields too and is expected to serve
    /// as well, does not.
    pub fn cheaper(&self) -> Option<String> {
        const LONG: f64 = 3.0;
        let Cost::Steps { seconds, .. } = self.setup().cost else { return None };
        let scene = self.case.scene();
        if seconds < LONG || *scene.model() != ModelChoice::Fem {
            return None;
        }
        let open = SelectedModel::of(&scene.clone().with_model(ModelChoice::Auto)).ok()?;
        // It has fields to draw, as explicit elements do.
        let serves = |it: &&ModelCandidate| {
            it.model.starts_with("condensed") && (it.chosen || it.reason.starts_with("serves"))
        };
        let other = open.considered.iter().find(serves).filter(|_| open.warning.is_none())?;
        Some(format!(
            "the run takes about {}; model.{} is also expected to be within the tolerance of the case \
             and takes hundredths of a second",
            show(seconds, "s"),
            other.model
        ))
    }

    /// That no model is known to serve, where the case leaves the choice open.
    pub(crate) fn choice_warning(&self) -> Option<String> {
        self.chosen.as_ref()?.warning.clone()
    }

    /// What was decided on the case as it is.
    pub fn setup(&self) -> &ModelSetup {
        self.model.setup()
    }

    /// What models of other cases made, and made for them.
    pub(crate) fn shared(&self) -> &SharedModels {
        &self.shared
    }

    /// What the run is asked for.
    pub fn request(&self) -> &OutputRequest {
        &self.request
    }

    /// The case with every default filled in: it runs again to the same bits.
    pub fn resolved(&self) -> &CaseFile {
        &self.resolved
    }

    /// Makes the run give something else than what the case asks for.
    ///
    /// # Errors
    /// More rows or snapshots than a run keeps, times that are no times.
    pub fn ask_for(&mut self, request: OutputRequest) -> Result<(), OutputRequestError> {
        request.check()?;
        self.request = request;
        Ok(())
    }

    /// The resolved case with its bodies meeting in another way.
    pub fn resolved_at(&self, approach: &Approach) -> CaseFile {
        self.meeting(self.resolved.clone(), approach)
    }

    /// Digest of what the case asks to be computed, its bodies meeting like this: see
    /// [`case_identity`](crate::case_identity).
    pub fn made_from(&self, approach: &Approach) -> String {
        identity_of(&self.meeting(self.case.file().clone(), approach))
    }

    pub(crate) fn meeting(&self, mut file: CaseFile, approach: &Approach) -> CaseFile {
        if *approach != self.setup().approach {
            let [lower, upper] = approach.velocities();
            // A speed is toward the other body; a body at rest has 0, never -0.
            for (body, speed) in file.body.iter_mut().zip([lower, 0.0 - upper]) {
                body.approach_speed = Some(Quantity::from_si(speed));
            }
            file.start = Some(StartTable { gap: Some(Quantity::from_si(approach.gap())) });
        }
        file
    }

    /// Makes the run compute no fields to draw, nor warn of those that could not be had. All else
    /// keeps its bits, the resolved case too.
    pub fn skip_snapshots(&mut self) {
        self.request.snapshots = SnapshotRequest::none();
        self.request.probes.clear();
    }

    /// Computes the collision, on finer meshes until its tolerance is met, and estimates its errors.
    pub fn run_within_tolerance(self, monitor: &mut dyn Monitor) -> ComputedCollision {
        let mut estimator = ErrorEstimator::default();
        let simulation = estimator.refine_before_run(self, || true).simulation;
        let compute = |_: &mut ErrorEstimator, simulation: &Self| {
            Ok::<_, Infallible>(simulation.run(monitor))
        };
        match estimator.within_tolerance(simulation, compute) {
            Ok(computed) => computed,
            Err(never) => match never {},
        }
    }

    /// Returns the coarser meshes before this one, the first one first.
    pub fn levels(&self) -> &[RefinementLevel] {
        &self.levels
    }

    /// Returns why the mesh was made finer.
    pub fn refined_because(&self) -> Option<String> {
        refined_because(self)
    }

    /// Returns an upper bound of the finer meshes that may follow the run; `None` if the mesh stays.
    pub fn refinement_bound(&self) -> Option<RefinementBound> {
        refinement_bound(self)
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

    /// Begins the collision: the caller decides when it goes on.
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
    /// let mut course = simulation.start();
    /// while course.progress().fraction < 0.5 && course.advance(&mut ()) {}
    ///
    /// // Put away, and taken up again, perhaps in another process.
    /// let memory = serde_json::to_string(&course.memory()).unwrap();
    /// let memory = serde_json::from_str(&memory).unwrap();
    /// let mut resumed = simulation.resume(memory)?;
    /// while resumed.advance(&mut ()) {}
    /// assert_eq!(resumed.finish(), simulation.run(&mut ()));
    /// # Ok::<(), fem_case::CaseError>(())
    /// ```
    pub fn start(&self) -> Box<dyn Stepper> {
        begun(&self.model, &self.setup().approach, &self.request)
    }

    /// Goes on from what a course of this case knew and was asked for, to the same bits.
    ///
    /// # Errors
    /// A memory of another case, or a model that goes on from none.
    pub fn resume(&self, memory: RestartState) -> Result<Box<dyn Stepper>, CaseError> {
        self.model.resume(memory).map_err(|refusal| refusal.in_case(&self.case))
    }

    /// What closed forms say of a collision of the case's bodies; none where that is no number.
    pub fn estimate(&self, collision: &Collision) -> Option<Estimate> {
        let setup = self.setup();
        match collision.approach == setup.approach {
            true => Some(setup.estimate),
            false => Estimate::at(self.case.scene(), collision.approach.speed()).ok(),
        }
    }

    /// By how much the numbers of a collision of which closed forms say this change without an effect.
    pub fn neglect_error(
        &self,
        verdict: &EffectDecision,
        estimate: &Estimate,
    ) -> Option<NeglectError> {
        let effect = EFFECTS.iter().find(|effect| effect.name() == verdict.name)?;
        effect.neglect_error(&self.scene_of_model(), estimate)
    }

    /// The scene with the model that computes it, where the case leaves that open.
    pub(crate) fn scene_of_model(&self) -> Cow<'_, Scene> {
        let scene = self.case.scene();
        match &self.chosen {
            Some(chosen) => Cow::Owned(scene.clone().with_model(chosen.scene.model().clone())),
            None => Cow::Borrowed(scene),
        }
    }

    /// Which effects were on in a collision of the case's bodies, and why; and what was to be known
    /// of them before it.
    pub fn decisions(&self, collision: &Collision) -> EffectDecisions {
        let setup = self.setup();
        let anew = self.estimate(collision).filter(|_| collision.approach != setup.approach);
        let decided = anew.and_then(|estimate| {
            let has = |effect: &dyn Effect| self.model.has(effect, &estimate);
            decide(self.case.scene(), &estimate, has).ok()
        });
        let mut decisions = decided.unwrap_or_else(|| setup.decisions.clone());
        decisions.take_what_was_found(self.case.scene(), collision);
        decisions
    }
}
