//! The model of a scene that effects have transformed: the collision is that of the transformed scene, and decisions and
//! warnings belong to the given scene.

use fem_collision::{Approach, Collision, Monitor, OutputRequest, StaticContact, Stop};
use fem_mesh::SphereMesh;

use crate::effects::{Effect, Support, Transformation, decide};
use crate::estimate::Estimate;
use crate::estimate::regime::Regime;
use crate::models::method::{Model, ModelSetup};
use crate::models::stepper::{RestartState, Stepper};
use crate::rejection::Rejection;

/// The model of a simplified scene.
#[derive(Debug)]
pub(super) struct Simplified {
    model: Box<dyn Model>,
    setup: ModelSetup,
    given: Regime,
    transformations: Vec<(&'static str, Transformation)>,
}

impl Simplified {
    /// Makes the model of a given scene from that of the transformed scene and the transformations.
    ///
    /// # Errors
    /// A switch of an effect that the model cannot obey.
    pub fn new(
        model: Box<dyn Model>,
        given: Regime,
        transformations: Vec<(&'static str, Transformation)>,
    ) -> Result<Self, Rejection> {
        let setup = ModelSetup { estimate: given.estimate.clone(), ..model.setup().clone() };
        let mut made = Self { model, setup, given, transformations };
        let Regime { scene, estimate } = &made.given;
        made.setup.decisions = decide(scene, estimate, |effect| made.support(effect, estimate))?;
        Ok(made)
    }
}

impl Model for Simplified {
    fn setup(&self) -> &ModelSetup {
        &self.setup
    }

    fn support(&self, effect: &dyn Effect, estimate: &Estimate) -> Option<Support> {
        let of_model = self.model.support(effect, estimate);
        let own = self.transformations.iter().find(|(name, _)| *name == effect.name());
        let Some((_, transformation)) = own else { return of_model };
        let relevance = effect.relevance(&self.given.scene, estimate).unwrap_or_default();
        transformation.support(of_model, &relevance.number)
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
