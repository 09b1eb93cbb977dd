//! What a way to compute collisions is to the rest of the house, and what it makes of a scene.
//!
//! A [`Method`] turns a scene into a [`Model`], which computes its collision at any approach. There
//! is one file a method in `models/`, where [`METHODS`](crate::METHODS) lists them.

use std::fmt;
use std::sync::Arc;

use fem_case::{CaseFile, Scene};
use fem_collision::{Approach, Collision, Monitor, OutputRequest, StaticContact};
use fem_mesh::SphereMesh;

use crate::effects::{Answer, Decisions, Effect};
use crate::estimate::Estimate;
use crate::models::restart_state::Memory;
use crate::models::stepper::Course;
use crate::plan::Plan;
use crate::plan::contact_noise_advice::Quieter;
use crate::plan::pair_cache::PairCache;
use crate::refusal::Refusal;

/// A way to compute collisions.
pub trait Method: Sync {
    /// Its key under `[model]`.
    fn name(&self) -> &'static str;

    /// Makes the model of a scene.
    ///
    /// # Errors
    /// A scene that the method cannot compute, or not within the scene's limits.
    fn build(&self, scene: &Scene, shared: &Shared) -> Result<Box<dyn Model>, Refusal>;

    /// Element updates to come, what runs are ordered by, of a scene that could run: meshes are made
    /// and no factors, and what takes milliseconds counts as nothing.
    ///
    /// # Errors
    /// As [`Method::build`], but for what only the making shows.
    fn price(&self, scene: &Scene) -> Result<u64, Refusal>;

    /// The case as written with the method's defaults filled in, which makes the same model; what
    /// the method does not read stays as it is.
    ///
    /// # Errors
    /// As [`Method::price`].
    fn resolve(&self, scene: &Scene, file: CaseFile) -> Result<CaseFile, Refusal>;
}

/// What the models of several scenes share; a clone shares the same.
#[derive(Clone, Debug, Default)]
pub struct Shared {
    /// Condensed pairs of bodies.
    pub pairs: Arc<PairCache>,
    /// Condensed pairs of reference runs, which estimate errors.
    pub reference_pairs: Arc<PairCache>,
    /// Whether models are asked for quantities alone, and keep no factors for fields.
    pub is_of_reference_runs: bool,
}

impl Shared {
    /// Returns what reference runs share.
    pub(crate) fn for_reference_runs(&self) -> Self {
        let pairs = || self.reference_pairs.clone();
        Self { pairs: pairs(), reference_pairs: pairs(), is_of_reference_runs: true }
    }
}

/// A scene ready to be computed, at any approach and from any number of threads: what a collision
/// gives does not depend on those before it.
pub trait Model: fmt::Debug + Send + Sync {
    /// What was decided on the scene as it is.
    fn setup(&self) -> &Setup;

    /// What it has of an effect in a collision of which closed forms say this; `None` of an effect
    /// that means nothing to it.
    fn has(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Answer>;

    /// Computes a collision of the scene's bodies, as far as it gets; one that asks for what no run
    /// keeps ([`OutputRequest::check`]) does not begin. Where the contact outgrows the region in which it is
    /// looked for, the collision is computed again with a larger one.
    fn collide(
        &self,
        approach: &Approach,
        want: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision;

    /// Begins a collision that goes on in steps, as far as whoever has the course lets it go; `None` of
    /// a model that computes all in one go.
    fn start(&self, _: &Approach, _: &OutputRequest) -> Option<Box<dyn Course>> {
        None
    }

    /// Goes on from what a course of the same model knew and was asked for, to the same bits.
    ///
    /// # Errors
    /// A memory of another model, or a model that goes on from none.
    fn resume(&self, _: Memory) -> Result<Box<dyn Course>, Refusal> {
        let message = format!("{} goes on from no memory", self.setup().description);
        Err(Refusal::new("model", message).with_help("compute the collision anew"))
    }

    /// The contact of the scene's bodies under a force (N) that stays, all having relaxed; `None` of
    /// bodies that flow under it for ever.
    ///
    /// # Errors
    /// A contact that the model cannot compute.
    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Refusal>;

    /// The meshes; a wall has none, nor has a model without elements.
    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        [None, None]
    }
}

/// What was decided on a scene before its collision is computed.
#[derive(Clone, Debug)]
pub struct Setup {
    /// In a few words: what computes the collision.
    pub description: String,
    /// How the scene's bodies meet.
    pub approach: Approach,
    /// What a run of the scene is asked for.
    pub want: OutputRequest,
    /// What closed forms say.
    pub estimate: Estimate,
    /// Which effects are on, and why.
    pub decisions: Decisions,
    /// Of keys that the case gives and the model does not read.
    pub unread: Vec<String>,
    /// What the run will take.
    pub cost: Cost,
    /// Of a model with meshes.
    pub elements: Option<ElementSetup>,
}

impl Setup {
    /// What the user should know before the run.
    pub fn warnings(&self) -> Vec<String> {
        self.decisions.warnings.iter().chain(&self.unread).cloned().collect()
    }
}

/// What was decided on finite elements.
#[derive(Clone, Debug)]
pub struct ElementSetup {
    /// Mesh, contact and time step.
    pub plan: Plan,
    /// Whether springs keep the surfaces apart.
    pub has_springs: bool,
    /// Mass that is moved for a longer step, over that of the lighter body: the larger one of both bodies'.
    pub added_share: f64,
    /// What makes the contact quieter.
    pub quieter: Quieter,
}

/// What a run will take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cost {
    /// Every element is computed at every step.
    Steps {
        /// Elements of both bodies.
        elements: u64,
        /// Nodes of both bodies.
        nodes: u64,
        /// Until separation.
        steps: u64,
        /// Elements times steps.
        element_updates: u64,
        /// On one core of 3 GHz, s; an order of magnitude.
        seconds: f64,
        /// Memory of the run, bytes.
        memory: u64,
        /// Memory of its condensed reference runs, bytes; `None` if there are none.
        reference_memory: Option<u64>,
        /// Time step, s.
        time_step: f64,
        /// What it would be without mass scaling, s.
        plain_time_step: f64,
    },
    /// The bodies are factored once.
    Factors {
        /// Elements of both bodies.
        elements: u64,
        /// Points that can touch.
        contact_points: u64,
        /// Until the contact ends.
        steps: u64,
        /// Bytes of the factors.
        factor_bytes: u64,
        /// Memory of the run, bytes.
        memory: u64,
    },
    /// Milliseconds, without any mesh.
    Little {
        /// The force law, if it is one of the overlap and its rate.
        force: Option<ForceLaw>,
    },
}

/// F = K ξ^γ + C ξⁿ ξ̇, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceLaw {
    /// Stiffness K.
    pub stiffness: f64,
    /// Exponent γ of the spring.
    pub elastic_exponent: f64,
    /// Damping C.
    pub damping: f64,
    /// Exponent n of the dashpot.
    pub damping_exponent: f64,
}
