//! The interface of a method: the traits `Method` and `Model`, and a model's setup and cost.
//!
//! A [`Method`] turns a scene into a [`Model`], which computes its collision at any approach. [`METHODS`](crate::METHODS)
//! lists all methods.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use fem_case::{CaseFile, Scene};
use fem_collision::{
    Approach, Collision, Monitor, OutputRequest, QuantityOfInterest, StaticContact, Stop,
};
use fem_laws::NormalSprings;
use fem_laws::laws::ContactLaw;
use fem_mesh::SphereMesh;

use crate::effects::{
    Effect, EffectDecision, EffectDecisions, EffectStatus, Support, effect_named,
};
use crate::estimate::quasi_static::KnownImpacts;
use crate::estimate::{Estimate, Regime};
use crate::models::stepper::{RestartState, SingleStep, Stepper};
use crate::plan::Plan;
use crate::plan::contact_method::ContactNoiseAdvice;
use crate::plan::pair_cache::PairCache;
use crate::rejection::Rejection;

/// A way to compute collisions.
pub trait Method: Sync {
    /// Returns the method's key under `[model]`.
    fn name(&self) -> &'static str;

    /// Makes the model of a scene in its regime.
    ///
    /// # Errors
    /// A scene that the method cannot compute, or not within the scene's limits.
    fn build(&self, regime: &Regime, shared: &SharedModels) -> Result<Box<dyn Model>, Rejection>;

    /// Returns the method's support for an effect as far as it is known before the model is built: the answer of
    /// [`Model::support`] but for the numbers of the meshes. `None` means that the method has no use for the effect.
    fn support(&self, effect: &dyn Effect, scene: &Scene, estimate: &Estimate) -> Option<Support>;

    /// Checks a scene against the method's limits of validity that no closed form foretells.
    ///
    /// # Errors
    /// A scene whose collision the method would stop.
    fn check(&self, _: &Regime) -> Result<(), Rejection> {
        Ok(())
    }

    /// Returns what is expected of a run. Meshes are made, but no factors.
    ///
    /// # Errors
    /// As [`Method::build`], but for faults that only factors show.
    fn expected(&self, regime: &Regime) -> Result<ExpectedRun, Rejection> {
        let model = self.build(regime, &SharedModels::default())?;
        let setup = model.setup();
        let element_updates = match setup.cost {
            Cost::Steps { element_updates, .. } => element_updates,
            _ => 0,
        };
        let plan = setup.elements.as_ref().map(|elements| &elements.plan);
        let out_of_reach = plan.and_then(Plan::out_of_reach).map(str::to_string);
        Ok(ExpectedRun { element_updates, out_of_reach })
    }

    /// Returns the case as written with the method's defaults filled in, which makes the same model. Keys that the
    /// method does not read stay as they are. `plan` is that of a model that is built.
    ///
    /// # Errors
    /// As [`Method::expected`].
    fn resolve(
        &self,
        regime: &Regime,
        plan: Option<&Plan>,
        file: CaseFile,
    ) -> Result<CaseFile, Rejection>;
}

/// What is expected of a run before its factors are made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ExpectedRun {
    /// Number of element updates, by which runs are ordered; 0 of a model without steps.
    pub element_updates: u64,
    /// The reason why no mesh meets `accuracy.tolerance`, if none does.
    pub out_of_reach: Option<String>,
}

/// Caches that the models of several scenes share; clones share the same caches.
#[derive(Clone, Debug, Default)]
pub struct SharedModels {
    /// Condensed pairs of bodies.
    pub pairs: Arc<PairCache>,
    /// Condensed pairs of reference runs, which estimate errors.
    pub reference_pairs: Arc<PairCache>,
    /// Ting's impacts, so that a sweep over the impact angle computes its impact along the axis once.
    pub(crate) impacts: KnownImpacts,
    /// Whether models are asked for quantities alone, and keep no factors for fields.
    pub is_of_reference_runs: bool,
}

impl SharedModels {
    /// Returns caches of condensed pairs with a limit of memory, in bytes each.
    pub fn with_max_bytes(max_bytes: usize) -> Self {
        let pairs = || Arc::new(PairCache::with_max_bytes(max_bytes));
        Self { pairs: pairs(), reference_pairs: pairs(), ..Self::default() }
    }

    /// Returns what reference runs share.
    pub(crate) fn for_reference_runs(&self) -> Self {
        let pairs = || self.reference_pairs.clone();
        let impacts = self.impacts.clone();
        Self { pairs: pairs(), reference_pairs: pairs(), impacts, is_of_reference_runs: true }
    }
}

/// A scene ready to be computed at any approach and from any number of threads. A collision does not depend on earlier
/// ones.
pub trait Model: fmt::Debug + Send + Sync {
    /// Returns the decisions on the scene.
    fn setup(&self) -> &ModelSetup;

    /// Returns the model's support for an effect in a collision with this closed-form estimate; `None` if the model
    /// has no use for the effect.
    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support>;

    /// Computes a collision of the scene's bodies to its end or failure. An invalid request ([`OutputRequest::check`])
    /// stops it at the start. If the contact outgrows the candidate region, the collision is computed again with a
    /// larger one.
    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision;

    /// Begins a collision that is computed in pieces; `None` for a model without steps.
    fn start(&self, _: &Approach, _: &OutputRequest) -> Option<Box<dyn Stepper>> {
        None
    }

    /// Continues a collision of the same model from a restart state, to the same bits.
    ///
    /// # Errors
    /// A restart state of another model, or a model without restart states.
    fn resume(&self, _: RestartState) -> Result<Box<dyn Stepper>, Rejection> {
        let message = format!("{} cannot continue from a restart state", self.setup().description);
        Err(Rejection::new("model", message).with_help("compute the collision from its start"))
    }

    /// Begins a collision of bodies that meet again in the same place, as an ended collision of this model has left them.
    ///
    /// # Errors
    /// A model whose bodies keep no dents, or a collision that cannot be computed.
    fn again(
        &self,
        _: &RestartState,
        _: &Approach,
        _: &OutputRequest,
    ) -> Result<Box<dyn Stepper>, Stop> {
        Err(Stop::NotMade(format!("{} keeps no dents", self.setup().description)))
    }

    /// Returns the contact of the relaxed bodies under a constant force (N); `None` if the bodies flow without limit.
    ///
    /// # Errors
    /// A contact that the model cannot compute.
    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection>;

    /// Computes a collision as [`Model::collide`] does, and its contact as independent springs; `None` of a model without a
    /// distribution of its pressure, or of a collision that did not end.
    fn collide_on_springs(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> (Collision, Option<NormalSprings>) {
        (self.collide(approach, request, monitor), None)
    }

    /// Returns the meshes; `None` for a wall, or in a model without elements.
    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        [None, None]
    }
}

/// Returns the closed-form estimate of a scene at an approach speed, m/s.
pub(super) fn estimate_at(regime: &Regime, speed: f64) -> Result<Cow<'_, Estimate>, Stop> {
    regime.at(speed).map_err(|error| Stop::OutOfRange(error.to_string()))
}

/// Begins a collision, in a single piece if the model has no steps.
pub(crate) fn start_stepper(
    model: &Arc<dyn Model>,
    approach: &Approach,
    request: &OutputRequest,
) -> Box<dyn Stepper> {
    model.start(approach, request).unwrap_or_else(|| {
        let (model, approach, request) = (model.clone(), *approach, request.clone());
        let collide = move |monitor: &mut dyn Monitor| model.collide(&approach, &request, monitor);
        Box::new(SingleStep::new(approach, collide))
    })
}

/// The decisions on a scene before its collision is computed.
#[derive(Clone, Debug)]
pub struct ModelSetup {
    /// Short description of the model.
    pub description: String,
    /// Initial velocities and gap of the bodies.
    pub approach: Approach,
    /// Output request of the run.
    pub request: OutputRequest,
    /// Closed-form estimate of the collision.
    pub estimate: Estimate,
    /// Decisions on the effects, with their reasons.
    pub decisions: EffectDecisions,
    /// Warnings about keys that the case sets and the model does not read.
    pub unread_key_warnings: Vec<String>,
    /// Cost of the run.
    pub cost: Cost,
    /// Setup of the elements, for a model with meshes.
    pub elements: Option<ElementSetup>,
}

impl ModelSetup {
    /// Returns the model-form error of the restitution by the effects whose names `counts` accepts; `None` if one is unknown.
    pub(crate) fn restitution_error(
        &self,
        scene: &Scene,
        counts: impl Fn(&str) -> bool,
    ) -> Option<f64> {
        let of_effect = |decision: &EffectDecision| {
            let effect = effect_named(decision.name)?;
            let neglect_error = effect.neglect_error(scene, &self.estimate);
            let status = EffectStatus { is_lacking: decision.is_lacking, neglect_error };
            let error = effect.model_form_error(scene, &self.estimate, &status);
            error.size(QuantityOfInterest::Restitution)
        };
        let decisions = self.decisions.all.iter();
        decisions.filter(|decision| counts(decision.name)).map(of_effect).sum()
    }
}

impl ModelSetup {
    /// Returns the warnings before the run.
    pub fn warnings(&self) -> Vec<String> {
        self.decisions.warnings.iter().chain(&self.unread_key_warnings).cloned().collect()
    }
}

/// The decisions on finite elements.
#[derive(Clone, Debug)]
pub struct ElementSetup {
    /// Mesh, contact and time step.
    pub plan: Plan,
    /// Whether the contact has penalty springs.
    pub has_springs: bool,
    /// Larger moved mass of both bodies over the lighter body's mass.
    pub moved_share: f64,
    /// Advice against contact noise.
    pub noise_advice: ContactNoiseAdvice,
}

/// Cost of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cost {
    /// Every element is computed at every step.
    Steps {
        /// Elements of both bodies.
        elements: u64,
        /// Nodes of both bodies.
        nodes: u64,
        /// Number of steps until separation.
        steps: u64,
        /// Elements times steps.
        element_updates: u64,
        /// Order of magnitude of the time on one core of 3 GHz, in seconds.
        seconds: f64,
        /// Memory of the run, bytes.
        memory: u64,
        /// Memory of its condensed reference runs, bytes; `None` if there are none.
        reference_memory: Option<u64>,
        /// Time step, s.
        time_step: f64,
        /// Time step without mass scaling, in seconds.
        plain_time_step: f64,
    },
    /// The bodies are factored once.
    Factors {
        /// Elements of both bodies.
        elements: u64,
        /// Number of contact points.
        contact_points: u64,
        /// Number of steps until the contact ends.
        steps: u64,
        /// Memory of the factors, bytes.
        factor_bytes: u64,
        /// Memory of the run, bytes.
        memory: u64,
    },
    /// The run has no mesh and takes milliseconds.
    ClosedForm {
        /// The contact law, if the model has one.
        law: Option<ContactLaw>,
    },
}
