//! The model of a scene that effects have transformed: the collision is that of the transformed scene, and decisions and
//! warnings belong to the given scene.

use fem_case::Scene;
use fem_collision::{Approach, Collision, Monitor, OutputRequest, StaticContact, Stop};
use fem_mesh::SphereMesh;

use crate::effects::{Effect, Support, decide};
use crate::estimate::Estimate;
use crate::models::method::{Model, ModelSetup};
use crate::models::stepper::{RestartState, Stepper};
use crate::rejection::Rejection;

/// The model of a simplified scene.
#[derive(Debug)]
pub(super) struct Simplified {
    model: Box<dyn Model>,
    setup: ModelSetup,
    supports: Vec<(&'static str, Support)>,
}

impl Simplified {
    /// Makes the model of a given scene from that of the transformed scene and the supports of the effects.
    ///
    /// # Errors
    /// A switch of an effect that the model cannot obey.
    pub fn new(
        model: Box<dyn Model>,
        given: &Scene,
        supports: Vec<(&'static str, Support)>,
    ) -> Result<Self, Rejection> {
        let own = model.setup().clone();
        let estimate = Estimate::checked(given)?;
        let support = |effect: &dyn Effect| support(effect, &supports, model.as_ref(), &estimate);
        let decisions = decide(given, &estimate, support)?;
        let setup = ModelSetup { estimate, decisions, ..own };
        Ok(Self { model, setup, supports })
    }
}

/// Returns the support of the effects that transformed the scene, or else the model's support.
fn support(
    effect: &dyn Effect,
    supports: &[(&'static str, Support)],
    model: &dyn Model,
    estimate: &Estimate,
) -> Option<Support> {
    let own = supports.iter().find(|(name, _)| *name == effect.name());
    own.map(|(_, support)| support.clone()).or_else(|| model.support(effect, estimate))
}

impl Model for Simplified {
    fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        support(effect, &self.supports, self.model.as_ref(), estimate)
    }

    fn collide(
        &self,
        approach: &Approach,
        request: &OutputRequest,
        monitor: &mut dyn Monitor,
    ) -> Collision {
        self.model.collide(approach, request, monitor)
    }

    fn start(&self, approach: &Approach, request: &OutputRequest) -> Option<Box<dyn Stepper>> {
        self.model.start(approach, request)
    }

    fn resume(&self, state: RestartState) -> Result<Box<dyn Stepper>, Rejection> {
        self.model.resume(state)
    }

    fn again(
        &self,
        before: &RestartState,
        approach: &Approach,
        request: &OutputRequest,
    ) -> Result<Box<dyn Stepper>, Stop> {
        self.model.again(before, approach, request)
    }

    fn static_contact(&self, force: f64) -> Result<Option<StaticContact>, Rejection> {
        self.model.static_contact(force)
    }

    fn meshes(&self) -> [Option<&SphereMesh>; 2] {
        self.model.meshes()
    }
}
